// SPDX-License-Identifier: MIT
// Whether there is time enough: a bound that holds whatever robots do.
#pragma once

#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::soak {

// Whether every target can have a robot of its own that is at most `way_m` away, straight on (a maximum matching: Kuhn
// 1955). Obstacles only make ways longer.
[[nodiscard]] bool all_in_reach(const std::vector<world::Vec2>& robots, const std::vector<world::Vec2>& targets,
                                double way_m);

}  // namespace banyan::soak
