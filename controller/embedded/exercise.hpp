// SPDX-License-Identifier: MIT
// One robot fed with bytes as from its radio, for a while: what firmware does each tick, reduced to
// a number. The firmware runs it on the chip, the tests on the host.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>

#include "banyan/controller/controller.hpp"
#include "banyan/controller/trig.hpp"

namespace banyan::embedded {

// The neighbours of the exercise: enough to fill a part of the table, near enough to be edges.
inline constexpr std::size_t neighbors = 8;

// Steps `state` `ticks` times. Each tick two of three neighbours say over the wire what the robot
// itself said last, under their own id and one hop nearer to the root, from a place on a slowly
// turning ring. Returns a hash of all velocities and of the state at the end.
inline std::uint64_t exercise(const Params& params, const Policy& policy, State& state, int ticks) noexcept {
  std::array<Message, neighbors> messages;
  std::array<Heard, neighbors> heard;
  Message said{};
  std::uint64_t digest = 0xCBF29CE484222325ULL;  // FNV-1a, by words
  const auto add = [&digest](std::uint64_t word) { digest = (digest ^ word) * 0x100000001B3ULL; };
  for (int tick = 0; tick < ticks; ++tick) {
    std::size_t received = 0;
    for (std::size_t k = 0; k < neighbors; ++k) {
      if ((static_cast<std::size_t>(tick) + k) % 3 == 0) continue;  // unheard: remembered, carried along
      Message sent = said;
      sent.id = static_cast<RobotId>(k + 1);
      sent.phase = static_cast<Phase>((tick / 40) % 5);
      sent.epoch = static_cast<std::uint16_t>(tick / 200);
      sent.root = {1, 1};
      sent.label_cm = static_cast<std::uint16_t>(100 * k);
      sent.committed = k % 2 == 0;
      sent.depth = static_cast<std::uint16_t>(k + 1);
      sent.tree_hops = 0;
      sent.parent = static_cast<RobotId>(k);
      const Wire wire = encode(sent);
      const std::optional<Message> decoded = decode(wire);
      if (!decoded) continue;
      messages[received] = *decoded;
      const Vec2 bearing = unit_vector(0.7F * static_cast<float>(k) + 0.01F * static_cast<float>(tick));
      heard[received] = {&messages[received], bearing * (0.5F + 0.15F * static_cast<float>(k))};
      ++received;
    }
    const Vec2 target{2.0F, 1.0F};
    const Odometry odometry{0.01F, params.drive == Drive::holonomic ? 0.005F : 0.0F, 0.02F};
    const Output output =
        step(params, policy, state, std::span(heard).first(received), odometry, state.is_worker ? &target : nullptr);
    said = output.message;
    add(std::bit_cast<std::uint32_t>(output.velocity.forward_m_s));
    add(std::bit_cast<std::uint32_t>(output.velocity.sideways_m_s));
    add(std::bit_cast<std::uint32_t>(output.velocity.turn_rad_s));
  }
  add(hash(state));
  return digest;
}

// Every algorithm with every drive, as connector and as worker; names and results go to `report`.
inline void exercise_all(State& state, void (*report)(const char* name, std::uint64_t digest) noexcept) noexcept {
  for (const Drive drive : {Drive::differential, Drive::holonomic}) {
    for (const bool worker : {false, true}) {
      for (const Policy* policy : policies()) {
        Params params = policy->defaults(Reading::corrected);
        params.drive = drive;
        state = initial_state(0, worker, false);
        report(policy->name().data(), exercise(params, *policy, state, 1000));
      }
    }
  }
}

}  // namespace banyan::embedded
