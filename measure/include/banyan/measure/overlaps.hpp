// SPDX-License-Identifier: MIT
// Bodies in one place. Only the body model `linear` has no contacts, as the paper has none; in the others bodies push
// each other apart, and nothing is looked for.
#pragma once

#include <cstdint>
#include <vector>

#include "banyan/measure/moment.hpp"

namespace banyan::measure {

// A tick costs O(robots log robots) and allocates nothing.
class Overlaps {
 public:
  struct Row {
    std::int64_t overlap_ticks = -1;  // -1: not with this body model
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  explicit Overlaps(const world::World& start);
  Overlaps(const world::World& start, Row& /*row*/) : Overlaps(start) {}
  void observe(const world::World& world);
  void observe(const Moment& now, Row& /*row*/) { observe(now.world); }
  void sum_up(const Moment& /*end*/, Row& row) const { row.overlap_ticks = ticks_; }

  // In which the centres of two living robots were nearer than two radii; -1: not with this body model.
  [[nodiscard]] std::int64_t ticks() const noexcept { return ticks_; }

 private:
  [[nodiscard]] bool any() const noexcept;

  double reach_m_;
  std::int64_t ticks_;
  std::vector<world::Vec2> by_x_;  // the living
};

}  // namespace banyan::measure
