// SPDX-License-Identifier: MIT
// Robots that stand where a test puts them, and what is counted of them; then a mission of convoy.
#include "banyan/measure/redundancy.hpp"

#include <gtest/gtest.h>

#include "banyan/measure/observer.hpp"
#include "banyan/world/world.hpp"
#include "plain_scenario.hpp"

namespace banyan::measure {
namespace {

world::Scenario mission(std::size_t paths) {
  world::Scenario s = world::plain_scenario();
  s.mission.algorithm = "convoy";
  s.mission.link_redundancy = paths;
  s.mission.settle_s = 40.0;
  s.swarm.redundancy = 5.0;
  s.targets = world::RingTargets{3, 6.0};
  return s;
}

measure::Run result_of(const world::Scenario& scenario) {
  world::World world(scenario);
  Observer observer(world);
  while (!observer.finished()) {
    world.step();
    observer.observe(world);
  }
  return observer.result(world);
}

TEST(Redundancy, WithOnePathNothingIsCountedOrDone) {
  const auto run = result_of(mission(1));
  EXPECT_EQ(run.companions, 0U);
  EXPECT_EQ(run.redundant_time_ratio, -1.0);
  EXPECT_EQ(run.redundant_targets, 0U);
}

TEST(Redundancy, CompanionsGiveASecondPath) {
  const auto run = result_of(mission(2));
  ASSERT_TRUE(run.complete);
  EXPECT_GT(run.redundant_time_ratio, 0.7);
  EXPECT_EQ(run.severed_ticks, 0U);
  EXPECT_EQ(run.redundant_targets, 3U);
  EXPECT_TRUE(run.single_targets.empty());
  EXPECT_GT(run.companions, 5U);
}

// With line of sight spares join the edges, until nobody depends on the robot between it and the next but one.
TEST(Redundancy, BranchesFoldWithSight) {
  world::Scenario s = mission(2);
  s.radio.line_of_sight = true;
  const auto run = result_of(s);
  ASSERT_TRUE(run.complete);
  EXPECT_GT(run.redundant_time_ratio, 0.7);
  EXPECT_EQ(run.severed_ticks, 0U);
  EXPECT_EQ(run.redundant_targets, 3U);
  EXPECT_LT(run.companions, 4U);
  EXPECT_GT(run.committed, run.robots_bound);
  EXPECT_LT(run.disconnected_time_ratio, 0.003);
}

// Fewer than folded branches take: companions stand beside the robots of the tree, as without line of sight.
TEST(Redundancy, FewRobotsDoNotFoldWithSight) {
  world::Scenario s = mission(2);
  s.radio.line_of_sight = true;
  s.swarm.redundancy = 2.0;
  const auto run = result_of(s);
  ASSERT_TRUE(run.complete);
  EXPECT_GT(run.redundant_time_ratio, 0.7);
  EXPECT_EQ(run.redundant_targets, 3U);
  EXPECT_GT(run.companions, 5U);
}

// Too few robots for companions: all targets are reached, and the summary says which of them have one path.
TEST(Redundancy, TooFewRobotsCompleteWithOnePath) {
  world::Scenario s = mission(2);
  s.swarm.redundancy = 1.2;
  const auto run = result_of(s);
  ASSERT_TRUE(run.complete);
  EXPECT_LT(run.redundant_targets, 3U);
  EXPECT_FALSE(run.single_targets.empty());
}

}  // namespace
}  // namespace banyan::measure
