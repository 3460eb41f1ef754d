// SPDX-License-Identifier: MIT
// Numbers as they travel: whole multiples of a unit, saturated; lengths in units of C (platform.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "banyan/controller/core/robot_id.hpp"

namespace banyan {

inline constexpr float per_range = 256.0F;  // units in C, for lengths

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

// A length in such units, C.
constexpr float from_fixed(std::uint16_t length) noexcept { return static_cast<float>(length) / per_range; }

// One coordinate of a place as it travels: 14 bits in steps of 1/256, 1/64, 1/16 or 1/4 C, whichever is the finest that
// reaches so far, and two bits that say which. So a place within 32 C is exact to 1/512 C, and none nearer than 2,047 C
// is cut off.
struct Coordinate {
  std::int16_t bits = 0;

  [[nodiscard]] static constexpr Coordinate of(float ranges) noexcept {
    constexpr float largest = 8191.0F;
    float unit = per_range;
    int scale = 0;
    for (; scale < 3 && (ranges < 0.0F ? -ranges : ranges) * unit > largest; ++scale) unit *= 0.25F;
    const float steps = std::clamp(ranges * unit + (ranges < 0.0F ? -0.5F : 0.5F), -largest, largest);
    return {static_cast<std::int16_t>(static_cast<int>(steps) * 4 + scale)};
  }
  [[nodiscard]] constexpr float value() const noexcept {  // C
    constexpr float steps[] = {1.0F / per_range, 4.0F / per_range, 16.0F / per_range, 64.0F / per_range};
    return static_cast<float>(bits >> 2) * steps[bits & 3];
  }
  // Each length has one form.
  [[nodiscard]] constexpr bool is_possible() const noexcept { return of(value()) == *this; }
  friend constexpr bool operator==(Coordinate, Coordinate) noexcept = default;
};

}  // namespace banyan
