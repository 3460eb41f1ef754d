// SPDX-License-Identifier: MIT
// "In this state, each robot must identify a new parent to attach to. The selection of a new parent aims to create the
// shortest possible paths between the root robot and the worker robots, i.e., the leaf nodes in the tree." (paper
// Sec. III-B)
#include "banyan/controller/core/search.hpp"
#include "banyan/controller/paper/corrections.hpp"

namespace banyan::paper {
namespace {

constexpr int orphan_still_ticks = 5;
constexpr float longest_link = 0.95F;  // C: the next step might break a longer one (row e)

// ---- Outwards, Sec. III-D: "a logical spanning tree over the entire robot network" ----

// All robots join in SELECT PARENT, later only those that matter to the tree.
bool may_join_outwards(const Robot& robot) noexcept {
  return robot.self.phase == Phase::select_parent || robot.self.role != Role::spare;
}
// "Viable candidates are non-workers already in the tree [...] Among these, the robot selects the closest robot."
float distance_to_committed(const Robot& robot, int k) noexcept {
  return robot.said(k).committed ? robot.range(k) : not_counted;
}
// Never equality: with motion and occlusion the flood under-counts.
bool has_all_robots(const Robot& root) noexcept { return root.self.subtree >= root.self.flood_robots; }

// ---- Inwards, Sec. III-E: "the robots join the tree starting from the workers towards the root" ----

// "it broadcasts its parent id, which indicates to the parent robot that robot i is a child"
bool may_join_inwards(const Robot& robot) noexcept {
  const auto joins = [&](int k) { return robot.said(k).role != Role::spare; };
  return robot.self.is_worker || banyan::any_of(robot.children, joins);
}
// "non-workers in the tree or robots not in the tree [...] the smallest distance to the root"
float distance_to_root(const Robot& robot, int k) noexcept {
  return static_cast<float>(robot.said(k).label) + robot.reading.handicap(robot, k);
}
bool has_all_workers(const Robot& root) noexcept { return root.self.subtree_workers >= root.self.flood_workers; }

// ---- Both ----

// Not a worker, of this epoch, and above me in the order of the tree.
bool may_be_parent(const Robot& robot, int k) noexcept {
  const Message& m = robot.said(k);
  return robot.alive(k) && m.role != Role::worker && m.epoch == robot.self.epoch && is_ahead(robot, k);
}

// The best candidate, -1 if there is none. An edge that exists may be as long as the guard lets it grow (row h).
int best_candidate(const Robot& robot, bool in_tree) noexcept {
  const float range = robot.reading.parent_range(robot.params);
  return least_of(robot.neighbors(), not_counted, [&](int k) {
    const Message& m = robot.said(k);
    const float reach = k == robot.old_parent ? std::max(range, robot.params.ideal_distance) : range;
    const bool may = may_be_parent(robot, k) && m.label < robot.self.label && robot.range(k) <= reach;
    return may && (!in_tree || (m.committed && m.role != Role::spare)) ? robot.growth.cost(robot, k) : not_counted;
  });
}

// No candidate for a while: the neighbour that gave the label will do; then a robot without children, which has nobody
// below it, may take a new place in the order.
int second_choice(const Robot& robot) noexcept {
  constexpr int flood_parent_after = 4;  // ticks
  constexpr int any_committed_after = 7;
  const State& self = robot.self;
  const int k = robot.table().find(self.flood_parent);
  if (self.search_ticks > flood_parent_after && k >= 0 && may_be_parent(robot, k) && robot.said(k).label < self.label &&
      robot.range(k) <= longest_link)
    return k;
  if (self.search_ticks <= any_committed_after || robot.children.size + robot.old_children.size > 0) return -1;
  const float range = robot.reading.parent_range(robot.params);
  return least_of(robot.neighbors(), not_counted, [&](int j) {
    const bool may = may_be_parent(robot, j) && robot.said(j).committed && robot.range(j) <= range;
    return may ? robot.range(j) : not_counted;
  });
}

void join(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.label == unknown_label || !robot.growth.may_join(robot)) return;
  int k = best_candidate(robot, false);
  if (k < 0) {
    if (self.search_ticks < UINT16_MAX) ++self.search_ticks;
    k = second_choice(robot);
  }
  if (k >= 0) take_parent(robot, k);
}

// "If a robot can not receive data from its selected parent, it selects another parent and updates its data." If there
// is none, it keeps the parent and drives to where it should be.
void repair(Robot& robot) noexcept {
  if (robot.self.role == Role::spare) return leave_tree(robot);
  const int k = best_candidate(robot, true);
  if (k < 0) return;
  take_parent(robot, k);
  ++robot.self.tally.repairs;
}

// The neighbour through which the rooted tree is nearest: a robot of the tree, or a free spare that can be drafted
// towards it. Never an orphan: it might be below me in the tree.
int way_to_tree(const Robot& robot, float range) noexcept {
  int best = -1;
  for (int k = 0; k < robot.neighbors(); ++k) {
    const Message& m = robot.said(k);
    if (!may_be_parent(robot, k) || m.tree_hops == unreachable || m.old_parent == robot.self.id) continue;
    if (robot.range(k) > range) continue;
    const int hops = best < 0 ? unreachable : robot.said(best).tree_hops;
    if (m.tree_hops < hops || (m.tree_hops == hops && robot.range(k) < robot.range(best))) best = k;
  }
  return best;
}

// A robot that matters and has no path to the root in GROW TREE takes the next way that there is (row g).
void reattach_orphan(Robot& robot) noexcept {
  constexpr int attach_ticks = 20;
  constexpr int drafted_attach_ticks = 4;
  State& self = robot.self;
  const bool matters = !robot.is_root() && (self.is_worker || robot.useful_children > 0);
  if (!matters || self.phase < Phase::grow_tree || self.depth != invalid_depth) {
    self.orphan_ticks = 0;
    return;
  }
  if (self.orphan_ticks < UINT16_MAX) ++self.orphan_ticks;
  const bool drafted = self.parent == nobody && !self.is_worker;
  if (self.orphan_ticks <= (drafted ? drafted_attach_ticks : attach_ticks)) return;
  int k = way_to_tree(robot, std::min(robot.reading.parent_range(robot.params), longest_link));
  if (k < 0) k = way_to_tree(robot, longest_link);
  if (k < 0) return;
  take_parent(robot, k);
  self.orphan_ticks = orphan_still_ticks;  // time for the new parent to attach in turn
  ++self.tally.repairs;
}

// While a spare that has just joined my edge has its parent's number of the last tick, my own rests, so that it gets
// ahead of me.
void update_seqno(Robot& robot) noexcept {
  State& self = robot.self;
  const int spare = robot.table().find(self.grant);
  if (robot.is_root()) self.seqno = advanced(self.seqno);
  else if (robot.alive(robot.parent) && !(robot.alive(spare) && robot.said(spare).inserted_child == self.id))
    keep_up(robot, robot.parent);
}

// "depth": flows down; an orphan's is invalid, which spreads to all robots below it by a hop per tick. In GROW TREE an
// old parent is only a constraint: it may be below me by now.
void update_depth(Robot& robot) noexcept {
  State& self = robot.self;
  const int up = self.phase < Phase::grow_tree ? robot.up() : robot.parent;
  const int above = robot.alive(up) ? robot.said(up).depth : invalid_depth;
  self.depth = robot.is_root()          ? std::uint16_t{1}
               : above == invalid_depth ? invalid_depth
                                        : static_cast<std::uint16_t>(std::min(above + 1, UINT16_MAX - 1));
  const bool free = self.role == Role::spare && self.parent == nobody;
  const int k = self.depth == invalid_depth && free ? nearest_to_tree(robot) : -1;
  self.tree_hops = self.depth != invalid_depth ? std::uint8_t{0}
                   : k < 0                     ? unreachable
                                               : static_cast<std::uint8_t>(robot.said(k).tree_hops + 1);
}

}  // namespace

