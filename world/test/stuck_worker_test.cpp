// SPDX-License-Identifier: MIT
// A worker that talks but does not move loses its target to one that does.
#include <gtest/gtest.h>

#include "worlds.hpp"

namespace banyan::world {
namespace {

TEST(StuckWorker, IsReplaced) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Scenario scenario = ring("convoy", 40, 3, 4.0, seed);
    const std::size_t stuck = World(scenario).targets()[1].worker;
    scenario.events.push_back({.time_s = 2.0, .action = Freeze{stuck}});
    World world(scenario);
    const auto held = [&] { return world.holder(0) && world.holder(1) && world.holder(2); };
    while (world.tick() < 2000 && !held()) world.step();
    EXPECT_TRUE(held()) << "seed " << seed;
    EXPECT_NE(world.holder(1), stuck);
    // ... for good: it does not come back to what it cannot do.
    run_until(world, world.tick() + 1000);
    EXPECT_TRUE(held()) << "seed " << seed;
  }
}

// From there it is too far, and the way round the end of the wall is short. Workers stayed behind it for ever.
TEST(NearWorker, GoesRoundAWallThatIsRightBeforeItsTarget) {
  Scenario scenario = ring("convoy", 13, 1, 3.0, 1);
  scenario.targets = std::vector<Vec2>{{0.0, 3.0}};
  scenario.obstacles = {Wall{{-0.6, 2.86}, {1.4, 2.86}}};
  World world(scenario);
  while (world.tick() < 600 && !world.holder(0)) world.step();
  EXPECT_TRUE(world.holder(0));
}

}  // namespace
}  // namespace banyan::world
