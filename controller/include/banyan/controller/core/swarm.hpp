// SPDX-License-Identifier: MIT
// The interface between algorithms and hosts. A host (the simulated world, the page, a process on a robot)
// runs robots of one algorithm through this interface and knows nothing else of them; an algorithm knows
// nothing of its host. One virtual call serves a range of robots, so that calls inside the loop are not virtual.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/report.hpp"

namespace banyan {

// A packet as one robot received it: its sender, how many ticks ago it was sent (1: what it composed in the
// tick before), and where it was then, in the receiver's body frame (m). `age_s`: if the position is not as
// of now, how long ago it was measured, in the receiver's frame of then.
struct Packet {
  std::uint32_t sender = 0;  // index in the swarm, or a place that receive() has given
  std::uint32_t age_ticks = 1;
  Vec2 position;
  float age_s = 0.0F;
};

// What one robot has received and sensed since its last step.
struct Sensed {
  std::span<const Packet> packets;  // in any order; of several of one sender the last counts
  Senses senses;
  bool steps = true;  // false: dead or asleep. It repeats its last message.
};

// A number in a message, for recordings and inspectors.
struct FieldInfo {
  std::string_view name;
  std::string_view meaning;
  int decimals = 0;
};

class Swarm {
 public:
  virtual ~Swarm() = default;
  [[nodiscard]] virtual std::unique_ptr<Swarm> clone() const = 0;
  [[nodiscard]] virtual std::size_t size() const noexcept = 0;

  // One tick is step() for ranges that do not overlap and together are all robots, in any order and on any
  // threads, then decide() and advance(). step() writes the command and the report of each robot that steps, and
  // neither of one that does not; all spans are as long as `sensed`. No allocation after the first ticks.
  virtual void step(std::size_t first, std::span<const Sensed> sensed, std::span<Velocity> commands,
                    std::span<Report> reports) = 0;
  virtual void advance() noexcept = 0;
  // For swarms whose robots are decided for all at once, by something that is no step: called on one thread, after all
  // ranges of a tick and before advance(), or between ticks (World::decide). May change the command and the report of
  // every robot that stepped last; the spans are of all robots. May throw; the world is then worthless.
  virtual void decide(std::span<Velocity> /*commands*/, std::span<Report> /*reports*/) {}
  // Between two ticks: robot i begins anew, as a spare that knows nothing. Nothing to do where nothing is kept of it.
  virtual void restart(std::size_t /*i*/) {}

  // What robot i broadcast last, as bytes: at most largest_wire (wire.hpp). Returns how many.
  virtual std::size_t send(std::size_t i, std::span<std::uint8_t> bytes) const noexcept = 0;
  [[nodiscard]] virtual std::size_t message_bytes() const noexcept = 0;  // of each of its messages
  // A message from outside the swarm: a place that stands for its sender in packets until advance(). Nothing
  // if the bytes are none that this algorithm writes. Not while step() runs.
  virtual std::optional<std::uint32_t> receive(std::span<const std::uint8_t> bytes) = 0;

  [[nodiscard]] virtual Report report(std::size_t i) const noexcept = 0;
  // Every bit of robot i that can influence a later step, messages under way included.
  virtual void add_to(Digest& digest, std::size_t i) const noexcept = 0;
  // The numbers of a message, and those of what robot i broadcast last, or of the message that receive() has given
  // the place i, in the same order. Nobody and unknown are -1.
  [[nodiscard]] virtual std::span<const FieldInfo> message_fields() const noexcept = 0;
  virtual void message_numbers(std::size_t i, std::span<double> numbers) const noexcept = 0;

  virtual void set_line_of_sight(bool on) noexcept = 0;
  [[nodiscard]] virtual std::size_t memory_bytes() const noexcept = 0;
};

}  // namespace banyan
