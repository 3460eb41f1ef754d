// SPDX-License-Identifier: MIT
// A root that dies before anybody has heard it: the others find one among themselves.
#include <gtest/gtest.h>

#include "worlds.hpp"

namespace banyan::world {
namespace {

TEST(FirstRoot, IsReplacedIfItDiesUnheard) {
  for (const double pitch_m : {0.32, 1.3})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      Scenario scenario = ring("convoy", 40, 3, 4.0, seed);
      scenario.swarm.start.pitch_m = pitch_m;
      scenario.radio.loss = 0.2;
      scenario.events.push_back({.time_s = 0.1, .action = Kill{.of = Kill::Of::root}});
      World world(scenario);
      const auto held = [&] { return world.holder(0) && world.holder(1) && world.holder(2); };
      while (world.tick() < 2000 && !held()) world.step();
      EXPECT_TRUE(held()) << "seed " << seed << ", " << pitch_m << " m apart";
      EXPECT_EQ(living_roots(world), 1);
      run_until(world, world.tick() + 300);
      EXPECT_TRUE(held()) << "seed " << seed;
      EXPECT_EQ(living_roots(world), 1);
    }
}

}  // namespace
}  // namespace banyan::world
