// SPDX-License-Identifier: MIT
// Where a relay can stand: regions that a few discs have in common, in the plane, in closed form. Lengths are in
// units of the longest edge, so that the discs' radii are whole numbers of edges. Results hold up to `touch`.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::measure {

constexpr double touch = 1e-9;  // discs that miss each other by less than this touch

struct RangeDisc {
  world::Vec2 center;
  double radius = 0.0;

  [[nodiscard]] bool has(world::Vec2 p) const noexcept { return distance(center, p) <= radius + touch; }
  [[nodiscard]] world::Vec2 nearest(world::Vec2 from) const noexcept;
};

// The points of a region that are wanted: a few, in no order.
struct Points {
  std::array<world::Vec2, 2> at{};
  std::size_t count = 0;
  [[nodiscard]] const world::Vec2* begin() const noexcept { return at.data(); }
  [[nodiscard]] const world::Vec2* end() const noexcept { return at.data() + count; }
};
// Where the two circles meet: 0 or 2 points, which are equal where the circles touch.
[[nodiscard]] Points crossing(const RangeDisc& a, const RangeDisc& b) noexcept;

// What one or more discs have in common: convex, bounded by arcs between corners. Cost of each call: O(discs^2).
class CommonRegion {
 public:
  explicit CommonRegion(std::vector<RangeDisc> discs);
  [[nodiscard]] bool empty() const noexcept { return empty_; }
  [[nodiscard]] bool has(world::Vec2 p) const noexcept;
  // The cell must not be empty.
  [[nodiscard]] world::Vec2 nearest(world::Vec2 from) const noexcept;
  [[nodiscard]] const std::vector<RangeDisc>& discs() const noexcept { return discs_; }
  [[nodiscard]] const std::vector<world::Vec2>& corners() const noexcept { return corners_; }

 private:
  std::vector<RangeDisc> discs_;
  std::vector<world::Vec2> corners_;
  bool empty_ = false;
};

struct Nearest {
  world::Vec2 a, b;
};
// Two points of two cells, neither of them empty, with the least distance.
[[nodiscard]] Nearest nearest(const CommonRegion& a, const CommonRegion& b);

// A point of the disc within `a_reach` of cell a and `b_reach` of cell b, both positive; nothing if there is none.
[[nodiscard]] std::optional<world::Vec2> between(const RangeDisc& disc, const CommonRegion& a, double a_reach,
                                                 const CommonRegion& b, double b_reach);

}  // namespace banyan::measure
