// SPDX-License-Identifier: MIT
// How many robots are in the tree, how many would do, and how long the tree is.
#pragma once

#include "banyan/measure/moment.hpp"

namespace banyan::measure {

class TreeSize {
 public:
  struct Row {
    std::uint32_t committed = 0;  // at the end
    double mean_committed = 0.0;
    double committed_ratio = 0.0;   // committed / robots_bound
    double oracle_ratio = 0.0;      // committed / oracle_robots
    double deployment_ratio = 0.0;  // most robots in the tree in a tick up to completion / robots_bound
    // Edges to the parents and kept links, at the end; both ends alive, the child no spare.
    double network_length_m = 0.0;
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  TreeSize(const world::World& /*start*/, Row& /*row*/) {}
  void observe(const Moment& now, Row& row);
  void sum_up(const Moment& end, Row& row) const;

 private:
  std::uint64_t sum_ = 0;
  std::uint32_t most_deploying_ = 0;  // in a tick up to completion
  bool deployed_ = false;
};

}  // namespace banyan::measure
