// SPDX-License-Identifier: MIT
// All that a robot of chains from a base remembers between two steps.
#pragma once

#include "banyan/baselines/chains/message.hpp"
#include "banyan/baselines/common/motion.hpp"
#include "banyan/baselines/common/root.hpp"
#include "banyan/baselines/common/table.hpp"

namespace banyan::baselines::chains {

// A place in the own frame, carried along by odometry.
struct KnownPlace {
  bool known = false;
  Vec2 at;

  void put(Vec2 p) noexcept { known = true, at = p; }
};

// The way to the base.
struct Chain {
  RobotId parent = nobody;
  Ids above = no_ids();    // the parent that it has or had, then what that listed
  RobotId asked = nobody;  // a free robot that is to become the parent
  std::uint16_t asked_ticks = 0;
};

struct State : KnownRoot {
  RobotId id = nobody;
  OwnTarget assignment;
  KnownPlace base;

  RobotId worker = nobody;                  // of the chain; nobody: free
  std::uint8_t number = 0;                  // of the chain
  std::array<Chain, most_chains> chains{};  // a relay has the first alone
  RobotId child = nobody;
  bool linked = false;  // the child has named me as its parent
  KnownPlace child_place;
  Ids below = no_ids();    // the child that it has or had, then what that listed
  std::uint8_t links = 0;  // to the worker
  float beyond = 0.0F;     // along them and on to the target
  float path = 0.0F;       // straight from the base to the target
  bool whole = false;
  KnownPlace gap;                  // of a relay whose child fell silent: the place to take
  Vec2 outwards;                   // from there to the next
  std::uint16_t gap_ticks = 0;     // for how long there has been a gap; of a worker: a chain too few
  std::uint16_t astray_ticks = 0;  // how long it has been of no use to the chain
  RobotId ignored = nobody;        // it did not answer
  std::uint16_t ignored_ticks = 0;

  Tally tally;  // never read
  Table<Message> neighbors;

  // About `entries` entries of the table are needed soon, and all the rest.
  void prefetch(std::size_t entries) const noexcept { neighbors.prefetch(entries); }

  // In the place of a dead worker.
  [[nodiscard]] bool stands_in() const noexcept { return gap.known && whole; }
  [[nodiscard]] bool is_base() const noexcept { return root == id; }
  [[nodiscard]] bool is_worker() const noexcept { return worker == id; }
  [[nodiscard]] bool is_free() const noexcept { return worker == nobody; }
};

}  // namespace banyan::baselines::chains
