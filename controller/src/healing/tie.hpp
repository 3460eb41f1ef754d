// SPDX-License-Identifier: MIT
// Neighbours that are silent, but may be there and depend on a robot, where the radio loses packets (protocol 12).
#pragma once

#include "healing/robot.hpp"

namespace banyan {

inline constexpr int longest_silence_ticks = 100;  // for so long they are remembered at most

// Nothing that could hide neighbour k is near the line between us.
[[nodiscard]] bool is_in_the_clear(const HealingRobot& robot, int k) noexcept;

// Neighbour k may depend on me: it named me as parent or hold, or had neither; or I have neither, or it is my hold.
[[nodiscard]] bool may_depend(const HealingRobot& robot, int k) noexcept;

// And it has not been silent for so long that it is forgotten.
[[nodiscard]] bool may_be_tied(const HealingRobot& robot, int k) noexcept;

// And it is silent because packets get lost: it may not have gone, nor be hidden.
[[nodiscard]] bool is_tie(const HealingRobot& robot, int k) noexcept;

// How much farther away than where it was heard neighbour k may be, if it has been silent for longer than I because its
// packets get lost: it knows no better where I am, and may have driven.
[[nodiscard]] float strayed_way(const HealingRobot& robot, int k) noexcept;

}  // namespace banyan
