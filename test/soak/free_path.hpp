// SPDX-License-Identifier: MIT
// The shortest way past obstacles, for a point: no robot's way is shorter. A graph over the corners of the obstacles
// that see each other; a disc is a polygon within it, and a point passes between
// two obstacles that touch.
#pragma once

#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::soak {

// m; infinite where there is no way.
[[nodiscard]] double free_path_m(const std::vector<world::Obstacle>& obstacles, world::Vec2 from, world::Vec2 to);

}  // namespace banyan::soak
