// SPDX-License-Identifier: MIT
// "Situated communication [...] robots broadcast data within a limited range C, and upon receiving data, a robot is
// able to estimate the relative position of the data sender with respect to its own local reference frame" (paper Sec.
// II-B). The fields are kept in their wire types, so what a receiver computes with is exactly what travelled.
#pragma once

#include <concepts>
#include <cstdint>

#include "banyan/controller/core/report.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan::paper {

// Says who is root: the newer sequence wins, then the larger id.
struct RootToken {
  Serial sequence = 0;
  RobotId id = nobody;
  friend bool operator==(RootToken, RootToken) noexcept = default;
};
constexpr bool newer(RootToken a, RootToken b) noexcept {
  return a.sequence != b.sequence ? is_newer(a.sequence, b.sequence) : a.id > b.id;
}

inline constexpr std::uint16_t unknown_label = 0xFFFF;
inline constexpr std::uint16_t largest_label = 0xFFFE;  // below it in the tree there is no place
inline constexpr std::uint16_t invalid_depth = 0;
inline constexpr std::uint8_t unreachable = 0xFF;  // hops
inline constexpr float pull_unit = 16384.0F;       // fixed point of the pull: +-2
inline constexpr float largest_q = 1.0e9F;         // one robot's wrong values must not overflow the sums above it

// Vectors are written along the edge to the addressee (core/edge_frame.hpp): q and pull to the parent or, while there
// is none, the old parent; the centroid to the new root. What the fields mean is said below.
struct OfThisTree {  // forgotten when a new tree begins
  Need need = Need::no_need;
  bool committed = false, flood_done = false;
  std::uint16_t label = unknown_label;
  Serial seqno = 0;
  RobotId flood_parent = nobody, grant = nobody, request = nobody, new_root = nobody;
  RobotCount flood_robots = 0, flood_workers = 0;
  friend bool operator==(const OfThisTree&, const OfThisTree&) = default;
};
struct Message : OfThisTree {
  static constexpr std::uint8_t blocks = block::tree;
  RobotId id = nobody;
  Role role = Role::spare;
  Phase phase = Phase::init;
  std::uint8_t tree_hops = unreachable, call_hops = unreachable;
  Serial epoch = 0;
  RootToken root;
  std::uint16_t depth = invalid_depth;  // d_i
  RobotId parent = nobody, old_parent = nobody, hold = nobody;
  RobotCount subtree = 1, subtree_workers = 0;  // c_i - d_i + 1, and the workers among them
  RobotCount count = 0;                         // c_i
  std::uint16_t want = 0;
  Vec2 q;
  std::int16_t pull_x = 0, pull_y = 0;
  Coordinate centroid_x, centroid_y;
  friend bool operator==(const Message&, const Message&) = default;
};

template <class Visitor, class M>
requires std::derived_from<M, Message>
constexpr void visit_fields(Visitor& visit, M& m) noexcept {
  visit.choice("role", "0 spare, 1 connector, 2 worker, 3 root", m.role, 2, Role::root);
  visit.choice("phase", "0 init, 1 start_tree, 2 select_parent, 3 grow_tree, 4 select_root", m.phase, 3,
               Phase::select_root);
  visit.choice("need", "of the edge to the parent: 0 no_need, 1 need, 2 await", m.need, 2, Need::await);
  visit.flag("committed", "1: in this epoch's tree", m.committed);
  visit.flag("flood_done", "1: all robots below in the flood have answered", m.flood_done);
  visit.robot("id", "of the sender", m.id);
  visit.number("epoch", "counts the trees", m.epoch);
  visit.number("root_sequence", "newest root token known: sequence", m.root.sequence);
  visit.robot("root_id", "newest root token known: holder, -1: nobody", m.root.id);
  visit.known("label", "distance to the root along hops when the epoch began, in C / 256, -1: unknown", m.label);
  visit.number("seqno", "the root's count as it came down the tree", m.seqno);
  visit.number("depth", "d: in the tree, root 1; 0: no path of tree edges to the root", m.depth);
  visit.known("tree_hops", "hops over free spares to the rooted tree, 0: in it, -1: no way known", m.tree_hops);
  visit.known("call_hops", "hops to a need that nobody answers, -1: nobody calls", m.call_hops);
  visit.robot("parent", "robot, -1: nobody", m.parent);
  visit.robot("old_parent", "in the old tree while trees are switched, -1: nobody", m.old_parent);
  visit.robot("hold", "without a parent: the robot that the sender stays with, -1: nobody", m.hold);
  visit.robot("flood_parent", "the neighbour that gave the label, -1: nobody", m.flood_parent);
  visit.count("flood_robots", "robots labelled through this one, itself included", m.flood_robots);
  visit.count("flood_workers", "workers among them", m.flood_workers);
  visit.count("subtree", "1 + sum over the children", m.subtree);
  visit.count("subtree_workers", "workers among them", m.subtree_workers);
  visit.count("count", "c of Alg. 2; no rule uses it", m.count);
  visit.scaled("want", "largest remaining way of a worker below, 0: all have arrived", m.want, per_range);
  visit.real("q_x", "q of Alg. 1, along the edge from the sender to its parent", m.q.x, largest_q);
  visit.real("q_y", "the same, to the left of that edge", m.q.y, largest_q);
  visit.scaled("pull_x", "u_target from below, along the edge to the parent, -2 to 2", m.pull_x, pull_unit);
  visit.scaled("pull_y", "the same, to the left of that edge", m.pull_y, pull_unit);
  visit.robot("grant", "the spare let into the edge to the parent, -1: nobody", m.grant);
  visit.robot("request", "the owner of the edge that the sender wants to join or has just joined", m.request);
  visit.robot("new_root", "the robot to which the root token is offered, -1: nobody", m.new_root);
  visit.coordinate("centroid_x", "with the offer: relative to that robot, along the edge to it", m.centroid_x);
  visit.coordinate("centroid_y", "the same, to the left of that edge", m.centroid_y);
}

// To whom q and pull are addressed.
constexpr RobotId up_of(const Message& m) noexcept {
  return m.role == Role::root ? nobody : m.parent != nobody ? m.parent : m.old_parent;
}

// One received packet: its sender is in the receiver's body frame (x forward, y left; m), where it was `age_s` ago.
struct Heard {
  const Message* message;
  Vec2 position;
  float age_s = 0.0F;
};

}  // namespace banyan::paper
