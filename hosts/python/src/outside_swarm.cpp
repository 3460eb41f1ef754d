// SPDX-License-Identifier: MIT
#include "banyan/hosts/python/outside_swarm.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace banyan::python {
namespace {

constexpr std::int32_t nobody_here = -1;
constexpr std::int32_t own_target = -2;
constexpr float rounding = 1.00001F;  // a speed beyond the limit by less than this is at the limit

std::int32_t number_of(RobotId id) noexcept { return id == nobody ? nobody_here : static_cast<std::int32_t>(id); }

// The mission fixes a worker or the root; a robot about which nothing else is said holds the network together.
Report first_report(const Member& member) noexcept {
  Report report;
  report.role = member.root ? Role::root : member.worker ? Role::worker : Role::connector;
  if (member.worker) report.serves = member.id;
  return report;
}

// The places in `packets` of at most `room`, in their order: the nearest.
std::span<const std::uint32_t> nearest(std::span<const Packet> packets, std::size_t room) {
  static thread_local std::vector<std::uint32_t> of_thread;
  std::vector<std::uint32_t>& places = of_thread;
  places.resize(packets.size());
  for (std::size_t k = 0; k < places.size(); ++k) places[k] = static_cast<std::uint32_t>(k);
  if (places.size() <= room) return places;
  const auto nearer = [&](std::uint32_t a, std::uint32_t b) {
    const float da = squared_norm(packets[a].position), db = squared_norm(packets[b].position);
    return da < db || (!(db < da) && a < b);
  };
  const auto end = places.begin() + static_cast<std::ptrdiff_t>(room);
  std::nth_element(places.begin(), end, places.end(), nearer);
  std::sort(places.begin(), end);
  return std::span(places).first(room);
}

// A robot heard twice, as with clocks of their own, counts once, by its last packet.
std::span<const Packet> each_once(std::span<const Packet> packets) {
  static thread_local std::vector<Packet> of_thread;
  std::vector<Packet>& kept = of_thread;
  kept.assign(packets.begin(), packets.end());
  std::stable_sort(kept.begin(), kept.end(), [](const Packet& a, const Packet& b) { return a.sender < b.sender; });
  std::size_t end = 0;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (k + 1 < kept.size() && kept[k + 1].sender == kept[k].sender) continue;
    kept[end++] = kept[k];
  }
  return std::span<const Packet>(kept).first(end);
}

}  // namespace

OutsideSwarm::OutsideSwarm(std::span<const Member> members, const Setup& setup, std::shared_ptr<Block> block,
                           std::size_t place, std::unique_ptr<Swarm> beneath, std::unique_ptr<Mind> mind,
                           std::span<const FieldInfo> names)
    : platform_(setup.platform),
      members_(members.begin(), members.end()),
      payload_(block->shape().payload),
      neighbours_(block->shape().neighbours),
      slots_(setup.history + 1, std::vector<std::uint8_t>(members.size() * block->shape().payload)),
      block_(std::move(block)),
      place_(place),
      beneath_(std::move(beneath)),
      mind_(std::move(mind)),
      names_(names),
      exchange_(block_->exchange(place)) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    reports_.push_back(first_report(members_[i]));
    exchange_.of<bool>(Field::worker)[i] = members_[i].worker;
    exchange_.of<bool>(Field::root)[i] = members_[i].root;
    exchange_.of<std::int8_t>(Field::own_role)[i] = static_cast<std::int8_t>(reports_[i].role);
  }
}

// A copy has arrays of its own.
OutsideSwarm::OutsideSwarm(const OutsideSwarm& other)
    : platform_(other.platform_),
      members_(other.members_),
      reports_(other.reports_),
      payload_(other.payload_),
      neighbours_(other.neighbours_),
      slots_(other.slots_),
      slot_(other.slot_),
      in_tick_(other.in_tick_),
      block_(std::make_shared<Block>(other.block_->shape())),
      beneath_(other.beneath_ ? other.beneath_->clone() : nullptr),
      mind_(other.mind_ ? other.mind_->clone() : nullptr),
      names_(other.names_),
      exchange_(block_->exchange(0)) {
  block_->copy_from(*other.block_, other.place_, 0);
}

