// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/hub.hpp"

#include <algorithm>
#include <cmath>

namespace banyan::udp {
namespace {

constexpr double long_pause_s = 1.0;  // the hub itself was held up: nobody counts as silent for that
constexpr double repeat_stop_s = 0.02;
constexpr double insist_s = 1.0;

}  // namespace

Hub::Hub(const HubSettings& options, Roster& roster, KeyRing keys, HubJournal* journal)
    : RemoteLink(roster),
      options_(options),
      keys_(std::move(keys)),
      journal_(journal),
      socket_(options.listen),
      clock_(options.speed),
      mission_(journal != nullptr ? journal->mission() : static_cast<std::uint32_t>(new_session())),
      session_(new_session()) {
  for (std::size_t i = 0; i < roster.size(); ++i) robots_.emplace_back(SecureChannel(hub_node, roster.id(i), session_));
}

// ---- What arrives ----

void Hub::listen() {
  std::array<std::uint8_t, largest_datagram + 1> room;
  Address from;
  while (const auto datagram = socket_.receive(room, from)) {
    Drop reason{};
    if (const auto envelope = authenticate(*datagram, keys_, reason)) take(*envelope, from);
    else refuse(reason, from, std::nullopt);
  }
}

// Somebody who is not in the roster, if there is room. Whoever has a key may knock; few are remembered who have not
// answered.
Hub::Robot* Hub::newcomer(NodeId id) {
  constexpr std::size_t most = 32;
  if (id >= most_fleet_robots || roster_.size() >= roster_.most()) return nullptr;
  if (newcomers_.size() >= most && !newcomers_.contains(id))
    std::erase_if(newcomers_, [](const auto& known) { return !known.second.address; });
  if (newcomers_.size() >= most && !newcomers_.contains(id)) return nullptr;
  return &newcomers_.try_emplace(id, SecureChannel(hub_node, id, session_)).first->second;
}

// It has joined: as one more, or as one that counted as dead.
std::size_t Hub::admit(NodeId id, std::uint32_t tick) {
  const auto known = roster_.with_id(id);
  const std::size_t i = known ? *known : roster_.add(id);
  if (!known) {
    const auto newcomer = newcomers_.find(id);
    robots_.push_back(newcomer == newcomers_.end() ? Robot(SecureChannel(hub_node, id, session_)) : newcomer->second);
    newcomers_.erase(id);
    if (tracker_ != nullptr) tracker_->welcome(i);
  }
  Robot& robot = robots_[i];
  robot.dead = robot.left = robot.is_back = robot.told_stop = robot.answered_stop = false;
  robot.expected = true;
  robot.heard_tick = tick;
  return i;
}

void Hub::refuse(Drop reason, const Address& from, std::optional<NodeId> sender) {
  ++counts_.dropped[static_cast<std::size_t>(reason)];
  refusals_.refuse(reason, from, sender);
}

void Hub::take(const Envelope& envelope, const Address& from) {
  const auto place = roster_.with_id(envelope.sender);
  Robot* const sender = place ? &robots_[*place] : newcomer(envelope.sender);
  if (sender == nullptr) return refuse(Drop::misaddressed, from, envelope.sender);
  Robot& robot = *sender;
  const SecureChannel::Taken taken = robot.channel.take(envelope, clock_.now_s(), keys_);
  if (!taken.reply.empty()) socket_.send(taken.reply, from);
  if (taken.is_contested) refusals_.rival(envelope.sender, from);
  if (taken.drop) return refuse(*taken.drop, from, envelope.sender);
  if (!taken.counts && !taken.is_met) return;
  robot.address = from;
  robot.heard_tick = tick_;
  ++counts_.received;
  if (robot.dead && taken.is_met) robot.is_back = true;
  if (envelope.kind == EnvelopeKind::stopped) (robot.told_stop ? robot.answered_stop : robot.left) = true;
  if (envelope.kind != EnvelopeKind::status) return;
  const auto status = decode_status(envelope.payload);
  if (!status) return refuse(Drop::malformed, from, envelope.sender);
  const bool is_later = envelope.session != robot.session || envelope.counter > robot.counter;
  if (!is_later) return;  // overtaken
  robot.session = envelope.session;
  robot.counter = envelope.counter;
  robot.arrived.assign(envelope.payload.begin(), envelope.payload.end());
  robot.dropped = status->dropped;
  if (status->period_us > 0) counts_.periods.add(status->period_us);
}

std::optional<Status> Hub::take(std::size_t i) {
  if (i >= robots_.size()) return std::nullopt;  // a place for somebody who joins
  Robot& robot = robots_[i];
  if (robot.arrived.empty()) return std::nullopt;
  robot.begun = true;
  auto status = decode_status(robot.arrived);
  robot.arrived.clear();
  return status;
}

// ---- What is sent ----

void Hub::send(Robot& robot, EnvelopeKind kind, const Bytes& payload) {
  if (!robot.address) return;
  if (kind == EnvelopeKind::stop) robot.told_stop = true;
  socket_.send(robot.channel.seal(kind, payload, keys_), *robot.address);
  ++counts_.sent;
}

void Hub::deliver(std::size_t i, SensorFrame frame, std::span<const Hearing> heard) {
  Robot& robot = robots_[i];
  robot.expected = false;
  if (muted_) return;
  frame.mission = mission_;
  frame.begun = robot.begun;
  send(robot, EnvelopeKind::frame, encode(frame));
  send_heard(robot, frame, heard);
}

void Hub::send_heard(Robot& robot, const SensorFrame& frame, std::span<const Hearing> heard) {
  constexpr std::size_t room = largest_datagram - header_bytes - mac_bytes;
  constexpr std::size_t fixed = 17, per_packet = 11;
  HeardBundle bundle{frame.tick, frame.odometry, {}};
  std::size_t size = fixed;
  const auto flush = [&] {
    if (!bundle.packets.empty()) send(robot, EnvelopeKind::heard, encode(bundle));
    bundle.packets.clear();
    size = fixed;
  };
  for (const Hearing& packet : heard) {
    const std::size_t more = per_packet + packet.message.size();
    if (bundle.packets.size() >= options_.bundle || size + more > room) flush();
    bundle.packets.push_back(packet);
    size += more;
  }
  flush();
}

void Hub::dismiss(std::size_t i) {
  if (i >= robots_.size()) return;
  Robot& robot = robots_[i];
  if (robot.expected || robot.is_back) return;  // another program than the one that is gone
  robot.dead = true;
  if (!muted_ && !robot.answered_stop) send(robot, EnvelopeKind::stop, {});
}

std::size_t Hub::stop_all() {
  const double end_s = clock_.now_s() + insist_s * options_.speed;
  const std::array<int, 1> descriptor{socket_.descriptor()};
  const auto waits = [](const Robot& robot) { return robot.address && !robot.answered_stop && !robot.dead; };
  while (std::any_of(robots_.begin(), robots_.end(), waits) && clock_.now_s() < end_s) {
    for (Robot& robot : robots_)
      if (waits(robot)) send(robot, EnvelopeKind::stop, {});
    const double again_s = clock_.now_s() + repeat_stop_s * options_.speed;
    while (clock_.wait(descriptor, again_s)) listen();
  }
  counts_.dropped_by_robots = 0;
  for (const Robot& robot : robots_) counts_.dropped_by_robots += robot.dropped;
  return static_cast<std::size_t>(std::count_if(robots_.begin(), robots_.end(), waits));
}

// ---- Time ----

std::vector<std::size_t> Hub::gather(double seconds, const Stopped& stopped) {
  const double end_s = clock_.now_s() + seconds * options_.speed;
  const std::array<int, 1> descriptor{socket_.descriptor()};
  std::vector<std::size_t> missing;
  do {
    listen();
    missing.clear();
    for (std::size_t i = 0; i < robots_.size(); ++i)
      if (!robots_[i].address && !robots_[i].dead) missing.push_back(i);
    if (!missing.empty()) clock_.wait(descriptor, std::min(end_s, clock_.now_s() + 0.1 * options_.speed));
  } while (!missing.empty() && !stopped() && clock_.now_s() < end_s);
  return missing;
}

void Hub::keep_time(std::uint32_t tick, const Stopped& stopped) {
  const std::array<int, 1> descriptor{socket_.descriptor()};
  if (!begin_s_) {
    begin_s_ = clock_.now_s() - tick * options_.tick_s;
    for (Robot& robot : robots_) robot.heard_tick = tick;
  }
  const double due_s = *begin_s_ + tick * options_.tick_s;
  do {
    clock_.wait(descriptor, due_s);
    listen();
  } while (!stopped() && clock_.now_s() < due_s);
  const double late_s = clock_.now_s() - due_s;
  if (late_s < options_.tick_s) return;
  ++counts_.late_ticks;
  *begin_s_ += late_s;
  if (late_s < long_pause_s) return;
  for (Robot& robot : robots_) robot.heard_tick = tick;
}

HubJournalTick Hub::arrivals(std::uint32_t tick) {
  const auto patience = static_cast<std::uint32_t>(std::lround(options_.dead_after_s / options_.tick_s));
  HubJournalTick entries;
  for (const auto& [id, robot] : newcomers_)
    if (robot.address && roster_.size() + entries.size() < roster_.most() &&
        (tracker_ == nullptr || tracker_->has_seen(id)))
      entries.push_back(HubJournalEntry::of_newcomer(id));
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Robot& robot = robots_[i];
    if (robot.is_back) entries.push_back(HubJournalEntry::of_newcomer(roster_.id(i)));
    if (!robot.arrived.empty()) entries.push_back({static_cast<std::uint16_t>(i), robot.arrived});
    if (!robot.dead && (robot.left || tick - robot.heard_tick > patience))
      entries.push_back({static_cast<std::uint16_t>(i), {}});
  }
  return entries;
}

