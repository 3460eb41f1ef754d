// SPDX-License-Identifier: MIT
// Where robots begin: a connected start, random headings (docs/model.md).
#pragma once

#include <optional>
#include <vector>

#include "banyan/world/bodies.hpp"

namespace banyan::world {

// The `free_robot_count(scenario)` points of the layout, free of obstacles, jittered. A lattice grows over free
// neighbours (so no robot starts behind a wall), in O(N (log N + obstacles)). Robots never overlap and are
// connected as long as faults() finds nothing. Index order: by distance from the centre; a random start: in the
// order in which it grew. Fewer poses than robots when obstacles leave no room: faults() tells.
[[nodiscard]] Poses place(const Scenario& scenario);

// And after them those that join later, out of reach of everything until then.
[[nodiscard]] Poses place_all(const Scenario& scenario);

struct Assignment {
  std::vector<std::size_t> worker;  // per target: the nearest robot, distinct, in target order
  std::size_t root = 0;             // scenario.swarm.root or a random robot that is not a worker
};
// Of the robots at the start. Needs more of them than targets (faults() checks). A given root is never a worker. O(N
// T).
[[nodiscard]] Assignment assign(const Scenario& scenario, const Poses& poses, const std::vector<Vec2>& targets);

class World;  // world.hpp
// Where one more robot could stand: in sight of a living one, a spare if there is one, at the pitch of the start from
// it and from every other body. Nothing if there is no such place. A function of the world. O(robots^2) at worst.
[[nodiscard]] std::optional<Vec2> free_place(const World& world);

}  // namespace banyan::world
