// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/obstacles/bypass.hpp"
#include "banyan/controller/healing/healing.hpp"
#include "banyan/controller/tree/motion.hpp"

namespace banyan {
namespace {

constexpr float regroup_for_s = 40.0F;  // at most, then it waits again
constexpr int lost_ticks = 22;  // an orphan that has found no hold for so long has none in reach

bool is_cut_off(const HealingRobot& robot) noexcept {
  return robot.self.silence_ticks > robot.params.ticks(robot.params.retreat_after_s) + 2 * robot.liveness_ticks();
}

// The neighbour by which the rooted tree is nearest, none of my own branch; -1 if there is none.
int way_home(const HealingRobot& robot, bool workers_relay) noexcept {
  const TreeTable& table = robot.table();
  int best = -1;
  for (int k = 0; k < table.size(); ++k) {
    const TreeStanding& m = table.message(k);
    if (!table.alive(k) || (m.role == Role::worker && !workers_relay) || m.tree_hops == unreachable || m.parent == robot.self.id) continue;
    if (best < 0 || table.range(k) < table.range(best)) best = k;
  }
  return best;
}

}  // namespace

bool is_left_waiting(const HealingRobot& robot) noexcept {
  const HealingState& self = robot.self;
  const HealingParams& p = robot.params;
  return p.heals() && self.is_worker && self.root_known && self.parent != nobody && self.parent != self.root.id &&
         self.want_m > p.arrival_distance_m && self.unserved_ticks > p.ticks(p.regroup_after_s);
}

// A worker that still gets on, however slowly, has spares on their way.
void count_waiting(HealingRobot& robot, bool unserved, bool regroups) noexcept {
  HealingState& self = robot.self;
  const int after_ticks = robot.params.ticks(robot.params.regroup_after_s);
  if (!(unserved || regroups) || self.unserved_ticks >= robot.params.ticks(robot.params.regroup_after_s + regroup_for_s)) self.unserved_ticks = 0;
  else if (regroups || self.unserved_ticks < after_ticks || self.stalled_ticks >= after_ticks) robot.add_elapsed(self.unserved_ticks);
}

bool is_retreating(const HealingRobot& robot, bool regroups) noexcept {
  const HealingState& self = robot.self;
  if (!robot.params.heals() || robot.is_root() || !self.root_known) return false;
  return self.orphan_ticks > lost_ticks || is_cut_off(robot) || regroups;
}

Vec2 retreat_motion(const HealingRobot& robot, bool regroups, bool workers_relay) noexcept {
  constexpr float near_enough = 0.2F;  // of C
  const int k = is_cut_off(robot) || regroups ? -1 : way_home(robot, workers_relay);
  const Vec2 goal = k >= 0 ? robot.table().position(k) : robot.self.root_at;
  if (norm(goal) < near_enough * robot.params.communication_range_m) return avoidance(robot);
  return bypass(robot, goal) + avoidance(robot);
}

}  // namespace banyan
