// SPDX-License-Identifier: MIT
// Robots that step by clocks of their own.
#include <gtest/gtest.h>

#include <cmath>

#include "banyan/world/bodies.hpp"
#include "banyan/world/threads.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

Scenario clocked(double drift, std::uint64_t seed = 1) {
  Scenario s = ring("inwards", 16, 2, 3.0, seed);
  s.clocks.asynchronous = true;
  s.clocks.drift = drift;
  return s;
}

TEST(Clocks, EachStrikesOncePerPeriodOfItsOwn) {
  for (const double drift : {0.0, 0.01, 0.5}) {
    for (const int parts : {2, 5, 7}) {
      Scenario s = clocked(drift);
      s.clocks.substeps = parts;
      World world(s);
      for (int t = 1; t <= 60; ++t) {
        world.step();
        // Everything told but in the last part of the tick has been sent.
        std::uint64_t strikes = 0;
        for (std::uint64_t i = 0; i < world.size(); ++i) {
          const double phase = to_uniform(bits(s.seed, Purpose::clock_phase, i));
          const double rate = 1.0 + drift * (2.0 * to_uniform(bits(s.seed, Purpose::clock_rate, i)) - 1.0);
          strikes += static_cast<std::uint64_t>(phase + rate * (t - 1.0 / parts) + 1e-12);
        }
        ASSERT_EQ(world.packets_sent(), strikes) << "drift " << drift << ", " << parts << " parts, tick " << t;
      }
    }
  }
}

TEST(Clocks, WithoutLossEverybodyInLinkHearsEveryMessageOnceItSteps) {
  Scenario s = clocked(0.0);
  for (std::size_t i = 0; i < 16; ++i) { s.events.push_back({.action = Freeze{i}}); }
  s.radio.range_m = 2.0;
  World world(s);
  run_until(world, 20);
  const std::uint64_t before = world.packets_received();
  run_until(world, 120);
  std::uint64_t links = 0;
  for (std::size_t i = 0; i < world.size(); ++i) links += world.links(i).size();
  EXPECT_EQ(world.packets_received() - before, 100 * links);
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Neighbors& table = neighbors_of(world.swarm(), i);
    ASSERT_EQ(static_cast<std::size_t>(table.size()), world.links(i).size());
    for (int k = 0; k < table.size(); ++k) {
      const Vec2 d = rotate_back(world.headings()[i], world.positions()[table.id(k)] - world.positions()[i]);
      EXPECT_NEAR(d.x, believed_m(world, table, k).x, 1e-5);
      EXPECT_NEAR(d.y, believed_m(world, table, k).y, 1e-5);
    }
  }
}

// In motion: a robot whose clock strikes in the last part of a tick is seen from outside as it was
// when it stepped. What it believes is right but for what senders have moved since they were heard,
// 2 cm at most. Turning as robots do, it would be off by 0.5 m if packets were not carried along.
TEST(Clocks, WhatWaitsIsCarriedAlong) {
  const Scenario s = clocked(0.0);
  World world(s);
  int checked = 0;
  for (int t = 0; t < 100; ++t) {
    world.step();
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (to_uniform(bits(s.seed, Purpose::clock_phase, i)) * s.clocks.substeps >= 1.0) continue;
      const Neighbors& table = neighbors_of(world.swarm(), i);
      for (int k = 0; k < table.size(); ++k) {
        if (table.age(k) > 0) continue;
        const Vec2 truth = rotate_back(world.headings()[i], world.positions()[table.id(k)] - world.positions()[i]);
        const Vec2 believed = believed_m(world, table, k);
        ASSERT_LT(distance(believed, truth), 0.03) << t << " " << i;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 500);
}

TEST(Clocks, LatencyIsInWholeTicksBeyondTheFirstPart) {
  for (const int latency : {1, 2, 5}) {
    Scenario s = clocked(0.0);
    s.radio.latency_ticks = latency;
    World world(s);
    std::uint64_t first = 0;
    while (first == 0) {
      world.step();
      if (world.packets_received() > 0) first = world.tick();
    }
    // Sent within the first tick, heard latency - 1 ticks later at the receiver's next step.
    EXPECT_GE(first, static_cast<std::uint64_t>(latency));
    EXPECT_LE(first, static_cast<std::uint64_t>(latency) + 1);
  }
}

TEST(Clocks, SlotsHoldForEachStep) {
  Scenario s = clocked(0.0);
  s.radio.slots = 3;
  World world(s);
  run_until(world, 20);
  const std::uint64_t before = world.packets_received();
  run_until(world, 70);
  EXPECT_EQ(world.packets_received() - before, 50U * 16U * 3U);
}

TEST(Clocks, ABlackoutSilencesThem) {
  Scenario s = clocked(0.0);
  s.events = {{.time_s = 2.0, .action = Blackout{1.0}}};
  World world(s);
  run_until(world, 21);  // what had arrived before is still taken in
  const std::uint64_t before = world.packets_received();
  run_until(world, 30);
  EXPECT_EQ(world.packets_received(), before);
  run_until(world, 32);
  EXPECT_GT(world.packets_received(), before);
}

TEST(Clocks, TheMissionIsAccomplished) {
  for (const BodyModel body : {BodyModel::disks, BodyModel::box2d, BodyModel::linear}) {
    if (body == BodyModel::box2d && !has_box2d()) continue;
    Scenario s = clocked(0.05);
    s.robot.body = body;
    World world(s);
    while (world.tick() < 1500 && !(world.holder(0) && world.holder(1))) world.step();
    EXPECT_TRUE(world.holder(0) && world.holder(1));
  }
}

Scenario everything(std::uint64_t seed) {
  Scenario s = hostile("inwards", 24, seed);
  s.clocks.asynchronous = true;
  s.clocks.drift = 0.1;
  s.radio.latency_ticks = 3;
  s.radio.slots = 12;
  s.events = {{.time_s = 6.0, .action = Kill{.count = 4, .every_s = 1.0}}, {.time_s = 8.0, .action = Blackout{0.6}}};
  return s;
}

TEST(Clocks, AnyNumberOfThreadsGivesTheSame) {
  World one(everything(4));
  run_until(one, 150);
  for (const int threads : {2, 3, 4}) {
    Executor team(threads);
    World many(everything(4));
    while (many.tick() < 150) many.step(team);
    EXPECT_EQ(many.hash(), one.hash()) << threads;
    EXPECT_EQ(many.packets_received(), one.packets_received());
  }
}

TEST(Clocks, ACopyGoesOnAsTheOriginal) {
  World world(everything(5));
  run_until(world, 81);
  World copy(world);
  EXPECT_EQ(copy.hash(), world.hash());
  run_until(world, 160);
  run_until(copy, 160);
  EXPECT_EQ(copy.hash(), world.hash());
}

TEST(Clocks, DriftAndSeedDecide) {
  const auto hash = [](const Scenario& s) {
    World world(s);
    run_until(world, 50);
    return world.hash();
  };
  Scenario together = clocked(0.0);
  together.clocks.asynchronous = false;
  EXPECT_NE(hash(clocked(0.0)), hash(together));
  EXPECT_NE(hash(clocked(0.0)), hash(clocked(0.1)));
  EXPECT_NE(hash(clocked(0.1, 1)), hash(clocked(0.1, 2)));
}

}  // namespace
}  // namespace banyan::world
