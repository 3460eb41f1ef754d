// SPDX-License-Identifier: MIT
#include "banyan/controller/core/fixed_point.hpp"
#include "banyan/controller/healing/healing.hpp"

namespace banyan {
namespace {

constexpr float least_speed = 0.25F;  // of v: slower, it waits for others
constexpr int nearer_cm = 5;
constexpr int patience_hindered = 18;  // times as long: the way round may be long, and the target may drive away

// It is to drive towards its target, or round what is in between.
bool drives(const HealingRobot& robot, Vec2 v) noexcept {
  if (robot.self.detour.side != 0) return v != Vec2{};
  return dot(v, unit(*robot.target)) >= least_speed * robot.params.wheel_limit_m_s;
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

void watch_progress(HealingRobot& robot, Vec2 v) noexcept {
  HealingState& self = robot.self;
  const HealingParams& p = robot.params;
  const float left_m = robot.target != nullptr && self.is_worker ? norm(*robot.target) : 0.0F;
  if (!p.heals() || left_m <= p.arrival_distance_m) {
    self.progress = {};
    return;
  }
  const auto left_cm = to_fixed<std::uint16_t>(left_m, per_cm);
  const bool hindered = self.detour.side != 0 || !robot.obstacles.empty() || robot.target_strays;
  if (hindered) {  // what lies behind the obstacle is a new way
    self.progress.least_cm = left_cm;
  } else if (left_cm + nearer_cm <= self.progress.least_cm) {
    self.progress = {left_cm, 0};
    return;
  }
  if (!drives(robot, v)) return;
  for (int k = 0; k < (hindered ? 1 : patience_hindered); ++k) robot.add_elapsed(self.progress.vain_ticks);
  if (self.progress.vain_ticks > patience_hindered * p.ticks(p.give_up_after_s)) give_up(robot);
}

}  // namespace banyan
