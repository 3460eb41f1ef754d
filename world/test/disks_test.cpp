// SPDX-License-Identifier: MIT
// Wheels on arcs, their noise, and discs that do not overlap.
#include <gtest/gtest.h>

#include <cmath>

#include "banyan/world/bodies.hpp"
#include "banyan/world/obstacles.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

struct Floor {
  Scenario scenario = plain_scenario();
  Poses poses;
  std::vector<Velocity> command;
  std::vector<Odometry> odometry;
  std::unique_ptr<Bodies> bodies;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> near;
  std::uint64_t tick = 0;

  Floor(const Scenario& s, Poses start)
      : scenario{s},
        poses{std::move(start)},
        command(poses.position.size()),
        odometry(poses.position.size()),
        bodies{make_disks(s, poses.position.size())} {}
  void step() {
    near.clear();
    for (std::uint32_t i = 0; i < poses.position.size(); ++i)
      for (std::uint32_t j = i + 1; j < poses.position.size(); ++j)
        if (distance(poses.position[i], poses.position[j]) < 0.3) near.emplace_back(i, j);
    bodies->step(command, near, tick++, poses, odometry);
  }
};

Poses one(Vec2 p = {}, double heading_rad = 0.0) { return {{p}, {unit_vector(heading_rad)}}; }

TEST(Disks, DriveStraight) {
  Floor floor({}, one({1, 2}, 0.5));
  floor.command[0] = {0.15F, 0, 0};
  for (int t = 0; t < 100; ++t) floor.step();
  EXPECT_NEAR(floor.poses.position[0].x, 1 + 1.5 * std::cos(0.5), 1e-6);
  EXPECT_NEAR(floor.poses.position[0].y, 2 + 1.5 * std::sin(0.5), 1e-6);
  EXPECT_NEAR(floor.odometry[0].forward_m, 0.015F, 1e-7F);
}

TEST(Disks, DriveCircles) {
  Floor floor({}, one());
  floor.command[0] = {0.1F, 0, 0.5F};  // radius 0.2 m around (0, 0.2)
  double farthest = 0;
  for (int t = 1; t <= 126; ++t) {
    floor.step();
    farthest = std::max(farthest, std::fabs(distance(floor.poses.position[0], Vec2{0, 0.2}) - 0.2));
    EXPECT_NEAR(norm(floor.poses.heading[0]), 1.0, 1e-9);
  }
  EXPECT_LT(farthest, 0.2 * 0.001);
  EXPECT_NEAR(angle_of(floor.poses.heading[0]), 126 * 0.05 - 2 * pi<double>, 1e-5);
}

TEST(Disks, WheelsKeepTheirLimit) {
  Floor floor({}, one());
  floor.command[0] = {5.0F, 0, 0};
  floor.step();
  EXPECT_NEAR(floor.poses.position[0].x, 0.02, 1e-9);
  floor.command[0] = {0, 0, -100.0F};
  floor.step();
  EXPECT_NEAR(angle_of(floor.poses.heading[0]), -0.04 / 0.1054, 1e-9);
}

TEST(Disks, CannotMoveSideways) {
  Floor floor({}, one());
  floor.command[0] = {0, 0.2F, 0};
  floor.step();
  EXPECT_EQ(floor.poses.position[0], Vec2{});
}

// Each wheel's factor is normal with the given sigma: the forward speed, their mean, has sigma / sqrt 2.
TEST(Disks, WheelNoiseHasItsSigma) {
  Scenario s = plain_scenario();
  s.robot.wheel_noise = 0.1;
  Floor floor(s, one());
  double sum = 0, squares = 0, turns = 0;
  constexpr int n = 20'000;
  for (int t = 0; t < n; ++t) {
    floor.command[0] = {0.1F, 0, 0};
    floor.step();
    const double factor = static_cast<double>(floor.odometry[0].forward_m) / 0.01;
    sum += factor;
    squares += (factor - 1) * (factor - 1);
    turns += static_cast<double>(floor.odometry[0].turn_rad) * static_cast<double>(floor.odometry[0].turn_rad);
  }
  EXPECT_NEAR(sum / n, 1.0, 0.002);
  EXPECT_NEAR(std::sqrt(squares / n), 0.1 / std::sqrt(2.0), 0.002);
  EXPECT_NEAR(std::sqrt(turns / n), 0.1 * std::sqrt(2.0) * 0.01 / 0.1054, 0.0004);
}

