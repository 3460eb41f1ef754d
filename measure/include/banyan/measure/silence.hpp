// SPDX-License-Identifier: MIT
// For how long the ends of tree edges have not heard each other.
#pragma once

#include <cstdint>
#include <vector>

#include "banyan/world/world.hpp"

namespace banyan::measure {

// I of outwards (paper Table I: 1.2 s at a tick of 0.1 s), for algorithms that have no such parameter.
constexpr double usual_liveness_ticks = 12.0;

// The liveness period I of the algorithm that runs in this world, after which a neighbour that was not heard counts as
// gone: its parameter liveness_rounds times the tick, or usual_liveness_ticks.
[[nodiscard]] double liveness_period_s(const world::World& world);

// Counts, per pair of ends, the ticks in a row in which a tree edge between them had no radio link. A silence begins
// with the first such tick, so that of an edge that is new and without a link counts from then on. Memory: the edges
// without a link in the last two ticks.
class Silence {
 public:
  // A silence is long if it is longer than `limit_s` >= 0; `tick_s` > 0.
  Silence(double limit_s, double tick_s);

  // Once per tick, before its edges.
  void next_tick();
  // An edge of this tick has no link. Whether its silence is long by now; the order of the ends does not matter, and a
  // pair may be asked for twice. O(log edges).
  [[nodiscard]] bool is_long(RobotId a, RobotId b);

 private:
  struct Pair {
    RobotId low, high;
    std::uint32_t ticks;  // without a link, in a row
  };
  std::uint32_t limit_ticks_;
  std::vector<Pair> last_, now_;  // of the last tick, in order; of this one
};

}  // namespace banyan::measure
