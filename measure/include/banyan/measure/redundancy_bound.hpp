// SPDX-License-Identifier: MIT
// How few robots can join the targets so that the loss of any k - 1 others cuts no two of them off from each other.
#pragma once

#include <cstdint>
#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::measure {

struct RedundancyBound {
  std::uint32_t robots = 0;
  bool exact = false;  // a network with as few exists
};

// No network of fewer robots, a worker for each target among them, has `paths` >= 1 disjoint paths between any two
// targets, each worker within `tolerance_m` >= 0 of its target, each edge shorter than `range_m` > 0, and a root that
// is no worker. Obstacles and line of sight are ignored. For one path this is robots_bound(). See docs/model.md for the
// proof. `exact`, which is looked for with up to nine targets: a ring through the targets, or as many Steiner trees of
// relays as there are to be paths, has no more. Pure; some milliseconds.
[[nodiscard]] RedundancyBound redundancy_bound(const std::vector<world::Vec2>& targets, double tolerance_m,
                                               double range_m, std::uint32_t paths);

}  // namespace banyan::measure