TEST(Disks, WheelBiasStaysTheSameThroughARun) {
  Scenario s = plain_scenario();
  s.robot.wheel_bias = 0.1;
  Floor floor(s, {{{0, 0}, {5, 0}}, {{1, 0}, {1, 0}}});
  floor.command = {{0.1F, 0, 0}, {0.1F, 0, 0}};
  floor.step();
  const std::vector<Odometry> first = floor.odometry;
  for (int t = 0; t < 50; ++t) floor.step();
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(floor.odometry[i].forward_m, first[i].forward_m);
    EXPECT_NE(floor.odometry[i].turn_rad, 0.0F);
  }
  EXPECT_NE(first[0].turn_rad, first[1].turn_rad);
}

TEST(Disks, OdometryNoiseChangesWhatIsMeasuredAndNotTheMotion) {
  Scenario s = plain_scenario();
  s.robot.odometry_noise = 0.2;
  Floor floor(s, one());
  floor.command[0] = {0.1F, 0, 0};
  double squares = 0;
  constexpr int n = 5000;
  for (int t = 0; t < n; ++t) {
    floor.step();
    const double error = static_cast<double>(floor.odometry[0].forward_m) / 0.01 - 1;
    squares += error * error;
  }
  EXPECT_NEAR(floor.poses.position[0].x, n * 0.01, 1e-4);
  EXPECT_NEAR(std::sqrt(squares / n), 0.2, 0.01);
}

TEST(Disks, TwoThatMeetTouchAndDoNotOverlap) {
  Floor floor({}, {{{0, 0}, {1, 0}}, {{1, 0}, {-1, 0}}});
  floor.command = {{0.2F, 0, 0}, {0.2F, 0, 0}};
  for (int t = 0; t < 60; ++t) {
    floor.step();
    EXPECT_GE(distance(floor.poses.position[0], floor.poses.position[1]), 2 * 0.0704);
  }
  EXPECT_NEAR(distance(floor.poses.position[0], floor.poses.position[1]), 2 * 0.0704, 1e-4);
  EXPECT_NEAR(floor.poses.position[0].x + floor.poses.position[1].x, 1.0, 1e-6) << "neither is stronger";
}

TEST(Disks, RobotsOnTheSameSpotComeApart) {
  Floor floor({}, {{{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}});
  floor.step();
  EXPECT_GE(distance(floor.poses.position[0], floor.poses.position[1]), 2 * 0.0704 - 1e-9);
}

TEST(Disks, ObstaclesAreNotEntered) {
  Scenario s = plain_scenario();
  s.obstacles = {Disc{{1, 0}, 0.3}, Box{{-1, 0}, {0.4, 0.4}, 0.4}, Wall{{0, 1}, {2, 1.5}}};
  Floor floor(s, one());
  for (int t = 0; t < 4000; ++t) {
    const double turn = to_uniform(bits(1, Purpose::loss, static_cast<std::uint64_t>(t) / 20)) - 0.5;
    floor.command[0] = {0.2F, 0, static_cast<float>(2 * turn)};
    floor.step();
    for (const Obstacle& obstacle : s.obstacles)
      ASSERT_GE(clearance(obstacle, floor.poses.position[0]), s.robot.radius_m - 1e-9) << t;
  }
}

// In a whole run everybody is pushed about; overlaps stay small and pass.
TEST(Disks, HardlyOverlapInACrowd) {
  Scenario s = ring("outwards", 60, 4, 4.0, 3);
  s.swarm.start.pitch_m = 0.16;
  s.swarm.start.jitter_m = 0.005;
  World world(s);
  double worst_m = 0;
  for (int t = 0; t < 300; ++t) {
    world.step();
    for (std::size_t i = 0; i < world.size(); ++i)
      for (std::size_t j = i + 1; j < world.size(); ++j)
        worst_m = std::max(worst_m, 2 * s.robot.radius_m - distance(world.positions()[i], world.positions()[j]));
  }
  EXPECT_LT(worst_m, 0.01);
}

}  // namespace
}  // namespace banyan::world
