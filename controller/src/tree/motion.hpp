// SPDX-License-Identifier: MIT
// Robot motion (paper Sec. III-G, protocol 9): virtual forces, and the limits for the guard (core/guard.hpp).
#pragma once

#include "banyan/controller/core/guard.hpp"
#include "tree/robot.hpp"

namespace banyan {

// A robot nearer than this is where I am: it has no direction, and powers of 1 / d would overflow.
inline constexpr float same_spot = 1e-6F;

// Visits the index of every neighbour at the other end of an edge of mine, old or new, once: parents first.
template <class Visit> void for_each_tree_neighbor(const TreeRobot& robot, Visit visit) noexcept {
  if (robot.parent >= 0) visit(robot.parent);
  if (robot.old_parent >= 0 && robot.old_parent != robot.parent) visit(robot.old_parent);
  for (const IndexList* below : {&robot.children, &robot.old_children})
    for (const int k : *below)
      if (k != robot.parent && k != robot.old_parent) visit(k);
}

// u^avoid: repulsion from robots nearer than A that are no tree neighbours, and from obstacles.
[[nodiscard]] Vec2 avoidance(const TreeRobot& robot) noexcept;

// The velocity (v_max, own frame) nearest to `u`, in units of speed_gain, within the guard and the wheels' limits.
[[nodiscard]] Vec2 allowed(Vec2 u, const Guard& guard, const TreeParams& params) noexcept;

}  // namespace banyan
