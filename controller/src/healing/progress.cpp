// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/core/fixed_point.hpp"
#include "healing/healing.hpp"

namespace banyan {
namespace {

constexpr int progress_steps = 6;  // of per_range: so much nearer is progress

// How much of a tick at full speed towards the target this velocity is, in eighteenths; back and forth adds to 0.
// On the way round an obstacle every motion counts as one towards the target.
int eighteenths(const HealingRobot& robot, Vec2 v, bool hindered) noexcept {
  const float towards = dot(v, unit(*robot.target));
  if (!hindered) return static_cast<int>(static_cast<float>(patience_hindered) * towards);
  return v != Vec2{} && (robot.self.detour.side != 0 || towards > 0.0F) ? 1 : 0;
}

void give_up(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  if (Task* task = find_task(self, self.serves); task != nullptr) {
    if (self.forgets) begin_doubt(robot, *task);
    task->gave_up = true;
  }
  resign(robot);
}

}  // namespace

void watch_progress(HealingRobot& robot, bool retreats, Vec2 v) noexcept {
  HealingState& self = robot.self;
  const HealingParams& p = robot.params;
  const float left = robot.target != nullptr && self.is_worker && !robot.is_station ? norm(*robot.target) : 0.0F;
  if (!p.heals() || left <= p.arrival_distance) {
    self.progress = {};
    return;
  }
  const auto left_steps = to_fixed<std::uint16_t>(left, per_range);
  if (retreats) {  // what it drives back it will have to drive again
    self.progress.least = left_steps;
    return;
  }
  const bool hindered = self.detour.side != 0 || !robot.obstacles.empty() || robot.target_strays;
  if (hindered) {  // behind the obstacle begins a new way; a tick that brings it nearer is not in vain
    const bool nearer = left_steps < self.progress.least;
    self.progress.least = left_steps;
    if (nearer) return;
  } else if (left_steps + progress_steps <= self.progress.least) {
    self.progress = {left_steps, 0};
    return;
  }
  const int most = patience_hindered * p.rounds(p.give_up_after_drives);
  const int vain = self.progress.vain_ticks + eighteenths(robot, v, hindered) * robot.elapsed_ticks;
  self.progress.vain_ticks = static_cast<std::uint16_t>(std::clamp(vain, 0, most));
  if (vain <= 0) self.progress.least = left_steps;  // it has been led away, and has to drive that again
  if (vain > most) give_up(robot);
}

}  // namespace banyan
