// SPDX-License-Identifier: MIT
// Spare management (paper Sec. III-F, Fig. 5): stretched edges ask for a spare, spares look for
// edges, and one at a time is let in. An edge is owned by its child end.
#pragma once

#include "banyan/controller/robot.hpp"

namespace banyan {

void manage_spares(Robot& robot) noexcept;

// The edge to my parent is too long, and some worker below still wants to go on. As printed (literal)
// the second half is missing, and the first reads "smaller" (docs/algorithms.md, row 2).
[[nodiscard]] bool is_stretched(const Robot& robot) noexcept;
// A child that is no spare is in NEED.
[[nodiscard]] bool child_in_need(const Robot& robot) noexcept;

// Where a spare in EXTEND EDGE is heading: the midpoint of the edge it was granted, own frame, m.
// False if it does not know both ends.
[[nodiscard]] bool edge_midpoint(const Robot& robot, RobotId owner, Vec2& midpoint) noexcept;

// The robot a spare stays with: the nearest of the tree, else the one by which the tree is nearest. It
// keeps the one it has while that is as good: who turns to another every tick gets nowhere.
[[nodiscard]] RobotId nearest_reference(const Robot& robot) noexcept;

}  // namespace banyan
