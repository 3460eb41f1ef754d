// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/remote_swarm.hpp"

#include <algorithm>
#include <array>

namespace banyan::udp {

RemoteSwarm::RemoteSwarm(std::unique_ptr<Swarm> local, std::span<const Member> members, const Setup& setup,
                         RemoteLink& link, std::uint32_t silence)
    : SwarmElsewhere(std::move(local)),
      robots_(members.size()),
      history_(std::max<std::size_t>(1, setup.history)),
      silence_(silence),
      link_(&link),
      line_of_sight_(setup.platform.line_of_sight) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    robots_[i].member = members[i];
    robots_[i].recent.resize(history_);
  }
}

RemoteSwarm::RemoteSwarm(const RemoteSwarm& other)
    : SwarmElsewhere(other),
      robots_(other.robots_),
      history_(other.history_),
      silence_(other.silence_),
      line_of_sight_(other.line_of_sight_),
      collected_(other.collected_),
      tick_(other.tick_) {}

std::unique_ptr<Swarm> RemoteSwarm::clone() const { return std::unique_ptr<Swarm>(new RemoteSwarm(*this)); }

namespace {

// With indices in place of ids; nobody for whom the roster does not have.
Report with_indices(Report report, const Roster& roster) {
  const auto index = [&](RobotId& id) {
    const auto robot = id == nobody ? std::nullopt : roster.with_id(id);
    id = robot ? static_cast<RobotId>(*robot) : nobody;
  };
  for (RobotId* id : {&report.parent, &report.old_parent, &report.serves, &report.root, &report.grant, &report.request,
                      &report.relieves})
    index(*id);
  for (RobotId& id : report.kept) index(id);
  std::fill(std::remove(report.kept.begin(), report.kept.end(), nobody), report.kept.end(), nobody);
  return report;
}

}  // namespace

void RemoteSwarm::restart(std::size_t i) {
  SwarmElsewhere::restart(i);
  Robot fresh;
  fresh.member.id = robots_[i].member.id;
  fresh.recent.resize(history_);
  robots_[i] = std::move(fresh);
}

// A message that the algorithm does not know makes the whole status worthless.
void RemoteSwarm::hear(std::size_t i, const Status& status) {
  if (!take(i, status.message)) return;
  take(i, with_indices(status.report, link_->roster()));
  Robot& robot = robots_[i];
  robot.silent_ticks = 0;
  robot.velocity = status.velocity;
  robot.recent[slot(0)] = status.message;
  if (!robot.given_up.empty() && status.given_up_serial == static_cast<std::uint8_t>(robot.given_up_serial + 1)) {
    ++robot.given_up_serial;
    robot.given_up.pop_front();
  }
}

// What others hear in this tick must be known before the first robot is told.
void RemoteSwarm::collect() {
  if (collected_) return;
  collected_ = true;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Robot& robot = robots_[i];
    robot.recent[slot(0)].clear();
    ++robot.silent_ticks;
    const auto status = link_ != nullptr ? link_->take(i) : std::nullopt;
    if (status) hear(i, *status);
  }
  end_taking();
}

SensorFrame RemoteSwarm::frame_of(Robot& robot, const Senses& senses) const {
  SensorFrame frame;
  frame.tick = tick_;
  frame.root = robot.member.root;
  frame.worker = robot.member.worker;
  frame.sent = senses.orders.sent;
  frame.has_target = senses.orders.target.has_value();
  frame.line_of_sight = line_of_sight_;
  frame.station = senses.orders.station;
  frame.target = senses.orders.target.value_or(Vec2{});
  frame.odometry = robot.odometry;
  frame.given_up = robot.given_up.empty() ? nobody : link_->roster().id(robot.given_up.front());
  frame.given_up_serial = static_cast<std::uint8_t>(robot.given_up_serial + (robot.given_up.empty() ? 0 : 1));
  const std::size_t seen = std::min(senses.obstacles.size(), most_seen);
  frame.obstacles.assign(senses.obstacles.begin(), senses.obstacles.begin() + static_cast<std::ptrdiff_t>(seen));
  return frame;
}

void RemoteSwarm::step(std::size_t first, std::span<const Sensed> sensed, std::span<Velocity> commands,
                       std::span<Report> reports) {
  collect();
  for (std::size_t k = 0; k < sensed.size(); ++k) {
    Robot& robot = robots_[first + k];
    if (!sensed[k].steps) {
      if (link_ != nullptr) link_->dismiss(first + k);
      continue;
    }
    const Senses& senses = sensed[k].senses;
    robot.odometry = moved(robot.odometry, senses.odometry);
    if (senses.orders.given_up != nobody) robot.given_up.push_back(senses.orders.given_up);
    heard_.clear();
    for (const Packet& packet : sensed[k].packets) {
      // One tick old is what arrived in this one.
      const Bytes& message = robots_[packet.sender].recent[slot(packet.age_ticks - 1)];
      if (link_ != nullptr && !message.empty())
        heard_.push_back({link_->roster().id(packet.sender), packet.position, message});
    }
    if (link_ != nullptr) link_->deliver(first + k, frame_of(robot, senses), heard_);
    commands[k] = robot.silent_ticks > silence_ ? Velocity{} : robot.velocity;
    reports[k] = report(first + k);
  }
}

void RemoteSwarm::advance() noexcept {
  ++tick_;
  collected_ = false;
}

void RemoteSwarm::add_to(Digest& digest, std::size_t i) const noexcept {
  const Robot& robot = robots_[i];
  digest.add(robot.silent_ticks);
  digest.add(robot.odometry.position);
  digest.add(robot.odometry.turn_rad);
  SwarmElsewhere::add_to(digest, i);
}

std::size_t RemoteSwarm::memory_bytes() const noexcept {
  return sizeof(*this) - sizeof(SwarmElsewhere) + SwarmElsewhere::memory_bytes() +
         robots_.size() * (sizeof(Robot) + history_ * message_bytes());
}

AlgorithmElsewhere remote_algorithm(const Algorithm& real, RemoteLink& link, std::uint32_t silence) {
  return {real, [&link, silence](std::unique_ptr<Swarm> local, const Setup& setup, std::span<const Member> members) {
            return std::make_unique<RemoteSwarm>(std::move(local), members, setup, link, silence);
          }};
}

}  // namespace banyan::udp
