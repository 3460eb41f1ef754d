// SPDX-License-Identifier: MIT
// What a robot remembers between two steps.
#pragma once

#include <array>

#include "banyan/controller/core/neighbors.hpp"
#include "banyan/controller/paper/message.hpp"

namespace banyan::paper {

// The neighbours, and what each of them said last.
struct Neighborhood : Neighbors {
  std::array<Message, neighbor_capacity> messages{};
};

// A plain value: copy it, compare it, hash it. Its first part is what a robot says of itself; q is in its own frame.
struct State : Message {
  bool is_worker = false, target_known = false, centroid_known = false;
  SpareState spare_state = SpareState::wait;
  RobotId reference = nobody;  // the robot a spare stays with, or follows to a need
  Vec2 target;                 // C, own frame: where I was sent to, carried along while it is not sensed
  Vec2 pull;                   // own frame: u_target, my own or from below
  Vec2 centroid;               // C, own frame: of SELECT ROOT
  // Ticks since then, or for so long
  std::uint16_t phase_ticks = 0, done_ticks = 0, label_wait_ticks = 0, search_ticks = 0, orphan_ticks = 0;
  std::uint16_t childless_ticks = 0, offer_ticks = 0, unserved_ticks = 0, grant_ticks = 0;
  std::uint16_t request_ticks = 0, ungranted_ticks = 0;
  Tally tally;  // the algorithm never reads it
  Neighborhood neighbors;
};

}  // namespace banyan::paper
