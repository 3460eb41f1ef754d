// SPDX-License-Identifier: MIT
// A robot of convoy: the same step, with more to know.
#pragma once

#include <algorithm>

#include "banyan/controller/convoy/params.hpp"
#include "banyan/controller/convoy/state.hpp"
#include "banyan/controller/core/search.hpp"
#include "healing/robot.hpp"
#include "obstacles/sight.hpp"
#include "power/power.hpp"

namespace banyan {

// What a robot of convoy hears is what robots of convoy say.
inline const ConvoyMessage& convoy_message(const TreeMessage& m) noexcept {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-static-cast-downcast): a swarm has one algorithm
  return static_cast<const ConvoyMessage&>(m);
}

// And in a swarm on batteries, what such robots say.
inline const PoweredConvoyMessage& powered_message(const ConvoyMessage& m) noexcept {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-static-cast-downcast): a swarm has one algorithm
  return static_cast<const PoweredConvoyMessage&>(m);
}

struct ConvoyRobot : HealingRobot {
  ConvoyRobot(const ConvoyParams& params_, ConvoyState& self_, const Inputs<Heard>& inputs, Workspace& space) noexcept
      : HealingRobot(params_, self_, inputs, space), params(params_), self(self_) {}

  const ConvoyParams& params;  // the same objects as the tree's
  ConvoyState& self;
  PowerRobot* power = nullptr;  // null: it does not run on a battery

  [[nodiscard]] const ConvoyStanding& convoy_of(int k) const noexcept {
    return self.convoy_standings[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] const CornerStanding& corner_of(int k) const noexcept { return self.corners.of(k); }
  // Neighbour k, a worker: the target it serves, by the robot first sent there.
  [[nodiscard]] RobotId served_by(int k) const noexcept {
    return self.healing_standings[static_cast<std::size_t>(k)].serves;
  }
  // What my parent has said this tick; null if I did not hear it.
  [[nodiscard]] const ConvoyMessage* parent_message() const noexcept {
    if (self.parent == nobody) return nullptr;
    const auto it = first_of(heard, [&](const Heard& h) { return h.message->id == self.parent; });
    return it == heard.end() ? nullptr : &convoy_message(*it->message);
  }
};

// I have to be relieved; so has neighbour k.
[[nodiscard]] inline bool is_leaving(const ConvoyRobot& robot) noexcept {
  return robot.power != nullptr && robot.power->power.said.leaving;
}
[[nodiscard]] inline bool is_leaving(const ConvoyRobot& robot, int k) noexcept {
  return robot.power != nullptr && robot.power->standing(k).leaving;
}

[[nodiscard]] inline bool sees_clearly(const ConvoyRobot& robot, int k, float clearance) noexcept {
  return sees_clearly(robot, robot.self.corners, k, clearance);
}

// The beginning of a tick (tree/tick.hpp): memory is carried, the table brought up to date, orders followed.
void begin_tick(ConvoyRobot& robot, const Inputs<Heard>& inputs) noexcept;

}  // namespace banyan
