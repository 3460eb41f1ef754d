// SPDX-License-Identifier: MIT
#include "healing/tie.hpp"

#include <algorithm>

#include "healing/healing.hpp"

namespace banyan {

bool is_in_the_clear(const HealingRobot& robot, int k) noexcept {
  constexpr float bodies = 3.0F;  // of the radius: a body that hides it may have moved since
  const TreeParams& p = robot.params;
  const TreeTable& table = robot.table();
  if (!p.line_of_sight) return true;
  if (!robot.obstacles.empty()) return false;
  const Vec2 there = table.position(k);
  for (int j = 0; j < table.size(); ++j)
    if (j != k && distance_to_segment(table.position(j), Vec2{}, there) < bodies * p.body_radius) return false;
  return true;
}

bool may_depend(const HealingRobot& robot, int k) noexcept {
  const TreeState& self = robot.self;
  const TreeStanding& m = robot.table().message(k);
  if (m.parent == self.id || m.old_parent == self.id) return m.role != Role::spare || robot.has_bursts();
  if (is_untied(m) || hold_of(m) == self.id || robot.table().id(k) == robot.held) return true;
  return robot.held == nobody && self.parent == nobody && self.old_parent == nobody && !robot.is_root();
}

bool may_be_tied(const HealingRobot& robot, int k) noexcept {
  const int longest_ticks = std::max(longest_silence_ticks, robot.loss_ticks);
  const bool has_ties = robot.tie_ticks > 0 || may_start_thin(robot);
  return has_ties && robot.table().age(k) <= longest_ticks && may_depend(robot, k);
}

bool is_tie(const HealingRobot& robot, int k) noexcept {
  return robot.table().age(k) <= robot.tie_ticks && may_depend(robot, k) && is_in_the_clear(robot, k);
}

float strayed_way(const HealingRobot& robot, int k) noexcept {
  constexpr int usual_ticks = 2;     // for so long a neighbour is silent now and then
  constexpr int at_most_ticks = 30;  // it will not have driven away for longer
  const int ticks = robot.table().age(k) - usual_ticks;
  if (robot.tie_ticks == 0 || ticks <= 0) return 0.0F;
  if (robot.self.phase == Phase::init) return 0.0F;  // nobody near has set out, and beyond it others may hear me
  if ((robot.table().alive(k) && !robot.has_bursts()) || !is_in_the_clear(robot, k)) return 0.0F;
  const TreeParams& p = robot.params;
  return p.speed_gain * p.way_in_a_round() *
         static_cast<float>(robot.has_bursts() ? ticks : std::min(ticks, at_most_ticks));
}

}  // namespace banyan
