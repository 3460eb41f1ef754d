// SPDX-License-Identifier: MIT
// How a swarm on batteries lasts, against sums by hand.
#include "banyan/measure/lasting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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
  s.battery.places = {{0.0, 5.0}};  // nobody ever gets there, all are frozen
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

// Six robots, four of them free, and a place so far away. Charged for half a battery, a robot gains 0.002 - 0.001 a
// second; it drives at half of 0.2 m/s.
double lasts_with_place_at(double far_m, std::size_t slots, double* by_hand_s = nullptr) {
  world::Scenario s = frozen(6);
  s.battery.places = {{0.0, far_m}};
  s.battery.capacity_j = 1000.0;
  s.battery.slots = slots;
  s.battery.charge_w = 2.0;
  world::World world(s);
  Lasting lasting(world);
  world.step();
  lasting.observe(world);
  double sum_m = 0.0;
  int posts = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    if (world.reports()[i].role == Role::spare) continue;
    sum_m += std::hypot(world.positions()[i].x, world.positions()[i].y - far_m);
    ++posts;
  }
  const double charging_s = 0.5 / 0.001;
  const double share = charging_s / (charging_s + 2.0 * sum_m / posts / 0.1);
  if (by_hand_s != nullptr) *by_hand_s = 6.0 * (1.0 - 0.0001) / (0.006 - 4.0 * share * 0.002);
  return lasting.lasts_s(world, 3.0);
}

TEST(Lasting, WhoeverHasFarToDriveIsChargedForLessOfItsTime) {
  double by_hand_s = 0.0;
  const double lasts_s = lasts_with_place_at(50.0, 10, &by_hand_s);
  EXPECT_NEAR(lasts_s, by_hand_s, 1e-6 * by_hand_s);
  EXPECT_GT(lasts_s, 0.0);
  EXPECT_EQ(lasts_with_place_at(5.0, 10), -1.0) << "near enough it lasts";
}

TEST(Lasting, FartherPlacesAndFewerSlotsNeverMakeItLast) {
  const auto longest_if_ever = [](double s) { return s < 0.0 ? std::numeric_limits<double>::infinity() : s; };
  for (const std::size_t slots : {1U, 2U, 3U, 6U}) {
    double last = std::numeric_limits<double>::infinity();
    for (const double far_m : {1.0, 5.0, 20.0, 50.0, 200.0}) {
      const double s = longest_if_ever(lasts_with_place_at(far_m, slots));
      EXPECT_LE(s, last) << slots << " slots, " << far_m << " m";
      EXPECT_TRUE(far_m <= 50.0 || s < last) << slots << " slots: fewer are charged than have one";
      EXPECT_LE(s, longest_if_ever(lasts_with_place_at(far_m, slots + 1))) << slots << " slots, " << far_m << " m";
      last = s;
    }
  }
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
