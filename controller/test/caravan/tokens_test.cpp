// SPDX-License-Identifier: MIT
// The root and the holders of targets: exactly one of each, whoever dies.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tiny_world.hpp"

namespace banyan::caravan {
namespace {

constexpr Vec2 target_place{0.7F, 0};

// Worker 1 at its target, and three spares around.
TinyWorld camp() {
  TinyWorld world({{0, 0}, {0.65F, 0}, {0.3F, 0.3F}, {0.2F, -0.3F}, {-0.3F, 0.1F}}, {1});
  world.send(1, target_place);
  return world;
}

TEST(CaravanTokens, OneSpareTakesTheTargetOfADeadHolderAndGoesThere) {
  TinyWorld world = camp();
  world.steps(100);
  ASSERT_EQ(world.holders(1), std::vector<std::size_t>{1});
  world.kill(1);
  world.call_back(1);
  const int silent = world.until(600, [&] { return !world.holders(1).empty(); });
  EXPECT_GE(silent, 10) << "it may only be hidden";
  EXPECT_LE(silent, 120);
  const auto first = world.holders(1);
  world.steps(150);
  ASSERT_EQ(world.holders(1), first);
  EXPECT_EQ(world.role(first[0]), Role::worker);
  EXPECT_LE(world.to(first[0], target_place), 0.1F);
}

// News of twenty others comes in turn; its parent notices at once.
TEST(CaravanTokens, ADeadHolderIsReplacedAsSoonHoweverManyTargetsThereAre) {
  std::vector<Vec2> places{{0, 0}, {0.3F, 0}, {0, 0.3F}, {-0.3F, 0}, {0, -0.3F}};
  std::vector<std::size_t> sent{1};
  for (std::size_t i = 5; i < 25; ++i) {
    places.push_back(unit_vector(0.3F * static_cast<float>(i)) * 0.7F);
    sent.push_back(i);
  }
  TinyWorld world(places, sent);
  for (std::size_t i = 5; i < 25; ++i) world.send(i, places[i]);
  world.send(1, {1.5F, 0});
  world.steps(400);
  ASSERT_LE(world.to(1, {1.5F, 0}), 0.1F);
  world.kill(1);
  world.call_back(1);
  EXPECT_LE(world.until(600, [&] { return !world.holders(1).empty(); }), 120);
}

RC_GTEST_PROP(CaravanTokens, ExactlyOneHoldsTheTargetWhoeverDies, ()) {
  TinyWorld world = camp();
  world.dice = Dice(any_seed());
  world.loss = 0.01F * static_cast<float>(*rc::gen::inRange(0, 31));
  world.steps(*rc::gen::inRange(60, 160));
  const auto second = *rc::gen::inRange<std::size_t>(2, 5);
  world.kill(1);
  world.steps(*rc::gen::inRange(0, 300));
  world.kill(second);
  world.steps(1200);
  const auto holders = world.holders(1);
  RC_ASSERT(holders.size() == 1);
  RC_ASSERT(world.to(holders[0], target_place) <= 0.1F);
}

RC_GTEST_PROP(CaravanTokens, ExactlyOneBecomesRootOnceTheRootDies, ()) {
  TinyWorld world = camp();
  world.dice = Dice(any_seed());
  world.loss = 0.01F * static_cast<float>(*rc::gen::inRange(0, 31));
  world.steps(*rc::gen::inRange(30, 160));
  world.kill(0);
  world.steps(500);
  const auto roots = world.of_role(Role::root);
  RC_ASSERT(roots.size() == 1);
  for (std::size_t i = 1; i < world.size(); ++i) {
    RC_ASSERT(world.said(i).root.id == roots[0]);
    RC_ASSERT(world.leads_to(i, roots[0]));
  }
  RC_ASSERT(world.holders(1) == std::vector<std::size_t>{1});
}

TEST(CaravanTokens, ASwarmThatHasNeverHeardOfARootMakesOne) {
  TinyWorld world({{0, 0}, {0.5F, 0}, {1.0F, 0}}, {}, false);
  world.steps(1000);
  ASSERT_EQ(world.of_role(Role::root), std::vector<std::size_t>{0});
  EXPECT_TRUE(world.leads_to(2, 0));
}

// A worker that nobody hears for long has a second one at its target, until both hear each other.
TEST(CaravanTokens, OfTwoThatServeATargetTheOneThatIsThereStays) {
  TinyWorld world = camp();
  world.steps(60);
  world.hold(1);
  world.places[1] = {0.4F, -0.4F};  // somebody has carried it away
  world.jam(1);
  world.until(600, [&] { return world.holders(1).size() == 2; });
  ASSERT_EQ(world.holders(1).size(), 2U);
  const std::size_t second = world.holders(1)[1];
  world.until(300, [&] { return world.to(second, target_place) <= 0.05F; });
  world.steps(2);
  world.jam(1, false);
  EXPECT_LE(world.until(100, [&] { return world.holders(1).size() == 1; }), 30);
  world.steps(100);
  EXPECT_EQ(world.holders(1), std::vector<std::size_t>{second});
  EXPECT_NE(world.role(1), Role::worker) << "though it is still sent";
}

TEST(CaravanTokens, WhoWasSentKeepsItsTargetWhileNobodyIsThere) {
  TinyWorld world = camp();
  world.send(1, {0.7F, 2.5F});  // the others do not move, so that it gets only as far as its promises allow
  for (std::size_t i = 0; i < world.size(); ++i)
    if (i != 1) world.hold(i);
  world.steps(60);
  world.jam(1);
  world.until(600, [&] { return world.holders(1).size() == 2; });
  ASSERT_EQ(world.holders(1).size(), 2U);
  world.steps(20);
  world.jam(1, false);
  EXPECT_LE(world.until(100, [&] { return world.holders(1).size() == 1; }), 40);
  world.steps(100);
  EXPECT_EQ(world.holders(1), std::vector<std::size_t>{1});
}

RC_GTEST_PROP(CaravanTokens, WhileItIsHeardARobotThatWasSentKeepsItsTarget, ()) {
  TinyWorld world = camp();
  world.dice = Dice(any_seed());
  world.loss = 0.01F * static_cast<float>(*rc::gen::inRange(0, 31));
  world.send(1, world.dice.on_disc(1.5F));
  for (int t = 0; t < 400; ++t) {
    world.step();
    RC_ASSERT(world.holders(1) == std::vector<std::size_t>{1});
  }
}

TEST(CaravanTokens, ATargetThatIsGivenUpIsServedByNobody) {
  TinyWorld world = camp();
  world.steps(100);
  world.give_up(1);
  world.call_back(1);
  for (int t = 0; t < 600; ++t) {
    world.step();
    ASSERT_TRUE(world.holders(1).empty()) << t;
  }
  EXPECT_EQ(world.role(1), Role::spare);
}

TEST(CaravanTokens, AReplacementGivesItUpToo) {
  TinyWorld world = camp();
  world.steps(100);
  world.kill(1);
  world.until(600, [&] { return !world.holders(1).empty(); });
  ASSERT_EQ(world.holders(1).size(), 1U);
  world.steps(100);
  world.give_up(1);
  for (int t = 0; t < 600; ++t) {
    world.step();
    ASSERT_TRUE(world.holders(1).empty()) << t;
  }
  EXPECT_EQ(world.of_role(Role::spare).size(), 3U);
}

TEST(CaravanTokens, OnlyItsHolderHasToHearThatATargetIsGivenUp) {
  TinyWorld world = camp();
  world.steps(100);
  world.call_back(1);
  for (int t = 0; t < 600; ++t) {
    world.step();
    ASSERT_TRUE(world.holders(1).empty()) << t;
  }
}

TEST(CaravanTokens, WhoIsSentAgainServesAgain) {
  TinyWorld world = camp();
  world.steps(100);
  world.call_back(1);
  world.steps(50);
  world.send(1, {0.5F, 0.5F});
  world.steps(150);
  EXPECT_EQ(world.holders(1), std::vector<std::size_t>{1});
  EXPECT_LE(world.to(1, {0.5F, 0.5F}), 0.1F);
  EXPECT_EQ(world.of_role(Role::spare).size(), 3U) << "nobody else goes there, nor to the place before";
}

// The root stays, and nobody else is there to go between: it waits at the end of its promise.
TEST(CaravanTokens, AWorkerThatWaitsForSparesInVainPutsItsTargetOffAndTriesAgain) {
  TinyWorld world({{0, 0}, {0.5F, 0}}, {1});
  world.send(1, {3.0F, 0});
  world.hold(0);
  const int drive = world.params.rounds(1.0F);
  const int waited = world.until(20 * drive, [&] { return world.holders(1).empty(); });
  EXPECT_GT(waited, 5 * drive);
  EXPECT_LT(waited, 9 * drive);
  ASSERT_TRUE(world.holders(1).empty());
  bool told = false;
  for (int t = 0; t < 4; ++t) {
    world.step();
    told |= world.said(1).token.name == 1 && world.said(1).token.holder == put_off;
  }
  EXPECT_TRUE(told);
  EXPECT_EQ(world.role(1), Role::spare);
  const int paused = world.until(40 * drive, [&] { return !world.holders(1).empty(); });
  EXPECT_GT(paused, 11 * drive);
  EXPECT_LT(paused, 14 * drive);
}

TEST(CaravanTokens, ATargetThatIsGivenUpWhileItIsPutOffIsNotTriedAgain) {
  TinyWorld world({{0, 0}, {0.5F, 0}}, {1});
  world.send(1, {3.0F, 0});
  world.hold(0);
  const int drive = world.params.rounds(1.0F);
  world.until(20 * drive, [&] { return world.holders(1).empty(); });
  world.steps(drive);
  world.call_back(1);
  for (int t = 0; t < 40 * drive; ++t) {
    world.step();
    ASSERT_TRUE(world.holders(1).empty()) << t;
  }
}

TEST(CaravanTokens, AWorkerWhoseMotorsFailLeavesItsTargetToAnother) {
  TinyWorld world = camp();
  world.send(1, {0.7F, 0.9F});
  world.hold(1);
  world.until(1000, [&] { return world.holders(1) != std::vector<std::size_t>{1}; });
  world.until(1000, [&] { return !world.holders(1).empty(); });
  world.steps(300);
  const auto holders = world.holders(1);
  ASSERT_EQ(holders.size(), 1U);
  EXPECT_NE(holders[0], 1U);
  EXPECT_LE(world.to(holders[0], {0.7F, 0.9F}), 0.1F);
}

// The holder dies with the only one that it has told.
TEST(CaravanTokens, WhoHearsBothEndsKnowsThePlaceThatOneIsTold) {
  TinyWorld world = camp();
  world.hold_all();
  world.until(20, [&] { return world.said(1).token.told != nobody && world.said(1).token.name == 1; });
  const RobotId told = world.said(1).token.told;
  ASSERT_NE(told, nobody);
  world.step();
  for (std::size_t i = 0; i < world.size(); ++i) world.hold(i, false);
  world.kill(1);
  if (told != 0) world.kill(told);
  else world.jam(0);
  world.until(1000, [&] { return !world.holders(1).empty(); });
  world.steps(300);
  ASSERT_EQ(world.holders(1).size(), 1U);
  EXPECT_LE(world.to(world.holders(1)[0], target_place), 0.15F);
}

}  // namespace
}  // namespace banyan::caravan
