// SPDX-License-Identifier: MIT
// Where robots begin: a compact connected cluster, random headings (docs/model.md).
#pragma once

#include <vector>

#include "banyan/world/bodies.hpp"

namespace banyan::world {

// The `robot_count(scenario)` lattice points nearest to start.center that are free of obstacles and
// reached from it over free lattice neighbours (so nobody starts behind a wall), jittered, in
// O(N (log N + obstacles)). Robots never overlap as long as pitch - 2 jitter >= 2 radius, which
// faults() checks. Index order: by distance from the centre. Fewer poses than robots when
// obstacles enclose the start too narrowly: faults() tells.
[[nodiscard]] Poses place(const Scenario& scenario);

struct Assignment {
  std::vector<std::size_t> worker;   // per target: the nearest robot, distinct, in target order
  std::size_t root = 0;              // scenario.swarm.root or a random robot that is no worker
};
// Needs more robots than targets (faults() checks). A given root is never a worker. O(N T).
[[nodiscard]] Assignment assign(const Scenario& scenario, const Poses& poses, const std::vector<Vec2>& targets);

}  // namespace banyan::world
