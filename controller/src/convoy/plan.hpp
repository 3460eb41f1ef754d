// SPDX-License-Identifier: MIT
// Chains from target to target (docs/convoy.md). What robots see locally never finds an edge
// between two distant targets; but all robots are told where the targets are (healing.hpp). Once all
// workers have arrived, the root plans a tree through the targets if that takes fewer robots than the
// tree has: for each target a host, the target where its branch is to begin. The plan travels down the
// tree. The topmost robot of a branch that serves one target alone leads it there: from robot to robot
// of the other branch, with its own branch in tow. The distance from a point on one side of a triangle to the
// opposite corner is largest at one of that side's ends, so a branch that ends no longer than it
// began is long enough all the way.
#pragma once

#include "convoy/robot.hpp"

namespace banyan {

// A plan is being carried out, as far as I know.
[[nodiscard]] inline bool is_planned(const ConvoyState& self) noexcept { return self.plan_ticks > 0; }

// The root: all workers have arrived some time ago. Those of branches that change their parents may be missed for a
// moment.
[[nodiscard]] bool has_settled(const ConvoyRobot& robot) noexcept;

// I lead my branch: where to, own frame, C.
[[nodiscard]] bool find_goal(const ConvoyRobot& robot, Vec2& goal) noexcept;

// I lead, and my branch is too short to go on: a spare between my parent and me would lead it farther.
[[nodiscard]] bool is_held_back(const ConvoyRobot& robot) noexcept;

// How a robot that leads its branch moves, in units of speed_gain.
[[nodiscard]] Vec2 lead(const ConvoyRobot& robot) noexcept;

// My part in it, whatever my role; once a tick, before the census.
void take_part_in_plan(ConvoyRobot& robot) noexcept;

}  // namespace banyan
