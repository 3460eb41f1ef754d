// SPDX-License-Identifier: MIT
// What moves a robot of any baseline: its target, robots that are too near, and the limits of the links that it keeps.
#pragma once

#include <span>

#include "banyan/baselines/common/params.hpp"
#include "banyan/controller/core/guard.hpp"
#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/neighbors.hpp"

namespace banyan::baselines {

// Where a robot has been sent, as in every algorithm here: its position is updated by odometry while it is not sensed.
struct OwnTarget {
  bool sent = false;
  bool known = false;
  Vec2 target;  // C, own frame

  void follow(const Orders& orders, const Carry& carry) noexcept;
  [[nodiscard]] float away() const noexcept { return sent && known ? norm(target) : 0.0F; }
};

// Towards the target with magnitude tau, fading within the arrival distance; zero for all but workers.
[[nodiscard]] Vec2 target_pull(const OwnTarget& assignment, const BaselineParams& params) noexcept;
// From robots and obstacles nearer than A.
[[nodiscard]] Vec2 avoidance(const Neighbors& table, std::span<const Vec2> obstacles,
                             const BaselineParams& params) noexcept;
// What the motors do for u within the guard, u in units of K.
[[nodiscard]] Motion move(Vec2 u, const Guard& guard, const BaselineParams& params) noexcept;

}  // namespace banyan::baselines
