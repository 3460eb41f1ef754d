// SPDX-License-Identifier: MIT
// The yardstick for "as few robots as possible": how short a network joining the targets can be.
#pragma once

#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::measure {

struct SteinerLength {
  double lower_m = 0.0;   // certified: no network is shorter
  double upper_m = 0.0;   // length of a network that exists
  bool exact = false;     // lower == upper up to 1e-6 relative
};

// Euclidean Steiner minimal tree of the terminals. Exact (Smith 1992: topologies by branch and
// bound) up to 9 terminals; above, between 0.8241 and 1 times the minimum spanning tree
// (Chung & Graham 1985).
[[nodiscard]] SteinerLength steiner_length(const std::vector<world::Vec2>& terminals);

// ceil((Steiner - T tolerance) / C) + 1 with the certified lower length (spec 11).
[[nodiscard]] std::uint32_t robots_bound(const std::vector<world::Vec2>& targets, double tolerance_m, double range_m);

}  // namespace banyan::measure
