// SPDX-License-Identifier: MIT
// What changes convoy's tree between reconstructions (docs/convoy.md): branches are shortened
// (shortcut.cpp), kept in sight (link_repair.cpp) and, once their workers have arrived,
// pruned (pruning.cpp). Every new parent is ahead of the robot that takes it (parent_selection.hpp).
#pragma once

#include "convoy/robot.hpp"

namespace banyan {

// Once a tick: the first of these changes that is due.
void take_shortcuts(ConvoyRobot& robot) noexcept;

inline constexpr int pending_limit_ticks = 15;  // a seqno rests at most this long; seqnos of branches differ by less

// Neighbour k belongs to the rooted tree and does not name me as parent: heard this tick or the last.
[[nodiscard]] bool is_rooted(const ConvoyRobot& robot, int k) noexcept;
[[nodiscard]] bool is_rooted_in_sight(const ConvoyRobot& robot, int k) noexcept;
// And it may be my parent now: no farther than range, and ahead of me.
[[nodiscard]] bool may_be_parent(const ConvoyRobot& robot, int k, float range) noexcept;

// Neighbour k is a worker at its target, as far as I know where that is: it cannot be towed.
[[nodiscard]] bool stands_at_target(const ConvoyRobot& robot, int k) noexcept;
// Neighbour k is a worker, and my target is in reach from its own (from where it is, if I do not know that one).
[[nodiscard]] bool reaches_target_from(const ConvoyRobot& robot, int k) noexcept;

// ---- link_repair.cpp ----

// The state of my line of sight to my parent. There must be a parent.
struct Outlook {
  bool endangered;  // hidden, warned, or a robot is near it
  bool urgent;      // hidden, warned, or a robot is about to block it
};
[[nodiscard]] Outlook outlook(const ConvoyRobot& robot) noexcept;

// Endangered: takes another parent, or lets its own seqno rest until it can.
void keep_in_sight(ConvoyRobot& robot, bool urgent) noexcept;

// I hide my parent from its own parent: I become a child of that robot, so that my parent can become my child.
// True if I did.
[[nodiscard]] bool step_before_parent(ConvoyRobot& robot) noexcept;

// The child whose line of sight to me is about to be cut; nobody if there is none.
[[nodiscard]] RobotId child_to_warn(const ConvoyRobot& robot) noexcept;

// ---- pruning.cpp ----

// My branch has arrived: takes a parent that makes a robot of the branch superfluous, now or as soon as the
// pending parent is ahead.
void prune(ConvoyRobot& robot) noexcept;

}  // namespace banyan
