// SPDX-License-Identifier: MIT
// The one cost: insertion, release, repair and avoidance, as they look from outside.
#include <gtest/gtest.h>

#include "tiny_world.hpp"

namespace banyan::caravan {
namespace {

constexpr float tolerance = 0.1F;  // C, of the mission
constexpr float rounding = 1e-3F;

// A worker and two spares beside the root.
TinyWorld party(Vec2 target) {
  TinyWorld world({{0, 0}, {0.3F, 0}, {0.15F, 0.25F}, {0.1F, -0.3F}}, {1});
  world.send(1, target);
  return world;
}

TEST(CaravanParent, ASpareStandsBetweenTheRootAndAWorkerThatDrivesAway) {
  TinyWorld world = party({1.6F, 0});
  world.hold(0);
  for (int t = 0; t < 400; ++t) {
    world.step();
    ASSERT_LE(world.longest_on(world.way_up(1)), longest_edge + rounding) << t;
  }
  EXPECT_LE(world.to(1, {1.6F, 0}), tolerance);
  const auto way = world.way_up(1);
  ASSERT_EQ(way.size(), 3U) << "one spare is enough";
  EXPECT_EQ(way.back(), 0U);
  EXPECT_EQ(world.role(way[1]), Role::connector);
  const Vec2 between = world.places[way[1]];
  EXPECT_GT(between.x, 0.4F);
  EXPECT_LT(between.x, 1.2F);
  EXPECT_EQ(world.of_role(Role::spare).size(), 1U);
}

TEST(CaravanParent, NearTheRootAWorkerTakesNoSpare) {
  TinyWorld world = party({0.6F, 0});
  world.steps(200);
  EXPECT_LE(world.to(1, {0.6F, 0}), tolerance);
  EXPECT_EQ(world.said(1).parent, 0);
  EXPECT_EQ(world.of_role(Role::spare).size(), 2U);
}

TEST(CaravanParent, AConnectorIsSpareAgainOnceTheWorkerComesBack) {
  TinyWorld world = party({1.6F, 0});
  world.hold(0);
  world.steps(400);
  ASSERT_EQ(world.of_role(Role::connector).size(), 1U);
  world.send(1, {0.4F, 0.3F});
  world.steps(300);
  EXPECT_LE(world.to(1, {0.4F, 0.3F}), tolerance);
  EXPECT_EQ(world.said(1).parent, 0);
  EXPECT_EQ(world.of_role(Role::spare).size(), 2U);
}

TEST(CaravanParent, ASparePrefersTheTreeToASpareHalfWay) {
  TinyWorld world({{0, 0}, {0.3F, 0.15F}, {0.6F, 0}});
  world.hold_all();
  world.steps(20);
  EXPECT_EQ(world.said(2).parent, 0) << "each spare on the way would have to join";
  world.part(0, 2);
  world.steps(20);
  EXPECT_EQ(world.said(2).parent, 1) << "if there is nothing else";
}

// Workers 1 and 2 are at their targets; the root hears 1 alone, and spare 3 stands beside 2.
TEST(CaravanParent, WhatCountsIsTheWholeWayToTheRoot) {
  TinyWorld world({{0, 0}, {0.62F, 0.15F}, {1.1F, -0.15F}, {1.1F, 0}}, {1, 2});
  world.send(1, world.places[1]);
  world.send(2, world.places[2]);
  world.hold_all();
  world.steps(60);
  ASSERT_EQ(world.said(2).parent, 1);
  EXPECT_EQ(world.said(3).parent, 1);
}

TEST(CaravanParent, ALittleToAndFroChangesNothing) {
  // Spare 3 between workers 1 and 2, as far from both, and hidden from the root.
  TinyWorld world({{0, 0.5F}, {-0.3F, 0}, {0.3F, 0}, {0, -0.3F}}, {1, 2});
  world.send(1, world.places[1]);
  world.send(2, world.places[2]);
  world.hold_all();
  world.part(0, 3);
  world.steps(60);
  const RobotId parent = world.said(3).parent;
  for (int t = 0; t < 200; ++t) {
    world.places[3].x = t % 20 < 10 ? 0.05F : -0.05F;
    world.step();
    ASSERT_EQ(world.said(3).parent, parent) << t;
  }
}

TEST(CaravanParent, AHiddenParentIsReplacedByARobotInSight) {
  TinyWorld world({{0, 0}, {0.6F, 0}, {0.3F, 0.4F}}, {1});
  world.send(1, {0.6F, 0});
  world.hold_all();
  world.steps(60);
  ASSERT_EQ(world.said(1).parent, 0);
  world.part(0, 1);
  EXPECT_LE(world.until(60, [&] { return world.said(1).parent == 2; }), 10);
  EXPECT_EQ(world.role(2), Role::spare) << "it has not heard of that yet";
  world.steps(2);
  EXPECT_EQ(world.role(2), Role::connector);
}

// Worker 1 is on its way, or there; worker 2 beyond hears it and spare 3 alone.
TinyWorld two_workers(Vec2 target_of_1, Vec2 target_of_2) {
  TinyWorld world({{0, 0}, {0.6F, 0}, {1.2F, 0}, {0.6F, 0.2F}}, {1, 2});
  world.send(1, target_of_1);
  world.send(2, target_of_2);
  world.hold_all();
  return world;
}

TEST(CaravanParent, AWorkerThatGoesElsewhereIsNoParentOfOneThatHasFarToGo) {
  TinyWorld world = two_workers({0.6F, -2.0F}, {2.6F, 0});
  world.steps(60);
  EXPECT_EQ(world.said(2).parent, 3);
}

TEST(CaravanParent, ToOneThatHasArrivedAnyWorkerWillDo) {
  TinyWorld world = two_workers({0.6F, -2.0F}, {1.2F, 0});
  world.steps(60);
  EXPECT_EQ(world.said(2).parent, 1) << "it takes no robot more";
}

// Both are as good; whatever made it change, it need not change back.
TEST(CaravanParent, NobodyGoesToAndFroBetweenTwoConnectors) {
  TinyWorld world({{0, 0}, {1.55F, 0}, {0.8F, 0.15F}, {0.8F, -0.15F}}, {1});
  world.send(1, {1.55F, 0});
  world.hold_all();
  world.steps(100);
  const std::size_t parent = world.said(1).parent;
  world.part(1, parent);
  world.steps(4);
  world.part(1, parent, false);
  int changes = 0;
  for (int t = 0; t < 200; ++t) {
    const RobotId before = world.said(1).parent;
    world.step();
    changes += world.said(1).parent != before ? 1 : 0;
  }
  EXPECT_LE(changes, 1);
  EXPECT_EQ(world.of_role(Role::connector).size(), 1U);
}

// A robot near the line may hide it; so the one that is a little farther is the parent.
TEST(CaravanParent, ALineOfSightThatIsBlockedCostsMore) {
  const std::vector<Vec2> places{{0, 0}, {0.6F, 0}, {0.3F, 0.02F}, {0.3F, 0.25F}};
  TinyWorld world(places, {1});
  world.send(1, {1.5F, 0});
  world.hold_all();
  world.steps(60);
  EXPECT_NE(world.said(1).parent, 0);
  TinyWorld over_bodies(places, {1});
  over_bodies.params.line_of_sight = false;
  over_bodies.send(1, {1.5F, 0});
  over_bodies.hold_all();
  over_bodies.steps(60);
  EXPECT_EQ(over_bodies.said(1).parent, 0) << "radio goes through bodies";
}

}  // namespace
}  // namespace banyan::caravan