std::unique_ptr<Swarm> OutsideSwarm::clone() const { return std::unique_ptr<Swarm>(new OutsideSwarm(*this)); }

void OutsideSwarm::step(std::size_t first, std::span<const Sensed> sensed, std::span<Velocity> commands,
                        std::span<Report> reports) {
  if (beneath_) beneath_->step(first, sensed, commands, reports);
  const std::vector<std::uint8_t>& last = slots_[slot_of(1)];
  for (std::size_t k = 0; k < sensed.size(); ++k) {
    const std::size_t i = first + k;
    exchange_.of<bool>(Field::steps)[i] = sensed[k].steps;
    // Until something else is decided it says what it said.
    if (payload_ > 0) std::memcpy(slots_[slot_].data() + i * payload_, last.data() + i * payload_, payload_);
    if (!sensed[k].steps) continue;
    sense(i, sensed[k].senses);
    hear(i, slots_.size() > 2 ? each_once(sensed[k].packets) : sensed[k].packets);
  }
  if (first == 0) in_tick_ = true;  // only one thread has the first robot
}

void OutsideSwarm::sense(std::size_t i, const Senses& senses) noexcept {
  const Vec2 target = senses.orders.target.value_or(Vec2{});
  exchange_.of<bool>(Field::sent)[i] = senses.orders.sent;
  exchange_.of<bool>(Field::has_target)[i] = senses.orders.target.has_value();
  exchange_.of<float>(Field::target)[2 * i] = target.x;
  exchange_.of<float>(Field::target)[2 * i + 1] = target.y;
  exchange_.of<std::int32_t>(Field::given_up)[i] = number_of(senses.orders.given_up);
  float* const odometry = exchange_.of<float>(Field::odometry) + 3 * i;
  odometry[0] = senses.odometry.forward_m;
  odometry[1] = senses.odometry.sideways_m;
  odometry[2] = senses.odometry.turn_rad;
  const std::size_t seen = std::min(senses.obstacles.size(), most_seen);
  std::int32_t& obstacles = exchange_.of<std::int32_t>(Field::obstacles)[i];
  float* const at = exchange_.of<float>(Field::obstacle_position) + 2 * most_seen * i;
  for (std::size_t k = 0; k < std::max(seen, static_cast<std::size_t>(obstacles)); ++k) {
    at[2 * k] = k < seen ? senses.obstacles[k].x : 0.0F;
    at[2 * k + 1] = k < seen ? senses.obstacles[k].y : 0.0F;
  }
  obstacles = static_cast<std::int32_t>(seen);
}

void OutsideSwarm::hear(std::size_t i, std::span<const Packet> packets) {
  const auto places = nearest(packets, neighbours_);
  std::int32_t& heard = exchange_.of<std::int32_t>(Field::heard)[i];
  std::int32_t* const sender = exchange_.of<std::int32_t>(Field::sender) + neighbours_ * i;
  std::int32_t* const age = exchange_.of<std::int32_t>(Field::age) + neighbours_ * i;
  float* const position = exchange_.of<float>(Field::position) + 2 * neighbours_ * i;
  std::uint8_t* const message = exchange_.of<std::uint8_t>(Field::message) + payload_ * neighbours_ * i;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Packet& packet = packets[places[k]];
    sender[k] = static_cast<std::int32_t>(packet.sender);
    age[k] = static_cast<std::int32_t>(packet.age_ticks);
    position[2 * k] = packet.position.x;
    position[2 * k + 1] = packet.position.y;
    if (payload_ > 0) std::memcpy(message + k * payload_, said(slot_of(packet.age_ticks), packet.sender), payload_);
  }
  const std::size_t before = static_cast<std::size_t>(heard);
  for (std::size_t k = places.size(); k < before; ++k) {
    sender[k] = nobody_here;
    age[k] = 0;
    position[2 * k] = position[2 * k + 1] = 0.0F;
    if (payload_ > 0) std::memset(message + k * payload_, 0, payload_);
  }
  heard = static_cast<std::int32_t>(places.size());
}

