// SPDX-License-Identifier: MIT
// Two wheels: limits, noise and what their encoders measure. Shared by the differential bodies.
#pragma once

#include <algorithm>

#include "banyan/controller/core/inputs.hpp"
#include "banyan/world/random.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

struct Twist {
  double forward_m_s = 0.0;
  double turn_rad_s = 0.0;
};

// What the wheels make of a command: each within its limit, times its noise (drawn every tick) and
// its bias (drawn once).
[[nodiscard]] inline Twist wheel_twist(const RobotModel& robot, double wheel_distance_m, const Velocity& command,
                                       std::uint64_t seed, std::size_t i, std::uint64_t tick) noexcept {
  const double turn_part = 0.5 * static_cast<double>(command.turn_rad_s) * wheel_distance_m;
  double wheel[2] = {static_cast<double>(command.forward_m_s) - turn_part,
                     static_cast<double>(command.forward_m_s) + turn_part};
  for (std::uint64_t side = 0; side < 2; ++side) {
    wheel[side] = std::clamp(wheel[side], -robot.wheel_limit_m_s, robot.wheel_limit_m_s);
    if (robot.wheel_noise > 0.0)
      wheel[side] *= 1.0 + robot.wheel_noise * to_normal(bits(seed, Purpose::wheel_noise, i, side, tick));
    if (robot.wheel_bias > 0.0)
      wheel[side] *= 1.0 + robot.wheel_bias * to_normal(bits(seed, Purpose::wheel_bias, i, side));
  }
  return {0.5 * (wheel[0] + wheel[1]), (wheel[1] - wheel[0]) / wheel_distance_m};
}

// Odometry of a motion by `shift` (body frame of the tick's start, m) and `turn` (rad).
[[nodiscard]] inline Odometry measured_odometry(const RobotModel& robot, Vec2 shift, double turn, std::uint64_t seed,
                                                std::size_t i, std::uint64_t tick) noexcept {
  if (robot.odometry_noise > 0.0) {
    shift *= 1.0 + robot.odometry_noise * to_normal(bits(seed, Purpose::odometry_noise, i, 0, tick));
    turn *= 1.0 + robot.odometry_noise * to_normal(bits(seed, Purpose::odometry_noise, i, 1, tick));
  }
  return {static_cast<float>(shift.x), static_cast<float>(shift.y), static_cast<float>(turn)};
}

}  // namespace banyan::world
