// SPDX-License-Identifier: MIT
// How few robots can join the targets: a lower bound for any swarm, and an oracle, which knows all positions and
// puts relays where they are best. Neither knows obstacles or line of sight. All functions are pure.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::measure {

// No fewer robots complete a mission: a worker for each target, and what lies between. See docs/model.md for the
// proof. Targets in metres, in any order, equal ones allowed; `tolerance_m` >= 0 is how far from its target a worker
// may stand, `range_m` > 0 the length that no edge reaches. At least one more than targets, because the root is no
// worker; 1 for no target. Costs what steiner_length() costs.
[[nodiscard]] std::uint32_t robots_bound(const std::vector<world::Vec2>& targets, double tolerance_m, double range_m);

// A network of targets and relays. Nodes: the targets in their order, then the relays.
struct RelayTree {
  std::vector<world::Vec2> relays;                             // metres
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  // a tree
  bool exact = false;                                          // no network has fewer relays
};

// The Steiner tree with minimum number of Steiner points and bounded edge length (Lin & Xue 1999): the fewest relays
// so that all targets, each with a worker upon it, are joined by edges of at most `range_m` > 0 (up to 1e-8 of it).
// Workers relay, too. Exact for up to five targets: all topologies, with whole numbers of edges on their branches,
// in ascending order of the sum; whether one can be laid out is decided in closed form (discs.hpp). Six to nine:
// the best tree all of whose full components (parts with targets only as leaves) have up to five targets. More: the
// same components with up to four, chosen greedily by what each saves, above 40 targets up to three. With six to nine
// `exact` is true where the lower bound is met, with more only if no relay is needed. Where targets are dozens of hops
// apart the search ends after two seconds with what it has: then it is not exact with three to five targets either.
[[nodiscard]] RelayTree fewest_relays(const std::vector<world::Vec2>& targets, double range_m);

// The most targets that so many robots can hold: a worker for each, and relays as above, at least one robot besides
// the workers. Up to nine targets over all sets of them, each with its fewest relays; more: sets that grow from each
// target by what is nearest, so the true number may be larger.
[[nodiscard]] std::uint32_t most_targets(const std::vector<world::Vec2>& targets, double range_m, std::uint32_t robots);

}  // namespace banyan::measure