constexpr Growth outwards{.may_join = may_join_outwards, .cost = distance_to_committed, .is_complete = has_all_robots};
constexpr Growth inwards{.may_join = may_join_inwards, .cost = distance_to_root, .is_complete = has_all_workers};

// "at a distance smaller than the communication range C"
float parent_range(const Params& /*params*/) noexcept { return 1.0F; }
float no_handicap(const Robot& /*robot*/, int /*k*/) noexcept { return 0.0F; }

bool is_ahead(const Robot& robot, int k) noexcept {
  const Message& m = robot.said(k);
  const State& self = robot.self;
  if (m.epoch != self.epoch || m.label >= largest_label) return false;
  return m.seqno != self.seqno ? is_newer(m.seqno, self.seqno) : m.label < self.label;
}

void keep_up(Robot& robot, int k) noexcept {
  State& self = robot.self;
  const Message& m = robot.said(k);
  if (m.epoch != self.epoch || m.label >= largest_label || !is_newer(m.seqno, self.seqno)) return;
  self.seqno = m.seqno;
  const std::uint16_t below = label_below(m.label, robot.range(k));
  const bool renews = robot.reading.renews_labels && self.phase >= Phase::grow_tree;
  if (self.label == unknown_label || self.label <= m.label || (renews && self.label > below)) self.label = below;
}

