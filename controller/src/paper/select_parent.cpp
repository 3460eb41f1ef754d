// SPDX-License-Identifier: MIT
// "In this state, each robot must identify a new parent to attach to. The selection of a new parent aims to create the
// shortest possible paths between the root robot and the worker robots, i.e., the leaf nodes in the tree." (paper
// Sec. III-B)
#include "banyan/controller/paper/rules.hpp"

namespace banyan::paper {
namespace {

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
  const auto joins = [&](int k) { return robot.is_child(k) && robot.said(k).role != Role::spare; };
  return robot.self.is_worker || robot.any(joins);
}
// "Among these, a robot selects a neighbor with the smallest distance to the root." Within S if there is one (row k).
float distance_to_root(const Robot& robot, int k) noexcept {
  const bool too_far = robot.reading.prefers_safe_parent && robot.range(k) > robot.params.safe_range;
  return static_cast<float>(robot.said(k).label) + (too_far ? static_cast<float>(unknown_label) : 0.0F);
}
bool has_all_workers(const Robot& root) noexcept { return root.self.subtree_workers >= root.self.flood_workers; }

// ---- Both ----

constexpr float longest_link = 0.95F;  // C: the next step might break a longer one (row e)
constexpr int orphan_still_ticks = 5;

// "at a distance smaller than the communication range C" (row 4)
float longest_choice(const Robot& robot) noexcept {
  constexpr float margin = 0.01F;
  return robot.reading.keeps_margin ? robot.params.ideal_distance - margin : 1.0F;
}

// A robot in reach that is not a worker, and above me in the order of the tree.
bool may_be_parent(const Robot& robot, int k, float reach) noexcept {
  return robot.alive(k) && robot.said(k).role != Role::worker && is_ahead(robot, k) && robot.range(k) <= reach;
}

// The best candidate, -1 if there is none. An edge that exists may be as long as the guard lets it grow (row h).
int best_candidate(const Robot& robot, bool in_tree) noexcept {
  const float reach = longest_choice(robot);
  return robot.least([&](int k) {
    const Message& m = robot.said(k);
    const bool known = k == robot.old_parent;
    const bool may = m.label < robot.self.label && (!in_tree || (m.committed && m.role != Role::spare)) &&
                     may_be_parent(robot, k, known ? std::max(reach, robot.params.ideal_distance) : reach);
    return may ? robot.growth.cost(robot, k) : not_counted;
  });
}

// Without a candidate for a while, the neighbour that gave the label will do; then a robot that has nobody below it may
// take a new place in the order, behind any robot of the tree.
void join(Robot& robot) noexcept {
  constexpr int flood_parent_after_ticks = 4;
  constexpr int any_committed_after_ticks = 7;
  State& self = robot.self;
  if (self.label == unknown_label || !robot.growth.may_join(robot)) return;
  int k = best_candidate(robot, false);
  if (k < 0 && self.search_ticks++ >= flood_parent_after_ticks) {
    k = robot.find(self.flood_parent);
    if (k >= 0 && (robot.said(k).label >= self.label || !may_be_parent(robot, k, longest_link))) k = -1;
    if (k < 0 && self.search_ticks > any_committed_after_ticks && !robot.any([&](int j) { return robot.is_below(j); }))
      k = robot.least([&](int j) {
        const bool may = robot.said(j).committed && may_be_parent(robot, j, longest_choice(robot));
        return may ? robot.range(j) : not_counted;
      });
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
int way_to_tree(const Robot& robot, float reach) noexcept {
  constexpr std::pair none(int{unreachable}, 0.0F);
  return robot.least(none, [&](int k) {
    const bool may = may_be_parent(robot, k, reach) && robot.said(k).old_parent != robot.self.id;
    return may ? std::pair(int{robot.said(k).tree_hops}, robot.range(k)) : none;
  });
}

// In GROW TREE a robot that matters and has no path to the root takes the next way that there is (row g).
void reattach_orphan(Robot& robot) noexcept {
  constexpr int attach_ticks = 20;
  constexpr int drafted_attach_ticks = 4;
  State& self = robot.self;
  const auto useful = [&](int k) { return robot.is_below(k) && robot.said(k).role != Role::spare; };
  const bool matters = !robot.is_root() && (self.is_worker || robot.any(useful));
  if (!matters || self.phase < Phase::grow_tree || self.depth != invalid_depth) {
    self.orphan_ticks = 0;
    return;
  }
  if (self.orphan_ticks < UINT16_MAX) ++self.orphan_ticks;
  const bool drafted = self.parent == nobody && !self.is_worker;
  if (self.orphan_ticks <= (drafted ? drafted_attach_ticks : attach_ticks)) return;
  int k = way_to_tree(robot, std::min(longest_choice(robot), longest_link));
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
  const int spare = robot.find(self.grant);
  const bool awaits =
      robot.alive(spare) && robot.said(spare).role != Role::spare && robot.said(spare).request == self.id;
  if (robot.is_root()) self.seqno = advanced(self.seqno);
  else if (robot.alive(robot.parent) && !awaits) keep_up(robot, robot.parent);
}

bool is_free_spare(const Robot& robot) noexcept {
  return robot.self.role == Role::spare && robot.self.parent == nobody && robot.self.depth == invalid_depth;
}

// Of the robots with the fewest hops over free spares to the rooted tree the one that is farthest in the order.
int nearest_to_tree(const Robot& robot) noexcept {
  constexpr std::pair none(int{unreachable}, -serial_half_range - 1);
  return robot.least(none, [&](int k) {
    const Message& m = robot.said(k);
    return robot.alive(k) ? std::pair(int{m.tree_hops}, -ahead_by(m.seqno, robot.self.seqno)) : none;
  });
}

// "depth": an orphan's is invalid, which spreads to all robots below it by a hop per tick. In GROW TREE an old parent
// is only a constraint: it may be below me by now.
void update_depth(Robot& robot) noexcept {
  State& self = robot.self;
  const int up = self.phase < Phase::grow_tree ? robot.up() : robot.parent;
  const int above = robot.alive(up) ? robot.said(up).depth : invalid_depth;
  self.depth = static_cast<std::uint16_t>(robot.is_root() ? 1 : above == invalid_depth ? 0 : above + 1);
  const int k = is_free_spare(robot) ? nearest_to_tree(robot) : -1;
  self.tree_hops = self.depth != invalid_depth ? std::uint8_t{0}
                   : k < 0                     ? unreachable
                                               : static_cast<std::uint8_t>(robot.said(k).tree_hops + 1);
}

}  // namespace

constexpr Growth outwards{may_join_outwards, distance_to_committed, has_all_robots};
constexpr Growth inwards{may_join_inwards, distance_to_root, has_all_workers};

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

void take_parent(Robot& robot, int k) noexcept {
  State& self = robot.self;
  robot.set_parent(robot.said(k).id);
  self.committed = true;
  self.search_ticks = 0;
  self.hold = nobody;
  keep_up(robot, k);
  if (self.label == unknown_label) self.label = label_below(robot.said(k).label, robot.range(k));
  if (self.phase >= Phase::grow_tree) robot.set_old_parent(nobody);
}

// For an orphan that drafts a spare, the spare must be ahead; one about to join an edge stays behind.
void keep_up_with_tree(Robot& robot) noexcept {
  const int k = nearest_to_tree(robot);
  if (is_free_spare(robot) && k >= 0 && robot.self.phase >= Phase::grow_tree && robot.self.request == nobody)
    keep_up(robot, k);
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
    const bool leaves = self.role == Role::spare && self.phase >= Phase::grow_tree;
    if (self.parent == nobody) join(robot);
    else if (!robot.alive(robot.parent)) repair(robot);
    else if (leaves && !robot.has_child()) leave_tree(robot);
    reattach_orphan(robot);
  }
  update_seqno(robot);
  update_depth(robot);
}

}  // namespace banyan::paper
