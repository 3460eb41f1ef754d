// SPDX-License-Identifier: MIT
// How long the mission took, and the least that it could have taken.
#pragma once

#include "banyan/measure/moment.hpp"

namespace banyan::measure {

class Course {
 public:
  struct Row {
    std::uint32_t robots = 0;
    std::uint64_t ticks = 0;
    double time_s = 0.0;
    bool complete = false;  // in time, at some tick
    double completion_time_s = -1.0;
    double time_limit_s = 0.0;
    double normalized_time = 1.0;  // completion time / limit, 1 when not complete
    double time_bound_s = 0.0;     // lower bound of the completion time
    double time_ratio = -1.0;      // completion time / bound; -1: not complete, or the bound is 0
    std::uint64_t hash = 0;        // state hash of the world at the end
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  Course(const world::World& start, Row& row);
  void observe(const Moment& now, Row& row) const;
  static void sum_up(const Moment& end, Row& row);

 private:
  double rounding_s_;
};

}  // namespace banyan::measure
