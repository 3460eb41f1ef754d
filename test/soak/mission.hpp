// SPDX-License-Identifier: MIT
// Random missions of every kind, each a function of (seed, index) alone: what a soak finds can be run
// again by itself (docs/soak.md).
#pragma once

#include <cstdint>
#include <string>

#include "banyan/world/scenario.hpp"

namespace banyan::soak {

[[nodiscard]] world::Scenario mission(std::uint64_t seed, std::uint64_t index);

// What a mission has in it that makes its invariants weaker; read off the scenario, however it was made.
struct Traits {
  bool deaths = false;  // robots die
  bool noise = false;   // of sensors, wheels or odometry
  bool obstacles = false;
  bool changes = false;      // targets move, appear or are given up; robots freeze
  bool clocks = false;       // of their own, or latency
  bool loose = false;        // the start is no compact cluster
  bool small_radio = false;  // C below 2 m
  bool rough_radio = false;  // no disc with independent losses of at most 0.3
  bool many = false;         // more than 12 targets
};
[[nodiscard]] Traits traits_of(const world::Scenario& scenario);
// "loose start, obstacles": for people; "plain" if there is nothing.
[[nodiscard]] std::string text_of(const Traits& traits);

}  // namespace banyan::soak
