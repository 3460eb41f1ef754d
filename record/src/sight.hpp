// SPDX-License-Identifier: MIT
// Whether a robot's body blocks a line of sight, by the rules of the simulated radio.
#pragma once

#include "banyan/record/frame.hpp"
#include "banyan/world/obstacles.hpp"

namespace banyan::record {

// Whether the robot hides `a` and `b` from each other. Dead bodies do unless they vanish (robot.dead_bodies). Where
// sight leaks, the nearer of the two may look over it (radio.sight_leak). The caller leaves out a and b themselves.
[[nodiscard]] inline bool hides(const Setting& setting, const RobotFrame& robot, const RobotFrame& a,
                                const RobotFrame& b) {
  if (!(robot.alive || setting.dead_bodies)) return false;
  if (!world::blocks(world::Disc{robot.position, setting.radius_m}, a.position, b.position)) return false;
  const Vec2 along = b.position - a.position;
  const bool nearer_to_a = 2.0 * dot(robot.position - a.position, along) < squared_norm(along);
  return !(nearer_to_a ? a.raised : b.raised);
}

}  // namespace banyan::record
