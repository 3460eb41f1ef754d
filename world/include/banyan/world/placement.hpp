// SPDX-License-Identifier: MIT
// Where robots begin: a connected start, random headings (docs/model.md).
#pragma once

#include <vector>

#include "banyan/world/bodies.hpp"

namespace banyan::world {

// The `robot_count(scenario)` points of the layout, free of obstacles, jittered. A lattice grows over free
// neighbours (so no robot starts behind a wall), in O(N (log N + obstacles)). Robots never overlap and are
// connected as long as faults() finds nothing. Index order: by distance from the centre; a random start: in the
// order in which it grew. Fewer poses than robots when obstacles leave no room: faults() tells.
[[nodiscard]] Poses place(const Scenario& scenario);

struct Assignment {
  std::vector<std::size_t> worker;  // per target: the nearest robot, distinct, in target order
  std::size_t root = 0;             // scenario.swarm.root or a random robot that is not a worker
};
// Needs more robots than targets (faults() checks). A given root is never a worker. O(N T).
[[nodiscard]] Assignment assign(const Scenario& scenario, const Poses& poses, const std::vector<Vec2>& targets);

}  // namespace banyan::world
