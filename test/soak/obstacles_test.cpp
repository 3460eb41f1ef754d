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
#include "sight.hpp"

namespace banyan::soak {
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
  std::size_t parts_at_the_end = 0;      // of the network, by range and sight
};

Outcome simulate(const world::Scenario& scenario) {
  world::World world(scenario);
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
  const std::vector<bool> living(world.alive().begin(), world.alive().end());
  outcome.parts_at_the_end = SightCheck(world).components(living, world.line_of_sight());
  return outcome;
}

Outcome simulate(const std::string& name, std::uint64_t seed) { return simulate(load(name, seed)); }

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

// The tree gets through; spares may stay behind the wall.
TEST(Obstacles, TheGapInAWallIsFound) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) EXPECT_TRUE(simulate("wall-with-gap", seed).run.complete) << seed;
}

// A root that is towed round a corner has its spares behind it.
TEST(Obstacles, SparesFollowTheRootRoundCorners) {
  for (const char* name : {"rooms", "scattered-discs"})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      world::Scenario scenario = load(name, seed);
      scenario.mission.stop_when_complete = false;
      scenario.mission.time_limit_s = 120.0;
      const Outcome outcome = simulate(scenario);
      EXPECT_TRUE(outcome.run.complete) << name << " " << seed;
      EXPECT_EQ(outcome.parts_at_the_end, 1U) << name << " " << seed;
    }
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

// More targets than a robot remembers, among bodies that stay and hide. Whoever is cut off finds the tree again, and a
// worker that dies is replaced, be the dead a few connectors one after the other, a worker and the robot above it, or a
// fifth of all.
TEST(Deaths, InATreeOfManyTargetsAreHealed) {
  using world::Kill;
  Kill connectors{.of = Kill::Of::connectors}, pair{.of = Kill::Of::worker_and_parent}, fifth{};
  connectors.count = 8, connectors.every_s = 8.0;
  pair.count = 1;
  fifth.share = 0.2;
  std::uint64_t seed = 0;
  for (const Kill& kill : {connectors, pair, fifth}) {
    world::Scenario scenario = load("swarm-500", ++seed);
    scenario.swarm.robots = 160;
    scenario.targets = world::RandomTargets{20, 7.0, {}};
    scenario.robot.dead_bodies = true;
    scenario.mission.time_limit_s = 150.0;
    scenario.events = {{5.0, world::Event::When::complete, kill}};
    const Outcome outcome = simulate(scenario);
    ASSERT_TRUE(outcome.run.complete) << seed;
    EXPECT_TRUE(outcome.run.recovered) << seed;
    EXPECT_EQ(outcome.parts_at_the_end, 1U) << seed;
  }
}

}  // namespace
}  // namespace banyan::soak
