// SPDX-License-Identifier: MIT
// What a robot remembers between two steps. A plain value: copy it, compare it, hash it.
#pragma once

#include <array>
#include <cstdint>

#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/neighbors.hpp"
#include "banyan/controller/paper/message.hpp"

namespace banyan::paper {

// The neighbours, and what each of them said last.
struct Table : Neighbors {
  std::array<Message, neighbor_capacity> messages{};
};

// What it says of itself (message.hpp), and what it keeps to itself. The message's vectors are written when it is sent.
struct State : Message {
  bool is_worker = false;
  bool target_known = false;
  bool centroid_known = false;
  SpareState spare_state = SpareState::wait;
  RobotId reference = nobody;    // the robot a spare stays with, or follows to a need
  Vec2 target;                   // C, own frame: where I was sent to, carried along while it is not sensed
  Vec2 q;                        // C, own frame; at the root the centroid
  Vec2 pull;                     // own frame: u_target of the workers below
  Vec2 centroid;                 // C, own frame: of SELECT ROOT
  float way_left = 0.0F;         // `want`, C
  RobotCount flood_counted = 0;  // the root, in START TREE: the most robots that the flood had found (row 7)
  // Ticks
  std::uint16_t flood_ticks = 0;       // and when that was
  std::uint16_t phase_ticks = 0;       // in this phase
  std::uint16_t done_ticks = 0;        // for which the barrier has held
  std::uint16_t label_wait_ticks = 0;  // since the first labelled neighbour was heard
  std::uint16_t search_ticks = 0;      // without a candidate parent
  std::uint16_t orphan_ticks = 0;      // without a path to the root
  std::uint16_t childless_ticks = 0;   // a connector without a child that is not a spare
  std::uint16_t offer_ticks = 0;       // of the root token
  std::uint16_t unserved_ticks = 0;    // in NEED without a grant
  std::uint16_t grant_ticks = 0;
  std::uint16_t inserted_ticks = 0;
  std::uint16_t request_ticks = 0;
  std::uint16_t ungranted_ticks = 0;
  Tally tally;  // the algorithm never reads it
  Table neighbors;
};

[[nodiscard]] State initial(RobotId id, bool worker, bool root) noexcept;
[[nodiscard]] Report report(const State& state) noexcept;
// Every field that can influence a later step.
void add_to(Digest& digest, const State& state) noexcept;

}  // namespace banyan::paper
