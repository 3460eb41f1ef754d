// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/relay.hpp"

#include <algorithm>
#include <array>

namespace banyan::udp {

Relay::Relay(const Address& listen, const Address& hub, const Impairment& hop, std::uint64_t seed, double speed)
    : front_(listen),
      hub_(hub),
      hop_(hop),
      clock_(speed),
      speed_(speed),
      random_(seed),
      descriptors_{front_.descriptor()} {}

// SplitMix64.
double Relay::draw() noexcept {
  random_ += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = random_;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
}

std::size_t Relay::side_of(const Address& robot) {
  const auto at = std::find_if(sides_.begin(), sides_.end(), [&](const Side& side) { return side.robot == robot; });
  if (at != sides_.end()) return static_cast<std::size_t>(at - sides_.begin());
  sides_.push_back({robot, Socket(Address{}), {}});
  descriptors_.push_back(sides_.back().socket.descriptor());
  return sides_.size() - 1;
}

void Relay::impair(std::size_t side, bool to_hub, ByteView datagram) {
  ++taken_;
  const int copies = draw() < hop_.duplicate ? 2 : 1;
  for (int copy = 0; copy < copies; ++copy) {
    if (draw() < hop_.loss || sides_[side].under_way[to_hub ? 1 : 0] == most_under_way) continue;
    const double now_s = clock_.now_s();
    double sent_s = now_s;
    if (hop_.rate_bytes_s > 0.0) {
      double& free_s = sides_[side].free_s[to_hub ? 1 : 0];
      sent_s = free_s = std::max(free_s, now_s) + static_cast<double>(datagram.size()) / hop_.rate_bytes_s;
    }
    const bool overtakes = draw() < hop_.reorder;
    const double delay_s = std::max(0.0, hop_.delay_s + hop_.jitter_s * (2.0 * draw() - 1.0));
    ++sides_[side].under_way[to_hub ? 1 : 0];
    flights_.push(
        {overtakes ? sent_s : sent_s + delay_s, taken_, side, to_hub, Bytes(datagram.begin(), datagram.end())});
  }
}

void Relay::take_in() {
  std::array<std::uint8_t, 65536> room;
  Address from;
  while (const auto datagram = front_.receive(room, from)) impair(side_of(from), true, *datagram);
  for (std::size_t k = 0; k < sides_.size(); ++k)
    while (const auto datagram = sides_[k].socket.receive(room, from))
      if (from == hub_) impair(k, false, *datagram);
}

void Relay::hand_on() {
  while (!flights_.empty() && flights_.top().due_s <= clock_.now_s()) {
    const Flight& flight = flights_.top();
    Side& side = sides_[flight.side];
    if (flight.to_hub) side.socket.send(flight.bytes, hub_);
    else front_.send(flight.bytes, side.robot);
    --side.under_way[flight.to_hub ? 1 : 0];
    ++handed_on_;
    flights_.pop();
  }
}

void Relay::pump(double seconds) {
  const double end_s = clock_.now_s() + seconds * speed_;
  do {
    clock_.wait(descriptors_, flights_.empty() ? end_s : std::min(end_s, flights_.top().due_s));
    take_in();
    hand_on();
  } while (clock_.now_s() < end_s);
}

}  // namespace banyan::udp