void OutsideSwarm::suggest(std::span<const Velocity> commands, std::span<const Report> reports) noexcept {
  float* const suggested = exchange_.of<float>(Field::suggested);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    suggested[3 * i] = commands[i].forward_m_s;
    suggested[3 * i + 1] = commands[i].sideways_m_s;
    suggested[3 * i + 2] = commands[i].turn_rad_s;
    exchange_.of<std::int8_t>(Field::own_role)[i] = static_cast<std::int8_t>(reports[i].role);
    exchange_.of<std::int32_t>(Field::own_parent)[i] = number_of(reports[i].parent);
  }
}

// What the wheels can do of what was decided, in its proportions. Nonsense counts as standing still.
Velocity OutsideSwarm::velocity_of(std::size_t i) const noexcept {
  const float* const v = exchange_.of<float>(Field::velocity) + 3 * i;
  if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2])) return {};
  if (platform_.drive == Drive::holonomic) {
    const float speed = norm(Vec2{v[0], v[1]});
    const float share = speed > rounding * platform_.wheel_limit_m_s ? platform_.wheel_limit_m_s / speed : 1.0F;
    return {v[0] * share, v[1] * share, v[2]};
  }
  const WheelSpeeds wheels = wheel_speeds({v[0], 0.0F, v[2]}, platform_.wheel_distance_m);
  const float fastest = std::max(std::fabs(wheels.left_m_s), std::fabs(wheels.right_m_s));
  const float share = fastest > rounding * platform_.wheel_limit_m_s ? platform_.wheel_limit_m_s / fastest : 1.0F;
  return {v[0] * share, 0.0F, v[2] * share};
}

void OutsideSwarm::report_of(std::size_t i, Report& report) const noexcept {
  const auto robot = [&](std::int32_t id) {
    return id >= 0 && static_cast<std::size_t>(id) < members_.size() ? static_cast<RobotId>(id) : nobody;
  };
  const bool sent = exchange_.of<bool>(Field::sent)[i];
  const std::int8_t role = exchange_.of<std::int8_t>(Field::role)[i];
  report.role = role >= 0 && role <= static_cast<std::int8_t>(Role::root) ? static_cast<Role>(role)
                : members_[i].root                                        ? Role::root
                : sent                                                    ? Role::worker
                                                                          : Role::connector;
  report.parent = robot(exchange_.of<std::int32_t>(Field::parent)[i]);
  const std::int32_t serves = exchange_.of<std::int32_t>(Field::serves)[i];
  report.serves = serves == own_target ? (sent ? members_[i].id : nobody) : robot(serves);
  if (report.role != Role::worker) report.serves = nobody;
  const std::int32_t* const kept = exchange_.of<std::int32_t>(Field::kept) + most_kept_links * i;
  report.kept = no_links();
  std::size_t end = 0;
  for (std::size_t k = 0; k < most_kept_links; ++k)
    if (const RobotId other = robot(kept[k]); other != nobody) report.kept[end++] = other;
}

void OutsideSwarm::decide(std::span<Velocity> commands, std::span<Report> reports) {
  if (mind_ && in_tick_) {
    if (beneath_) suggest(commands, reports);
    mind_->decide(block_);
    block_->decided(place_) = 1;
  }
  if (block_->decided(place_) == 0) {
    if (beneath_ && in_tick_) suggest(commands, reports);
    return;
  }
  block_->decided(place_) = 0;
  std::vector<std::uint8_t>& now = slots_[in_tick_ ? slot_ : slot_of(1)];
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!exchange_.of<bool>(Field::steps)[i]) continue;
    commands[i] = velocity_of(i);
    if (beneath_) continue;
    if (payload_ > 0)
      std::memcpy(now.data() + i * payload_, exchange_.of<std::uint8_t>(Field::broadcast) + i * payload_, payload_);
    report_of(i, reports_[i]);
    reports[i] = reports_[i];
    exchange_.of<std::int8_t>(Field::own_role)[i] = static_cast<std::int8_t>(reports_[i].role);
    exchange_.of<std::int32_t>(Field::own_parent)[i] = number_of(reports_[i].parent);
  }
}

