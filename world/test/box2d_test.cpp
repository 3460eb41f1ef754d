// SPDX-License-Identifier: MIT
// Rigid discs: motors within their bounds, contact, and a clone that goes on bit by bit alike.
#include <gtest/gtest.h>

#include <cmath>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/bodies.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/placement.hpp"
#include "banyan/world/random.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

struct Box2dBench {
  Poses poses;
  std::vector<Velocity> command;
  std::vector<Odometry> odometry;
  std::unique_ptr<Bodies> bodies;
  std::uint64_t tick = 0;

  Box2dBench(const Scenario& s, Poses start)
      : poses{std::move(start)},
        command(poses.position.size()),
        odometry(poses.position.size()),
        bodies{make_box2d(s, poses)} {}
  Box2dBench(const Box2dBench& o)
      : poses{o.poses}, command{o.command}, odometry{o.odometry}, bodies{o.bodies->clone()}, tick{o.tick} {}
  void step() { bodies->step(command, {}, tick++, poses, odometry); }
  // Everybody turns and drives as it likes, changing its mind every 15 ticks.
  void wander() {
    for (std::size_t i = 0; i < command.size(); ++i) {
      const auto draw = [&](std::uint64_t k) { return to_uniform(bits(9, Purpose::loss, i, tick / 15, k)); };
      command[i] = {static_cast<float>(0.2 * draw(0)), 0.0F, static_cast<float>(2 * draw(1) - 1)};
    }
    step();
  }
};

Scenario dense(std::size_t robots) {
  Scenario scenario;
  scenario.swarm.robots = robots;
  scenario.swarm.start.pitch_m = 0.16;
  scenario.swarm.start.jitter_m = 0.005;
  return scenario;
}

TEST(Box2d, AcceleratesNoFasterThanItsForce) {
  Scenario scenario;
  scenario.robot.mass_kg = 0.4;
  scenario.robot.max_force_n = 0.1;  // 0.25 m/s^2: 0.2 m/s after 0.8 s
  Box2dBench bench(scenario, one_robot());
  bench.command[0] = {0.2F, 0.0F, 0.0F};
  for (int t = 1; t <= 16; ++t) {
    bench.step();
    const double s = 0.1 * t;
    const double expected = s <= 0.8 ? 0.125 * s * s : 0.08 + 0.2 * (s - 0.8);
    EXPECT_NEAR(bench.poses.position[0].x, expected, 0.0012) << t;  // sub-steps of 0.01 s
  }
}

TEST(Box2d, SpinsUpNoFasterThanItsTorque) {
  Scenario scenario;
  const double inertia = 2 * scenario.robot.mass_kg * scenario.robot.radius_m * scenario.robot.radius_m;
  scenario.robot.max_torque_nm = inertia * 2.0;  // 2 rad/s^2: 1 rad/s after 0.5 s
  Box2dBench bench(scenario, one_robot());
  bench.command[0] = {0.0F, 0.0F, 1.0F};
  for (int t = 1; t <= 12; ++t) {
    bench.step();
    const double s = 0.1 * t;
    EXPECT_NEAR(angle_of(bench.poses.heading[0]), s <= 0.5 ? s * s : 0.25 + (s - 0.5), 0.012) << t;
  }
}

TEST(Box2d, DrivesAnArcLikeADifferentialRobot) {
  Box2dBench bench(Scenario{}, one_robot());
  bench.command[0] = {0.1F, 0.0F, 0.5F};  // radius 0.2 m
  for (int t = 0; t < 31; ++t) bench.step();
  const double angle = 3.1 * 0.5;
  EXPECT_NEAR(bench.poses.position[0].x, 0.2 * std::sin(angle), 0.004);
  EXPECT_NEAR(bench.poses.position[0].y, 0.2 * (1 - std::cos(angle)), 0.004);
  EXPECT_NEAR(bench.poses.heading[0].y, std::sin(angle), 0.01);
  EXPECT_NEAR(norm(bench.poses.heading[0]), 1.0, 1e-12);
}

TEST(Box2d, OdometryFollowsTheBodyOnAFreeDrive) {
  Box2dBench bench(Scenario{}, one_robot({2, 1}, 1.0));
  Vec2 p = bench.poses.position[0];
  Vec2 heading = bench.poses.heading[0];
  for (int t = 0; t < 200; ++t) {
    bench.wander();
    const double turn = static_cast<double>(bench.odometry[0].turn_rad);
    p += rotate(heading, Vec2{static_cast<double>(bench.odometry[0].forward_m),
                              static_cast<double>(bench.odometry[0].sideways_m)});
    heading = rotate(heading, unit_vector(turn));
  }
  EXPECT_LT(distance(p, bench.poses.position[0]), 0.005) << "after 2 m";
  EXPECT_LT(distance(heading, bench.poses.heading[0]), 1e-3);
}

TEST(Box2d, AtRestNothingMoves) {
  Scenario scenario = dense(30);
  Box2dBench bench(scenario, place(scenario));
  bench.step();
  const std::vector<Vec2> start = bench.poses.position;
  for (int t = 0; t < 50; ++t) bench.step();
  EXPECT_EQ(start, bench.poses.position);
}

TEST(Box2d, PosesAreNotRoundedAgainEveryTick) {
  Box2dBench bench(Scenario{}, one_robot({1.0 / 3, -2.0 / 7}, 0.3));
  bench.step();
  const Vec2 first = bench.poses.position[0];
  EXPECT_NEAR(first.x, 1.0 / 3, 1e-6);
  const Vec2 heading = bench.poses.heading[0];
  for (int t = 0; t < 1000; ++t) bench.step();
  EXPECT_EQ(bench.poses.position[0], first);
  EXPECT_EQ(bench.poses.heading[0], heading);
}

