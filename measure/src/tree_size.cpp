// SPDX-License-Identifier: MIT
#include "banyan/measure/tree_size.hpp"

#include <algorithm>

#include "banyan/measure/metrics.hpp"
#include "tree_view.hpp"

namespace banyan::measure {
namespace {

constexpr Column<TreeSize::Row> tree_size_table[] = {
    column<&TreeSize::Row::committed>("committed", "robots in the tree at the end", "robots in the tree at the end"),
    quantity<&TreeSize::Row::mean_committed>("mean_committed", "mean over ticks", "robots in the tree, mean over time"),
    ratio<&TreeSize::Row::committed_ratio>("committed_ratio", "committed / robots_bound",
                                           "robots in the tree / lower bound"),
    ratio<&TreeSize::Row::oracle_ratio>("oracle_ratio", "committed / oracle_robots", "robots in the tree / oracle's"),
    ratio<&TreeSize::Row::deployment_ratio>("deployment_ratio",
                                            "most robots in the tree in a tick up to completion / robots_bound",
                                            "most in the tree, deploying / lower bound"),
    quantity<&TreeSize::Row::network_length_m>(
        "network_length_m", "edges from living robots of the tree to their living parents, at the end",
        "length of the tree (m)"),
};

// Edges from the living robots of the tree to their living parents, in a reconstruction to the old ones, and the
// links that they keep.
double network_length_m(const world::World& world) {
  double length_m = 0.0;
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (!is_of_tree(world, i)) continue;
    const auto add = [&](RobotId other) {
      if (other < world.size() && world.alive()[other] != 0)
        length_m += distance(world.positions()[i], world.positions()[other]);
    };
    add(up_of(world.reports()[i]));
    for_each_kept_link(world, i, add);
  }
  return length_m;
}

}  // namespace

std::span<const Column<TreeSize::Row>> TreeSize::columns() noexcept { return tree_size_table; }

void TreeSize::observe(const Moment& now, Row& row) {
  row.committed = now.tick.committed;
  sum_ += row.committed;
  if (!deployed_) most_deploying_ = std::max(most_deploying_, row.committed);
  deployed_ = now.run.complete;
}

void TreeSize::sum_up(const Moment& end, Row& row) const {
  const Run& run = end.run;
  row.mean_committed = static_cast<double>(sum_) / std::max(1.0, static_cast<double>(run.ticks));
  row.committed_ratio = static_cast<double>(row.committed) / static_cast<double>(run.robots_bound);
  row.deployment_ratio = static_cast<double>(most_deploying_) / static_cast<double>(run.robots_bound);
  // Without an answer there is no ratio.
  row.oracle_ratio =
      run.oracle_robots > 0 ? static_cast<double>(row.committed) / static_cast<double>(run.oracle_robots) : -1.0;
  row.network_length_m = network_length_m(end.world);
}

}  // namespace banyan::measure
