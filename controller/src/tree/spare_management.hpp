// SPDX-License-Identifier: MIT
// Spare management (paper Sec. III-F, Fig. 5): stretched edges ask for a spare, spares look for
// edges, and each edge lets one in at a time. An edge is owned by its child end.
#pragma once

#include "banyan/controller/core/function_ref.hpp"
#include "tree/robot.hpp"

namespace banyan {

// What differs between the algorithms about edges and the spares that join them.
struct EdgeRule {
  FunctionRef<bool()> needs_spare;                      // the edge to my parent, or one below it, wants a spare
  FunctionRef<bool()> may_call;                         // an unanswered need calls spares from afar (protocol 7)
  FunctionRef<void(bool unserved)> count_waiting;       // keeps unserved_ticks
  FunctionRef<bool(int owner, int parent)> may_insert;  // a spare whose edge is granted joins it from where it is
};

void manage_spares(TreeRobot& robot, const EdgeRule& rule) noexcept;

// Ticks in NEED without a grant.
void count_unserved(TreeRobot& robot, bool unserved) noexcept;

// The edge to my parent is too long, and some worker below still has to travel. As printed (literal)
// the second half is missing, and the first reads "smaller" (docs/algorithms.md, row 2).
[[nodiscard]] bool is_stretched(const TreeRobot& robot) noexcept;
// A child that is not a spare is in NEED.
[[nodiscard]] bool child_in_need(const TreeRobot& robot) noexcept;

// Where a spare in EXTEND EDGE is heading: the midpoint of the edge it was granted, own frame, C.
// False if it does not know both ends.
[[nodiscard]] bool edge_midpoint(const TreeRobot& robot, RobotId owner, Vec2& midpoint) noexcept;

// The robot a spare stays with: the nearest of the tree, else the one through which the tree is nearest. It keeps
// its present reference while that is as good, because a robot that turns to another every tick gets nowhere.
[[nodiscard]] RobotId nearest_reference(const TreeRobot& robot) noexcept;

}  // namespace banyan
