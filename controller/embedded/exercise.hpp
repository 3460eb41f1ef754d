// SPDX-License-Identifier: MIT
// One robot that gets bytes as from its radio, for a while: the work of firmware in each tick, reduced
// to a number. The firmware runs it on the chip, the tests on the host.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <new>
#include <optional>
#include <span>

#include "banyan/controller/convoy/convoy.hpp"
#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/function_ref.hpp"
#include "banyan/controller/core/trig.hpp"
#include "banyan/controller/healing/tick.hpp"
#include "banyan/controller/inwards.hpp"
#include "banyan/controller/outwards.hpp"

namespace banyan::embedded {

// The neighbours of the exercise: enough to fill a part of the table, near enough to be edges.
inline constexpr std::size_t neighbors = 8;

// What neighbour k broadcasts in a tick: the robot's own last message, as from a robot one hop nearer to the root.
inline void speak_as(std::size_t k, int tick, TreeMessage& message) noexcept {
  message.id = static_cast<RobotId>(k + 1);
  message.phase = static_cast<Phase>((tick / 40) % 5);
  message.epoch = static_cast<Serial>(tick / 200);
  message.root = {1, 1};
  message.label = static_cast<std::uint16_t>(128 * k);
  message.committed = k % 2 == 0;
  message.depth = static_cast<std::uint16_t>(k + 1);
  message.tree_hops = 0;
  message.parent = static_cast<RobotId>(k);
}

inline void add_all(std::span<const std::uint8_t> wire, Digest& digest) noexcept {
  for (const std::uint8_t byte : wire) digest.add(byte);
}

// A thousand ticks of a robot. In each, two of three neighbours send a message (`say`: what reaches the robot over
// the wire; null if it is rejected) from places on a slowly turning ring, and the robot moves (`move`). Velocities
// go to `digest`.
inline void run(bool worker, Drive drive, FunctionRef<const TreeMessage*(std::size_t, int)> say,
                FunctionRef<Velocity(std::span<Heard>, const Senses&)> move, Digest& digest) noexcept {
  std::array<Heard, neighbors> heard;
  for (int tick = 0; tick < 1000; ++tick) {
    std::size_t received = 0;
    for (std::size_t k = 0; k < neighbors; ++k) {
      if ((static_cast<std::size_t>(tick) + k) % 3 == 0) continue;  // unheard: remembered, carried along
      const TreeMessage* const message = say(k, tick);
      if (message == nullptr) continue;
      const Vec2 bearing = unit_vector(0.7F * static_cast<float>(k) + 0.01F * static_cast<float>(tick));
      heard[received++] = {message, bearing * (0.5F + 0.15F * static_cast<float>(k))};
    }
    Senses senses;
    senses.odometry = {0.01F, drive == Drive::holonomic ? 0.005F : 0.0F, 0.02F};
    senses.orders.sent = worker;
    senses.orders.target = Vec2{2.0F, 1.0F};
    const Velocity velocity = move(std::span(heard).first(received), senses);
    for (const float v : {velocity.forward_m_s, velocity.sideways_m_s, velocity.turn_rad_s}) digest.add(v);
  }
}

// The state's hash belongs to the comparison of two machines, but no robot needs it: firmware is measured without.
inline constexpr bool hashes_state = BANYAN_EXERCISE_HASHES_STATE;

// The same for an algorithm. Returns a hash of all velocities, of every byte that travels and of the state at the end.
template <class Message, class Params, class State>
std::uint64_t exercise(Output<Message> (*step)(const Params&, State&, const Inputs<Heard>&) noexcept,
                       const Params& params, State& state) noexcept {
  std::array<std::optional<Message>, neighbors> received;
  Message said{};
  Digest digest;
  const auto say = [&](std::size_t k, int tick) -> const TreeMessage* {
    speak_as(k, tick, said);
    std::array<std::uint8_t, wire_size<Message>()> wire;
    encode_fields(said, wire);
    add_all(wire, digest);
    received[k] = decode_fields<Message>(wire);
    return received[k] ? &*received[k] : nullptr;
  };
  const auto move = [&](std::span<Heard> heard, const Senses& senses) {
    const Output<Message> output = step(params, state, {heard, senses, Platform{}});
    said = output.message;
    return velocity_of(output.motion, Platform{});
  };
  run(state.is_worker, params.drive, say, move, digest);
  if constexpr (hashes_state) add_to(digest, state);
  return digest.value();
}

// Room for one robot of any algorithm: convoy's state has the others' in it. A robot's memory is known when it is
// built.
using Memory = ConvoyState;

// Every algorithm with every drive, as connector and as worker; names and results go to `report`.
inline void exercise_all(Memory& memory, void (*report)(const char* name, std::uint64_t digest) noexcept) noexcept {
  for (const Drive drive : {Drive::differential, Drive::holonomic}) {
    for (const bool worker : {false, true}) {
      const auto begin = [&]() -> Memory& { return *new (&memory) Memory(initial_convoy_state(0, worker, false)); };
      const auto as_tree = [&](const char* name, auto step, HealingParams (*defaults)() noexcept) {
        HealingParams params = defaults();
        params.drive = drive;
        report(name, exercise<TreeMessage, TreeParams, TreeState>(step, params, begin()));
      };
      const auto as_healing = [&](const char* name, auto step, HealingParams (*defaults)() noexcept) {
        HealingParams params = defaults();
        params.drive = drive;
        report(name, exercise<HealingMessage, HealingParams, HealingState>(step, params, begin()));
      };
      as_tree("outwards, literal", outwards_literal_step, outwards_defaults);
      as_healing("outwards", outwards_step, outwards_defaults);
      as_tree("inwards, literal", inwards_literal_step, inwards_defaults);
      as_healing("inwards", inwards_step, inwards_defaults);
      ConvoyParams params = convoy_defaults();
      params.drive = drive;
      report("convoy", exercise<ConvoyMessage, ConvoyParams, ConvoyState>(convoy_step, params, begin()));
    }
  }
}

}  // namespace banyan::embedded
