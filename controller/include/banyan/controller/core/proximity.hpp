// SPDX-License-Identifier: MIT
// For hosts with a real proximity sensor: it sees robots too, and Senses::obstacles must not have them.
#pragma once

#include <algorithm>
#include <span>

#include "banyan/controller/core/vec2.hpp"

namespace banyan {

// Of `readings` (nearest points of surfaces, body frame, m) those that are no robot's body, in place; the order
// stays. `robots`: where robots were heard, in the same frame, m. A reading within `tolerance_m` of a body of
// radius `body_radius_m` around one of them is that robot. The dead say nothing, and remain obstacles.
inline std::span<Vec2> without_robots(std::span<Vec2> readings, std::span<const Vec2> robots, float body_radius_m,
                                      float tolerance_m) noexcept {
  const auto is_robot = [&](Vec2 reading) {
    return std::any_of(robots.begin(), robots.end(),
                       [&](Vec2 robot) { return distance(reading, robot) <= body_radius_m + tolerance_m; });
  };
  const auto end = std::remove_if(readings.begin(), readings.end(), is_robot);
  return readings.first(static_cast<std::size_t>(end - readings.begin()));
}

}  // namespace banyan