TEST(Box2d, BodiesHardlyPenetrate) {
  Scenario scenario = dense(40);
  scenario.obstacles = {Wall{{-2, 0.9}, {2, 0.9}}, Box{{0.9, 0}, {0.3, 1}, 0.4}, Disc{{-0.9, 0}, 0.2}};
  Box2dBench bench(scenario, place(scenario));
  ASSERT_EQ(bench.poses.position.size(), 40U);
  double deepest = 0.0;
  double deepest_obstacle = 0.0;
  double travelled = 0.0;
  for (int t = 0; t < 300; ++t) {
    const std::vector<Vec2> before = bench.poses.position;
    bench.wander();
    for (std::size_t i = 0; i < 40; ++i) {
      travelled += distance(before[i], bench.poses.position[i]);
      for (const Obstacle& o : scenario.obstacles)
        deepest_obstacle = std::max(deepest_obstacle, scenario.robot.radius_m - clearance(o, bench.poses.position[i]));
      for (std::size_t j = 0; j < i; ++j)
        deepest =
            std::max(deepest, 2 * scenario.robot.radius_m - distance(bench.poses.position[i], bench.poses.position[j]));
    }
  }
  EXPECT_LT(deepest, 0.003);
  EXPECT_LT(deepest_obstacle, 0.003);
  EXPECT_GT(deepest, 0.0) << "they did touch";
  EXPECT_GT(travelled, 40 * 1.0);
}

TEST(Box2d, TwoHeadOnHoldEachOther) {
  Box2dBench bench(Scenario{}, {{{-0.2, 0}, {0.2, 0}}, {{1, 0}, {-1, 0}}});
  bench.command = {{0.2F, 0, 0}, {0.2F, 0, 0}};
  for (int t = 0; t < 50; ++t) bench.step();
  EXPECT_NEAR(distance(bench.poses.position[0], bench.poses.position[1]), 0.1408, 0.002);
  EXPECT_NEAR(bench.poses.position[0].x + bench.poses.position[1].x, 0.0, 1e-3);
  EXPECT_NEAR(static_cast<double>(bench.odometry[0].forward_m), 0.0, 1e-3) << "stalled wheels do not turn";
}

TEST(Box2d, AShoveFromTheSideIsLostOnTheEncoders) {
  // One drives into the flank of another whose brakes are no stronger than its motors.
  Box2dBench bench(Scenario{}, {{{0, -0.3}, {0.0, 0}}, {{0, 1}, {1, 0}}});
  bench.command = {{0.2F, 0, 0}, {}};
  double measured = 0.0;
  for (int t = 0; t < 60; ++t) {
    bench.step();
    measured += std::abs(static_cast<double>(bench.odometry[1].sideways_m)) +
                std::abs(static_cast<double>(bench.odometry[1].forward_m));
  }
  EXPECT_GT(bench.poses.position[1].y, 0.1);
  EXPECT_LT(measured, 0.01);
}

TEST(Box2d, CloneGoesOnBitByBitAlike) {
  Scenario scenario = dense(60);
  scenario.robot.wheel_noise = 0.05;
  scenario.obstacles = {Wall{{-2, 0.9}, {2, 0.9}}, Box{{1.1, 0}, {0.3, 1}, 0.4}};
  Box2dBench original(scenario, place(scenario));
  for (int t = 0; t < 100; ++t) original.wander();
  Box2dBench copy(original);
  EXPECT_EQ(copy.bodies->hash(0), original.bodies->hash(0));
  for (int t = 0; t < 200; ++t) original.wander();
  for (int t = 0; t < 200; ++t) copy.wander();
  EXPECT_EQ(copy.poses.position, original.poses.position);
  EXPECT_EQ(copy.poses.heading, original.poses.heading);
  EXPECT_EQ(copy.bodies->hash(0), original.bodies->hash(0));
}

// Thinner than that, or so far out that its corners fall together, a box ends the program (an assertion of Box2D).
TEST(Box2d, TakesBoxesAsThinAsTheChecksAllow) {
  const auto draw = [](std::uint64_t i, std::uint64_t k) { return to_uniform(bits(3, Purpose::loss, i, k)); };
  for (std::uint64_t i = 0; i < 3000; ++i) {
    Scenario scenario;
    Box box;
    box.center = std::pow(10.0, 4.0 * draw(i, 0)) * unit_vector(6.28 * draw(i, 1));
    box.angle_rad = i % 3 == 0 ? 0.0 : 6.28 * draw(i, 2);
    const double length_m = std::pow(10.0, -3.0 + 7.0 * draw(i, 3));
    box.size = {length_m, 1e-9};
    box.size = {length_m, least_side_in_box2d_m(box) * 1.0001};  // with its own breadth it reaches a little farther
    box.size.x = std::max(box.size.x, box.size.y);
    scenario.obstacles = {box};
    Box2dBench bench(scenario, one_robot());
    bench.step();
    EXPECT_EQ(bench.tick, 1U) << i;
  }
}

TEST(Box2d, HashSeesVelocities) {
  Box2dBench bench(Scenario{}, one_robot());
  const std::uint64_t at_rest = bench.bodies->hash(1);
  bench.command[0] = {0.1F, 0.0F, 0.0F};
  bench.step();
  EXPECT_NE(bench.bodies->hash(1), at_rest);
  bench.command[0] = {};
  for (int t = 0; t < 10; ++t) bench.step();
  EXPECT_EQ(bench.bodies->hash(1), at_rest) << "stands still again";
}

}  // namespace
}  // namespace banyan::world
