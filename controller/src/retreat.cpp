// SPDX-License-Identifier: MIT
#include "banyan/controller/healing.hpp"
#include "banyan/controller/motion.hpp"

namespace banyan {

bool is_retreating(const Robot& robot) noexcept {
  const State& self = robot.self;
  const Params& p = robot.params;
  if (!p.heals() || robot.is_root() || !self.root_known) return false;
  return self.silence_ticks > p.ticks(p.retreat_after_s) + 2 * robot.liveness_ticks();
}

Vec2 retreat_motion(const Robot& robot) noexcept {
  constexpr float near_enough = 0.2F;  // of C
  const float away_m = norm(robot.self.root_at);
  if (away_m < near_enough * robot.params.communication_range_m) return avoidance(robot);
  return unit(robot.self.root_at) + avoidance(robot);
}

}  // namespace banyan
