// SPDX-License-Identifier: MIT
// The way round an obstacle, by the points of its surface within the proximity sensor's reach: enough to
// slide along a wall and to follow it to its end. No map and no plan (docs/convoy.md).
#pragma once

#include <span>

#include "banyan/controller/core/guard.hpp"

namespace banyan {

// What a robot senses of obstacles, and how large it is, C.
struct SensedObstacles {
  std::span<const Vec2> obstacles;
  float body_radius;
  RobotId id;  // robots with the same choice choose differently
};

// A way round an obstacle that a robot is driving; vectors in its own frame, C.
struct Detour {
  std::int8_t side = 0;       // +1: the obstacle is to the right, -1: to the left, 0: no detour
  std::int8_t last_side = 0;  // of the one that ended near here; 0: none did
  bool again = false;         // it continues one that ended in vain
  Vec2 contact;               // where the obstacle was touched last
  Vec2 origin;                // where the detour began
  Vec2 goal;                  // as it was then
  float leave = 0.0F;         // the detour is over when the goal is nearer than this
  float span = 0.0F;          // this far from the origin the other side is tried
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
