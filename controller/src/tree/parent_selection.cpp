// SPDX-License-Identifier: MIT
#include "tree/parent_selection.hpp"

#include <algorithm>

#include "banyan/controller/core/search.hpp"
#include "tree/label.hpp"

namespace banyan {
namespace {

constexpr int patience_flood_ticks = 4;    // without a candidate, then the flood parent will do
constexpr int patience_relabel_ticks = 7;  // then a childless robot may take a new place in the order
constexpr int orphan_still_ticks = 5;      // as an orphan, then it no longer pulls its branch
constexpr int orphan_attach_ticks = 20;    // then it takes another parent
constexpr int drafted_attach_ticks = 4;    // the same for a spare that an orphan has taken

// The best candidate by the rule, -1 if none.
int choose_parent(const TreeRobot& robot, const ParentRule& rule) noexcept {
  int best = -1;
  for (int k = 0; k < robot.table().size(); ++k)
    if (is_candidate(robot, k) && (best < 0 || rule.prefers(k, best))) best = k;
  return best;
}

// No candidate for a while: the flood parent, even beyond the range in which parents are chosen, if it
// is ahead.
int flood_parent(const TreeRobot& robot) noexcept {
  const TreeState& self = robot.self;
  const int k = robot.table().find(self.flood_parent);
  if (k < 0 || !robot.is_sure(k)) return -1;
  const TreeStanding& m = robot.table().message(k);
  const bool near = robot.table().range(k) <= longest_link;
  return near && m.epoch == self.epoch && m.label < self.label && is_ahead(robot, k) ? k : -1;
}

// Still none: a childless robot has no robot below it, so it may move behind any committed neighbour.
int nearest_committed(const TreeRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  return least_of(table.size(), not_counted, [&](int k) {
    const TreeStanding& m = table.message(k);
    const bool may = robot.is_sure(k) && m.epoch == robot.self.epoch && m.committed && m.label != unknown_label &&
                     is_ahead(robot, k) && table.range(k) <= robot.parent_range();
    return may ? table.range(k) : not_counted;
  });
}

void join(TreeRobot& robot, const ParentRule& rule) noexcept {
  TreeState& self = robot.self;
  if (self.label == unknown_label || !rule.may_join) return;
  int k = choose_parent(robot, rule);
  if (k < 0) {
    if (self.search_ticks < UINT16_MAX) ++self.search_ticks;
    if (self.search_ticks > patience_flood_ticks) k = flood_parent(robot);
    const bool childless = robot.children.size == 0 && robot.old_children.size == 0;
    if (k < 0 && childless && self.search_ticks > patience_relabel_ticks) k = nearest_committed(robot);
  }
  if (k >= 0) take_parent(robot, k);
}

// Of a spare: nobody depends on it any more.
bool is_superfluous(const TreeRobot& robot) noexcept {
  return robot.self.phase >= Phase::grow_tree && robot.children.size == 0;
}

// The neighbour through which the rooted tree is nearest: a robot of the tree, or a free spare that can be
// drafted towards it. Never an orphan: it might be below me in the tree.
int way_to_tree(const TreeRobot& robot, float range) noexcept {
  const TreeTable& table = robot.table();
  int best = -1;
  const auto key = [&](int k) { return std::pair(table.message(k).tree_hops, table.range(k)); };
  for (int k = 0; k < table.size(); ++k) {
    const TreeStanding& m = table.message(k);
    if (!robot.is_sure(k) || m.epoch != robot.self.epoch || m.tree_hops == unreachable) continue;
    if (!is_ahead(robot, k) || m.old_parent == robot.self.id || table.range(k) > range) continue;
    if (best < 0 || key(k) < key(best)) best = k;
  }
  return best;
}

void reattach_orphan(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  const bool matters = !robot.is_root() && (self.is_worker || robot.useful_children > 0);
  const bool settled = self.phase >= Phase::grow_tree;
  if (!matters || !settled || self.depth != invalid_depth) {
    self.orphan_ticks = 0;
    return;
  }
  if (self.orphan_ticks < UINT16_MAX) ++self.orphan_ticks;
  const bool drafted = self.parent == nobody && !self.is_worker;
  if (self.orphan_ticks <= (drafted ? drafted_attach_ticks : orphan_attach_ticks)) return;
  const float last_resort = longest_link;
  int k = way_to_tree(robot, std::min(robot.parent_range(), last_resort));
  if (k < 0) k = way_to_tree(robot, last_resort);
  if (k < 0) return;
  take_parent(robot, k);
  self.orphan_ticks = orphan_still_ticks;  // time for the new parent to attach in turn
  ++self.tally.repairs;
}

// The order is still that of the old root: a robot that has handed over the token is ahead of its heir, and
// would take as parent a robot that is below it in the tree.
bool hangs_on_heir(const TreeRobot& robot) noexcept {
  return robot.self.phase == Phase::select_root && robot.self.parent == nobody && robot.old_parent_alive();
}

// A spare that has just joined my edge has its parent's sequence number of the last tick: I wait for it.
bool awaits_inserted(const TreeRobot& robot) noexcept {
  const int k = robot.table().find(robot.self.grant);
  return k >= 0 && robot.table().alive(k) && robot.table().message(k).inserted_child == robot.self.id;
}

// While I wait for another parent to get ahead, my sequence number rests: the other robot's overtakes it, unless
// that robot is below me.
void update_seqno(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  const bool was_fresh = self.seqno_ticks < serial_half_range;
  robot.add_elapsed(self.seqno_ticks);
  // So old that others could take it for new: this robot no longer has a place in the order (serial.hpp).
  if (was_fresh && self.seqno_ticks >= serial_half_range && !robot.is_root()) self.label = unknown_label;
  if (robot.is_root()) {
    ++self.seqno;
    self.seqno_ticks = 0;
  } else if (robot.parent_alive() && !awaits_inserted(robot) && self.pending_parent == nobody) {
    keep_up(robot, robot.parent);
  }
}

// Depth flows down; an orphan's is invalid, which spreads to all robots below it by a hop per tick.
void update_depth(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  // In GROW TREE an old parent is only a constraint: it may be below me in the tree by now.
  const int up = self.parent != nobody ? robot.parent : self.phase < Phase::grow_tree ? robot.old_parent : -1;
  if (robot.is_root()) {
    self.depth = 1;
  } else if (up >= 0 && robot.is_linked(up) && robot.table().message(up).depth != invalid_depth) {
    self.depth = static_cast<std::uint16_t>(std::min(robot.table().message(up).depth + 1, UINT16_MAX - 1));
  } else {
    self.depth = invalid_depth;
  }
}

// Hops over free spares to the rooted tree: the gradient that orphans follow.
void update_tree_hops(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  self.tree_hops = self.depth != invalid_depth ? std::uint8_t{0} : unreachable;
  if (self.depth != invalid_depth || self.role != Role::spare || self.parent != nobody) return;
  const TreeTable& table = robot.table();
  int nearest = -1;
  int hops = unreachable - 1;  // the most that is passed on; robots that know no way have more
  Serial freshest = 0;
  for (const Rows* const rows : {&table.nearest, &table.all()}) {
    if (nearest >= 0) break;
    rows->for_each([&](int k) {
      const TreeStanding& m = table.message(k);
      if (m.tree_hops > hops || !robot.is_linked(k)) return;
      if (m.tree_hops == hops && nearest >= 0 && !is_newer(m.seqno, freshest)) return;
      hops = m.tree_hops;
      freshest = m.seqno;
      nearest = k;
    });
  }
  self.tree_hops = nearest < 0 ? unreachable : static_cast<std::uint8_t>(hops + 1);
}

}  // namespace

bool is_candidate(const TreeRobot& robot, int k) noexcept {
  const TreeStanding& m = robot.table().message(k);
  // An edge that exists may be as long as the guard lets it grow.
  const float range = std::max(robot.parent_range(), k == robot.old_parent ? robot.params.ideal_distance : 0.0F);
  return robot.is_sure(k) && m.epoch == robot.self.epoch && m.label < robot.self.label && is_ahead(robot, k) &&
         robot.table().range(k) <= range;
}

bool is_ahead(const TreeRobot& robot, int k) noexcept {
  const TreeStanding& m = robot.table().message(k);
  const TreeState& self = robot.self;
  if (m.epoch != self.epoch || m.label >= largest_label) return false;  // nothing fits behind the largest label
  return m.seqno != self.seqno ? is_news(m.seqno, self.seqno, self.seqno_ticks) : m.label < self.label;
}

bool is_named_parent(const TreeRobot& robot) noexcept {
  return banyan::any_of(robot.children, [&](int k) { return robot.table().message(k).role != Role::spare; });
}

void keep_up(TreeRobot& robot, int k) noexcept {
  TreeState& self = robot.self;
  const TreeStanding& m = robot.table().message(k);
  if (m.epoch != self.epoch || m.label >= largest_label || !is_news(m.seqno, self.seqno, self.seqno_ticks)) return;
  self.seqno = m.seqno;
  self.seqno_ticks = 0;
  // A newer number permits a smaller label. Labels that only grew would in a long epoch reach the largest one, behind
  // which there is no place.
  const std::uint16_t below = label_below(m.label, robot.table().range(k));
  const bool renews = self.phase >= Phase::grow_tree;
  if (self.label == unknown_label || self.label <= m.label || (renews && self.label > below)) self.label = below;
}

void take_parent(TreeRobot& robot, int k) noexcept {
  TreeState& self = robot.self;
  robot.set_parent(k);
  self.committed = true;
  self.search_ticks = 0;
  self.pending_parent = nobody;
  keep_up(robot, k);
  // A robot without a label that is as fresh as its parent must not be ahead of it.
  if (self.label == unknown_label) self.label = label_below(robot.table().message(k).label, robot.table().range(k));
  if (self.phase >= Phase::grow_tree) robot.drop_old_parent();
}

void leave_tree(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  robot.drop_parent();
  robot.drop_old_parent();
  self.committed = false;
  self.need = Need::no_need;
  self.grant = nobody;
  self.request = nobody;
  self.pending_parent = nobody;
  self.spare_state = SpareState::wait;
}

bool is_orphan(const TreeRobot& robot) noexcept { return robot.self.orphan_ticks > orphan_still_ticks; }

void select_parent(TreeRobot& robot, const ParentRule& rule) noexcept {
  TreeState& self = robot.self;
  if (robot.is_root()) {
    robot.drop_parent();
    self.committed = true;
  } else if (self.phase >= Phase::select_parent && !hangs_on_heir(robot)) {
    if (self.parent == nobody) join(robot, rule);
    else if (self.role == Role::spare && (!robot.parent_alive() || is_superfluous(robot))) leave_tree(robot);
    reattach_orphan(robot);
  }
  update_seqno(robot);
  update_depth(robot);
  update_tree_hops(robot);
}

}  // namespace banyan
