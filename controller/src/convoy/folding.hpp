// SPDX-License-Identifier: MIT
// A second path with line of sight, once a branch arrives (docs/lasting.md): it folds. Its edges get so short that each
// robot hears its grandparent, past its parent, which steps out of the line between the two. So hardly a robot of the
// tree needs a companion any more, and nobody stands beside the edges and hides them. With mission.link_redundancy = k
// edges are at most a k-th of a link long. It is the companions that came along which join the edges.
#pragma once

#include "convoy/robot.hpp"

namespace banyan {

// The mission asks for more paths than one, and robots hide others. Not with more targets than a robot remembers, since
// robots are missed then, nor with thrift above 0, which asks for fewer robots, nor on batteries, where somebody calls
// nearly all the time.
[[nodiscard]] bool may_fold(const ConvoyRobot& robot) noexcept;

// A branch begins to fold when its workers still have so far to go.
inline constexpr float folds_from = 0.3F;

// My branch folds. Not while an edge in need calls: its tree comes first.
[[nodiscard]] bool folds(const ConvoyRobot& robot) noexcept;

// The branch of a neighbour that says `m` does not fold yet.
[[nodiscard]] inline bool is_under_way(const TreeStanding& m) noexcept {
  constexpr auto from = static_cast<int>(per_range * folds_from);
  return m.want >= from;
}

// The longest edge of a branch that has folded, C.
[[nodiscard]] float folded_edge(const ConvoyParams& params) noexcept;

// The longest link that a branch that has folded relies on, C.
inline constexpr float folded_reach = 0.96F;

// My edge to my parent (there must be one) is too long or hidden. A worker's does not count before it has arrived: its
// companion would come between it and its parent.
[[nodiscard]] bool wants_fold(const ConvoyRobot& robot) noexcept;

// The edge between these two neighbours folds, and I am not near its middle yet: there is no point in joining it here.
[[nodiscard]] bool is_off_middle(const ConvoyRobot& robot, int owner, int parent) noexcept;

// Neighbour k is the worker at the end of a branch that travels: it has a companion, too, for the edge that it will
// have to fold.
[[nodiscard]] bool leads_travelling(const ConvoyRobot& robot, int k) noexcept;

// How a robot of a branch that folds moves, in units of speed_gain: long edges draw it, those to its children sooner.
// So what is missing far out is soon missing near the root, where the spares are. If it does not hear its grandparent
// although its parent's edge is not in need, somebody stands between the two: it moves sideways.
[[nodiscard]] Vec2 folding_motion(const ConvoyRobot& robot) noexcept;

// Out of the lines between robots and their grandparents, in units of speed_gain: away from the parent between them,
// since on that side are its edges. From within `width` of the line.
[[nodiscard]] Vec2 clear_folds(const ConvoyRobot& robot, float width) noexcept;

}  // namespace banyan
