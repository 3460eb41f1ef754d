// SPDX-License-Identifier: MIT
// `disks`: differential drive along exact arcs, and discs that push each other apart when they
// overlap. No mass, no friction: the fast and reproducible default.
#include <algorithm>

#include "banyan/world/bodies.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/random.hpp"
#include "banyan/world/wheels.hpp"

namespace banyan::world {
namespace {

// How much farther than to their touching bodies that overlap are moved apart, so that rounds end; of a radius, and a
// millionth of a metre for a Khepera IV.
constexpr double beyond_touching = 1e-6 / 0.0704;

class Disks final : public Bodies {
 public:
  explicit Disks(const Scenario& scenario)
      : robot_(scenario.robot),
        wheel_distance_m_(wheel_distance_m(scenario)),
        obstacles_(scenario.obstacles),
        tick_s_(scenario.tick_s),
        seed_(scenario.seed) {}

  [[nodiscard]] std::unique_ptr<Bodies> clone() const override { return std::make_unique<Disks>(*this); }

  void step(std::span<const Velocity> command, NearPairs near, std::uint64_t tick, Poses& poses,
            std::span<Odometry> odometry) override {
    for (std::size_t i = 0; i < command.size(); ++i) {
      odometry[i] = {};
      if (command[i].forward_m_s != 0.0F || command[i].turn_rad_s != 0.0F)
        roll(i, command[i], tick, poses, odometry[i]);
    }
    separate(near, poses);
    if (!obstacles_.empty())
      for (Vec2& p : poses.position)
        for (const Obstacle& obstacle : obstacles_) p += push_out(obstacle, p, robot_.radius_m);
  }

  void set_obstacles(std::span<const Obstacle> obstacles) override {
    obstacles_.assign(obstacles.begin(), obstacles.end());
  }

  [[nodiscard]] std::uint64_t hash(std::uint64_t h) const noexcept override { return h; }  // poses are all there is

 private:
  void roll(std::size_t i, const Velocity& command, std::uint64_t tick, Poses& poses,
            Odometry& odometry) const noexcept {
    const Twist twist = wheel_twist(robot_, wheel_distance_m_, command, seed_, i, tick);
    const double arc_m = twist.forward_m_s * tick_s_;
    const double turn = twist.turn_rad_s * tick_s_;
    const Vec2 half = unit_vector(0.5 * turn);
    // The chord of an arc points along the mean heading; its length differs from the arc's by
    // less than turn^2 / 24, 0.6 % at the fastest turn.
    const Vec2 middle = rotate(half, poses.heading[i]);
    poses.position[i] += middle * arc_m;
    const Vec2 heading = rotate(half, middle);
    poses.heading[i] = heading * (1.5 - 0.5 * squared_norm(heading));  // one Newton step keeps |heading| = 1
    odometry = measured_odometry(robot_, half * arc_m, turn, seed_, i, tick);
  }

  // Gauss-Seidel over the pairs that could touch, in their fixed order.
  void separate(NearPairs near, Poses& poses) const noexcept {
    const double reach = 2.0 * robot_.radius_m;
    for (int round = 0; round < 8; ++round) {
      bool overlap = false;
      for (const auto& [i, j] : near) {
        const Vec2 d = poses.position[j] - poses.position[i];
        const double d2 = squared_norm(d);
        if (d2 >= reach * reach) continue;
        overlap = true;
        const double length = std::sqrt(d2);
        const Vec2 n = length > 0.0 ? d / length : Vec2{1.0, 0.0};
        const Vec2 shift = n * (0.5 * (reach - length) + beyond_touching * robot_.radius_m);
        poses.position[i] -= shift;
        poses.position[j] += shift;
      }
      if (!overlap) return;
    }
  }

  RobotModel robot_;
  double wheel_distance_m_;
  std::vector<Obstacle> obstacles_;
  double tick_s_;
  std::uint64_t seed_;
};

}  // namespace

std::unique_ptr<Bodies> make_disks(const Scenario& scenario, std::size_t) { return std::make_unique<Disks>(scenario); }

}  // namespace banyan::world