void OutsideSwarm::advance() noexcept {
  if (beneath_) beneath_->advance();
  slot_ = (slot_ + 1) % slots_.size();
  in_tick_ = false;
}

std::size_t OutsideSwarm::send(std::size_t i, std::span<std::uint8_t> bytes) const noexcept {
  if (beneath_) return beneath_->send(i, bytes);
  bytes[0] = static_cast<std::uint8_t>(members_[i].id & 0xFFU);
  bytes[1] = static_cast<std::uint8_t>(members_[i].id >> 8U);
  std::copy_n(said(slot_of(1), i), payload_, bytes.begin() + id_bytes);
  return id_bytes + payload_;
}

std::size_t OutsideSwarm::message_bytes() const noexcept {
  return beneath_ ? beneath_->message_bytes() : id_bytes + payload_;
}

void OutsideSwarm::add_to(Digest& digest, std::size_t i) const noexcept {
  if (beneath_) return beneath_->add_to(digest, i);
  digest.add(reports_[i].role);
  digest.add(reports_[i].parent);
  digest.add(reports_[i].serves);
  for (std::size_t age = 1; age < slots_.size(); ++age)
    for (std::size_t k = 0; k < payload_; ++k) digest.add(said(slot_of(age), i)[k]);
}

std::span<const FieldInfo> OutsideSwarm::message_fields() const noexcept {
  return beneath_ ? beneath_->message_fields() : names_;
}

void OutsideSwarm::message_numbers(std::size_t i, std::span<double> numbers) const noexcept {
  if (beneath_) return beneath_->message_numbers(i, numbers);
  const std::uint8_t* const bytes = said(slot_of(1), i);
  const bool floats = names_.size() < payload_;
  for (std::size_t k = 0; k < names_.size(); ++k) {
    float real = 0.0F;
    if (floats) std::memcpy(&real, bytes + sizeof real * k, sizeof real);
    numbers[k] = floats ? static_cast<double>(real) : static_cast<double>(bytes[k]);
  }
}

std::size_t OutsideSwarm::memory_bytes() const noexcept {
  return sizeof(*this) + slots_.size() * members_.size() * payload_ +
         members_.size() * (sizeof(Member) + sizeof(Report)) + block_->memory_bytes() / block_->swarms() +
         (beneath_ ? beneath_->memory_bytes() : 0);
}

OutsideAlgorithm::OutsideAlgorithm(Outside outside) : outside_(std::move(outside)) {
  const std::size_t numbers = outside_.floats ? outside_.payload / sizeof(float) : outside_.payload;
  for (std::size_t k = 0; k < numbers; ++k) texts_.push_back((outside_.floats ? "m" : "b") + std::to_string(k));
  for (const std::string& text : texts_) names_.push_back({text, "a number of the message", outside_.floats ? 3 : 0});
}

std::vector<const ParameterInfo*> OutsideAlgorithm::parameters() const {
  return outside_.beneath != nullptr ? outside_.beneath->parameters() : std::vector<const ParameterInfo*>{};
}
std::vector<float> OutsideAlgorithm::values(const Setup& setup) const {
  return outside_.beneath != nullptr ? outside_.beneath->values(setup) : std::vector<float>{};
}
std::string OutsideAlgorithm::fault(const Setup& setup) const {
  return outside_.beneath != nullptr ? outside_.beneath->fault(setup) : "";
}

std::unique_ptr<Swarm> OutsideAlgorithm::make(const Setup& setup, std::span<const Member> members) const {
  auto block = outside_.block ? outside_.block
                              : std::make_shared<Block>(Shape{members.size(), outside_.neighbours, outside_.payload});
  auto mind = outside_.mind ? outside_.mind(setup, members, block) : nullptr;
  return std::make_unique<OutsideSwarm>(members, setup, std::move(block), outside_.place,
                                        outside_.beneath != nullptr ? outside_.beneath->make(setup, members) : nullptr,
                                        std::move(mind), names_);
}

}  // namespace banyan::python
