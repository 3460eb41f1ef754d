// SPDX-License-Identifier: MIT
// Any bytes at all as the packets of any algorithm: Swarm::receive() must reject them, or a robot that hears them must
// survive it and still send what others can read. The sanitizers this is built with see reads past the end.
//
// The input: which algorithm and reading, how the robot begins, where the senders are, and then packets, each with its
// length in front.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/controller/core/wire.hpp"

namespace {

using namespace banyan;
using Bytes = std::span<const std::uint8_t>;

void require(bool holds) {
  if (!holds) std::abort();
}

std::uint8_t take(Bytes& input) {
  if (input.empty()) return 0;
  const std::uint8_t first = input.front();
  input = input.subspan(1);
  return first;
}

std::unique_ptr<Swarm> one_robot(std::uint8_t choice, std::uint8_t beginning) {
  const std::vector<const Algorithm*> list(algorithms().begin(), algorithms().end());
  Setup setup;
  setup.reading = choice >= 128 ? "literal" : "corrected";
  const Member member{3, beginning % 2 == 1, beginning % 4 > 1};
  const Algorithm& algorithm = *list[choice % 128 % list.size()];
  return algorithm.fault(setup).empty() ? algorithm.make(setup, {&member, 1}) : nullptr;
}

std::optional<std::uint32_t> receive(Swarm& swarm, Bytes bytes) {
  // A copy of exactly that size on the heap, so that the sanitizer sees the first byte beyond.
  const auto copy = std::make_unique<std::uint8_t[]>(bytes.size());
  if (!bytes.empty()) std::memcpy(copy.get(), bytes.data(), bytes.size());
  return swarm.receive({copy.get(), bytes.size()});
}

std::vector<Packet> packets_of(Swarm& swarm, Bytes input, std::uint8_t where) {
  std::vector<Packet> packets;
  while (!input.empty() && packets.size() < 8) {
    const std::size_t length = std::min<std::size_t>(take(input), input.size());
    const auto place = receive(swarm, input.first(length));
    input = input.subspan(length);
    if (place)
      packets.push_back(
          {.sender = *place,
           .position = {0.01F * static_cast<float>(where), 0.2F * static_cast<float>(packets.size() + 1)}});
  }
  return packets;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes input(data, size);
  const std::uint8_t choice = take(input), beginning = take(input), where = take(input);
  const auto swarm = one_robot(choice, beginning);
  if (!swarm) return 0;
  for (int tick = 0; tick < 3; ++tick) {
    const std::vector<Packet> packets = packets_of(*swarm, input, where);
    std::array<Sensed, 1> sensed;
    sensed[0].packets = packets;
    sensed[0].senses.orders.sent = beginning % 2 == 1;
    sensed[0].senses.orders.target = Vec2{1.0F, 1.0F};
    std::array<Velocity, 1> command{};
    std::array<Report, 1> report{};
    swarm->step(0, sensed, command, report);
    require(std::isfinite(command[0].forward_m_s) && std::isfinite(command[0].turn_rad_s));
    swarm->advance();
    std::array<std::uint8_t, largest_wire> said{};
    require(swarm->receive(Bytes(said).first(swarm->send(0, said))).has_value());
    swarm->advance();
  }
  return 0;
}
