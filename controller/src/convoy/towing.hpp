// SPDX-License-Identifier: MIT
// The rules of convoy (docs/convoy.md) about motion, and about which branches have arrived. shortcut.hpp has
// what changes its tree between two reconstructions.
#pragma once

#include <algorithm>

#include "convoy/robot.hpp"

namespace banyan {

// Whether branches that have arrived save robots at all: merge_distance 0 switches it off.
[[nodiscard]] bool prunes(const ConvoyParams& params) noexcept;
// There are workers below me, and all stand at their targets: my branch may save robots.
[[nodiscard]] bool has_arrived(const ConvoyRobot& robot) noexcept;
// Neighbour k is a worker that has arrived: it may be the parent of others whose workers have arrived.
[[nodiscard]] bool is_relay(const ConvoyRobot& robot, int k) noexcept;

// A worker at its target passes on the pull of its children instead of its own.
[[nodiscard]] bool passes_pull_on(const ConvoyRobot& robot, Vec2& pull) noexcept;

// A robot of the tree: a worker drives to its target, a connector follows the children that tow it;
// tension straightens chains; no robot stays in another edge's line of sight. In units of speed_gain.
[[nodiscard]] Vec2 towed_motion(const ConvoyRobot& robot) noexcept;

// A spare: where it is, unless it is called, in the way, or left behind.
[[nodiscard]] Vec2 waiting_motion(const ConvoyRobot& robot) noexcept;

// 0 up to `start`, 1 from `width` beyond it on, in proportion between.
[[nodiscard]] inline float ramp(float d, float start, float width) noexcept {
  return std::clamp((d - start) / width, 0.0F, 1.0F);
}

// How hard a robot at distance d from a line of sight is pushed off it, in units of corridor_gain; 0 at `width`.
[[nodiscard]] inline float push_off_line(float d, float width) noexcept {
  constexpr float on_line = 5e-4F;    // nearer it is no harder
  constexpr float most_push = 20.0F;  // a line across the robot outweighs all others, but not without limit
  return std::min(width / std::max(d, on_line) - 1.0F, most_push);
}

}  // namespace banyan
