// SPDX-License-Identifier: MIT
// What a scenario stands for.
#include "banyan/world/scenario.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/world/obstacles.hpp"
#include "plain_scenario.hpp"

namespace banyan::world {
namespace {

TEST(Scenario, RedundancyGivesThePapersNinetyFour) {
  Scenario scenario = plain_scenario();
  scenario.swarm.redundancy = 4;
  scenario.targets = RingTargets{4, 9.0, 0.7, {}};
  EXPECT_EQ(robot_count(scenario), 94U);  // protocol 2, row 10
  scenario.swarm.start.center = {2, 3};
  scenario.targets = RingTargets{4, 9.0, 0.7, {2, 3}};
  EXPECT_EQ(robot_count(scenario), 94U) << "distances count from the start";
  // An exact multiple stays exact although the sum of the distances is rounded up.
  scenario.swarm.start.center = {0, 0};
  scenario.targets = std::vector<Vec2>(6, Vec2{1.540841 * 4, 0});
  EXPECT_EQ(robot_count(scenario), 96U);
  scenario.targets = RingTargets{4, 9.0, 0.7, {}};
  scenario.radio.range_m = 1.0;
  EXPECT_EQ(robot_count(scenario), 187U) << "edges are shares of the range: 4 * 36 / 0.7704205";
  scenario.targets = RingTargets{4, 4.5, 0.7, {}};
  EXPECT_EQ(robot_count(scenario), 94U);
  scenario.targets = RingTargets{4, 0.05, 0.3, {}};
  EXPECT_EQ(robot_count(scenario), 5U) << "never less than a worker each and a root";
  scenario.swarm.robots = 33;
  EXPECT_EQ(robot_count(scenario), 33U);
}

TEST(Scenario, RingTargetsStandAtEqualAngles) {
  Scenario scenario = plain_scenario();
  std::get<RingTargets>(scenario.targets) = {5, 6.0, 0.25, {1, 2}};
  const std::vector<Vec2> ring = target_positions(scenario);
  ASSERT_EQ(ring.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(ring[i].x, 1 + 6 * std::cos(0.25 + i * 2 * M_PI / 5), 1e-9);
    EXPECT_NEAR(ring[i].y, 2 + 6 * std::sin(0.25 + i * 2 * M_PI / 5), 1e-9);
  }
}

TEST(Scenario, RandomTargetsFillAnAnnulusEvenly) {
  Scenario scenario = plain_scenario();
  scenario.targets = RandomTargets{2000, 9.0, {1, 2}};
  const std::vector<Vec2> random = target_positions(scenario);
  EXPECT_EQ(random, target_positions(scenario));
  int inner = 0;
  for (const Vec2 p : random) {
    const double r = distance(p, Vec2{1, 2});
    EXPECT_GE(r, 9 * std::sqrt(0.1) - 1e-9);
    EXPECT_LE(r, 9.0 + 1e-9);
    inner += r < 9 * std::sqrt(0.55);  // half of the annulus' area
  }
  EXPECT_NEAR(inner, 1000, 110);
  scenario.seed = 2;
  EXPECT_NE(random, target_positions(scenario));
}

TEST(Scenario, RandomTargetsKeepClearOfObstacles) {
  Scenario scenario = plain_scenario();
  scenario.targets = RandomTargets{500, 9.0, {}};
  scenario.obstacles = {Box{{6, 0}, {12, 30}, 0.0}, Disc{{-5, 0}, 2}};  // the box takes all of x > 0
  for (const Vec2 p : target_positions(scenario))
    for (const Obstacle& o : scenario.obstacles) EXPECT_GE(clearance(o, p), scenario.robot.radius_m);
}

TEST(Scenario, TimeLimitIsTenTimesTheDriveToTheFarthestTarget) {
  Scenario scenario = plain_scenario();
  scenario.targets = std::vector<Vec2>{{3, 4}, {1, 0}};
  EXPECT_DOUBLE_EQ(time_limit_s(scenario), 250.0);
  scenario.mission.time_limit_s = 77;
  EXPECT_DOUBLE_EQ(time_limit_s(scenario), 77.0);
}

// The lengths of a Khepera IV at C = 2 m, and `factor` times as long.
void expect_lengths(const Scenario& scenario, double factor) {
  EXPECT_DOUBLE_EQ(start_pitch_m(scenario), 0.32 * factor);
  EXPECT_DOUBLE_EQ(start_jitter_m(scenario), 0.02 * factor);
  EXPECT_DOUBLE_EQ(target_tolerance_m(scenario), 0.2 * factor);
  EXPECT_DOUBLE_EQ(proximity_m(scenario), 0.3 * factor);
  EXPECT_DOUBLE_EQ(charging_reach_m(scenario), 0.6 * factor);
}

TEST(Scenario, LengthsThatAreNotGivenFollowFromTheRangeAndTheBody) {
  Scenario scenario = plain_scenario();
  expect_lengths(scenario, 1.0);
  EXPECT_EQ(wheel_distance_m(scenario), 0.1054);
  EXPECT_EQ(max_acceleration_m_s2(scenario), 1.0);
  EXPECT_DOUBLE_EQ(norm(target_positions(scenario)[0]), 3.0);
  scenario.radio.range_m = 0.5;
  expect_lengths(scenario, 1.0);  // the bodies are as large as they were
  EXPECT_DOUBLE_EQ(norm(target_positions(scenario)[0]), 0.75);
  scenario.robot.radius_m = 0.0352;
  expect_lengths(scenario, 0.5);
  EXPECT_DOUBLE_EQ(wheel_distance_m(scenario), 0.0527);
  scenario.radio.range_m = 7.0;
  expect_lengths(scenario, 3.5);
  scenario.robot.wheel_limit_m_s = 1.4;
  EXPECT_DOUBLE_EQ(max_acceleration_m_s2(scenario), 14.0) << "as fast as it drives within 0.02 drives, 0.1 s";
  scenario.swarm.start.pitch_m = scenario.swarm.start.jitter_m = scenario.mission.target_tolerance_m =
      scenario.robot.proximity_m = scenario.battery.reach_m = scenario.robot.wheel_distance_m =
          scenario.robot.max_acceleration_m_s2 = 0.0;
  expect_lengths(scenario, 0.0);  // what is given counts
  EXPECT_EQ(wheel_distance_m(scenario) + max_acceleration_m_s2(scenario), 0.0);
}

TEST(Scenario, AlgorithmsAreSetUpFromMissionAndPlatform) {
  Scenario scenario = plain_scenario();
  scenario.mission.algorithm = "inwards";
  scenario.mission.reading = "literal";
  scenario.mission.target_tolerance_m = 0.15;
  scenario.mission.parameters = {{"target_gain", 0.125}};
  scenario.radio.range_m = 2.5;
  scenario.radio.line_of_sight = true;
  scenario.tick_s = 0.05;
  scenario.robot.wheel_limit_m_s = 0.3;
  scenario.robot.wheel_distance_m = 0.2;
  scenario.robot.radius_m = 0.13;
  const banyan::Setup setup = setup_of(scenario);
  EXPECT_EQ(setup.reading, "literal");
  EXPECT_EQ(setup.arrival_distance_m, 0.15);
  EXPECT_EQ(setup.parameters, scenario.mission.parameters);
  EXPECT_EQ(setup.platform.communication_range_m, 2.5F);
  EXPECT_TRUE(setup.platform.line_of_sight);
  EXPECT_EQ(setup.platform.tick_s, 0.05F);
  EXPECT_EQ(setup.platform.wheel_limit_m_s, 0.3F);
  EXPECT_EQ(setup.platform.wheel_distance_m, 0.2F);
  EXPECT_EQ(setup.platform.body_radius_m, 0.13F);
  EXPECT_EQ(setup.platform.drive, Drive::differential);
  scenario.robot.body = BodyModel::linear;
  EXPECT_EQ(setup_of(scenario).platform.drive, Drive::holonomic);
}

TEST(Scenario, TheAlgorithmsValuesAreItsTableAndThenTheScenariosOwn) {
  Scenario scenario = plain_scenario();
  scenario.mission.algorithm = "inwards";
  const Algorithm& inwards = algorithm_of(scenario);
  const auto value = [&](std::string_view key) {
    const auto rows = inwards.parameters();
    const auto values = inwards.values(setup_of(scenario));
    EXPECT_EQ(rows.size(), values.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (rows[k]->key == key) return values[k];
    ADD_FAILURE() << key;
    return 0.0F;
  };
  const float recruitment = value("recruitment_distance");
  const float gain = value("target_gain");
  scenario.mission.parameters = {{"target_gain", 0.125}};
  EXPECT_NE(gain, 0.125F);
  EXPECT_EQ(value("target_gain"), 0.125F);
  EXPECT_EQ(value("recruitment_distance"), recruitment);
}

TEST(Scenario, LeastRobotsHoldsForAStraightLineAndAStar) {
  EXPECT_EQ(least_robots({{0, 0}}, 0.2, 2.0), 1U);
  EXPECT_EQ(least_robots({{-9, 0}, {9, 0}}, 0.2, 2.0), 10U);  // (18 - 0.4) / 2 = 8.8 links
  EXPECT_EQ(least_robots({{-9, 0}, {9, 0}}, 0.0, 2.0), 10U);  // 9 links exactly
  // Four corners: the tree through three sides needs 0.8241 * 30 / 2 links, more than a diagonal's 7.07.
  EXPECT_EQ(least_robots({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 0.0, 2.0), 14U);
}

}  // namespace
}  // namespace banyan::world
