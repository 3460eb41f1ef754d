// SPDX-License-Identifier: MIT
// A robot of the tree that heals: the same step, with more to know.
#pragma once

#include "banyan/controller/healing/params.hpp"
#include "banyan/controller/healing/state.hpp"
#include "banyan/controller/tree/robot.hpp"

namespace banyan {

struct HealingRobot : TreeRobot {
  HealingRobot(const HealingParams& params_, HealingState& self_, const Admitted& admitted) noexcept
      : TreeRobot(params_, corrected_reading, self_, admitted), params(params_), self(self_) {
    loss_ticks = self.loss_ticks;
  }

  const HealingParams& params;   // the same objects as the tree's
  HealingState& self;
};

[[nodiscard]] inline Vec2 bypass(const HealingRobot& robot, Vec2 goal) noexcept { return bypass(robot, robot.self.detour, goal); }

// What a healing robot hears is what healing robots say.
inline const HealingMessage& healing_message(const TreeMessage& m) noexcept {
  return static_cast<const HealingMessage&>(m);  // NOLINT(cppcoreguidelines-pro-type-static-cast-downcast): all of a swarm run the same
}
inline const HealingMessage& said(const Heard& h) noexcept { return healing_message(*h.message); }

}  // namespace banyan
