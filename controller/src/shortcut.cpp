// SPDX-License-Identifier: MIT
// How convoy keeps its tree small and in sight between reconstructions (docs/convoy.md, rules 5, 6, 9).
#include <algorithm>

#include "banyan/controller/convoy.hpp"
#include "banyan/controller/parent_selection.hpp"
#include "banyan/controller/sight.hpp"

namespace banyan {
namespace {

// A robot of the tree that I may hang on: heard this tick or the last, ahead of me, in sight.
bool is_hold(const Robot& robot, int k, float range_m) noexcept {
  const Neighborhood& table = robot.table();
  const Standing& m = table.message(k);
  return table.age(k) <= 1 && table.range(k) <= range_m && m.role != Role::spare && m.parent != robot.self.id &&
         m.old_parent != robot.self.id && m.depth != invalid_depth && is_ahead(robot, k) &&
         sees_clearly(robot, k, robot.params.clearance * robot.params.communication_range_m);
}

// Rule 5: the connector between me and my grandparent serves only me, and is not needed any more.
void release(Robot& robot) noexcept {
  const Neighborhood& table = robot.table();
  const Standing& parent = table.message(robot.parent);
  if (parent.role != Role::connector || parent.child_count != 1 || parent.parent == nobody || parent.need == Need::await ||
      parent.inserted_child != nobody)
    return;
  const int k = table.find(parent.parent);
  if (k < 0 || table.message(k).role == Role::worker) return;
  if (is_hold(robot, k, robot.params.release_distance * robot.params.communication_range_m)) take_parent(robot, k);
}

// An edge that would need a spare: a robot of the tree may stand nearer.
constexpr float DANGER = 0.8F, URGENT = 0.7F;
void take_nearer(Robot& robot) noexcept {
  const Params& p = robot.params;
  const Neighborhood& table = robot.table();
  int best = -1;
  float best_m = p.release_distance * p.communication_range_m;
  for (int k = 0; k < table.size(); ++k) {
    if (k == robot.parent || table.range(k) >= best_m || table.message(k).role == Role::worker || !is_hold(robot, k, best_m)) continue;
    best = k;
    best_m = table.range(k);
  }
  if (best >= 0) take_parent(robot, best);
}

// A worker goes its own way and cannot be towed: as long as I have to go on, anybody else will do.
void leave_worker(Robot& robot) noexcept {
  const Neighborhood& table = robot.table();
  int best = -1;
  for (int k = 0; k < table.size(); ++k) {
    if (table.message(k).role == Role::worker || !is_hold(robot, k, robot.params.parent_range_m())) continue;
    if (best < 0 || table.range(k) < table.range(best)) best = k;
  }
  if (best >= 0) take_parent(robot, best);
}

// Rule 6: my parent is hidden, or soon will be. The visible robot nearest to the old edge that is
// ahead of me: one of the tree or, when it is too late, a spare, which joins because it is named.
void keep_in_sight(Robot& robot, bool urgent) noexcept {
  const Params& p = robot.params;
  const Neighborhood& table = robot.table();
  const Vec2 parent = table.position(robot.parent);
  const float clearance_m = p.clearance * p.communication_range_m;
  int best = -1;
  float best_m = 1e9F;
  for (int k = 0; k < table.size(); ++k) {
    const Standing& m = table.message(k);
    if (k == robot.parent || table.age(k) > 0) continue;
    const bool spare = urgent && m.role == Role::spare && m.parent == nobody && m.request == nobody && is_ahead(robot, k) &&
                       m.tree_hops != unreachable && table.range(k) <= p.parent_range_m() && sees_clearly(robot, k, clearance_m);
    if (!spare && !is_hold(robot, k, p.parent_range_m())) continue;
    const float d = norm(nearest_on_segment(-table.position(k), parent - table.position(k))) + (spare ? p.communication_range_m : 0.0F);
    if (d < best_m) {
      best_m = d;
      best = k;
    }
  }
  if (best < 0) return;
  robot.self.grant = nobody;  // of the edge that is given up
  take_parent(robot, best);
}

}  // namespace

void take_shortcuts(Robot& robot) noexcept {
  const State& self = robot.self;
  if (self.phase != Phase::grow_tree || robot.parent < 0 || self.role == Role::spare || self.inserted_child != nobody) return;
  constexpr int hidden_ticks = 1;
  const Params& p = robot.params;
  const bool hidden = robot.table().age(robot.parent) > std::max(hidden_ticks, usual_silence_ticks(robot));
  const float clearance_m = p.clearance * p.communication_range_m;
  const bool endangered = hidden || !sees_clearly(robot, robot.parent, DANGER * clearance_m);
  if (endangered) keep_in_sight(robot, hidden || !sees_clearly(robot, robot.parent, URGENT * clearance_m));
  else if (self.grant != nobody) return;  // the tree changes here already
  else if (self.want_m > 0.0F && robot.table().message(robot.parent).role == Role::worker) leave_worker(robot);
  else if (robot.self.need == Need::need) take_nearer(robot);
  else release(robot);
}

}  // namespace banyan
