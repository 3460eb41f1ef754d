// SPDX-License-Identifier: MIT
// What keeps links from getting too long, whatever a robot tries to do: half-planes of velocities. And what
// the motors make of a velocity, within these limits.
#pragma once

#include <array>

#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/neighbors.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan {

// The nearest velocity (v_max) to `v` that lengthens no edge to `neighbor` (position, own frame) faster than
// (longest - d)/2 x `rate`, per drive. With both ends doing so no edge outgrows `longest`.
struct Guard {
  static constexpr int capacity = neighbor_capacity + 64;  // tree neighbours, then obstacles
  struct HalfPlane {
    float x, y;   // unit vector, from the neighbour to me
    float limit;  // v_max, along it
    [[nodiscard]] Vec2 away() const noexcept { return {x, y}; }
  };
  std::array<HalfPlane, capacity> planes;  // the first `size` are valid
  int size = 0;
  void add(Vec2 neighbor, float longest, float rate) noexcept;
  // Not faster than `limit` along `direction` (unit). What exceeds the capacity is dropped.
  void add_limit(Vec2 direction, float limit) noexcept;
  [[nodiscard]] Vec2 apply(Vec2 v) const noexcept;
};

// Wheels or holonomic base: the motion nearest to velocity `v` (v_max, own frame) that the drive can do now.
[[nodiscard]] Motion drive(Vec2 v, const Guard& guard, const Machine& machine) noexcept;

}  // namespace banyan
