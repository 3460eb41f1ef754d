// SPDX-License-Identifier: MIT
// Robots are too few for both targets until one of them ends: then the one that was given up is tried again, and held.
#include <gtest/gtest.h>

#include <algorithm>

#include "banyan/world/world.hpp"
#include "plain_scenario.hpp"

namespace banyan::world {
namespace {

TEST(Again, ATargetThatWasGivenUpIsHeldOnceAnotherHasEnded) {
  Scenario s = plain_scenario();
  s.mission.algorithm = "convoy";
  s.swarm.robots = 7;
  s.targets = std::vector<Vec2>{{-5.5, 0.0}, {9.0, 0.0}};
  s.events.push_back({.time_s = 250.0, .action = RemoveTarget{0}});
  World world(s);
  const auto far = static_cast<RobotId>(world.targets()[1].worker);
  const auto is_served = [&] {
    return std::ranges::any_of(world.reports(), [&](const Report& r) { return r.serves == far; });
  };
  while (world.time_s() < 250.0) world.step();
  EXPECT_TRUE(world.holder(0));
  EXPECT_FALSE(is_served()) << "given up";
  while (world.time_s() < 400.0 && !world.holder(1)) world.step();
  EXPECT_TRUE(world.holder(1));
}

}  // namespace
}  // namespace banyan::world
