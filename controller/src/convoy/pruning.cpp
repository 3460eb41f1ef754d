// SPDX-License-Identifier: MIT
// Rule 9: fewer robots, once all workers below have arrived.
#include "convoy/shortcut.hpp"

#include <algorithm>

#include "convoy/plan.hpp"
#include "convoy/towing.hpp"
#include "tree/parent_selection.hpp"

namespace banyan {
namespace {

constexpr int period = 20;          // ticks
constexpr float shorter_by = 0.1F;  // of C: an edge so much shorter is worth a change of parent

// Whether neighbour k may carry a branch that has arrived: at rest itself, and not about to leave the tree.
bool can_carry(const ConvoyRobot& robot, int k) noexcept {
  const TreeStanding& m = robot.table().message(k);
  return k != robot.parent && !is_leaving(robot, k) && m.want == 0 && m.epoch == robot.self.epoch &&
         (m.role != Role::connector || robot.convoy_of(k).child_count > 0) && is_rooted_in_sight(robot, k);
}

// My parent serves only me: if I take another one, it is no longer needed, and neither are the robots above
// it that serve only it.
bool saves_parent(const ConvoyRobot& robot) noexcept {
  const TreeStanding& parent = robot.table().message(robot.parent);
  return parent.role == Role::connector && robot.convoy_of(robot.parent).child_count == 1;
}

// Takes the reachable neighbour nearest to the root as parent, at once.
bool merge(ConvoyRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const float reach = thrifty(robot.params, robot.params.merge_distance);
  int best = -1;
  for (int k = 0; k < table.size(); ++k) {
    if (table.range(k) > reach || table.message(k).label >= robot.self.label || !is_ahead(robot, k)) continue;
    if (best >= 0 && table.message(k).label >= table.message(best).label) continue;
    if (can_carry(robot, k)) best = k;
  }
  if (best < 0) return false;
  take_parent(robot, best);
  return true;
}

// Robots that are not ahead of me may be below me in the tree or in another branch: I cannot tell. I let my
// sequence number rest, which a robot below me never overtakes. Each turn tries another candidate; otherwise a
// robot below me might be the only one ever tried.
void want_parent(ConvoyRobot& robot, float reach, int turn) noexcept {
  const TreeTable& table = robot.table();
  IndexList carriers;
  for (int k = 0; k < table.size(); ++k)
    if (table.range(k) < reach && can_carry(robot, k)) carriers.push(k);
  if (carriers.size == 0) return;
  robot.self.pending_parent = table.id(carriers.items[turn % carriers.size]);
  robot.self.pending_ticks = 0;
}

void follow_pending(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  const int k = robot.table().find(self.pending_parent);
  const float reach = thrifty(robot.params, robot.params.merge_distance);
  if (k < 0 || ++self.pending_ticks > pending_limit_ticks || robot.table().range(k) > reach || !can_carry(robot, k)) {
    self.pending_parent = nobody;
  } else if (is_ahead(robot, k)) {
    take_parent(robot, k);
  }
}

// I lead my branch to another target: I want the robot of the tree nearest to it that I can reach.
void want_next_step(ConvoyRobot& robot) noexcept {
  Vec2 goal;
  if (!find_goal(robot, goal)) return;
  const TreeTable& table = robot.table();
  int best = -1;
  float best_length = distance(table.position(robot.parent), goal) - shorter_by;
  for (int k = 0; k < table.size(); ++k) {
    const float d = distance(table.position(k), goal);
    if (d >= best_length || table.range(k) > thrifty(robot.params, robot.params.merge_distance) || !can_carry(robot, k))
      continue;
    best = k;
    best_length = d;
  }
  if (best < 0) return;
  robot.self.pending_parent = table.id(best);
  robot.self.pending_ticks = 0;
}

}  // namespace

// In turns, so that neighbours see what the others have done.
void prune(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  if (self.pending_parent != nobody) return follow_pending(robot);
  if (is_planned(self)) return want_next_step(robot);  // other changes would undo the plan
  const ConvoyParams& p = robot.params;
  const TreeStanding& parent = robot.table().message(robot.parent);
  if (static_cast<int>((self.phase_ticks + self.id) % period) >= robot.elapsed_ticks || parent.need == Need::await ||
      parent.inserted_child != nobody)
    return;
  const int turn = self.phase_ticks / period;
  if (!saves_parent(robot)) want_parent(robot, robot.table().range(robot.parent) - shorter_by, turn);
  else if (!merge(robot)) want_parent(robot, thrifty(p, p.merge_distance), turn);
}

}  // namespace banyan
