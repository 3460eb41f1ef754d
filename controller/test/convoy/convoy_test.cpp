// SPDX-License-Identifier: MIT
// Convoy's rules (docs/convoy.md) about parents and spares, seen from outside.
#include "banyan/controller/convoy/convoy.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "chain.hpp"

namespace banyan {
namespace {

TEST_F(ConvoyChain, AskForASpareWhenLongWithWorkLeftOrWhenHidden) {
  const auto needs = [&] { return bench.step().message.need == Need::need; };
  EXPECT_FALSE(needs());
  bench.move(2, {-0.85F, 0.0F});
  EXPECT_TRUE(needs());
  bench.say(3).want = 0;
  EXPECT_FALSE(needs());
  bench.move(2, {-0.5F, 0.0F});
  bench.step();
  bench.silence(2);
  for (int t = 0; t < 2; ++t) EXPECT_FALSE(needs());
  EXPECT_TRUE(needs());
}

TEST_F(ConvoyChain, OnlyAnEdgeNearItsLimitCallsSparesFromAfar) {
  const auto calls = [&] { return bench.steps(30).message.call_hops == 0; };  // longer than a need waits for an answer
  bench.move(2, {-0.85F, 0.0F});
  EXPECT_FALSE(calls());
  bench.move(2, {-0.925F, 0.0F});
  EXPECT_TRUE(calls());
}

// Whether a spare joins the edge from `owner` to `parent` that it is granted, with somebody else about. Before and when
// it is granted, `parent` names these two.
bool joins(Vec2 owner, Vec2 parent, std::optional<Vec2> other = std::nullopt,
           std::pair<RobotId, RobotId> named = {1, 1}) {
  ConvoyBench bench = grown<Convoy>();
  auto& above = bench.put(3, parent);
  above.role = Role::connector;
  above.label = 100;
  above.depth = 2;
  auto& below = bench.put(2, owner);
  below.role = Role::worker;
  below.label = 300;
  below.depth = 3;
  below.parent = 3;
  below.need = Need::need;
  if (other) bench.put(4, *other).role = Role::spare;
  above.count = named.first;
  EXPECT_EQ(bench.step().message.request, 2);
  below.grant = 1;
  below.need = Need::await;
  above.count = named.second;
  return bench.steps(2).message.parent == 3;
}

TEST(Convoy, ASpareJoinsWhereItStandsIfItSeesBothEnds) {
  EXPECT_TRUE(joins({-0.5F, 0.1F}, {0.5F, 0.1F}));
  EXPECT_FALSE(joins({-0.5F, 0.1F}, {0.5F, 0.1F}, Vec2{0.25F, 0.05F}));
  EXPECT_FALSE(joins({-0.5F, 0.1F}, {0.905F, 0.1F}));
}

TEST(Convoy, ASpareDoesNotJoinBelowARobotThatMayNotHearIt) {
  EXPECT_TRUE(joins({-0.5F, 0.1F}, {0.5F, 0.1F}, std::nullopt, {4, 9})) << "I would not come between 4 and 9";
  EXPECT_FALSE(joins({-0.5F, 0.1F}, {0.5F, 0.1F}, std::nullopt, {9, 4})) << "but between 9 and 4";
  EXPECT_TRUE(joins({-0.5F, 0.1F}, {0.5F, 0.1F}, std::nullopt, {9, 1}));
}

TEST(Convoy, ASpareInTheWayJoinsIfNobodyHidesAnEndFromIt) {
  EXPECT_TRUE(joins({-0.5F, 0.0F}, {0.5F, 0.0F}, Vec2{0.25F, 0.06F}));
  EXPECT_FALSE(joins({-0.5F, 0.0F}, {0.5F, 0.0F}, Vec2{0.25F, 0.03F}));
}

// Both are blocked, but 3 can be heard past 5; 4 hides 2, which is nearer to me and to the root.
TEST(Convoy, PrefersABlockedParentThatItStillSees) {
  ConvoyBench bench = grown<Convoy>();
  bench.state.phase = Phase::select_parent;
  bench.state.label = 200;
  bench.send({-2.5F, 0.0F});
  bench.put(2, {0.5F, 0.0F}).label = 50;
  bench.put(3, {0.0F, 0.6F}).label = 100;
  bench.put(4, {0.25F, 0.01F}).role = Role::spare;
  bench.put(5, {0.06F, 0.3F}).role = Role::spare;
  EXPECT_EQ(bench.step().message.parent, 3);
}

// Also in epoch 0, which follows epoch 65,535.
TEST(Convoy, ATreeThatHasArrivedKeepsTheEdgesOfTheOldOne) {
  for (const Serial epoch : {Serial{0}, Serial{2}}) {
    ConvoyBench bench = grown<Convoy>();
    bench.state.epoch = epoch;
    bench.state.phase = Phase::select_parent;
    bench.state.label = 200;
    bench.state.old_parent = 2;
    bench.send({0.0F, 0.05F});
    bench.put(2, {0.75F, 0.0F}).label = 100;
    bench.put(3, {0.0F, 0.25F}).label = 50;
    EXPECT_EQ(bench.step().message.parent, 2) << epoch;
  }
}

}  // namespace
}  // namespace banyan
