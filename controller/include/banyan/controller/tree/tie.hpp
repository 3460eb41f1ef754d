// SPDX-License-Identifier: MIT
// Neighbours that are silent, but may be there and depend on a robot, where the radio loses packets (protocol 12).
#pragma once

#include "banyan/controller/tree/robot.hpp"

namespace banyan {

inline constexpr int longest_silence_ticks = 100;  // for so long they are remembered at most

// Nothing that could hide neighbour k is near the line between us.
[[nodiscard]] bool is_in_the_clear(const TreeRobot& robot, int k) noexcept;

// Neighbour k may depend on me: it named me as parent or hold, or had neither; or I have neither, or it is my hold.
[[nodiscard]] bool may_depend(const TreeRobot& robot, int k) noexcept;

// And it is silent because packets get lost: it may not have gone, nor be hidden.
[[nodiscard]] bool is_tie(const TreeRobot& robot, int k) noexcept;

// How far neighbour k may have driven since it was heard, if its packets get lost: it knows no better where I am.
[[nodiscard]] float way_since_m(const TreeRobot& robot, int k) noexcept;
[[nodiscard]] inline float strayed_m(const TreeRobot& robot, int k) noexcept {
  constexpr int usual_ticks = 2;
  return robot.tie_ticks == 0 || robot.table().age(k) <= usual_ticks ? 0.0F : way_since_m(robot, k);
}

}  // namespace banyan
