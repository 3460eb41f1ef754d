// SPDX-License-Identifier: MIT
// Neighbours that are silent, but may be there and depend on a robot, where the radio loses packets, or where few
// robots are near and hide each other (protocol 12).
#pragma once

#include "banyan/controller/healing/robot.hpp"

namespace banyan {

inline constexpr int longest_silence_ticks = 100;  // for so long they are remembered at most

// Nothing that could hide neighbour k is near the line between us.
[[nodiscard]] bool is_in_the_clear(const HealingRobot& robot, int k) noexcept;

// Neighbour k may depend on me: it named me as parent or hold, or had neither; or I have neither, or it is my hold.
[[nodiscard]] bool may_depend(const HealingRobot& robot, int k) noexcept;

// And it has not been silent for so long that it is forgotten.
[[nodiscard]] bool may_be_tied(const HealingRobot& robot, int k) noexcept;

// And it is silent because packets get lost: it may not have gone, nor be hidden. In a thin start with line of sight it
// may be: nobody else may hear it.
[[nodiscard]] bool is_tie(const HealingRobot& robot, int k) noexcept;

// In a thin start with line of sight: the nearest silent neighbour to which I am tied, or which may depend on me; -1 if
// there is none.
[[nodiscard]] int missed_tie(const HealingRobot& robot) noexcept;

// How much farther away than where it was heard neighbour k may be, if it has been silent for longer than I because its
// packets get lost: it knows no better where I am, and may have driven.
[[nodiscard]] float strayed_way(const HealingRobot& robot, int k) noexcept;

// Where packets get lost many in a row, some neighbours have not been heard yet in the first rounds: nobody leaves
// them.
[[nodiscard]] inline bool awaits_the_unheard(const HealingRobot& robot) noexcept {
  return robot.has_bursts() && robot.self.turn < longest_silence_ticks;
}

}  // namespace banyan
