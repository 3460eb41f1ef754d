// SPDX-License-Identifier: MIT
#include "banyan/controller/core/guard.hpp"

#include <algorithm>

#include "banyan/controller/core/trig.hpp"

namespace banyan {
namespace {

// The heading to turn to for `v`. Beside an edge that must not grow, a heading slightly too far outwards stops the
// robot, and the turn is never completed: so aim a little farther inwards, once for each such edge.
Vec2 aim(Vec2 v, float speed, const Guard& guard) noexcept {
  constexpr float inwards = 0.05F;  // rad
  for (int k = 0; k < guard.size; ++k)
    if (const Guard::HalfPlane& plane = guard.planes[k]; speed * plane.x > plane.limit)
      v -= plane.away() * (speed * inwards);
  return v;
}

}  // namespace

void Guard::add(Vec2 neighbor, float longest, float rate) noexcept {
  const float d = norm(neighbor);
  if (d <= 0.0F) return;
  add_limit(-neighbor / d, 0.5F * (longest - d) * rate);
}

void Guard::add_limit(Vec2 direction, float limit) noexcept {
  if (size == capacity) return;
  planes[size++] = {direction.x, direction.y, limit};
}

Vec2 Guard::apply(Vec2 v) const noexcept {
  // Projections onto the half-planes in turn; they settle in a few rounds.
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    bool violated = false;
    for (int k = 0; k < size; ++k) {
      const float excess = dot(v, planes[k].away()) - planes[k].limit;
      if (excess <= 0.0F) continue;
      v -= planes[k].away() * excess;
      violated = true;
    }
    if (!violated) return v;
  }
  // What still violates a bound is scaled down: standing still is allowed while no edge is too long.
  float scale = 1.0F;
  for (int k = 0; k < size; ++k) {
    const float limit = planes[k].limit;
    const float along = dot(v, planes[k].away());
    if (along > limit && along > 0.0F) scale = std::min(scale, std::max(0.0F, limit) / along);
  }
  return v * scale;
}

Motion drive(Vec2 v, const Guard& guard, const Machine& machine) noexcept {
  constexpr float still = 5e-4F;     // v_max: it has no direction to turn to
  constexpr float turn_gain = 0.4F;  // of the angle in a round: more would overshoot with old news of where to go
  const float speed = norm(v);
  if (speed < still) return {};
  if (machine.drive == Drive::holonomic) return {v.x, v.y, 0.0F};
  const float turn_limit = 2.0F / machine.wheel_distance;
  const float turn = std::clamp(turn_gain * machine.rounds_per_drive * angle_of(v.x > 0.0F ? aim(v, speed, guard) : v),
                                -turn_limit, turn_limit);
  float forward = std::max(0.0F, v.x);  // |u| max(0, cos theta)
  forward = std::min(forward, 1.0F - 0.5F * std::fabs(turn) * machine.wheel_distance);
  // The guard again, along the true heading (1, 0).
  for (int k = 0; k < guard.size; ++k) {
    const Guard::HalfPlane& plane = guard.planes[k];
    if (plane.x > 0.0F && forward * plane.x > plane.limit) forward = std::max(0.0F, plane.limit) / plane.x;
  }
  return {std::max(0.0F, forward), 0.0F, turn};
}

}  // namespace banyan
