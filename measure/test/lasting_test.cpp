// SPDX-License-Identifier: MIT
// How a swarm on batteries lasts, against sums by hand.
#include "banyan/measure/lasting.hpp"

#include <gtest/gtest.h>

#include "banyan/algorithms/algorithms.hpp"

namespace banyan::measure {
namespace {

world::Scenario frozen(std::size_t robots) {
  world::Scenario s = world::plain_scenario(algorithms());
  s.swarm.robots = robots;
  s.targets = world::RingTargets{2, 3.0};
  s.battery.model = world::Battery::Model::time;
  s.battery.charge_per_s = 0.001;
  for (std::size_t i = 0; i < robots; ++i) s.events.push_back({.action = world::Freeze{i}});
  return s;
}

TEST(Lasting, WithoutAPlaceTheChargeLastsAsLongAsIsLeftOfIt) {
  world::World world(frozen(6));
  Lasting lasting(world);
  for (int t = 0; t < 1000; ++t) {
    world.step();
    lasting.observe(world);
  }
  EXPECT_NEAR(lasting.least_charge(), 0.9, 1e-9);
  EXPECT_NEAR(lasting.mean_charge(), 0.9, 1e-9);
  EXPECT_NEAR(lasting.lasts_s(world, 3.0), 900.0, 1e-6);
  EXPECT_EQ(lasting.swaps(), 0U);
}

// Six robots draw 0.006 a second. All but three of the tree, and the one that stands at the place, may be charged.
TEST(Lasting, AsManyAreChargedAsAreFreeAndHaveASlot) {
  world::Scenario s = frozen(6);
  s.battery.places = {{0.0, 500.0}};  // nobody ever gets there
  s.battery.capacity_j = 1000.0;
  s.battery.slots = 1;
  s.battery.charge_w = 2.0;
  world::World world(s);
  Lasting lasting(world);
  for (int t = 0; t < 1000; ++t) {
    world.step();
    lasting.observe(world);
  }
  EXPECT_NEAR(lasting.lasts_s(world, 3.0), 5.4 / (0.006 - 0.002), 1e-6);
  s.battery.slots = 10;
  world::World more(s);
  Lasting of_more(more);
  more.step();
  of_more.observe(more);
  EXPECT_EQ(of_more.lasts_s(more, 3.0), -1.0);  // four times 0.002
  EXPECT_GT(of_more.lasts_s(more, 6.0), 0.0);   // one time
}

TEST(Lasting, WithoutBatteriesThereIsNothingToSay) {
  world::Scenario s = frozen(6);
  s.battery.model = world::Battery::Model::none;
  world::World world(s);
  Lasting lasting(world);
  world.step();
  lasting.observe(world);
  EXPECT_EQ(lasting.least_charge(), -1.0);
  EXPECT_EQ(lasting.lasts_s(world, 3.0), -1.0);
}

}  // namespace
}  // namespace banyan::measure
