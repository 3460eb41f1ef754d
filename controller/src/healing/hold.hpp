// SPDX-License-Identifier: MIT
// What ties a robot to the others while it has no parent: its hold (protocol 12, corrected). It obeys the order
// of the tree (is_ahead), so parents, old parents and holds lead from each robot towards the root and never in a
// circle, and both ends guard every such link. A robot without a hold stays in range of all that it hears,
// and they of it. So a network that begins in one piece stays in one, in every phase and from every start.
#pragma once

#include "healing/robot.hpp"

namespace banyan {

// Sets robot.hold, and lets a spare keep up with the order. -1: it has a parent or is the root, or knows of
// no robot that is tied to one.
void find_hold(HealingRobot& robot) noexcept;

}  // namespace banyan
