// SPDX-License-Identifier: MIT
// The paper's linear dynamics against closed forms and against bodies integrated in tiny steps.
#include <gtest/gtest.h>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/bodies.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/random.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

struct LinearBench {
  Scenario scenario;
  Poses poses;
  std::vector<Velocity> command;
  std::vector<Odometry> odometry;
  std::unique_ptr<Bodies> bodies;
  std::uint64_t tick = 0;

  LinearBench(const Scenario& s, Poses start)
      : scenario{s},
        poses{std::move(start)},
        command(poses.position.size()),
        odometry(poses.position.size()),
        bodies{make_linear(s, poses.position.size())} {}
  void step() { bodies->step(command, {}, tick++, poses, odometry); }
};

// In [-1, 1).
float uniform(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  return static_cast<float>(2 * to_uniform(bits(seed, Purpose::loss, a, b)) - 1);
}

TEST(Linear, ReachesTheCommandedSpeedAtTheBoundOfItsAcceleration) {
  Scenario scenario;
  scenario.robot.max_acceleration_m_s2 = 0.5;  // 0.2 m/s take four ticks
  LinearBench bench(scenario, one_robot());
  bench.command[0] = {0.2F, 0.0F, 0.0F};
  for (int t = 1; t <= 10; ++t) {
    bench.step();
    const double s = t * 0.1;
    const double expected = s <= 0.4 ? 0.25 * s * s : 0.04 + 0.2 * (s - 0.4);
    EXPECT_NEAR(bench.poses.position[0].x, expected, 1e-7) << t;
    EXPECT_EQ(bench.poses.position[0].y, 0.0);
  }
  bench.command[0] = {};
  for (int t = 0; t < 4; ++t) bench.step();
  const Vec2 stopped = bench.poses.position[0];
  EXPECT_NEAR(stopped.x, 0.16 + 0.04, 1e-7);
  bench.step();
  EXPECT_NEAR(bench.poses.position[0].x, stopped.x, 1e-7);
}

TEST(Linear, VelocityAndAccelerationKeepTheirBounds) {
  Scenario scenario;
  scenario.robot.max_acceleration_m_s2 = 0.7;
  LinearBench bench(scenario, one_robot());
  Vec2 last{};
  for (std::uint64_t t = 0; t < 2000; ++t) {
    const auto draw = [&](std::uint64_t k) { return uniform(7, t, k); };
    bench.command[0] = {draw(0), draw(1), 3 * draw(2)};  // far beyond the limit
    const Vec2 before = bench.poses.position[0];
    bench.step();
    // v follows from p = p0 + (v0 + v1) h / 2
    const Vec2 v = (bench.poses.position[0] - before) * (2 / 0.1) - last;
    EXPECT_LE(norm(v), 0.2 + 1e-6);
    EXPECT_LE(norm(v - last), 0.07 + 1e-6);
    last = v;
  }
}

TEST(Linear, CommandIsInTheBodyFrame) {
  Scenario scenario;
  scenario.robot.max_acceleration_m_s2 = 1000.0;
  LinearBench bench(scenario, one_robot({1, 1}, 0.5));
  bench.command[0] = {0.1F, 0.15F, 0.0F};
  for (int t = 0; t < 10; ++t) bench.step();
  const Vec2 moved = bench.poses.position[0] - Vec2{1, 1};
  const Vec2 expected = rotate(unit_vector(0.5), Vec2{0.1, 0.15}) * 0.95;  // the first tick gives half
  EXPECT_NEAR(moved.x, expected.x, 1e-7);
  EXPECT_NEAR(moved.y, expected.y, 1e-7);
}

TEST(Linear, TurnsAsToldAndStaysAUnitVector) {
  LinearBench bench(Scenario{}, one_robot());
  bench.command[0] = {0.0F, 0.0F, 0.5F};
  for (int t = 0; t < 1000; ++t) bench.step();
  const double angle = 1000 * 0.05;
  EXPECT_NEAR(bench.poses.heading[0].x, std::cos(angle), 1e-5);
  EXPECT_NEAR(norm(bench.poses.heading[0]), 1.0, 1e-12);
  EXPECT_EQ(bench.poses.position[0], Vec2{});
}

