// SPDX-License-Identifier: MIT
// How short a network that joins the targets can be.
#pragma once

#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::measure {

struct SteinerLength {
  double lower_m = 0.0;  // certified: no network is shorter
  double upper_m = 0.0;  // length of a network that exists
  bool exact = false;    // lower == upper up to 1e-6 relative
};

// Euclidean Steiner minimal tree of the terminals; equal ones count once. Exact (Smith 1992:
// topologies by branch and bound) up to 12 terminals: random ones and rings take 2 ms for 8 and
// some 20 ms, 100 ms at worst, for 12; lattices 0.1 s for 10 and up to 3 s for 12, when it may give
// up, always at the same point. If it gives up, and above 12 terminals, the upper bound is the shortest
// tree found (above 12: the minimum spanning tree) and the lower one the larger of 0.8241 times the
// minimum spanning tree (Chung & Graham 1985) and what is known of 12, 10 or 8 terminals far apart.
[[nodiscard]] SteinerLength steiner_length(const std::vector<world::Vec2>& terminals);

// Length of the shortest star, from the targets' geometric median (Weiszfeld 1937, stopped when it moves
// by less than 1e-9 of the extent), within 1e-6 relative. 0 for less than two targets.
[[nodiscard]] double star_length(const std::vector<world::Vec2>& terminals);

}  // namespace banyan::measure
