// SPDX-License-Identifier: MIT
// What every robot of a tree broadcasts once a tick (protocol 1): the paper's part of it. The fields are
// kept in their wire types, so what a receiver computes with is exactly what travelled.
#pragma once

#include <cstdint>

#include "banyan/controller/core/fixed_point.hpp"
#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/report.hpp"
#include "banyan/controller/core/serial.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan {

// A token that says who is root: the larger (sequence, id) wins. Aligned as BasicVec2 is (vec2.hpp).
struct alignas(2 * sizeof(RobotId)) RootToken {
  Serial sequence = 0;
  RobotId id = nobody;
  friend constexpr bool operator==(RootToken a, RootToken b) noexcept { return equal_as<std::uint32_t>(a, b); }
};
constexpr bool newer(RootToken a, RootToken b) noexcept {
  return a.sequence != b.sequence ? is_newer(a.sequence, b.sequence) : a.id > b.id;
}

inline constexpr std::uint16_t unknown_label = 0xFFFF;
// Nothing fits behind it: such a robot takes no child.
inline constexpr std::uint16_t largest_label = unknown_label - 1;
inline constexpr std::uint16_t invalid_depth = 0;
inline constexpr std::uint8_t unreachable = 0xFF;
inline constexpr std::uint8_t nobody_calls = 0xFF;
// From here on: of calls for companions (convoy/companions.hpp), which come last.
inline constexpr std::uint8_t companion_call = 128;

// How a robot is tied to others. It seldom changes from one message to the next (table.hpp).
struct TreeTies {
  RobotId parent = nobody;
  RobotId old_parent = nobody;
  RobotId grant = nobody;  // the spare I let into the edge to my parent; without parent: my hold
  Role role = Role::spare;
  std::uint8_t tree_hops = unreachable;  // hops over unattached spares to the rooted tree, 0: in it

  friend constexpr bool operator==(const TreeTies& a, const TreeTies& b) noexcept {
    return equal_as<std::uint64_t>(a, b);
  }
};

// What a robot keeps of each neighbour until it hears from it again: where it stands in the protocol.
struct TreeStanding : TreeTies {
  float q_x = 0.0F;  // edge frame to `up`: Alg. 1's contribution
  float q_y = 0.0F;
  Phase phase = Phase::init;
  Need need = Need::no_need;
  bool flood_done = false;                // START echo: my flood subtree is complete (protocol 5)
  bool committed = false;                 // I am in this epoch's tree
  bool parent_silent = false;             // my parent has not been heard for longer than I
  std::uint8_t call_hops = nobody_calls;  // hops to an edge whose need no spare has answered
  Serial epoch = 0;
  std::uint16_t label = unknown_label;  // distance to the root along hops (label.hpp, keep_up)
  Serial seqno = 0;                     // the root's count as it came down the tree: (seqno, label) orders the tree
  std::uint16_t depth = invalid_depth;  // root 1; 0: not connected to the root by tree edges
  RobotId flood_parent = nobody;
  RobotCount flood_robots = 0;  // echo sums
  RobotCount flood_workers = 0;
  RobotCount subtree = 0;  // 1 + sum over children
  RobotCount subtree_workers = 0;
  // Alg. 2's c_i, beside the sums above; nothing depends on it. So a robot that heals says here whom it hears
  // (healing/mutual.cpp); a field more would be too much for one message, and for the firmware.
  RobotCount count = 0;
  std::uint16_t want = 0;   // largest remaining worker distance below me
  std::int16_t pull_x = 0;  // target pull, edge frame to `up`, 1 = pull_unit
  std::int16_t pull_y = 0;
  RobotId request = nobody;         // the owner whose edge I want to join
  RobotId inserted_child = nobody;  // I have just been inserted above this robot

  friend bool operator==(const TreeStanding&, const TreeStanding&) = default;
};

// What a receiver uses only in the tick in which it is heard, or passes on.
struct TreeNews {
  RootToken root;             // gossip: the newest root token I know
  RobotId new_root = nobody;  // offer of the token root.sequence + 1
  Coordinate centroid_x;      // centroid - addressee, edge frame to `new_root`; with no offer: burst_of()
  Coordinate centroid_y;

  friend bool operator==(const TreeNews&, const TreeNews&) = default;
};

struct TreeMessage : TreeStanding, TreeNews {
  RobotId id = nobody;
  static constexpr std::uint8_t blocks = block::tree;
  friend bool operator==(const TreeMessage&, const TreeMessage&) = default;
};

inline constexpr float pull_unit = 16384.0F;  // fixed point of pull_x, pull_y: +-2
// Largest |component| of q. A sender keeps within it and decode() rejects what exceeds it, because one
// robot's wrong values could overflow the sums of all robots above it.
inline constexpr float q_limit = 1.0e9F;

