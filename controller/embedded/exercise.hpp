// SPDX-License-Identifier: MIT
// One robot that gets bytes as from its radio, for a while: the work of firmware in each tick, reduced
// to a number. The firmware runs it on the chip, the tests on the host.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <span>

#include "banyan/controller/caravan/caravan.hpp"
#include "banyan/controller/convoy/convoy.hpp"
#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/trig.hpp"
#include "banyan/controller/paper/paper.hpp"

namespace banyan::embedded {

// The neighbours of the exercise: enough to fill a part of the table, near enough to be edges.
inline constexpr std::size_t neighbors = 8;

// What neighbour k broadcasts in a tick: the robot's own last message, as from a robot one hop nearer to the root.
template <class Message> void speak_as(std::size_t k, int tick, Message& message) noexcept {
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

inline void speak_as(std::size_t k, int tick, caravan::Message& message) noexcept {
  message.id = static_cast<RobotId>(k + 1);
  message.role = static_cast<Role>((tick / 40) % 3);
  message.root = {1, 1};
  message.beat = static_cast<Serial>(tick - static_cast<int>(k));
  message.label = static_cast<std::uint16_t>(128 * k);
  message.parent = static_cast<RobotId>(k);
}

inline void add_all(std::span<const std::uint8_t> wire, Digest& digest) noexcept {
  for (const std::uint8_t byte : wire) digest.add(byte);
}

// The state's hash belongs to the comparison of two machines, but no robot needs it: firmware is measured without.
inline constexpr bool hashes_state = BANYAN_EXERCISE_HASHES_STATE;

// A thousand ticks of a robot. In each, two of three neighbours send a message from places on a slowly turning ring,
// and the robot moves. Returns a hash of all motions, of every byte that travels and of the state at the end.
template <class Heard, class Message, class State, class Step>
std::uint64_t exercise(Step step, Drive drive, State& state, Message said, bool worker) noexcept {
  std::array<std::optional<Message>, neighbors> received;
  std::array<Heard, neighbors> heard;
  Platform platform;
  platform.drive = drive;
  Digest digest;
  for (int tick = 0; tick < 1000; ++tick) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < neighbors; ++k) {
      if ((static_cast<std::size_t>(tick) + k) % 3 == 0) continue;  // unheard: remembered, carried along
      speak_as(k, tick, said);
      std::array<std::uint8_t, wire_size<Message>()> wire;
      encode_fields(said, wire);
      add_all(wire, digest);
      received[k] = decode_fields<Message>(wire);
      if (!received[k]) continue;
      const Vec2 bearing = unit_vector(0.7F * static_cast<float>(k) + 0.01F * static_cast<float>(tick));
      heard[count++] = {&*received[k], bearing * (0.5F + 0.15F * static_cast<float>(k))};
    }
    Senses senses;
    senses.odometry = {0.01F, drive == Drive::holonomic ? 0.005F : 0.0F, 0.02F};
    senses.orders.sent = worker;
    senses.orders.target = Vec2{2.0F, 1.0F};
    const Output<Message> output = step(state, Inputs<Heard>(std::span(heard).first(count), senses, platform));
    said = output.message;
    for (const float v : {output.motion.forward, output.motion.sideways, output.motion.turn}) digest.add(v);
  }
  if constexpr (hashes_state) add_to(digest, state);
  return digest.value();
}

// Room for one robot of any algorithm. A robot's memory is known when it is built.
struct Memory {
  alignas(ConvoyState) alignas(paper::State) alignas(caravan::State)
      std::array<std::byte, std::max({sizeof(ConvoyState), sizeof(paper::State), sizeof(caravan::State)})> bytes{};
};

// Every algorithm with every drive, as connector and as worker; names and results go to `report`.
inline void exercise_all(Memory& memory, void (*report)(const char* name, std::uint64_t digest) noexcept) noexcept {
  for (const Drive drive : {Drive::differential, Drive::holonomic}) {
    for (const bool worker : {false, true}) {
      const auto of_paper = [&](const char* name, const paper::Growth& growth, const paper::Reading& reading,
                                paper::Params params) {
        params.drive = drive;
        const auto step = [&](paper::State& state, const Inputs<paper::Heard>& inputs) {
          return paper::step(growth, reading, params, state, inputs);
        };
        paper::State& state = *new (memory.bytes.data()) paper::State(paper::initial(0, worker, false));
        report(name, exercise<paper::Heard>(step, drive, state, paper::Message{}, worker));
      };
      of_paper("outwards, literal", paper::outwards, paper::literal, paper::outwards_column());
      of_paper("outwards", paper::outwards, paper::corrected, paper::outwards_column());
      of_paper("inwards, literal", paper::inwards, paper::literal, paper::inwards_column());
      of_paper("inwards", paper::inwards, paper::corrected, paper::inwards_column());
      ConvoyParams params = convoy_defaults();
      params.drive = drive;
      const auto step = [&](ConvoyState& state, const Inputs<Heard>& inputs) {
        return convoy_step(params, state, inputs);
      };
      ConvoyState& state = *new (memory.bytes.data()) ConvoyState(initial_convoy_state(0, worker, false));
      report("convoy", exercise<Heard>(step, drive, state, ConvoyMessage{}, worker));
      caravan::Params of_caravan;
      of_caravan.drive = drive;
      const auto round = [&](caravan::State& robot, const Inputs<caravan::Heard>& inputs) {
        return caravan::step(of_caravan, robot, inputs);
      };
      caravan::State& robot = *new (memory.bytes.data()) caravan::State(caravan::initial(0, worker, false));
      report("caravan", exercise<caravan::Heard>(round, drive, robot, caravan::Message{}, worker));
    }
  }
}

}  // namespace banyan::embedded
