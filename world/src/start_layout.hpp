// SPDX-License-Identifier: MIT
// The points at which the layouts of swarm.start put robots, before jitter (docs/model.md).
#pragma once

#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::world {

// free_robot_count(scenario) points of every layout but a list, nearest to start.center first (a random
// start: in the order in which it grew); fewer if obstacles leave no room for more.
[[nodiscard]] std::vector<Vec2> start_points(const Scenario& scenario);

}  // namespace banyan::world
