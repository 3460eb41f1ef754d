// SPDX-License-Identifier: MIT
// Lines of sight as a robot can judge them: between points of its own frame, past the robots it
// knows of. A body in between will silence a radio that needs a free line.
#pragma once

#include "banyan/controller/core/function_ref.hpp"
#include "obstacles/corners.hpp"
#include "tree/robot.hpp"

namespace banyan {

inline constexpr float narrow = 0.5F;                // of `clearance`: just past a body, better than nothing
inline constexpr float obstacle_clearance = 0.025F;  // C: a tree edge must pass a corner at least this far away

// Every robot that is in the way matters.
inline constexpr auto none_is_passed = [](int /*k*/) { return false; };

// No robot of the table but neighbours `i` and `j` (-1: none) is nearer than `clearance` to the inside
// of segment a-b, unless `is_passed` says that it does not matter; nor am I, unless an end is where I am.
// O(neighbours).
[[nodiscard]] bool is_clear(const TreeRobot& robot, const Corners& corners, Vec2 a, Vec2 b, int i, int j,
                            float clearance, FunctionRef<bool(int k)> is_passed = none_is_passed) noexcept;

// The same for the segment from me to neighbour k.
[[nodiscard]] bool sees_clearly(const TreeRobot& robot, const Corners& corners, int k, float clearance,
                                FunctionRef<bool(int k)> is_passed = none_is_passed) noexcept;

// How many ticks of silence a lossy radio makes unlikely (about one in a hundred): longer ones mean
// that something stands between. 0 without loss.
[[nodiscard]] inline int usual_silence_ticks(const TreeRobot& robot) noexcept { return robot.loss_ticks * 2 / 5; }

}  // namespace banyan
