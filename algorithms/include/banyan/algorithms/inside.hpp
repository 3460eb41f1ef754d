// SPDX-License-Identifier: MIT
// A look into the robots of a tree: its state and its last message. For tests and debuggers;
// observers use reports.
#pragma once

#include <typeinfo>

#include "banyan/algorithms/swarms.hpp"

namespace banyan {

// A swarm as its own type; throws std::bad_cast if it is of another type.
template <class Algorithm> [[nodiscard]] const SwarmOf<Algorithm>& swarm_as(const Swarm& swarm) {
  return dynamic_cast<const SwarmOf<Algorithm>&>(swarm);
}

// Calls look(swarm) with a swarm of convoy or of the paper's as its own type; throws std::bad_cast if it is none.
template <class Look> decltype(auto) inside(const Swarm& swarm, Look look) {
  if (const auto* s = dynamic_cast<const SwarmOf<ConvoySwarm>*>(&swarm)) return look(*s);
  if (const auto* s = dynamic_cast<const SwarmOf<PaperSwarm<paper::outwards, paper::corrected>>*>(&swarm))
    return look(*s);
  if (const auto* s = dynamic_cast<const SwarmOf<PaperSwarm<paper::inwards, paper::corrected>>*>(&swarm))
    return look(*s);
  if (const auto* s = dynamic_cast<const SwarmOf<PaperSwarm<paper::outwards, paper::literal>>*>(&swarm))
    return look(*s);
  if (const auto* s = dynamic_cast<const SwarmOf<PaperSwarm<paper::inwards, paper::literal>>*>(&swarm)) return look(*s);
  throw std::bad_cast();
}

// What they have in common.
[[nodiscard]] inline const Neighbors& neighbors_of(const Swarm& swarm, std::size_t i) {
  return inside(swarm, [i](const auto& s) -> const Neighbors& { return s.state(i).neighbors; });
}
[[nodiscard]] inline bool is_worker(const Swarm& swarm, std::size_t i) {
  return inside(swarm, [i](const auto& s) { return s.state(i).is_worker; });
}

}  // namespace banyan
