// SPDX-License-Identifier: MIT
// For how long the radio network was in one piece.
#pragma once

#include "banyan/measure/moment.hpp"

namespace banyan::measure {

class NetworkParts {
 public:
  struct Row {
    std::uint32_t start_parts = 1;  // components at the start, over links of which both ends hear each other
    std::uint64_t split_ticks = 0;  // communication graph in several components
    std::uint64_t split_ticks_by_distance = 0;
    double fiedler_time_ratio = 0.0;
    double fiedler_time_ratio_by_distance = 0.0;
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  NetworkParts(const world::World& start, Row& row);
  void observe(const Moment& now, Row& row);
  void sum_up(const Moment& end, Row& row) const;

 private:
  std::uint64_t low_ticks_ = 0, low_ticks_by_distance_ = 0;
};

}  // namespace banyan::measure
