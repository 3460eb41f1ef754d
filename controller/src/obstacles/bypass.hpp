// SPDX-License-Identifier: MIT
// The way round an obstacle, for robots of the tree.
#pragma once

#include "obstacles/way_round.hpp"
#include "tree/robot.hpp"

namespace banyan {

[[nodiscard]] inline SensedObstacles sensed_obstacles(const TreeRobot& robot) noexcept {
  return {robot.obstacles, robot.params.body_radius, robot.self.id};
}
[[nodiscard]] inline Vec2 bypass(const TreeRobot& robot, Detour& detour, Vec2 goal) noexcept {
  return bypass(sensed_obstacles(robot), detour, goal);
}
inline void keep_off(const TreeRobot& robot, Guard& guard) noexcept {
  keep_off(sensed_obstacles(robot), robot.params.guard_rate, guard);
}

}  // namespace banyan
