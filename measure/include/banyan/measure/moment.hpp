// SPDX-License-Identifier: MIT
// What a metric looks at: the world, what has been seen of it in this tick, and the run so far.
#pragma once

#include <span>

#include "banyan/measure/tick.hpp"
#include "banyan/world/world.hpp"

namespace banyan::measure {

struct Run;

// A metric is a class with
//
//   struct Row;                                        its columns of a run
//   static std::span<const Column<Row>> columns();     their names and meanings
//   Metric(const world::World& start, Row& row);       before the first tick
//   void observe(const Moment& now, Row& row);         once per tick
//   void sum_up(const Moment& end, Row& row);          means and ratios; any number of times, each on a copy of the row
//
// and a line in metrics.hpp. It reads what metrics above it in that list have found from `run`.
struct Moment {
  const world::World& world;
  Tick& tick;
  std::span<const RobotId> holders;  // by target: the nearest living worker that serves it, if it holds it; or nobody
  const Run& run;
};

}  // namespace banyan::measure