TEST(Linear, OdometryAddsUpToTheTrueMotion) {
  Scenario scenario;
  scenario.obstacles = {Wall{{0.5, -1}, {0.5, 1}}, Disc{{-0.6, 0.2}, 0.3}};
  LinearBench bench(scenario, one_robot({0, 0}, 2.0));
  Vec2 p = bench.poses.position[0];
  Vec2 heading = bench.poses.heading[0];
  for (std::uint64_t t = 0; t < 500; ++t) {
    const auto draw = [&](std::uint64_t k) { return uniform(8, t / 20, k); };
    bench.command[0] = {0.2F * draw(0), 0.2F * draw(1), draw(2)};
    bench.step();
    const Odometry o = bench.odometry[0];
    p += rotate(heading, Vec2{static_cast<double>(o.forward_m), static_cast<double>(o.sideways_m)});
    heading = rotate(heading, unit_vector(static_cast<double>(o.turn_rad)));
  }
  EXPECT_LT(distance(p, bench.poses.position[0]), 1e-4);
  EXPECT_LT(distance(heading, bench.poses.heading[0]), 1e-5);
}

TEST(Linear, ObstaclesAreNotEntered) {
  Scenario scenario;
  scenario.obstacles = {Wall{{0.5, -1}, {0.5, 1}}};
  LinearBench bench(scenario, one_robot());
  bench.command[0] = {0.2F, 0.05F, 0.0F};
  for (int t = 0; t < 100; ++t) {
    bench.step();
    EXPECT_GE(clearance(scenario.obstacles[0], bench.poses.position[0]), scenario.robot.radius_m - 1e-9);
  }
  EXPECT_NEAR(bench.poses.position[0].x, 0.5 - scenario.robot.radius_m, 1e-9);
  EXPECT_GT(bench.poses.position[0].y, 0.4) << "slides along the wall";
  bench.command[0] = {-0.2F, 0.0F, 0.0F};
  for (int t = 0; t < 5; ++t) bench.step();
  EXPECT_LT(bench.poses.position[0].x, 0.37) << "no speed into the wall is left that had to be undone";
}

TEST(Linear, NoiseIsAFunctionOfSeedRobotAndTick) {
  Scenario scenario;
  scenario.robot.wheel_noise = 0.1;
  scenario.robot.wheel_bias = 0.1;
  scenario.robot.odometry_noise = 0.1;
  const auto run = [&] {
    LinearBench bench(scenario, {{{0, 0}, {1, 0}}, {{1, 0}, {1, 0}}});
    for (auto& c : bench.command) c = {0.1F, 0.05F, 0.1F};
    for (int t = 0; t < 50; ++t) bench.step();
    return bench.poses.position;
  };
  const std::vector<Vec2> first = run();
  EXPECT_EQ(first, run());
  EXPECT_GT(distance(first[0], first[1] - Vec2{1, 0}), 1e-3) << "two robots differ";
  scenario.seed = 2;
  EXPECT_NE(first, run());
}

TEST(Linear, CloneGoesOnAlikeAndHashSeesTheVelocity) {
  Scenario scenario;
  scenario.robot.max_acceleration_m_s2 = 0.3;
  LinearBench bench(scenario, one_robot());
  const std::uint64_t at_rest = bench.bodies->hash(1);
  bench.command[0] = {0.2F, 0.1F, 0.3F};
  for (int t = 0; t < 3; ++t) bench.step();
  EXPECT_NE(bench.bodies->hash(1), at_rest);
  const std::unique_ptr<Bodies> copy = bench.bodies->clone();
  EXPECT_EQ(copy->hash(1), bench.bodies->hash(1));
  Poses poses = bench.poses;
  std::vector<Odometry> odometry(1);
  for (int t = 0; t < 20; ++t) {
    copy->step(bench.command, {}, bench.tick, poses, odometry);
    bench.step();
  }
  EXPECT_EQ(poses.position, bench.poses.position);
  EXPECT_EQ(copy->hash(1), bench.bodies->hash(1));
}

}  // namespace
}  // namespace banyan::world
