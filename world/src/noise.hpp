// SPDX-License-Identifier: MIT
// What imperfect wheels and encoders make of a command, the same for every body model. Draws are
// keyed by (seed, robot, tick), so order and thread count cannot change them.
#pragma once

#include "banyan/controller/controller.hpp"
#include "banyan/world/random.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

// A velocity in the body frame, as the wheels really turn.
struct Motion {
  double forward_m_s = 0.0;
  double sideways_m_s = 0.0;
  double turn_rad_s = 0.0;
};

class Noise {
 public:
  explicit Noise(const Scenario& scenario) noexcept : robot_{scenario.robot}, seed_{scenario.seed} {}

  // Differential drive: each wheel's speed is off by its own factor.
  [[nodiscard]] Motion wheels(std::size_t robot, std::uint64_t tick, const Velocity& command) const noexcept {
    const double half = 0.5 * robot_.wheel_distance_m;
    const double forward = static_cast<double>(command.forward_m_s);
    const double turn = static_cast<double>(command.turn_rad_s);
    if (exact()) return {forward, 0.0, turn};
    const double left = (forward - turn * half) * actuator_factor(robot, tick, 0);
    const double right = (forward + turn * half) * actuator_factor(robot, tick, 1);
    return {0.5 * (left + right), 0.0, (right - left) / (2.0 * half)};
  }

  // Holonomic drive: the factors act on the two components of the velocity.
  [[nodiscard]] Motion holonomic(std::size_t robot, std::uint64_t tick, const Velocity& command) const noexcept {
    const double forward = static_cast<double>(command.forward_m_s);
    const double sideways = static_cast<double>(command.sideways_m_s);
    const double turn = static_cast<double>(command.turn_rad_s);
    if (exact()) return {forward, sideways, turn};
    return {forward * actuator_factor(robot, tick, 0), sideways * actuator_factor(robot, tick, 1), turn};
  }

  [[nodiscard]] Odometry measured(std::size_t robot, std::uint64_t tick, double forward_m, double sideways_m,
                                  double turn_rad) const noexcept {
    return {static_cast<float>(forward_m * odometry_factor(robot, tick, 0)),
            static_cast<float>(sideways_m * odometry_factor(robot, tick, 1)),
            static_cast<float>(turn_rad * odometry_factor(robot, tick, 2))};
  }

 private:
  [[nodiscard]] bool exact() const noexcept { return robot_.wheel_noise == 0.0 && robot_.wheel_bias == 0.0; }
  [[nodiscard]] double actuator_factor(std::size_t robot, std::uint64_t tick, std::uint64_t wheel) const noexcept {
    return factor(robot_.wheel_bias, bits(seed_, Purpose::wheel_bias, robot, wheel)) *
           factor(robot_.wheel_noise, bits(seed_, Purpose::wheel_noise, robot, tick, wheel));
  }
  [[nodiscard]] double odometry_factor(std::size_t robot, std::uint64_t tick, std::uint64_t reading) const noexcept {
    if (robot_.odometry_noise == 0.0) return 1.0;
    return factor(robot_.odometry_noise, bits(seed_, Purpose::odometry_noise, robot, tick, reading));
  }
  static double factor(double sigma, std::uint64_t draw) noexcept {
    return sigma == 0.0 ? 1.0 : 1.0 + sigma * to_normal(draw);
  }

  RobotModel robot_;
  std::uint64_t seed_;
};

}  // namespace banyan::world
