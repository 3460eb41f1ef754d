// SPDX-License-Identifier: MIT
// Convoy among walls and with targets that change, on the scenarios that users get.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"
#include "banyan/measure/observer.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/world.hpp"

namespace banyan::cli {
namespace {

world::Scenario load(const std::string& name, std::uint64_t seed) {
  const auto loaded = config::load_configuration(std::string(BANYAN_SCENARIOS) + "/" + name + ".toml", algorithms(),
                                                 {{"mission.algorithm=convoy", "test"}});
  EXPECT_TRUE(loaded.ok()) << name;
  world::Scenario scenario = loaded.configuration.scenario;
  scenario.seed = seed;
  return scenario;
}

struct Outcome {
  measure::Run run;
  double nearest_m = 1e9;                // of a robot's centre to an obstacle
  std::vector<double> held;              // share of the ticks after 60 s, by target
  std::vector<std::uint32_t> committed;  // of each tick
};

Outcome simulate(const std::string& name, std::uint64_t seed) {
  world::World world(load(name, seed));
  measure::Observer observer(world);
  Outcome outcome;
  double ticks = 0.0;
  while (!observer.finished()) {
    world.step();
    observer.observe(world);
    for (const world::Vec2 p : world.positions())
      for (const world::Obstacle& obstacle : world.scenario().obstacles)
        outcome.nearest_m = std::min(outcome.nearest_m, clearance(obstacle, p));
    std::uint32_t committed = 0;
    for (const Report& m : world.reports()) committed += m.role != Role::spare ? 1 : 0;
    outcome.committed.push_back(committed);
    if (world.time_s() < 60.0) continue;
    ticks += 1.0;
    outcome.held.resize(world.targets().size(), 0.0);
    for (std::size_t t = 0; t < world.targets().size(); ++t) outcome.held[t] += world.holder(t) ? 1.0 : 0.0;
  }
  for (double& share : outcome.held) share /= ticks;
  outcome.run = observer.result(world);
  return outcome;
}

// Doors, corners, pillars: everybody arrives, nobody is lost on the way, no edge outgrows the range.
TEST(Obstacles, RoomsAndPillarsAreCrossedWithoutLosingAnybody) {
  for (const char* name : {"rooms", "scattered-discs", "corridor"})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Outcome outcome = simulate(name, seed);
      EXPECT_TRUE(outcome.run.complete) << name << " " << seed;
      EXPECT_EQ(outcome.run.split_ticks, 0U) << name << " " << seed;
      EXPECT_EQ(outcome.run.broken_ticks_by_distance, 0U) << name << " " << seed;
      EXPECT_GT(outcome.nearest_m, 0.07) << name << " " << seed;  // a body's radius: nothing goes through
    }
}

// The tree gets through; spares may stay behind the wall for a while.
TEST(Obstacles, TheGapInAWallIsFound) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) EXPECT_TRUE(simulate("wall-with-gap", seed).run.complete) << seed;
}

TEST(Targets, ThatDriveAreFollowedWhileTheTreeGrowsAndShrinks) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Outcome outcome = simulate("following", seed);
    for (const double share : outcome.held) EXPECT_GT(share, 0.95) << seed;
    EXPECT_EQ(outcome.run.split_ticks, 0U) << seed;
    EXPECT_EQ(outcome.run.broken_ticks_by_distance, 0U) << seed;
  }
}

TEST(Targets, MayBeAddedAndGivenUpOnTheWay) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Outcome outcome = simulate("changing-mission", seed);
    ASSERT_EQ(outcome.held.size(), 4U) << seed;
    for (const std::size_t target : {0U, 1U, 3U}) EXPECT_GT(outcome.held[target], 0.9) << seed << " " << target;
    EXPECT_EQ(outcome.held[2], 0.0) << seed;
    EXPECT_EQ(outcome.run.split_ticks, 0U) << seed;
  }
}

}  // namespace
}  // namespace banyan::cli
