// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/listener.hpp"

#include <array>

namespace banyan::udp {

Listener::Listener(const ListenerOptions& options, Roster& roster, KeyRing keys)
    : RemoteLink(roster),
      options_(options),
      keys_(std::move(keys)),
      socket_(options.listen),
      clock_(options.speed),
      peers_(hub_node, new_session()),
      chart_(roster.most()),
      robots_(roster.most()),
      at_first_(roster.size()),
      arrived_(roster.size()) {}

void Listener::listen() {
  std::array<std::uint8_t, largest_datagram + 1> room;
  Address from;
  while (const auto datagram = socket_.receive(room, from)) {
    Drop reason{};
    const auto envelope = authenticate(*datagram, keys_, reason);
    if (envelope && hear(*envelope, from)) continue;
    ++dropped_;
    if (!envelope) refusals_.refuse(reason, from, std::nullopt);
  }
}

// Whether it was accepted.
bool Listener::hear(const Envelope& envelope, const Address& from) {
  const Peers::Taken taken = peers_.take(envelope, clock_.now_s(), keys_);
  if (!taken.reply.empty()) socket_.send(taken.reply, from);
  if (taken.is_contested) refusals_.rival(envelope.sender, from);
  if (taken.drop) refusals_.refuse(*taken.drop, from, envelope.sender);
  if (taken.what != Peers::Taken::What::account) return !taken.drop;
  auto account = decode_account(envelope.payload);
  const auto known = roster_.with_id(envelope.sender);
  if (!account || (!known && roster_.size() >= roster_.most())) {
    refusals_.refuse(account ? Drop::misaddressed : Drop::malformed, from, envelope.sender);
    return false;
  }
  const std::size_t i = known ? *known : roster_.add(envelope.sender);
  std::erase_if(account->seen, [&](const Sighting& s) { return !roster_.with_id(s.robot); });  // they have told nothing
  for (Sighting& sighting : account->seen) sighting.robot = static_cast<RobotId>(*roster_.with_id(sighting.robot));
  Robot& robot = robots_[i];
  robot.last = account->status;
  robot.is_new = true;
  robot.heard_s = clock_.now_s();
  chart_.take(i, *account);
  ++received_;
  return true;
}

std::optional<Status> Listener::take(std::size_t i) {
  Robot& robot = robots_[i];
  return std::exchange(robot.is_new, false) ? robot.last : std::nullopt;
}

void Listener::wait_until(double moment_s, const Stopped& stopped) {
  const std::array<int, 1> descriptor{socket_.descriptor()};
  do {
    clock_.wait(descriptor, moment_s);
    listen();
  } while (!stopped() && clock_.now_s() < moment_s);
}

std::vector<std::size_t> Listener::gather(double seconds, std::size_t targets, const Stopped& stopped) {
  const double end_s = clock_.now_s() + seconds * options_.speed;
  while (!stopped() && clock_.now_s() < end_s && (!missing().empty() || chart_.targets() < targets)) {
    wait_until(clock_.now_s() + options_.tick_s, stopped);
    chart_.update();
  }
  return missing();
}

std::vector<std::size_t> Listener::missing() const {
  std::vector<std::size_t> robots = chart_.missing();
  std::erase_if(robots, [this](std::size_t robot) { return robot >= at_first_; });
  return robots;
}

FleetChanges Listener::wait_for(std::uint32_t tick, const Stopped& stopped) {
  if (!begin_s_) begin_s_ = clock_.now_s() - tick * options_.tick_s;
  const double due_s = *begin_s_ + tick * options_.tick_s;
  wait_until(due_s, stopped);
  if (const double late_s = clock_.now_s() - due_s; late_s > options_.tick_s)
    *begin_s_ += late_s;  // it was held up itself
  chart_.update();
  FleetChanges changes;
  for (std::size_t i = 0; i < arrived_; ++i) {
    Robot& robot = robots_[i];
    const bool silent = clock_.now_s() - robot.heard_s >= options_.dead_after_s;
    if (robot.dead != silent) (silent ? changes.dead : changes.joined).push_back(i);
    robot.dead = silent;
  }
  for (; arrived_ < roster_.size() && chart_.poses()[arrived_]; ++arrived_) changes.joined.push_back(arrived_);
  return changes;
}

}  // namespace banyan::udp
