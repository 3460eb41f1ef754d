// SPDX-License-Identifier: MIT
// Which change of parent comes first, and shortening branches.
#include "convoy/shortcut.hpp"

#include <algorithm>

#include "banyan/controller/core/search.hpp"
#include "convoy/folding.hpp"
#include "convoy/handing_on.hpp"
#include "convoy/towing.hpp"
#include "healing/healing.hpp"
#include "obstacles/sight.hpp"
#include "tree/parent_selection.hpp"

namespace banyan {
namespace {

constexpr float beside_leaver = 0.6F;   // of `clearance`: less room will do, for the leaver stands beside its successor
constexpr float releases_later = 3.0F;  // times the spread of ranges: else the edge would ask for a spare again
constexpr float folded_release = 0.92F;  // of the longest folded edge: the parent between is not needed then

// Rule 5: the connector between me and my grandparent serves only me, and is not needed any more.
void release(ConvoyRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const TreeStanding& parent = table.message(robot.parent);
  if (parent.role != Role::connector || robot.convoy_of(robot.parent).child_count != 1 || parent.parent == nobody ||
      parent.need == Need::await || parent.inserted_child != nobody)
    return;
  const int k = table.find(parent.parent);
  if (k < 0 || (table.message(k).role == Role::worker && !is_relay(robot, k))) return;
  const ConvoyParams& p = robot.params;
  // A worker cannot be towed: a robot released between it and the root is free for the edge to its child.
  const bool helps = robot.self.is_worker && robot.self.call_hops == 1;
  const float merge = has_arrived(robot) ? thrifty(p, p.merge_distance) : helps ? p.merge_distance : 0.0F;
  const float limit = folds(robot) ? folded_release * folded_edge(p) : std::max(p.release_distance, merge);
  const float reach = limit - releases_later * table.spread();
  if (may_be_parent(robot, k, reach)) take_parent(robot, k);
}

// A worker that stands still and from which I can reach my target: neither of us has to be towed.
bool is_enough(const ConvoyRobot& robot, int k) noexcept {
  return stands_at_target(robot, k) && reaches_target_from(robot, k);
}

// For an edge that would need a spare: a nearer robot of the tree, or a worker from which I can reach my target.
void take_nearer(ConvoyRobot& robot) noexcept {
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  int best = -1;
  float best_length = folds(robot) ? folded_edge(p) : p.release_distance;
  for (int k = 0; k < table.size(); ++k) {
    if (k == robot.parent || table.range(k) >= best_length || !may_be_parent(robot, k, best_length)) continue;
    if (table.message(k).role == Role::worker && !is_relay(robot, k) && !is_enough(robot, k)) continue;
    best = k;
    best_length = table.range(k);
  }
  for (int k = 0; best < 0 && k < table.size() && !folds(robot); ++k)
    if (k != robot.parent && is_enough(robot, k) && may_be_parent(robot, k, robot.parent_range())) best = k;
  if (best >= 0) take_parent(robot, best);
}

// A worker goes its own way and cannot be towed: as long as I have to go on, any other robot is better.
void leave_worker(ConvoyRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const int best = least_of(table.size(), not_counted, [&](int k) {
    const bool may = table.message(k).role != Role::worker && may_be_parent(robot, k, robot.parent_range());
    return may ? table.range(k) : not_counted;
  });
  if (best >= 0) take_parent(robot, best);
}

// A robot that regroups takes any parent that is nearer to the root.
void take_inner(ConvoyRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const auto depth = [&](int k) { return static_cast<float>(table.message(k).depth); };
  const int best = least_of(table.size(), depth(robot.parent), [&](int k) {
    const bool may = table.message(k).role != Role::worker && may_be_parent(robot, k, robot.parent_range());
    return may ? depth(k) : not_counted;
  });
  if (best >= 0) take_parent(robot, best);
}

}  // namespace

bool stands_at_target(const ConvoyRobot& robot, int k) noexcept {
  if (robot.table().message(k).role != Role::worker) return false;
  const Task* task = find_task(robot.self, robot.served_by(k));
  return task != nullptr && !task->unlocated &&
         distance(robot.table().position(k), task->target) < robot.params.arrival_distance;
}

bool reaches_target_from(const ConvoyRobot& robot, int k) noexcept {
  if (robot.table().message(k).role != Role::worker || robot.target == nullptr) return false;
  Vec2 at = robot.table().position(k);
  if (!stands_at_target(robot, k)) {
    const Task* task = find_task(robot.self, robot.served_by(k));
    if (task != nullptr && !task->unlocated) at = task->target;
  }
  return distance(at, *robot.target) < robot.parent_range();
}

bool is_rooted(const ConvoyRobot& robot, int k) noexcept {
  const TreeTable& table = robot.table();
  const TreeStanding& m = table.message(k);
  return table.age(k) <= 1 && robot.is_sure(k) && m.role != Role::spare && m.parent != robot.self.id &&
         m.old_parent != robot.self.id && m.depth != invalid_depth;
}

bool is_rooted_in_sight(const ConvoyRobot& robot, int k) noexcept {
  return is_rooted(robot, k) && sees_clearly(robot, k, robot.params.clearance);
}

bool may_be_parent(const ConvoyRobot& robot, int k, float range) noexcept {
  return robot.table().range(k) <= range && !is_leaving(robot, k) && is_ahead(robot, k) && is_rooted_in_sight(robot, k);
}

void take_shortcuts(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  self.warned = child_to_warn(robot);
  if (self.phase != Phase::grow_tree || robot.parent < 0 || self.role == Role::spare || self.inserted_child != nobody) {
    self.pending_parent = nobody;
    return;
  }
  if (robot.power != nullptr && is_relieved(*robot.power)) return;  // the robot beside me keeps its edge
  const Outlook view = outlook(robot);
  const bool may_save = !view.endangered && self.grant == nobody && has_arrived(robot) && !folds(robot);
  if (!view.endangered && !may_save) self.pending_parent = nobody;
  if (!view.endangered && self.pending_parent == nobody) self.pending_ticks = 0;
  if (view.endangered) return keep_in_sight(robot, view.urgent);
  if (self.grant != nobody) return;  // this edge is about to change already
  if (robot.power != nullptr) {
    const int k = successor_of_parent(*robot.power, [&](int n) {
      return robot.table().range(n) <= robot.parent_range() && is_ahead(robot, n) && is_rooted(robot, n) &&
             sees_clearly(robot, n, beside_leaver * robot.params.clearance);
    });
    if (k >= 0) return take_parent(robot, k);
    if (is_leaving(robot) || robot.power->power.said.relieves != nobody) return;  // no robot is saved meanwhile
  }
  if (step_before_parent(robot) || leave_junction(robot)) return;
  if (is_left_waiting(robot)) take_inner(robot);
  else if (self.want > 0.0F && robot.table().message(robot.parent).role == Role::worker) leave_worker(robot);
  else if (self.need == Need::need) take_nearer(robot);
  else if (self.lead_to == nobody) release(robot);
  if (may_save) prune(robot);
}

}  // namespace banyan
