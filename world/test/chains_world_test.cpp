// SPDX-License-Identifier: MIT
// Chains from a base in whole worlds: how long links get, how many relays there are, and what is left when robots die
// one after the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "worlds.hpp"

namespace banyan::world {
namespace {

Scenario chains(std::size_t robots, std::size_t targets, double radius_m, std::uint64_t seed, int per_target = 1) {
  Scenario s = ring("chains", robots, targets, radius_m, seed);
  s.mission.parameters = {{"chains_per_target", per_target}};
  return s;
}

bool runs_until_all_are_held(World& world, double seconds) {
  const double end_s = world.time_s() + seconds;
  while (world.time_s() < end_s && !all_held(world)) world.step();
  return all_held(world);
}

std::size_t base_of(const World& world) {
  for (std::size_t i = 0; i < world.size(); ++i)
    if (world.alive()[i] && world.reports()[i].role == Role::root) return i;
  return world.size();
}
std::size_t count(const World& world, Role role) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < world.size(); ++i) n += world.alive()[i] && world.reports()[i].role == role ? 1 : 0;
  return n;
}

// Over promised links, without robot `without`.
bool joins_workers_to_base(const World& world, std::size_t without) {
  std::vector<std::size_t> todo{base_of(world)};
  std::vector<bool> seen(world.size());
  while (!todo.empty()) {
    const std::size_t at = todo.back();
    todo.pop_back();
    if (seen[at]) continue;
    seen[at] = true;
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (i == without || !world.alive()[i] || seen[i]) continue;
      const auto up = links_of(world.reports()[i]), down = links_of(world.reports()[at]);
      const bool linked =
          std::find(up.begin(), up.end(), at) != up.end() || std::find(down.begin(), down.end(), i) != down.end();
      if (linked) todo.push_back(i);
    }
  }
  for (std::size_t i = 0; i < world.size(); ++i)
    if (i != without && world.alive()[i] && world.reports()[i].role == Role::worker && !seen[i]) return false;
  return true;
}

// MAX is 0.72 C. Nobody knows better how far apart two robots are than the world.
TEST(ChainsWorld, NoLinkOutgrowsItsLimitAndEachChainHasTheRelaysThatItsLengthNeeds) {
  for (std::uint64_t seed = 1; seed <= (long_search() ? 100U : 10U); ++seed) {
    const double radius_m = 2.5 + 0.45 * static_cast<double>(seed % 10);
    const std::size_t targets = 2 + seed % 3;
    World world(chains(60, targets, radius_m, seed));
    while (!all_held(world) && world.time_s() < 60.0) {
      world.step();
      for (std::size_t i = 0; i < world.size(); ++i)
        for (const RobotId up : links_of(world.reports()[i]))
          ASSERT_LT(distance(world.positions()[i], world.positions()[up]), 0.72 * 2.0 + 0.005)
              << seed << ", tick " << world.tick() << ": " << i << " to " << up;
    }
    ASSERT_TRUE(all_held(world)) << seed;
    const Vec2 base = world.positions()[base_of(world)];
    std::size_t needed = 0;
    for (const Target& target : world.targets())
      needed += static_cast<std::size_t>(std::ceil(distance(target.position, base) / 1.12)) - 1;
    EXPECT_GE(count(world, Role::connector), needed) << seed;
    EXPECT_LE(count(world, Role::connector), needed + targets) << seed << ": one more where a chain is not straight";
  }
}

TEST(ChainsWorld, WithTwoChainsATargetNoSingleDeathCutsAWorkerOff) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    World world(chains(50, 3, 4.0, seed, 2));
    ASSERT_TRUE(runs_until_all_are_held(world, 60.0)) << seed;
    run_until(world, world.tick() + 50);
    const std::size_t base = base_of(world);
    for (std::size_t i = 0; i < world.size(); ++i)
      if (i != base) { EXPECT_TRUE(joins_workers_to_base(world, i)) << seed << ": without " << i; }
    World one(chains(50, 3, 4.0, seed));
    ASSERT_TRUE(runs_until_all_are_held(one, 60.0)) << seed;
    std::size_t cuts = 0;
    for (std::size_t i = 0; i < one.size(); ++i) cuts += i != base && !joins_workers_to_base(one, i) ? 1 : 0;
    EXPECT_GT(cuts, 0U) << "the test could not fail";
  }
}

// What the authors' first paper says in its abstract: targets are reached with up to 70 % of the robots of the backbone
// failing, one at a time. Spares take their places as long as there are any.
TEST(ChainsWorld, SeventyPercentOfTheBackboneMayDieOneAtATime) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scenario s = chains(50, 2, 5.0, seed);
    s.robot.dead_bodies = false;
    World world(s);
    ASSERT_TRUE(runs_until_all_are_held(world, 60.0)) << seed;
    const auto dying = static_cast<std::size_t>(std::ceil(0.7 * static_cast<double>(count(world, Role::connector))));
    for (std::size_t n = 0; n < dying; ++n) {
      world.intervene({.action = Kill{.of = Kill::Of::connectors}});
      run_until(world, world.tick() + 50);
      EXPECT_TRUE(runs_until_all_are_held(world, 60.0)) << seed << ", death " << n;
    }
    EXPECT_EQ(world.deaths(), dying);
    run_until(world, world.tick() + 300);
    EXPECT_TRUE(all_held(world)) << seed;
    EXPECT_TRUE(joins_workers_to_base(world, world.size())) << seed;
  }
}

TEST(ChainsWorld, TheLastRelayTakesTheTargetOfADeadWorker) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Scenario s = chains(40, 3, 4.0, seed);
    s.robot.dead_bodies = false;
    World world(s);
    ASSERT_TRUE(runs_until_all_are_held(world, 60.0)) << seed;
    world.intervene({.action = Kill{.of = seed % 2 == 0 ? Kill::Of::worker : Kill::Of::worker_and_parent}});
    run_until(world, world.tick() + 10);
    ASSERT_FALSE(all_held(world)) << seed;
    EXPECT_TRUE(runs_until_all_are_held(world, 60.0)) << seed;
    EXPECT_EQ(world.deaths(), 2U - (seed % 2 == 0 ? 1U : 0U));
  }
}

}  // namespace
}  // namespace banyan::world
