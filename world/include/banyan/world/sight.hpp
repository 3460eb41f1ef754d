// SPDX-License-Identifier: MIT
// Who hears whom, one pair at a time: what Radio has to find, and what says why two do not hear each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "banyan/world/scenario.hpp"

namespace banyan::world {

// A swarm at one moment. Spans have one entry per robot.
struct Scene {
  std::span<const Vec2> positions;  // m
  std::span<const std::uint8_t> alive;
  std::span<const std::uint8_t> raised;  // antennas that look over bodies near them; empty: none
  std::span<const Obstacle> obstacles;
  double range_m;      // C: links are shorter
  double radius_m;     // of a body
  bool line_of_sight;  // whether bodies and obstacles block
  bool dead_bodies;    // whether those of the dead do
};

// What stands between two robots: a robot, or an obstacle.
struct Blocker {
  bool is_obstacle;
  std::size_t index;
};

// Whether a disc of `radius` at `k` blocks the segment from the origin to `d`: nearer than radius to its interior.
[[nodiscard]] inline bool disc_blocks(Vec2 k, Vec2 d, double d2, double radius) noexcept {
  const double along = dot(k, d);
  if (along <= 0.0 || along >= d2) return false;
  const double across = cross(k, d);
  return across * across < radius * radius * d2;
}

// Both alive and nearer than the range.
[[nodiscard]] bool in_range(const Scene& scene, std::size_t i, std::size_t j) noexcept;

// The first robot in the way of i and j, or else the first obstacle, wherever they are. The end nearer to a body, along
// the segment, may look over it; nothing looks over an obstacle. O(robots + obstacles).
[[nodiscard]] std::optional<Blocker> blocker(const Scene& scene, std::size_t i, std::size_t j) noexcept;

// Whether i and j have a link: in range and, with line of sight, nothing between them. Symmetric to the bit.
[[nodiscard]] bool hears(const Scene& scene, std::size_t i, std::size_t j) noexcept;

}  // namespace banyan::world
