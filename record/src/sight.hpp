// SPDX-License-Identifier: MIT
// Whether a robot's body blocks a line of sight, by the rules of the simulated radio.
#pragma once

#include "banyan/record/frame.hpp"
#include "banyan/world/obstacles.hpp"

namespace banyan::record {

// Dead bodies hide what is behind them unless they vanish (robot.dead_bodies). The ends of the line, a and
// b, are not tested: the caller leaves their robots out.
[[nodiscard]] inline bool hides(const Setting& setting, const RobotFrame& robot, Vec2 a, Vec2 b) {
  return (robot.alive || setting.dead_bodies) && world::blocks(world::Disc{robot.position, setting.radius_m}, a, b);
}

}  // namespace banyan::record
