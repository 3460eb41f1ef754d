// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/core/search.hpp"
#include "healing/healing.hpp"
#include "obstacles/bypass.hpp"
#include "tree/motion.hpp"

namespace banyan {
namespace {

constexpr float regroup_for_drives = 4.0F;  // at most, then it waits again
constexpr int lost_ticks = 22;              // an orphan that has found no hold for so long has none in reach

bool is_cut_off(const HealingRobot& robot) noexcept {
  return robot.self.silence_ticks >
         whole(robot.params.retreat_after_rounds) + 2 * std::max(robot.liveness_ticks(), robot.tie_ticks);
}

// A robot that hears no other keeps none connected and may search: a root left alone or hidden among bodies, or a
// robot that came back to where the root was and found no other. It first waits as long as a worker to which no spare
// comes, since after a short radio failure all should be where they were. One that has never heard any waits, too.
bool is_alone(const HealingRobot& robot) noexcept {
  const HealingState& self = robot.self;
  return self.silence_ticks > robot.params.rounds(robot.params.regroup_after_drives) && self.expected_packets > 0.0F &&
         hears_nobody(robot);
}

// A spiral around the place where the others were. It needs no compass.
Vec2 search(const HealingRobot& robot) noexcept {
  constexpr float pitch = 0.08F;   // of C, a turn's growth of the radius over 2 pi: turns are C/2 apart
  constexpr float stride = 0.25F;  // of C: how far ahead it looks for a way past obstacles
  const Vec2 in = robot.self.root_at;
  const Vec2 along = Vec2{in.y, -in.x} - unit(in) * pitch;
  return bypass(robot, (norm(in) > same_spot ? unit(along) : Vec2{1.0F, 0.0F}) * stride);
}

// The nearest neighbour that knows a way to the rooted tree and is no child of mine; -1 if there is none.
int way_home(const HealingRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  return least_of(table.size(), not_counted, [&](int k) {
    const TreeStanding& m = table.message(k);
    const bool knows = table.alive(k) && m.tree_hops != unreachable && m.parent != robot.self.id;
    return knows ? table.range(k) : not_counted;
  });
}

}  // namespace

bool is_left_waiting(const HealingRobot& robot) noexcept {
  const HealingState& self = robot.self;
  const HealingParams& p = robot.params;
  return p.heals() && self.is_worker && self.root_known && self.parent != nobody && self.parent != self.root.id &&
         self.want > p.arrival_distance && self.unserved_ticks > p.rounds(p.regroup_after_drives);
}

// For a worker that still makes progress, however slowly, spares are on their way.
void count_waiting(HealingRobot& robot, bool unserved, bool regroups) noexcept {
  HealingState& self = robot.self;
  if (!(unserved || regroups)) {
    self.unserved_ticks = 0;
    return;
  }
  const int after_ticks = robot.params.rounds(robot.params.regroup_after_drives);
  if (self.unserved_ticks >= robot.params.rounds(robot.params.regroup_after_drives + regroup_for_drives))
    self.unserved_ticks = 0;
  else if (regroups || self.unserved_ticks < after_ticks || self.stalled_ticks >= after_ticks)
    robot.add_elapsed(self.unserved_ticks);
}

bool is_retreating(const HealingRobot& robot, bool regroups) noexcept {
  const HealingState& self = robot.self;
  if (!robot.params.heals() || !self.root_known) return false;
  if (robot.is_root()) return is_alone(robot);
  return self.orphan_ticks > lost_ticks || is_cut_off(robot) || regroups;
}

Vec2 retreat_motion(const HealingRobot& robot, bool regroups) noexcept {
  constexpr float near_enough = 0.2F;  // of C
  if (is_alone(robot)) return search(robot);
  const int k = is_cut_off(robot) || regroups ? -1 : way_home(robot);
  const Vec2 goal = k >= 0 ? robot.table().position(k) : robot.self.root_at;
  if (norm(goal) < near_enough) return avoidance(robot);
  return bypass(robot, goal) + avoidance(robot);
}

}  // namespace banyan