// The tree block, field by field (wire.hpp). `heals`: `count` is what a healing algorithm says in its place.
template <class Visitor, class M> constexpr void visit_tree_block(Visitor& visit, M& m, bool heals = false) noexcept {
  visit.choice("role", "0 spare, 1 connector, 2 worker, 3 root", m.role, 2, Role::root);
  visit.choice("phase", "0 init, 1 start_tree, 2 select_parent, 3 grow_tree, 4 select_root", m.phase, 3,
               Phase::select_root);
  visit.choice("need", "of the edge to the parent: 0 no_need, 1 need, 2 await", m.need, 2, Need::await);
  visit.flag("committed", "1: in this epoch's tree", m.committed);
  visit.flag("flood_done", "1: all robots below in the flood have answered", m.flood_done);
  visit.flag("parent_silent", "1: the parent has not been heard for longer than I", m.parent_silent);
  visit.robot("id", "of the sender, never -1", m.id);
  visit.number("epoch", "counts the trees", m.epoch);
  visit.number("root_sequence", "newest root token known: sequence", m.root.sequence);
  visit.robot("root_id", "newest root token known: holder, -1: nobody", m.root.id);
  visit.known("label", "distance to the root along hops, in C / 256, -1: none yet", m.label);
  visit.number("seqno", "the root's count as it came down the tree", m.seqno);
  visit.number("depth", "in the tree, 1 at the root; 0: no path of tree edges to the root", m.depth);
  visit.known("tree_hops", "hops over free spares to the rooted tree, 0: in it, -1: no way known", m.tree_hops);
  visit.known("call_hops", "hops to a need that no spare answers, from 128 on for a companion, -1: nobody calls",
              m.call_hops);
  visit.robot("parent", "in this epoch's tree, -1: nobody", m.parent);
  visit.robot("old_parent", "in the last epoch's tree, until GROW TREE, -1: nobody", m.old_parent);
  visit.robot("flood_parent", "the neighbour that gave the label, -1: nobody", m.flood_parent);
  visit.count("flood_robots", "robots labelled through this one, itself included", m.flood_robots);
  visit.count("flood_workers", "workers among them", m.flood_workers);
  visit.count("subtree", "1 + sum over the children", m.subtree);
  visit.count("subtree_workers", "workers among them", m.subtree_workers);
  if (heals) visit.robot("hears", "a neighbour that the sender hears; its own id: come nearer, -1: nobody", m.count);
  else visit.count("count", "c of Alg. 2; no rule uses it", m.count);
  visit.scaled("want", "largest remaining way of a worker below, 0: all have arrived", m.want, per_range);
  visit.real("q_x", "Alg. 1's contribution, along the edge to the parent", m.q_x, q_limit);
  visit.real("q_y", "the same, to the left of that edge", m.q_y, q_limit);
  visit.scaled("pull_x", "attraction to the targets below, -2 to 2, along the edge to the parent", m.pull_x, pull_unit);
  visit.scaled("pull_y", "the same, to the left of that edge", m.pull_y, pull_unit);
  visit.robot("grant", "the spare let into the edge to the parent; without a parent: the hold, -1: nobody", m.grant);
  visit.robot("request", "the owner of the edge a spare wants to join; own id: needs a companion, -1: nobody",
              m.request);
  visit.robot("inserted_child", "the robot above which the sender has just been inserted, -1: nobody",
              m.inserted_child);
  visit.robot("new_root", "the robot to which the root token is offered, -1: nobody", m.new_root);
  visit.coordinate(
      "centroid_x",
      "centroid relative to `new_root`, along the edge to it; without an offer: the longest burst known, in "
      "ticks / 256",
      m.centroid_x);
  visit.coordinate("centroid_y", "the same, to the left of that edge", m.centroid_y);
}

template <class Visitor> constexpr void visit_fields(Visitor& visit, TreeMessage& m) noexcept {
  visit_tree_block(visit, m);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, const TreeMessage& m) noexcept {
  visit_tree_block(visit, m);
}

// The tree neighbour that vectors of the census are addressed to: the parent or, during a switch
// while there is none, the old parent.
constexpr RobotId up_of(const TreeTies& m) noexcept {
  return m.role == Role::root ? nobody : m.parent != nobody ? m.parent : m.old_parent;
}
// The hold of a robot without a parent: the robot that it stays with.
constexpr RobotId hold_of(const TreeStanding& m) noexcept {
  return m.role == Role::root || up_of(m) != nobody ? nobody : m.grant;
}
// Nothing leads from it to a root.
constexpr bool is_untied(const TreeStanding& m) noexcept {
  return m.role != Role::root && up_of(m) == nobody && m.grant == nobody;
}

// One received packet. Its sender is in the receiver's body frame (x forward, y left; C), from range and
// bearing: where it was `age_s` ago, in the frame of then; 0: as of now. `message` lives as long as the step.
// In a healing algorithm it is a HealingMessage, and so on: all robots of a swarm run the same algorithm.
struct Heard {
  const TreeMessage* message;
  Vec2 position;
  float age_s = 0.0F;
  // The step's own notes
  std::int16_t place = -1;        // where it stands in the neighbour table, until an entry is removed; -1: nowhere
  RobotId named_before = nobody;  // what `count` was in the sender's last message
  Vec2 before{};                  // where the sender was at the last step, in the frame of then; zero: not heard then
  Heard* next_news = nullptr;
};

}  // namespace banyan
