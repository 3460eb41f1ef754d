// SPDX-License-Identifier: MIT
// Trees of two to five terminals that are all leaves, with as few relays as possible.
#pragma once

#include <cstdint>
#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::measure {

// A chain of `hops` edges between two nodes. A node below the number of terminals is a terminal; after these come
// the hubs.
struct Branch {
  int from, to, hops;
};

struct FullComponent {
  std::vector<world::Vec2> hubs;  // relays with three or more edges
  std::vector<Branch> branches;
  int relays = 0;  // hubs, and those within the branches
};

constexpr int most_leaves = 5;

// How many layouts may still be tried. Their number grows with the fourth and higher powers of the hops between the
// terminals, and where these are a hundred apart no search would end.
struct Tries {
  std::int64_t left = 2'000'000;  // some two seconds
  [[nodiscard]] bool used_up() const noexcept { return left <= 0; }
};

// The component of these terminals (2 to most_leaves) with the fewest relays, for edges of at most 1, if these are at
// most `most_relays`; otherwise, and if the tries are used up before one is found, one without branches. lengths[s] is
// a lower bound of the length of any network that joins the terminals in the bit set s.
[[nodiscard]] FullComponent full_component(const std::vector<world::Vec2>& terminals,
                                           const std::vector<double>& lengths, int most_relays, Tries& tries);

// Relays in a straight chain of edges of at most 1.
[[nodiscard]] int relays_between(world::Vec2 a, world::Vec2 b) noexcept;

}  // namespace banyan::measure
