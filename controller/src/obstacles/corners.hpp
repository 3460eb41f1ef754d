// SPDX-License-Identifier: MIT
// Lines of sight past obstacles: a robot remembers a few of the points that it has passed, so that no
// tree edge is cut by a corner. Children tell their parent of the corner nearest to their edge.
#pragma once

#include "banyan/controller/obstacles/state.hpp"
#include "tree/robot.hpp"

namespace banyan {

struct Guard;  // motion.hpp

void carry_corners(Corners& corners, const Carry& carry) noexcept;

// Adds what is sensed this tick to the remembered points, and forgets those that have proved wrong.
// Once a tick, after the memory has been carried along.
void remember_corners(const TreeRobot& robot, Corners& corners) noexcept;

// The obstacle point nearest to the inside of the edge to my parent, own frame, C; false if none is near.
[[nodiscard]] bool find_hinge(const TreeRobot& robot, const Corners& corners, Vec2& hinge) noexcept;

// Half-planes that keep obstacles out of the lines of sight along the robot's tree edges.
void keep_sight(const TreeRobot& robot, const Corners& corners, Guard& guard) noexcept;

// Away from obstacles that are about to cut one of the robot's tree edges. In units of speed_gain.
[[nodiscard]] Vec2 clear_sight(const TreeRobot& robot, const Corners& corners) noexcept;

// An obstacle is about to cut the edge to the parent, and this robot has to travel, or is towed by a child farther
// away than `towing_start`: the parent has to come up to the corner.
[[nodiscard]] bool is_pinned(const TreeRobot& robot, const Corners& corners, float towing_start) noexcept;

// No obstacle known to me is nearer than `clearance` to the inside of segment a-b (own frame, C).
[[nodiscard]] bool is_free(const TreeRobot& robot, const Corners& corners, Vec2 a, Vec2 b, float clearance) noexcept;

}  // namespace banyan
