// SPDX-License-Identifier: MIT
// What is to be seen in a tick, from outside: robots, edges, the radio graph, targets. Metrics count what it sees.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "banyan/measure/silence.hpp"
#include "banyan/measure/tick.hpp"
#include "banyan/world/tree_parts.hpp"
#include "graph_watch.hpp"

namespace banyan::measure {

class TickWatch {
 public:
  explicit TickWatch(const world::World& start);

  // Once per tick, after World::step. Charges and disjoint paths are left to the metrics that know of them.
  void look(const world::World& world, bool exact_fiedler, Tick& tick);
  // Of the last tick: Moment::holders.
  [[nodiscard]] std::span<const RobotId> holders() const noexcept { return holders_; }
  // Observer::stop_when.
  void stop_when(const std::function<bool()>& asked) { graph_.stop_when(asked); }

 private:
  void count_edges(const world::World& world, Tick& tick);
  void measure_targets(const world::World& world, Tick& tick);

  double range_m_, tolerance_m_;
  Silence silence_;
  world::TreeParts tree_parts_;
  GraphWatch graph_;
  std::vector<double> nearest_worker_;  // by target: squared distance
  std::vector<RobotId> holders_;
};

}  // namespace banyan::measure
