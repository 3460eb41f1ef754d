// SPDX-License-Identifier: MIT
// Whether a robot's body stands in the way of a line of sight, as the simulated radio has it.
#pragma once

#include "banyan/record/frame.hpp"
#include "banyan/world/obstacles.hpp"

namespace banyan::record {

// Dead bodies hide what is behind them unless they vanish (robot.dead_bodies). The ends of the line,
// a and b, are not asked about: leave their robots out.
[[nodiscard]] inline bool hides(const Setting& setting, const RobotFrame& robot, Vec2 a, Vec2 b) {
  return (robot.alive || setting.dead_bodies) && world::blocks(world::Disc{robot.position, setting.radius_m}, a, b);
}

}  // namespace banyan::record
