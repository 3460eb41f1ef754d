// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/listener.hpp"

#include <array>

namespace banyan::udp {

Listener::Listener(const ListenerOptions& options, std::size_t robots, KeyRing keys)
    : options_(options),
      keys_(std::move(keys)),
      socket_(options.listen),
      clock_(options.speed),
      peers_(hub_node, new_session()),
      chart_(robots),
      robots_(robots) {}

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
  const auto account = decode_account(envelope.payload);
  if (!account || envelope.sender >= robots_.size()) {
    refusals_.refuse(account ? Drop::misaddressed : Drop::malformed, from, envelope.sender);
    return false;
  }
  Robot& robot = robots_[envelope.sender];
  robot.last = account->status;
  robot.is_new = true;
  robot.heard_s = clock_.now_s();
  chart_.take(envelope.sender, *account);
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
  while (!stopped() && clock_.now_s() < end_s && (!chart_.missing().empty() || chart_.targets() < targets)) {
    wait_until(clock_.now_s() + options_.tick_s, stopped);
    chart_.update();
  }
  return chart_.missing();
}

std::vector<std::size_t> Listener::wait_for(std::uint32_t tick, const Stopped& stopped) {
  if (!begin_s_) begin_s_ = clock_.now_s() - tick * options_.tick_s;
  const double due_s = *begin_s_ + tick * options_.tick_s;
  wait_until(due_s, stopped);
  if (const double late_s = clock_.now_s() - due_s; late_s > options_.tick_s)
    *begin_s_ += late_s;  // it was held up itself
  chart_.update();
  std::vector<std::size_t> dead;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Robot& robot = robots_[i];
    if (robot.dead || clock_.now_s() - robot.heard_s < options_.dead_after_s) continue;
    robot.dead = true;
    dead.push_back(i);
  }
  return dead;
}

}  // namespace banyan::udp
