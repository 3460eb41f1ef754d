// SPDX-License-Identifier: MIT
// For how long tree edges were broken, and by what.
#pragma once

#include "banyan/measure/moment.hpp"

namespace banyan::measure {

class Edges {
 public:
  struct Row {
    std::uint64_t broken_ticks = 0;  // at least one broken tree edge
    std::uint64_t broken_ticks_by_distance = 0;
    std::uint64_t broken_ticks_by_occlusion = 0;
    std::uint64_t broken_ticks_by_death = 0;
    double disconnected_time_ratio = 0.0;  // broken_ticks / ticks
    double disconnected_time_ratio_by_distance = 0.0;
    double disconnected_time_ratio_by_occlusion = 0.0;
    double liveness_period_s = 0.0;                // I
    std::uint64_t broken_ticks_after_silence = 0;  // at least one tree edge broken for longer than I
    double disconnected_time_ratio_after_silence = 0.0;
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  Edges(const world::World& start, Row& row);
  static void observe(const Moment& now, Row& row);
  static void sum_up(const Moment& end, Row& row);
};

}  // namespace banyan::measure
