// SPDX-License-Identifier: MIT
// The paper's Sec. II-A as printed: x(t+1) = A x(t) + B u(t) with x = [p, v], both bounded.
// With tick h and constant acceleration within a tick,
//
//       | 1 0 h 0 |        | 0 0 h^2/2 0     |
//   A = | 0 1 0 h |    B = | 0 0 0     h^2/2 |    u = [0, a],  |a| <= max_acceleration,
//       | 0 0 1 0 |        | 0 0 h     0     |                 |v| <= wheel_limit.
//       | 0 0 0 1 |        | 0 0 0     h     |
//
// `a` brings v to the commanded velocity as fast as its bound allows. Robots are points to each
// other: the paper has no contact, so bodies may overlap here and `near` is not used. Obstacles
// bound the positions (the paper's X_i): a robot that would enter one is set back to its surface
// and loses the velocity into it. Turning is not part of x: a holonomic robot turns as commanded.
#include <algorithm>
#include <array>
#include <bit>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/bodies.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/random.hpp"
#include "banyan/world/wheels.hpp"

namespace banyan::world {
namespace {

using StateVector = std::array<double, 4>;
using Matrix = std::array<StateVector, 4>;  // rows

StateVector operator*(const Matrix& m, const StateVector& x) noexcept {
  StateVector y{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) y[i] += m[i][j] * x[j];
  return y;
}

// The commanded velocity with the noise of the drive: the two factors of wheels.hpp act on the
// components, because a holonomic robot has no left and right wheel.
Vec2 noisy(const RobotModel& robot, const Velocity& command, std::uint64_t seed, std::size_t i,
           std::uint64_t tick) noexcept {
  double v[2] = {static_cast<double>(command.forward_m_s), static_cast<double>(command.sideways_m_s)};
  for (std::uint64_t axis = 0; axis < 2; ++axis) {
    if (robot.wheel_noise > 0.0)
      v[axis] *= 1.0 + robot.wheel_noise * to_normal(bits(seed, Purpose::wheel_noise, i, axis, tick));
    if (robot.wheel_bias > 0.0) v[axis] *= 1.0 + robot.wheel_bias * to_normal(bits(seed, Purpose::wheel_bias, i, axis));
  }
  return {v[0], v[1]};
}

Vec2 shortened(Vec2 v, double limit) noexcept {
  const double n = norm(v);
  return n > limit ? v * (limit / n) : v;
}

class Linear final : public Bodies {
 public:
  Linear(const Scenario& scenario, std::size_t robots)
      : robot_{scenario.robot},
        obstacles_{scenario.obstacles},
        seed_{scenario.seed},
        max_acceleration_m_s2_{max_acceleration_m_s2(scenario)},
        h_{scenario.tick_s},
        a_{{{1, 0, h_, 0}, {0, 1, 0, h_}, {0, 0, 1, 0}, {0, 0, 0, 1}}},
        b_{{{0, 0, h_ * h_ / 2, 0}, {0, 0, 0, h_ * h_ / 2}, {0, 0, h_, 0}, {0, 0, 0, h_}}},
        velocity_(robots) {}

  [[nodiscard]] std::unique_ptr<Bodies> clone() const override { return std::make_unique<Linear>(*this); }

  void step(std::span<const Velocity> command, NearPairs, std::uint64_t tick, Poses& poses,
            std::span<Odometry> odometry) override {
    for (std::size_t i = 0; i < velocity_.size(); ++i) {
      const Vec2 start = poses.position[i];
      const Vec2 heading = poses.heading[i];
      move(poses.position[i], velocity_[i], rotate(heading, noisy(robot_, command[i], seed_, i, tick)));
      const double turn = static_cast<double>(command[i].turn_rad_s) * h_;
      if (turn != 0.0) poses.heading[i] = unit(rotate(heading, unit_vector(turn)));
      const Vec2 moved = rotate_back(heading, poses.position[i] - start);
      odometry[i] = measured_odometry(robot_, moved, turn, seed_, i, tick);
    }
  }

  void arrive(std::size_t i) override { velocity_[i] = {}; }

  void set_obstacles(std::span<const Obstacle> obstacles) override {
    obstacles_.assign(obstacles.begin(), obstacles.end());
  }

  [[nodiscard]] std::uint64_t hash(std::uint64_t h) const noexcept override {
    for (const Vec2 v : velocity_)
      for (const double x : {v.x, v.y}) h = mix(h ^ std::bit_cast<std::uint64_t>(x));
    return h;
  }

 private:
  // x(t+1) = A x(t) + B u(t), then the obstacles. v stays within its bound because both v and the
  // commanded velocity do and the new one lies between them.
  void move(Vec2& p, Vec2& v, Vec2 commanded) const noexcept {
    const Vec2 a = shortened((shortened(commanded, robot_.wheel_limit_m_s) - v) / h_, max_acceleration_m_s2_);
    const StateVector drift = a_ * StateVector{p.x, p.y, v.x, v.y};
    const StateVector control = b_ * StateVector{0.0, 0.0, a.x, a.y};
    p = {drift[0] + control[0], drift[1] + control[1]};
    v = {drift[2] + control[2], drift[3] + control[3]};
    for (const Obstacle& obstacle : obstacles_) {
      const Vec2 push = push_out(obstacle, p, robot_.radius_m);
      if (push == Vec2{}) continue;
      p += push;
      const Vec2 outward = unit(push);
      v -= outward * std::min(0.0, dot(v, outward));
    }
  }

  RobotModel robot_;
  std::vector<Obstacle> obstacles_;
  std::uint64_t seed_;
  double max_acceleration_m_s2_;
  double h_;
  Matrix a_, b_;
  std::vector<Vec2> velocity_;
};

}  // namespace

std::unique_ptr<Bodies> make_linear(const Scenario& scenario, std::size_t robots) {
  return std::make_unique<Linear>(scenario, robots);
}

}  // namespace banyan::world