// What the tracker sees, in as many entries as it takes.
void Hub::add_sight(HubJournalTick& entries) const {
  constexpr std::size_t most = 60000;
  const std::string lines = tracker_->lines();
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.size() - begin <= most ? lines.size() : lines.rfind('\n', begin + most) + 1;
    entries.push_back(
        {HubJournalEntry::tracker,
         {lines.begin() + static_cast<std::ptrdiff_t>(begin), lines.begin() + static_cast<std::ptrdiff_t>(end)}});
    begin = end;
  }
}

void Hub::play(std::uint32_t tick) {
  for (const HubJournalEntry& entry : journal_->recorded()[tick]) {
    if (entry.newcomer()) continue;  // in wait_for
    if (entry.robot == HubJournalEntry::tracker && tracker_ != nullptr)
      tracker_->restore({reinterpret_cast<const char*>(entry.status.data()), entry.status.size()});
    if (entry.robot < robots_.size() && !entry.status.empty()) robots_[entry.robot].arrived = entry.status;
  }
}

FleetChanges Hub::wait_for(std::uint32_t tick, const Stopped& stopped) {
  tick_ = tick;
  muted_ = is_replaying(tick);
  HubJournalTick entries;
  FleetChanges changes;
  const auto admit_all = [&] {
    for (const HubJournalEntry& entry : entries)
      if (const auto id = entry.newcomer(); id && (roster_.with_id(*id) || roster_.size() < roster_.most()))
        changes.joined.push_back(admit(*id, tick));
  };
  if (muted_) {
    entries = journal_->recorded()[tick];
    admit_all();
    play(tick);
  } else {
    keep_time(tick, stopped);
    if (tracker_ != nullptr) look_();
    entries = arrivals(tick);
    admit_all();
    if (journal_ != nullptr && tracker_ != nullptr) add_sight(entries);
    if (journal_ != nullptr) journal_->append(tick, entries);
  }
  for (const HubJournalEntry& entry : entries) {
    if (!entry.says_dead() || entry.robot >= robots_.size()) continue;
    robots_[entry.robot].dead = true;
    changes.dead.push_back(entry.robot);
  }
  return changes;
}

}  // namespace banyan::udp
