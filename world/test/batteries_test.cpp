// SPDX-License-Identifier: MIT
// Batteries: what robots draw against sums by hand, slots of charging places, and swarms that outlive their batteries.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "banyan/world/faults.hpp"
#include "banyan/world/threads.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

// Robots that never move: every robot is frozen from the start.
Scenario standing(Battery::Model model, std::size_t robots = 6) {
  Scenario s = ring("convoy", robots, 2, 3.0, 1);
  s.battery.model = model;
  for (std::size_t i = 0; i < robots; ++i) s.events.push_back({.action = Freeze{i}});
  return s;
}

// The mission of studies/battery.toml, one place at the start.
Scenario lasting(std::uint64_t seed) {
  Scenario s = ring("convoy", 36, 3, 6.0, seed);
  s.radio.line_of_sight = true;
  s.mission.stop_when_complete = false;
  s.battery.model = Battery::Model::power;
  s.battery.capacity_j = 1890.0;
  s.battery.charge_w = 31.5;
  s.battery.slots = 6;
  s.battery.places = {{0.0, 0.0}};
  return s;
}

TEST(Batteries, StandingRobotsDrawWhatTheModelSaysToTheLastBitOfASum) {
  Scenario s = standing(Battery::Model::power);
  World world(s);
  for (int t = 0; t < 1000; ++t) world.step();
  const double drawn = (s.battery.idle_w + s.battery.computing_w + s.battery.radio_w) * 100.0 / s.battery.capacity_j;
  for (const double level : world.charge()) EXPECT_NEAR(level, 1.0 - drawn, 1e-12);

  s = standing(Battery::Model::time);
  World by_time(s);
  for (int t = 0; t < 1000; ++t) by_time.step();
  for (const double level : by_time.charge()) EXPECT_NEAR(level, 1.0 - s.battery.charge_per_s * 100.0, 1e-12);

  World by_motion(standing(Battery::Model::motion));
  for (int t = 0; t < 1000; ++t) by_motion.step();
  for (const double level : by_motion.charge()) EXPECT_EQ(level, 1.0);
}

// A worker on its way to a target 100 m away drives straight at full speed; the other robots are hurried along.
TEST(Batteries, ADrivingRobotDrawsForItsWayAndItsWheels) {
  Scenario s = ring("convoy", 2, 1, 390.0, 1);
  s.swarm.start.headings_rad = {0.0, 0.0};
  s.swarm.start.layout = Layout::list;
  s.swarm.start.positions = {{0.0, 0.0}, {-0.5, 0.0}};
  s.battery.model = Battery::Model::motion;
  World world(s);
  double way_m = 0.0;
  for (int t = 0; t < 300; ++t) {
    const Vec2 before = world.positions()[0];
    world.step();
    way_m += distance(before, world.positions()[0]);
  }
  ASSERT_GT(way_m, 0.5);
  // Turning costs, too, and holding the straight line takes next to none.
  EXPECT_LE(world.charge()[0], 1.0 - s.battery.charge_per_m * way_m + 1e-9);
  EXPECT_GE(world.charge()[0], 1.0 - s.battery.charge_per_m * way_m - s.battery.charge_per_rad * 10.0);
}

TEST(Batteries, KheperaLastsEightHoursStandingAndFiveAtFullSpeed) {
  const Battery b;
  const double standing_w = b.idle_w + b.computing_w + b.radio_w;
  EXPECT_NEAR(b.capacity_j, 7.4 * 3.4 * 3600.0, 1e-6);
  EXPECT_NEAR(b.capacity_j / standing_w / 3600.0, 8.0, 0.05);
  EXPECT_NEAR(b.capacity_j / (standing_w + 2.0 * b.drive_w_per_m_s * RobotModel{}.wheel_limit_m_s) / 3600.0, 5.0, 0.05);
}

TEST(Batteries, ARobotWithoutChargeIsDeadWhereItStands) {
  Scenario s = standing(Battery::Model::time);
  s.battery.charge_per_s = 0.01;
  World world(s);
  for (int t = 0; t < 990; ++t) world.step();
  EXPECT_EQ(world.deaths(), 0U);
  const std::vector<Vec2> before(world.positions().begin(), world.positions().end());
  for (int t = 0; t < 20; ++t) world.step();
  EXPECT_EQ(world.deaths(), world.size());
  EXPECT_EQ(world.emptied(), world.size());
  EXPECT_TRUE(std::equal(before.begin(), before.end(), world.positions().begin()));
}

TEST(Batteries, ARobotThatRunsDownOnItsWayStopsThere) {
  Scenario s = ring("convoy", 6, 2, 30.0, 1);
  s.battery.model = Battery::Model::time;
  s.battery.charge_per_s = 0.2;
  World world(s);
  for (int t = 0; t < 48; ++t) world.step();
  const auto worker = static_cast<std::size_t>(world.targets()[0].worker);
  const Vec2 before = world.positions()[worker];
  world.step();
  EXPECT_GT(distance(before, world.positions()[worker]), 0.005) << "it is under way";
  for (int t = 0; t < 3; ++t) world.step();
  ASSERT_EQ(world.emptied(), world.size());
  const std::vector<Vec2> there(world.positions().begin(), world.positions().end());
  for (int t = 0; t < 20; ++t) world.step();
  EXPECT_TRUE(std::equal(there.begin(), there.end(), world.positions().begin()));
}

