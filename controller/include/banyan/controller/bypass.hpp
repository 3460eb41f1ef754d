// SPDX-License-Identifier: MIT
// Obstacles, as far as a robot knows them: points of their surfaces within its proximity sensor's reach,
// and a few that it has passed. Enough to slide along a wall, to follow it to its end, and to keep
// a tree edge's line of sight from being cut by a corner. No map and no plan (docs/convoy.md).
#pragma once

#include "banyan/controller/robot.hpp"

namespace banyan {

struct Guard;  // motion.hpp

// Files what is sensed this tick among the remembered points, and forgets those that proved wrong.
// Once a tick, after the memory has been carried along.
void remember_obstacles(Robot& robot) noexcept;

// The obstacle point nearest to the inside of the edge to my parent, own frame, m; false if none is near.
[[nodiscard]] bool find_hinge(const Robot& robot, Vec2& hinge) noexcept;

// The unit vector in which to drive in order to get to `goal` (own frame, m): straight, or along the
// obstacle in between. The side is chosen once, nearer to the goal, and kept until the way is free and
// the goal nearer than where the detour began; a side that leads too far is given up for the other,
// each time twice as far. Remembers the detour in the state. Zero for a zero goal.
[[nodiscard]] Vec2 bypass(const Robot& robot, Vec2 goal) noexcept;

// Half-planes that keep the robot off obstacles: it slides along them, and never pushes, because
// wheels that slip tell lies.
void keep_off(const Robot& robot, Guard& guard) noexcept;

// Half-planes that keep obstacles out of the lines of sight along the robot's tree edges.
void keep_sight(const Robot& robot, Guard& guard) noexcept;

// Away from obstacles that are about to cut one of the robot's tree edges. In units of speed_gain.
[[nodiscard]] Vec2 clear_sight(const Robot& robot) noexcept;

// An obstacle is about to cut the edge to the parent and holds this robot back, which must go on: the
// parent has to come up to the corner.
[[nodiscard]] bool is_pinned(const Robot& robot) noexcept;

// No obstacle known to me is nearer than `clearance_m` to the inside of segment a-b (own frame, m).
[[nodiscard]] bool is_free(const Robot& robot, Vec2 a, Vec2 b, float clearance_m) noexcept;

}  // namespace banyan
