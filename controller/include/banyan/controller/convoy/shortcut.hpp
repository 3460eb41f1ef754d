// SPDX-License-Identifier: MIT
// What changes convoy's tree between reconstructions (docs/convoy.md): branches are shortened
// (shortcut.cpp, rule 5), kept in sight (link repair.cpp, rule 6) and, once their workers have arrived,
// rid of robots (thrift.cpp, rule 9). Every new parent is ahead of whom it takes (parent_selection.hpp).
#pragma once

#include "banyan/controller/convoy/robot.hpp"

namespace banyan {

// Once a tick: the first of these changes that is due.
void take_shortcuts(ConvoyRobot& robot) noexcept;

inline constexpr int pending_limit_ticks = 15;  // a seqno rests no longer: more than those of two branches differ

// Neighbour k belongs to the rooted tree and does not name me as parent: heard this tick or the last.
[[nodiscard]] bool is_rooted(const ConvoyRobot& robot, int k) noexcept;
[[nodiscard]] bool is_rooted_in_sight(const ConvoyRobot& robot, int k) noexcept;
// And I may hang on it now: no farther than range_m, and ahead of me.
[[nodiscard]] bool is_hold(const ConvoyRobot& robot, int k, float range_m) noexcept;

// ---- link repair.cpp ----

// How my line of sight to my parent stands. There must be a parent.
struct Outlook {
  bool endangered;  // hidden, warned, or somebody stands near to it
  bool urgent;      // hidden, warned, or somebody stands all but in it
};
[[nodiscard]] Outlook outlook(const ConvoyRobot& robot) noexcept;

// Endangered: takes another parent, or lets its seqno rest until it can.
void keep_in_sight(ConvoyRobot& robot, bool urgent) noexcept;

// I stand where I hide my parent from its own parent: that one takes me, and my parent can hang on me.
// True if so.
[[nodiscard]] bool step_before_parent(ConvoyRobot& robot) noexcept;

// The child whose line of sight to me is about to be cut; nobody if there is none.
[[nodiscard]] RobotId child_to_warn(const ConvoyRobot& robot) noexcept;

// ---- thrift.cpp ----

// My branch has arrived: hangs on whoever makes a robot of it superfluous, now or after a wish.
void prune(ConvoyRobot& robot) noexcept;

}  // namespace banyan
