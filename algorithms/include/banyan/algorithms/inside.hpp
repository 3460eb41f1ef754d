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

// Calls look(swarm) with a swarm of a tree algorithm as its own type; throws std::bad_cast if it is none.
template <class Look> decltype(auto) inside(const Swarm& swarm, Look look) {
  if (const auto* s = dynamic_cast<const SwarmOf<CorrectedSwarm<outwards_step>>*>(&swarm)) return look(*s);
  if (const auto* s = dynamic_cast<const SwarmOf<CorrectedSwarm<inwards_step>>*>(&swarm)) return look(*s);
  if (const auto* s = dynamic_cast<const SwarmOf<ConvoySwarm>*>(&swarm)) return look(*s);
  if (const auto* s = dynamic_cast<const SwarmOf<LiteralSwarm<outwards_literal_step>>*>(&swarm)) return look(*s);
  if (const auto* s = dynamic_cast<const SwarmOf<LiteralSwarm<inwards_literal_step>>*>(&swarm)) return look(*s);
  throw std::bad_cast();
}

[[nodiscard]] inline const TreeState& tree_state(const Swarm& swarm, std::size_t i) {
  return inside(swarm, [i](const auto& s) -> const TreeState& { return s.state(i); });
}
[[nodiscard]] inline const TreeMessage& tree_message(const Swarm& swarm, std::size_t i) {
  return inside(swarm, [i](const auto& s) -> const TreeMessage& { return s.message(i); });
}
[[nodiscard]] inline const TreeParams& tree_params(const Swarm& swarm) {
  return inside(swarm, [](const auto& s) -> const TreeParams& { return s.params(); });
}

}  // namespace banyan
