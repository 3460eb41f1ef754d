// SPDX-License-Identifier: MIT
// How far the farthest driver has to go if each place gets a robot of its own.
#pragma once

#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::measure {

// The bottleneck assignment: over all ways to send one robot to each place, the least value of the longest straight
// drive, in metres; 0 for no place, -1 for fewer robots than places, or if places times robots are more than 20
// million. Positions in metres; obstacles and bodies are
// ignored. Of the robots only the p nearest of each of the p places are asked. A search over the distances, with a
// matching for each (augmenting paths).
[[nodiscard]] double bottleneck_m(const std::vector<world::Vec2>& robots, const std::vector<world::Vec2>& places);

}  // namespace banyan::measure
