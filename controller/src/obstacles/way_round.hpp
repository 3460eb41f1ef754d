// SPDX-License-Identifier: MIT
// The way round an obstacle, by the points of its surface within the proximity sensor's reach: enough to
// slide along a wall and to follow it to its end. No map and no plan (docs/convoy.md).
#pragma once

#include <span>

#include "banyan/controller/core/guard.hpp"
#include "banyan/controller/obstacles/state.hpp"

namespace banyan {

// What a robot senses of obstacles, and how large it is, C.
struct SensedObstacles {
  std::span<const Vec2> obstacles;
  float body_radius;
  RobotId id;  // robots with the same choice choose differently
};

inline constexpr float obstacle_near = 0.095F;  // C: between body and obstacle, when it begins to matter

void carry_detour(Detour& detour, const Carry& carry) noexcept;

// The unit vector in which to drive in order to get to `goal` (own frame, C): straight, or along the
// obstacle in between. The side is chosen once, nearer to the goal, and kept until the way is free and
// the goal nearer than where the detour began; a side that leads too far is given up for the other,
// each time twice as far. Remembers it in `detour`. Zero for a zero goal.
[[nodiscard]] Vec2 bypass(const SensedObstacles& robot, Detour& detour, Vec2 goal) noexcept;

// Half-planes that keep the robot off obstacles: it slides along them and never pushes, because odometry is
// wrong when wheels slip.
void keep_off(const SensedObstacles& robot, float rate, Guard& guard) noexcept;

}  // namespace banyan
