// SPDX-License-Identifier: MIT
// Which targets are held, for how long, and how soon again when their workers have died.
#pragma once

#include <string>

#include "banyan/measure/moment.hpp"
#include "banyan/measure/takeovers.hpp"

namespace banyan::measure {

class HeldTargets {
 public:
  struct Row {
    double held_time_ratio = -1.0;  // from completion on, mean share of the targets that are held; -1: not complete
    double unheld_time_ratio_by_death =
        -1.0;                          // of the rest, from a worker's death at its target until it is held again
    double held_ratio = 0.0;           // at the end, share of the active targets that are held; 1 without any
    std::uint32_t held_targets = 0;    // at the end, held by a worker that the tree joins to a root
    std::int64_t visited_places = -1;  // of visits.positions_m; -1: there are none
    double visited_s = -1.0;           // when the last of them all was visited
    std::string missed_targets;        // the other active ones, by index and why, "2 given up, 5 3.10 m short"
    std::uint32_t lost_holders = 0;    // workers that died at their targets (takeovers.hpp)
    double held_again_s = -1.0;  // from then until such a target was held again, median; -1: none, or most never were
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  HeldTargets(const world::World& start, Row& row);
  void observe(const Moment& now, Row& row);
  void sum_up(const Moment& end, Row& row) const;

 private:
  double tolerance_m_;
  Takeovers takeovers_;
  std::uint64_t ticks_ = 0;                         // since completion
  double held_sum_ = 0.0, waiting_by_death_ = 0.0;  // of the shares of the active targets, since then
};

}  // namespace banyan::measure
