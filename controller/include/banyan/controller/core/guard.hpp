// SPDX-License-Identifier: MIT
// What keeps links from getting too long, whatever a robot tries to do: half-planes of velocities. And what
// the motors make of a velocity, within these limits.
#pragma once

#include <array>

#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/neighbors.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan {

// The nearest velocity (m/s) to `v` that lengthens no edge to `neighbor` (position, own
// frame) faster than (longest - d)/2 x guard rate. With both ends doing so no edge outgrows `longest_m`.
struct Guard {
  static constexpr int capacity = neighbor_capacity + 64;  // tree neighbours, then obstacles
  struct HalfPlane {
    float x, y;       // unit vector, from the neighbour to me
    float limit_m_s;  // along it
    [[nodiscard]] Vec2 away() const noexcept { return {x, y}; }
  };
  std::array<HalfPlane, capacity> planes;  // the first `size` are valid
  int size = 0;
  void add(Vec2 neighbor, float longest_m, float rate_per_s) noexcept;
  // Not faster than `limit_m_s` along `direction` (unit). What exceeds the capacity is dropped.
  void add_limit(Vec2 direction, float limit_m_s) noexcept;
  [[nodiscard]] Vec2 apply(Vec2 v) const noexcept;
};

// Wheels or holonomic base: the velocity nearest to `v` (m/s, own frame) that the drive can do now.
[[nodiscard]] Velocity drive(Vec2 v, const Guard& guard, const Platform& platform) noexcept;

}  // namespace banyan
