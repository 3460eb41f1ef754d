// SPDX-License-Identifier: MIT
// How convoy keeps its tree small and in sight between reconstructions (docs/convoy.md, rules 5, 6, 9).
#include <algorithm>

#include "banyan/controller/convoy.hpp"
#include "banyan/controller/healing.hpp"
#include "banyan/controller/parent_selection.hpp"
#include "banyan/controller/plan.hpp"
#include "banyan/controller/sight.hpp"

namespace banyan {
namespace {

// Of `clearance`: a robot so near to the line of sight may soon be in it, and very soon.
constexpr float danger = 0.8F;
constexpr float urgency = 0.7F;
constexpr float narrow = 0.5F;           // just past a body: better than nothing
constexpr float impossible = 1e9F;

constexpr float merge_period_s = 2.0F;
constexpr float shorter_by = 0.1F;       // of C: an edge so much shorter is worth a change of parent
constexpr int wish_limit_ticks = 15;     // longer than pulses of two branches differ

// A robot of the rooted tree that does not name me as parent: heard this tick or the last, in sight.
bool is_rooted(const Robot& robot, int k) noexcept {
  const Neighborhood& table = robot.table();
  const Standing& m = table.message(k);
  return table.age(k) <= 1 && m.role != Role::spare && m.parent != robot.self.id && m.old_parent != robot.self.id &&
         m.depth != invalid_depth;
}

bool is_rooted_in_sight(const Robot& robot, int k) noexcept {
  return is_rooted(robot, k) && sees_clearly(robot, k, robot.params.clearance * robot.params.communication_range_m);
}

// That I may hang on now: ahead of me.
bool is_hold(const Robot& robot, int k, float range_m) noexcept {
  return robot.table().range(k) <= range_m && is_ahead(robot, k) && is_rooted_in_sight(robot, k);
}

// Rule 5: the connector between me and my grandparent serves only me, and is not needed any more.
void release(Robot& robot) noexcept {
  const Neighborhood& table = robot.table();
  const Standing& parent = table.message(robot.parent);
  if (parent.role != Role::connector || parent.child_count != 1 || parent.parent == nobody || parent.need == Need::await ||
      parent.inserted_child != nobody)
    return;
  const int k = table.find(parent.parent);
  if (k < 0 || (table.message(k).role == Role::worker && !is_relay(robot, k))) return;
  const Params& p = robot.params;
  const float reach = has_arrived(robot) ? std::max(p.release_distance, p.merge_distance) : p.release_distance;
  if (is_hold(robot, k, reach * p.communication_range_m)) take_parent(robot, k);
}

// An edge that would need a spare: a robot of the tree may stand nearer.
void take_nearer(Robot& robot) noexcept {
  const Params& p = robot.params;
  const Neighborhood& table = robot.table();
  int best = -1;
  float best_m = p.release_distance * p.communication_range_m;
  for (int k = 0; k < table.size(); ++k) {
    if (k == robot.parent || table.range(k) >= best_m || !is_hold(robot, k, best_m)) continue;
    if (table.message(k).role == Role::worker && !is_relay(robot, k)) continue;
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

// Who regroups takes whatever hold is nearer to the root.
void take_inner(Robot& robot) noexcept {
  const Neighborhood& table = robot.table();
  const int parent_depth = table.message(robot.parent).depth;
  int best = -1;
  for (int k = 0; k < table.size(); ++k) {
    if (table.message(k).role == Role::worker || table.message(k).depth >= parent_depth || !is_hold(robot, k, robot.params.parent_range_m())) continue;
    if (best < 0 || table.message(k).depth < table.message(best).depth) best = k;
  }
  if (best >= 0) take_parent(robot, best);
}

// ---- Rule 9: fewer robots, once all workers below have arrived ----

// Who may carry a branch that has arrived: at rest itself, and not about to leave the tree.
bool is_berth(const Robot& robot, int k) noexcept {
  const Standing& m = robot.table().message(k);
  return k != robot.parent && m.want_cm == 0 && m.epoch == robot.self.epoch &&
         (m.role != Role::connector || m.child_count > 0) && is_rooted_in_sight(robot, k);
}

// My parent serves only me: with another one for me it is not needed, nor are those above it that
// serve only it.
bool saves_parent(const Robot& robot) noexcept {
  const Standing& parent = robot.table().message(robot.parent);
  return parent.role == Role::connector && parent.child_count == 1;
}

// Whoever is nearest to the root takes me over at once.
bool merge(Robot& robot) noexcept {
  const Neighborhood& table = robot.table();
  const float reach_m = robot.params.merge_distance * robot.params.communication_range_m;
  int best = -1;
  for (int k = 0; k < table.size(); ++k) {
    if (table.range(k) > reach_m || table.message(k).label_cm >= robot.self.label_cm || !is_ahead(robot, k)) continue;
    if (best >= 0 && table.message(k).label_cm >= table.message(best).label_cm) continue;
    if (is_berth(robot, k)) best = k;
  }
  if (best < 0) return false;
  take_parent(robot, best);
  return true;
}

// Those that are not ahead of me may hang on me, or be of another branch: I cannot tell. I let my
// pulse rest. Who hangs on me never overtakes it. Each turn another one, or the first that hangs on
// me would be the only one ever tried.
void make_wish(Robot& robot, float reach_m, int turn) noexcept {
  const Neighborhood& table = robot.table();
  IndexList berths;
  for (int k = 0; k < table.size(); ++k)
    if (table.range(k) < reach_m && is_berth(robot, k)) berths.push(k);
  if (berths.size == 0) return;
  robot.self.wish = table.id(berths.items[turn % berths.size]);
  robot.self.wish_ticks = 0;
}

void follow_wish(Robot& robot) noexcept {
  State& self = robot.self;
  const int k = robot.table().find(self.wish);
  const float reach_m = robot.params.merge_distance * robot.params.communication_range_m;
  if (k < 0 || ++self.wish_ticks > wish_limit_ticks || robot.table().range(k) > reach_m || !is_berth(robot, k)) {
    self.wish = nobody;
  } else if (is_ahead(robot, k)) {
    take_parent(robot, k);
  }
}

// I lead my branch to another target: the robot of the tree next to it that I can reach.
void wish_for_next_step(Robot& robot) noexcept {
  Vec2 goal;
  if (!find_goal(robot, goal)) return;
  const Neighborhood& table = robot.table();
  const float c = robot.params.communication_range_m;
  int best = -1;
  float best_m = distance(table.position(robot.parent), goal) - shorter_by * c;
  for (int k = 0; k < table.size(); ++k) {
    const float d = distance(table.position(k), goal);
    if (d >= best_m || table.range(k) > robot.params.merge_distance * c || !is_berth(robot, k)) continue;
    best = k;
    best_m = d;
  }
  if (best < 0) return;
  robot.self.wish = table.id(best);
  robot.self.wish_ticks = 0;
}

// In turns, so that neighbours see what the others have done.
void save_robots(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.wish != nobody) return follow_wish(robot);
  if (is_planned(self)) return wish_for_next_step(robot);  // other changes would undo the plan
  const Params& p = robot.params;
  const int period = std::max(1, p.ticks(merge_period_s));
  const Standing& parent = robot.table().message(robot.parent);
  if ((self.phase_ticks + self.id) % period != 0 || parent.need == Need::await || parent.inserted_child != nobody) return;
  const int turn = self.phase_ticks / period;
  const float c = p.communication_range_m;
  if (!saves_parent(robot)) make_wish(robot, robot.table().range(robot.parent) - shorter_by * c, turn);
  else if (!merge(robot)) make_wish(robot, p.merge_distance * c, turn);
}

// How bad neighbour k would be as parent in place of one that is hidden, or soon will be: the nearer it
// is to the old edge the better; rather one of the tree than a spare, which joins because it is named.
float stopgap_cost(const Robot& robot, int k, bool urgent) noexcept {
  const Params& p = robot.params;
  const Neighborhood& table = robot.table();
  const Standing& m = table.message(k);
  const float c = p.communication_range_m;
  if (k == robot.parent || table.age(k) > 0 || table.range(k) > p.parent_range_m()) return impossible;
  const bool spare = m.role == Role::spare && m.parent == nobody && m.request == nobody && m.epoch == robot.self.epoch &&
                     m.tree_hops != unreachable;
  if (!spare && !is_rooted(robot, k)) return impossible;
  const bool clear = sees_clearly(robot, k, p.clearance * c);
  if (!clear && !(urgent && sees_clearly(robot, k, narrow * p.clearance * c))) return impossible;
  const Vec2 at = table.position(k);
  return norm(nearest_on_segment(-at, table.position(robot.parent) - at)) + (spare ? c : 0.0F) + (clear ? 0.0F : 2.0F * c);
}

// Rule 6: the best stopgap that is ahead of me, a spare only when it is urgent. If there is none, my
// pulse rests, so that the others get ahead; not for long, for they may all hang on me.
void keep_in_sight(Robot& robot, bool urgent) noexcept {
  State& self = robot.self;
  const Neighborhood& table = robot.table();
  int best = -1;
  int behind = -1;
  float best_cost = impossible;
  float behind_cost = impossible;
  for (int k = 0; k < table.size(); ++k) {
    const float cost = stopgap_cost(robot, k, urgent);
    const bool ahead = is_ahead(robot, k);
    if (!ahead && cost < behind_cost) {
      behind_cost = cost;
      behind = k;
    } else if (ahead && cost < best_cost && (urgent || table.message(k).role != Role::spare)) {
      best_cost = cost;
      best = k;
    }
  }
  if (best < 0) {
    self.wish = behind < 0 || ++self.wish_ticks > wish_limit_ticks ? nobody : table.id(behind);
    return;
  }
  self.grant = nobody;  // of the edge that is given up
  take_parent(robot, best);
}

// I stand where I hide my parent from its own parent: that one takes me, and my parent can hang on me.
bool step_before_parent(Robot& robot) noexcept {
  const Params& p = robot.params;
  const Neighborhood& table = robot.table();
  const int k = table.find(table.message(robot.parent).parent);
  if (k < 0 || table.age(k) > 0) return false;
  const float d = norm(nearest_on_segment(table.position(robot.parent), table.position(k)));
  if (d > danger * p.clearance * p.communication_range_m || !is_hold(robot, k, p.parent_range_m())) return false;
  take_parent(robot, k);
  return true;
}

// Of the robots around an edge its lower end may see less than the upper: others hide them.
RobotId child_to_warn(const Robot& robot) noexcept {
  const Params& p = robot.params;
  const Neighborhood& table = robot.table();
  for (const int k : robot.children)
    if (table.message(k).role != Role::spare && table.age(k) == 0 && !sees_clearly(robot, k, danger * p.clearance * p.communication_range_m))
      return table.id(k);
  return nobody;
}

}  // namespace

void take_shortcuts(Robot& robot) noexcept {
  State& self = robot.self;
  self.warned = child_to_warn(robot);
  if (self.phase != Phase::grow_tree || robot.parent < 0 || self.role == Role::spare || self.inserted_child != nobody) {
    self.wish = nobody;
    return;
  }
  constexpr int hidden_ticks = 1;
  const Params& p = robot.params;
  const bool hidden = robot.table().age(robot.parent) > std::max(hidden_ticks, usual_silence_ticks(robot));
  const float clearance_m = p.clearance * p.communication_range_m;
  const bool warned = robot.table().message(robot.parent).warned == self.id;
  const bool endangered = hidden || warned || !sees_clearly(robot, robot.parent, danger * clearance_m);
  const bool may_save = !endangered && self.grant == nobody && has_arrived(robot);
  if (!endangered && !may_save) self.wish = nobody;
  if (!endangered && self.wish == nobody) self.wish_ticks = 0;
  if (endangered) return keep_in_sight(robot, hidden || warned || !sees_clearly(robot, robot.parent, urgency * clearance_m));
  if (self.grant != nobody) return;  // the tree changes here already
  if (step_before_parent(robot)) return;
  if (is_regrouping(robot)) take_inner(robot);
  else if (self.want_m > 0.0F && robot.table().message(robot.parent).role == Role::worker) leave_worker(robot);
  else if (self.need == Need::need) take_nearer(robot);
  else if (self.errand == nobody) release(robot);
  if (may_save) save_robots(robot);
}

}  // namespace banyan
