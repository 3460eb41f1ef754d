// SPDX-License-Identifier: MIT
// All that the paper's algorithms remember between two steps. A plain value: copy it, compare it, hash it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "banyan/controller/tree/table.hpp"

namespace banyan {

struct TreeState {
  RobotId id = nobody;
  bool is_worker = false;
  Role role = Role::spare;
  Vec2 target;  // C, own frame: where I was sent to, carried along while it is not sensed
  bool target_known = false;

  // Epoch, phase, root token: gossip (epoch.hpp)
  Serial epoch = 0;
  Phase phase = Phase::init;
  std::uint16_t phase_ticks = 0;  // since this robot entered the phase
  RootToken root;
  std::uint16_t done_ticks = 0;  // how long the root's barrier has held

  // Label: distance to the root and the echo (label.hpp)
  std::uint16_t label = unknown_label;
  std::uint16_t label_wait_ticks = 0;  // since the first labelled neighbour was heard
  RobotId flood_parent = nobody;
  bool flood_done = false;
  RobotCount flood_robots = 0;
  RobotCount flood_workers = 0;

  // Tree (parent_selection.hpp)
  RobotId parent = nobody;
  RobotId old_parent = nobody;
  bool committed = false;
  std::uint16_t search_ticks = 0;     // without a candidate parent
  std::uint16_t orphan_ticks = 0;     // depth invalid, while I am a worker or have a child that is not a spare
  std::uint16_t childless_ticks = 0;  // connector without a child that is not a spare
  Serial seqno = 0;
  std::uint16_t seqno_ticks = 0;    // since it changed
  RobotId pending_parent = nobody;  // the robot I want as parent as soon as it is ahead of me
  std::uint16_t depth = invalid_depth;
  std::uint8_t tree_hops = unreachable;

  // Count and centroid (census.hpp)
  RobotCount subtree = 1;
  RobotCount subtree_workers = 0;
  RobotCount count = 0;             // Alg. 2
  Vec2 q;                           // C, own frame; at the root Alg. 1's centroid
  float want = 0.0F;                // largest remaining worker distance below me
  Vec2 pull;                        // target pull, own frame
  float least_want = 0.0F;          // the least want since it last grew
  std::uint16_t stalled_ticks = 0;  // since want last changed by a twentieth of C

  // Root selection (root_selection.hpp)
  Vec2 centroid;  // C, own frame
  bool centroid_known = false;
  RobotId new_root = nobody;  // offered to
  std::uint16_t offer_ticks = 0;

  // Spare management (spare_management.hpp)
  Need need = Need::no_need;
  std::uint16_t unserved_ticks = 0;  // in NEED without a grant
  std::uint8_t call_hops = nobody_calls;
  RobotId grant = nobody;
  std::uint16_t grant_ticks = 0;
  RobotId inserted_child = nobody;
  std::uint16_t inserted_ticks = 0;
  SpareState spare_state = SpareState::wait;
  RobotId request = nobody;  // owner of the edge I want to extend
  std::uint16_t request_ticks = 0;
  std::uint16_t ungranted_ticks = 0;
  RobotId reference = nobody;  // the robot a spare stays with, or follows to a need
  bool called = false;         // by an edge out of sight

  Tally tally;  // the algorithm never reads it
  TreeTable neighbors;

  // About `entries` entries of the table are needed soon, and all the rest.
  void prefetch(std::size_t entries) const noexcept {
    entries = std::min<std::size_t>(entries, neighbor_capacity);
    prefetch_lines(this, static_cast<std::size_t>(reinterpret_cast<const char*>(&neighbors) -
                                                  reinterpret_cast<const char*>(this)));
    neighbors.prefetch(entries);
  }
};

// Every field that can influence a later step, the table aside.
template <class Visitor, class State> constexpr void visit_tree_state(Visitor& visit, State& s) noexcept {
  visit(s.id), visit(s.is_worker), visit(s.role), visit(s.target), visit(s.target_known);
  visit(s.epoch), visit(s.phase), visit(s.phase_ticks), visit(s.root.sequence), visit(s.root.id), visit(s.done_ticks);
  visit(s.label), visit(s.label_wait_ticks), visit(s.flood_parent), visit(s.flood_done), visit(s.flood_robots),
      visit(s.flood_workers);
  visit(s.parent), visit(s.old_parent), visit(s.committed), visit(s.search_ticks), visit(s.orphan_ticks),
      visit(s.childless_ticks);
  visit(s.seqno), visit(s.seqno_ticks), visit(s.pending_parent), visit(s.depth), visit(s.tree_hops);
  visit(s.subtree), visit(s.subtree_workers), visit(s.count), visit(s.q), visit(s.want), visit(s.pull),
      visit(s.least_want), visit(s.stalled_ticks);
  visit(s.centroid), visit(s.centroid_known), visit(s.new_root), visit(s.offer_ticks);
  visit(s.need), visit(s.unserved_ticks), visit(s.call_hops), visit(s.grant), visit(s.grant_ticks),
      visit(s.inserted_child), visit(s.inserted_ticks);
  visit(s.spare_state), visit(s.request), visit(s.request_ticks), visit(s.ungranted_ticks), visit(s.reference),
      visit(s.called);
  visit(s.tally.insertions), visit(s.tally.handovers), visit(s.tally.repairs), visit(s.tally.elections),
      visit(s.tally.replacements), visit(s.tally.rejected);
}

}  // namespace banyan
