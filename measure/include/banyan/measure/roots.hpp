// SPDX-License-Identifier: MIT
// How often and for how long there were two roots, and how long the barriers took, as the root sees them.
#pragma once

#include "banyan/measure/moment.hpp"

namespace banyan::measure {

class Roots {
 public:
  struct Row {
    std::uint64_t two_roots_ticks = 0;  // more than one living root
    double longest_two_roots_s = 0.0;   // the longest such time without a break
    std::uint64_t epochs = 0;           // the last epoch reached; counters that wrap are counted on
    double start_phase_ticks = 0.0;     // mean length of a barrier phase at the root
    double select_phase_ticks = 0.0;
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  Roots(const world::World& /*start*/, Row& /*row*/) {}
  void observe(const Moment& now, Row& row);
  void sum_up(const Moment& end, Row& row) const;

 private:
  Serial last_epoch_ = 0;  // of a root
  std::uint64_t streak_ = 0, longest_ = 0;
  std::uint64_t start_ticks_ = 0, select_ticks_ = 0;
};

}  // namespace banyan::measure
