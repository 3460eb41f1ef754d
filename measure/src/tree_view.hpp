// SPDX-License-Identifier: MIT
// The tree as robots report it.
#pragma once

#include "banyan/world/world.hpp"

namespace banyan::measure {

inline bool is_of_tree(const world::World& world, std::size_t i) {
  return world.alive()[i] != 0 && world.reports()[i].role != Role::spare;
}

// The links that robot i keeps besides edges to parents, except those counted at the other end: that has i as its
// parent, or keeps the link, too, and has the smaller id.
template <class Visit> void for_each_kept_link(const world::World& world, std::size_t i, Visit visit) {
  const Report& mine = world.reports()[i];
  const auto me = static_cast<RobotId>(i);
  for (const RobotId other : mine.kept) {
    if (other == nobody) return;
    if (other == mine.parent || other == mine.old_parent) continue;
    if (other < world.size() && is_of_tree(world, other)) {
      const Report& theirs = world.reports()[other];
      if (theirs.parent == me || theirs.old_parent == me || (other < me && keeps(theirs, me))) continue;
    }
    visit(other);
  }
}

}  // namespace banyan::measure