// Of the robots with the fewest hops over free spares to the rooted tree the one that is farthest in the order.
int nearest_to_tree(const Robot& robot) noexcept {
  int best = -1;
  for (int k = 0; k < robot.neighbors(); ++k) {
    const Message& m = robot.said(k);
    if (!robot.alive(k) || m.tree_hops >= unreachable) continue;
    const Message* const other = best < 0 ? nullptr : &robot.said(best);
    if (other == nullptr || m.tree_hops < other->tree_hops ||
        (m.tree_hops == other->tree_hops && is_newer(m.seqno, other->seqno)))
      best = k;
  }
  return best;
}

// For an orphan that drafts a spare the spare must be ahead; one about to join an edge stays behind.
void keep_up_with_tree(Robot& robot) noexcept {
  const State& self = robot.self;
  if (self.depth != invalid_depth || self.role != Role::spare || self.parent != nobody) return;
  const int k = nearest_to_tree(robot);
  if (k >= 0 && self.phase >= Phase::grow_tree && self.request == nobody) keep_up(robot, k);
}

void take_parent(Robot& robot, int k) noexcept {
  State& self = robot.self;
  robot.set_parent(robot.table().id(k));
  self.committed = true;
  self.search_ticks = 0;
  self.hold = nobody;
  keep_up(robot, k);
  // A robot without a label that is as fresh as its parent must not be ahead of it.
  if (robot.reading.keeps_links && self.label == unknown_label)
    self.label = label_below(robot.said(k).label, robot.range(k));
  if (self.phase >= Phase::grow_tree) robot.set_old_parent(nobody);
}

bool is_orphan(const Robot& robot) noexcept { return robot.self.orphan_ticks > orphan_still_ticks; }

void select_parent(Robot& robot) noexcept {
  State& self = robot.self;
  // The order is still that of the old root: it is ahead of its heir, and would take a robot below it as parent (row
  // t).
  const bool hangs_on_heir = robot.reading.keeps_links && self.phase == Phase::select_root && self.parent == nobody &&
                             robot.alive(robot.old_parent);
  if (robot.is_root()) {
    robot.set_parent(nobody);
    self.committed = true;
  } else if (self.phase >= Phase::select_parent && !hangs_on_heir) {
    if (self.parent == nobody) join(robot);
    else if (!robot.alive(robot.parent)) repair(robot);
    else if (self.role == Role::spare && self.phase >= Phase::grow_tree && robot.children.size == 0) leave_tree(robot);
    reattach_orphan(robot);
  }
  update_seqno(robot);
  update_depth(robot);
}

}  // namespace banyan::paper
