// SPDX-License-Identifier: MIT
// What a robot of chains from a base broadcasts (docs/baselines.md).
#pragma once

#include <array>
#include <cstdint>

#include "banyan/controller/core/wire.hpp"

namespace banyan::baselines::chains {

inline constexpr std::size_t most_chains = 4;  // of a worker
inline constexpr std::size_t listed = 4;       // robots of a chain that a robot knows, each way
using Ids = std::array<RobotId, listed>;
static_assert(most_chains <= listed);  // a worker says its parents where others list theirs
constexpr Ids no_ids() noexcept { return {nobody, nobody, nobody, nobody}; }

struct Message {
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;
  RobotId worker = nobody;    // of its chain; nobody: it is free
  std::uint8_t chain = 0;     // which of that worker's; of a worker: for which it asks
  bool whole = false;         // the chain is complete from here to the worker
  Ids above = no_ids();       // the robots towards the base, its parent first; of a worker: the parent in each chain
  Ids below = no_ids();       // the robots towards the worker, its child first
  std::uint8_t links = 0;     // between it and the worker
  std::uint16_t beyond = 0;   // along them and on to the target
  std::uint16_t path = 0;     // straight from the base to the target
  RobotId asks = nobody;      // a free robot, to become its parent
  RobotId root = nobody;      // the base,
  std::uint8_t root_age = 0;  // from so many ticks ago

  friend bool operator==(const Message&, const Message&) = default;
};

template <class Visitor, class M> constexpr void visit_all(Visitor& visit, M& m) noexcept {
  visit.flag("whole", "the chain is complete from here to the worker", m.whole);
  visit.robot("id", "of the sender", m.id);
  visit.robot("worker", "of its chain, -1: it is free", m.worker);
  visit.number("chain", "which of that worker's; of a worker: for which it asks", m.chain);
  constexpr const char* above[] = {"above_1", "above_2", "above_3", "above_4"};
  constexpr const char* below[] = {"below_1", "below_2", "below_3", "below_4"};
  for (std::size_t i = 0; i < listed; ++i)
    visit.robot(above[i], "its parent, then the next towards the base; of a worker: a parent, -1: none", m.above[i]);
  for (std::size_t i = 0; i < listed; ++i)
    visit.robot(below[i], "its child, then the next towards the worker, -1: none", m.below[i]);
  visit.number("links", "between it and the worker", m.links);
  visit.scaled("beyond", "along them and on to the target", m.beyond, per_range);
  visit.scaled("path", "straight from the base to the target", m.path, per_range);
  visit.robot("asks", "a free robot that is to become its parent, -1: none", m.asks);
  visit.robot("root", "the base, -1: none is known", m.root);
  visit.number("root_age", "ticks since that said so", m.root_age);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, Message& m) noexcept { visit_all(visit, m); }
template <class Visitor> constexpr void visit_fields(Visitor& visit, const Message& m) noexcept { visit_all(visit, m); }

}  // namespace banyan::baselines::chains
