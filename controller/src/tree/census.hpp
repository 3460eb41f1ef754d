// SPDX-License-Identifier: MIT
// What flows up the tree every tick: the count (paper Alg. 2), the centroid (Alg. 1), the pull of
// the targets and how far the workers still have to go.
#pragma once

#include <cstdint>

#include "tree/robot.hpp"

namespace banyan {

// Sums over the children into subtree, subtree_workers, count, q, pull, want; at the root q is the
// centroid. While trees are switched, children that know only the old tree are counted by that.
// `rest_distance`: a worker this close to its target has no distance left; `own_want`: how far this robot
// has to travel for a reason of its own.
void take_census(TreeRobot& robot, float rest_distance, float own_want = 0.0F) noexcept;

// Alg. 2 as printed, with the sum over children instead of "neighbors" (docs/algorithms.md, row 5):
// `child_count` children whose counts add up to `child_counts`, own depth (root: 1).
[[nodiscard]] std::uint32_t algorithm2_count(int child_count, std::uint32_t child_counts, std::uint32_t depth) noexcept;

// Alg. 1, line 7: what a robot adds up to its parent, in its own frame. `a`: sum of the children's
// contributions in this frame; `descendants` = c_i - d_i; `parent`: vector to the parent.
[[nodiscard]] Vec2 algorithm1_contribution(Vec2 a, std::uint32_t descendants, Vec2 parent) noexcept;

}  // namespace banyan
