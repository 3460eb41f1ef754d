// SPDX-License-Identifier: MIT
// Numbers as they travel: whole multiples of a unit, saturated.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "banyan/controller/core/robot_id.hpp"

namespace banyan {

inline constexpr float per_cm = 100.0F;  // units in a metre, for lengths in cm

// `v` in units of 1 / `unit`, rounded, saturated.
template <class Int> constexpr Int to_fixed(float v, float unit) noexcept {
  const float scaled = v * unit + (v < 0.0F ? -0.5F : 0.5F);
  constexpr auto low = static_cast<float>(std::numeric_limits<Int>::min());
  constexpr auto high = static_cast<float>(std::numeric_limits<Int>::max());
  return static_cast<Int>(std::clamp(scaled, low, high));
}

// A count of robots, as it travels.
constexpr RobotCount saturated(std::uint32_t count) noexcept {
  return static_cast<RobotCount>(std::min(count, most_robots));
}

// A length in cm, in m.
constexpr float metres(std::int16_t cm) noexcept { return static_cast<float>(cm) * 0.01F; }

}  // namespace banyan
