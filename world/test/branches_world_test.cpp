// SPDX-License-Identifier: MIT
// Branch repositioning in whole worlds: what is reported stays in one piece while branches move, no link outgrows its
// limit, and what dead connectors have cut off is joined again.
#include <gtest/gtest.h>

#include <vector>

#include "worlds.hpp"

namespace banyan::world {
namespace {

// Robots of the network that no reported link, of either end, joins to the root.
std::size_t apart_from_root(const World& world) {
  std::vector<std::vector<std::size_t>> near(world.size());
  std::vector<std::size_t> todo;
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (!world.alive()[i]) continue;
    if (world.reports()[i].role == Role::root) todo.push_back(i);
    for (const RobotId other : links_of(world.reports()[i])) {
      if (!world.alive()[other]) continue;
      near[i].push_back(other);
      near[other].push_back(i);
    }
  }
  std::vector<bool> seen(world.size());
  while (!todo.empty()) {
    const std::size_t at = todo.back();
    todo.pop_back();
    if (seen[at]) continue;
    seen[at] = true;
    todo.insert(todo.end(), near[at].begin(), near[at].end());
  }
  std::size_t apart = 0;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const bool counts = world.alive()[i] && world.reports()[i].role != Role::spare;
    apart += counts && !seen[i] ? 1 : 0;
  }
  return apart;
}

TEST(BranchesWorld, WhatIsReportedIsOnePieceAndNoLinkOutgrowsItsLimit) {
  for (std::uint64_t seed = 1; seed <= (long_search() ? 200U : 12U); ++seed) {
    Scenario s = ring("branches", 60, 3 + seed % 4, 3.0, seed);
    s.targets = RandomTargets{3 + seed % 4, 5.0};
    s.radio.loss = 0.1 * static_cast<double>(seed % 3);
    World world(s);
    run_until(world, 60);  // the first links
    while (world.time_s() < 60.0) {
      world.step();
      ASSERT_EQ(apart_from_root(world), 0U) << seed << ", tick " << world.tick();
      for (std::size_t i = 0; i < world.size(); ++i)
        for (const RobotId other : links_of(world.reports()[i]))
          ASSERT_LT(distance(world.positions()[i], world.positions()[other]), 0.9375 * 2.0 + 0.02)
              << seed << ", tick " << world.tick() << ": " << i << " to " << other;
    }
    EXPECT_TRUE(all_held(world)) << seed;
  }
}

// The source has no rule for deaths; these are ours.
TEST(BranchesWorld, WhatADeadConnectorCutsOffIsJoinedAgain) {
  for (std::uint64_t seed = 1; seed <= (long_search() ? 40U : 6U); ++seed) {
    Scenario s = ring("branches", 48, 3 + seed % 2, 4.0, seed);
    s.robot.dead_bodies = false;
    World world(s);
    while (!all_held(world) && world.time_s() < 60.0) world.step();
    ASSERT_TRUE(all_held(world)) << seed;
    for (int death = 0; death < 3; ++death) {
      world.intervene({.action = Kill{.of = Kill::Of::connectors}});
      run_until(world, world.tick() + 400);
      EXPECT_EQ(apart_from_root(world), 0U) << seed << ", death " << death;
      EXPECT_TRUE(all_held(world)) << seed << ", death " << death;
    }
    EXPECT_GE(world.deaths(), 1U) << "a small network may have no third connector to lose";
  }
}

TEST(BranchesWorld, AnotherRootIsFoundAndJoined) {
  for (std::uint64_t seed = 1; seed <= (long_search() ? 40U : 6U); ++seed) {
    Scenario s = ring("branches", 48, 3, 4.0, seed);
    s.robot.dead_bodies = false;
    World world(s);
    run_until(world, 60 + 10 * seed);
    world.intervene({.action = Kill{.of = Kill::Of::root}});
    run_until(world, world.tick() + 600);
    EXPECT_EQ(apart_from_root(world), 0U) << seed;
    EXPECT_TRUE(all_held(world)) << seed;
  }
}

}  // namespace
}  // namespace banyan::world
