// SPDX-License-Identifier: MIT
// What a robot must not outgrow: its tree edges and the links that tie others to it (protocol 2, row 4; 9 and 12). And
// whom it must not push.
#pragma once

#include "banyan/controller/core/guard.hpp"
#include "healing/robot.hpp"

namespace banyan {

// Adds the edges of both trees. `lets_go`: except those to neighbours that have fallen silent and
// may be lost for good.
void guard_edges(const HealingRobot& robot, bool lets_go, Guard& guard) noexcept;

// Adds the links that tie robots without a parent to the others (hold.hpp). `lets_go`: except
// those to robots that are untied.
void guard_links(const HealingRobot& robot, bool lets_go, Guard& guard) noexcept;

// A robot that is pushed does not notice, and is wrong about places from then on. So nobody drives against a worker
// that knows its target only from others, nor does such a worker itself push; where robots hand their targets over all
// the time (passes_targets_on), nobody pushes anybody.
void push_nobody(const HealingRobot& robot, Guard& guard) noexcept;

}  // namespace banyan
