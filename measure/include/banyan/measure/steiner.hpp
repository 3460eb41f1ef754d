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

// Euclidean Steiner minimal tree of the terminals; equal ones count once. Exact (Smith 1992:
// topologies by branch and bound) up to 9 terminals, in milliseconds, for lattice-like ones in a
// tenth of a second. Above 9, at most the minimum spanning tree and at least the larger of 0.8241
// times that (Chung & Graham 1985) and the exact tree of 9 terminals far apart.
[[nodiscard]] SteinerLength steiner_length(const std::vector<world::Vec2>& terminals);

// ceil((Steiner - T tolerance) / C) + 1 with the certified lower length (protocol 11).
[[nodiscard]] std::uint32_t robots_bound(const std::vector<world::Vec2>& targets, double tolerance_m, double range_m);

}  // namespace banyan::measure