TEST(Batteries, DeathsByEventsAreNotCountedAsEmptyBatteries) {
  Scenario s = standing(Battery::Model::time);
  s.events.push_back({.time_s = 1.0, .action = Die{3}});
  World world(s);
  for (int t = 0; t < 20; ++t) world.step();
  EXPECT_EQ(world.deaths(), 1U);
  EXPECT_EQ(world.emptied(), 0U);
}

// Over a whole mission, tick by tick.
TEST(Batteries, ChargeRisesOnlyInASlotInReachAndSlotsAreNeverOverfilled) {
  const Scenario s = lasting(2);
  World world(s);
  std::vector<double> before(world.charge().begin(), world.charge().end());
  std::size_t charged_ticks = 0;
  for (int t = 0; t < 4000; ++t) {
    world.step();
    std::size_t used = 0;
    for (std::size_t i = 0; i < world.size(); ++i) {
      const bool charged = world.charged_at()[i] >= 0;
      used += charged ? 1 : 0;
      ASSERT_TRUE(world.charge()[i] >= 0.0 && world.charge()[i] <= 1.0);
      if (charged) {
        ASSERT_LE(norm(world.positions()[i]), charging_reach_m(s) + 1e-12);
      } else {
        ASSERT_LE(world.charge()[i], before[i]) << "robot " << i << " at tick " << t;
      }
      before[i] = world.charge()[i];
    }
    ASSERT_LE(used, s.battery.slots);
    charged_ticks += used;
  }
  EXPECT_GT(charged_ticks, 1000U);
}

TEST(Batteries, TheSameRunForAnyNumberOfThreadsAndForACopy) {
  World one(lasting(1));
  for (int t = 0; t < 200; ++t) one.step();
  World copy(one);
  World two(lasting(1));
  Executor both(2);
  for (int t = 0; t < 400; ++t) two.step(both);
  for (int t = 0; t < 200; ++t) one.step(), copy.step();
  EXPECT_EQ(one.hash(), two.hash());
  EXPECT_EQ(one.hash(), copy.hash());
}

TEST(Batteries, NoiseOfTheMeasurementChangesNoTrueCharge) {
  Scenario s = standing(Battery::Model::power);
  World exact(s);
  s.battery.noise = 0.1;
  World noisy(s);
  for (int t = 0; t < 300; ++t) exact.step(), noisy.step();
  EXPECT_TRUE(std::equal(exact.charge().begin(), exact.charge().end(), noisy.charge().begin()));
}

// Three lives of the batteries: every robot of the tree has been relieved several times, and none has run down.
TEST(Batteries, ASwarmHoldsItsTargetsForThreeBatteryLives) {
  World world(lasting(2));
  std::size_t held = 0, ticks = 0;
  for (int t = 0; t < 18000; ++t) {
    world.step();
    if (t < 600) continue;
    for (std::size_t k = 0; k < world.targets().size(); ++k) held += world.holder(k).has_value() ? 1 : 0;
    ticks += world.targets().size();
  }
  EXPECT_EQ(world.emptied(), 0U);
  EXPECT_GT(static_cast<double>(held) / static_cast<double>(ticks), 0.999);
  EXPECT_GT(*std::min_element(world.charge().begin(), world.charge().end()), 0.0);
}

std::string fault_of(const Scenario& s) {
  std::string text;
  for (const Fault& fault : faults(s)) text += fault.key + ": " + fault.text + "\n";
  return text;
}

TEST(BatteryKeys, WhatCannotBeIsNamed) {
  Scenario s = lasting(1);
  EXPECT_EQ(fault_of(s), "");
  s.battery.capacity_j = 0.0;
  EXPECT_NE(fault_of(s).find("battery.capacity_j"), std::string::npos);
  s = lasting(1);
  s.battery.start_charge = 1.5;
  EXPECT_NE(fault_of(s).find("battery.start_charge"), std::string::npos);
  s = lasting(1);
  s.battery.start_spread = 1.0;
  EXPECT_NE(fault_of(s).find("battery.start_spread: must be below battery.start_charge"), std::string::npos);
  s = lasting(1);
  s.battery.noise = -0.1;
  EXPECT_NE(fault_of(s).find("battery.noise"), std::string::npos);
  s = lasting(1);
  s.battery.slots = 0;
  EXPECT_NE(fault_of(s).find("battery.slots"), std::string::npos);
  s = lasting(1);
  s.battery.places.assign(101, {});
  EXPECT_NE(fault_of(s).find("battery.places_m: has 101 places"), std::string::npos);
  s = lasting(1);
  s.obstacles.push_back(Disc{{0.5, 5.0}, 1.0});
  s.battery.places = {{0.5, 5.0}};
  EXPECT_NE(fault_of(s).find("battery.places_m[0]"), std::string::npos);
  s = lasting(1);
  s.swarm.robots = 4;
  EXPECT_NE(fault_of(s), "");
}

}  // namespace
}  // namespace banyan::world
