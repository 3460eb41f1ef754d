// SPDX-License-Identifier: MIT
// Leaky sight (radio.sight_leak): whose antenna looks over the bodies of other robots. In ARGoS 3 the antenna of a
// Khepera IV is level with the top of its body, and a turn of the robot rounds its height up or down in the
// last bit. So whether it is above the bodies is a draw that every turn repeats (docs/model.md).
#pragma once

#include <cmath>
#include <cstdint>

#include "banyan/world/random.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

// A function of the robot and of its heading in steps of a millionth, so that a robot that drives straight keeps its
// antenna where it is although its heading is rounded at every tick.
[[nodiscard]] inline bool is_raised(const Scenario& scenario, std::uint64_t robot, Vec2 heading) noexcept {
  constexpr double steps = 1e6;
  const auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(heading.x * steps + 0.5)));
  const auto y = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(heading.y * steps + 0.5)));
  return to_uniform(bits(scenario.seed, Purpose::antenna, robot, x, y)) < scenario.radio.sight_leak;
}

}  // namespace banyan::world
