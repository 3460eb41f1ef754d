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
  bench.move(2, {-1.7F, 0.0F});
  EXPECT_TRUE(needs());
  bench.say(3).want_cm = 0;
  EXPECT_FALSE(needs());
  bench.move(2, {-1.0F, 0.0F});
  bench.step();
  bench.silence(2);
  for (int t = 0; t < 2; ++t) EXPECT_FALSE(needs());
  EXPECT_TRUE(needs());
}

TEST_F(ConvoyChain, OnlyAnEdgeNearItsLimitCallsSparesFromAfar) {
  const auto calls = [&] { return bench.steps(30).message.call_hops == 0; };  // longer than a need waits for an answer
  bench.move(2, {-1.7F, 0.0F});
  EXPECT_FALSE(calls());
  bench.move(2, {-1.85F, 0.0F});
  EXPECT_TRUE(calls());
}

// Whether a spare joins the edge from `owner` to `parent` that it is granted, with somebody else about. Before and when
// it is granted, `parent` names these two.
bool joins(Vec2 owner, Vec2 parent, std::optional<Vec2> other = std::nullopt,
           std::pair<RobotId, RobotId> named = {1, 1}) {
  ConvoyBench bench = grown<Convoy>();
  auto& above = bench.put(3, parent);
  above.role = Role::connector;
  above.label_cm = 100;
  above.depth = 2;
  auto& below = bench.put(2, owner);
  below.role = Role::worker;
  below.label_cm = 300;
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
  EXPECT_TRUE(joins({-1.0F, 0.2F}, {1.0F, 0.2F}));
  EXPECT_FALSE(joins({-1.0F, 0.2F}, {1.0F, 0.2F}, Vec2{0.5F, 0.1F}));
  EXPECT_FALSE(joins({-1.0F, 0.2F}, {1.81F, 0.2F}));
}

TEST(Convoy, ASpareDoesNotJoinBelowARobotThatMayNotHearIt) {
  EXPECT_TRUE(joins({-1.0F, 0.2F}, {1.0F, 0.2F}, std::nullopt, {4, 9})) << "I would not come between 4 and 9";
  EXPECT_FALSE(joins({-1.0F, 0.2F}, {1.0F, 0.2F}, std::nullopt, {9, 4})) << "but between 9 and 4";
  EXPECT_TRUE(joins({-1.0F, 0.2F}, {1.0F, 0.2F}, std::nullopt, {9, 1}));
}

TEST(Convoy, ASpareInTheWayJoinsIfNobodyHidesAnEndFromIt) {
  EXPECT_TRUE(joins({-1.0F, 0.0F}, {1.0F, 0.0F}, Vec2{0.5F, 0.12F}));
  EXPECT_FALSE(joins({-1.0F, 0.0F}, {1.0F, 0.0F}, Vec2{0.5F, 0.06F}));
}

// Both are blocked, but 3 can be heard past 5; 4 hides 2, which is nearer to me and to the root.
TEST(Convoy, PrefersABlockedParentThatItStillSees) {
  ConvoyBench bench = grown<Convoy>();
  bench.state.phase = Phase::select_parent;
  bench.state.label_cm = 200;
  bench.send({-5.0F, 0.0F});
  bench.put(2, {1.0F, 0.0F}).label_cm = 50;
  bench.put(3, {0.0F, 1.2F}).label_cm = 100;
  bench.put(4, {0.5F, 0.02F}).role = Role::spare;
  bench.put(5, {0.12F, 0.6F}).role = Role::spare;
  EXPECT_EQ(bench.step().message.parent, 3);
}

// Also in epoch 0, which follows epoch 65,535.
TEST(Convoy, ATreeThatHasArrivedKeepsTheEdgesOfTheOldOne) {
  for (const Serial epoch : {Serial{0}, Serial{2}}) {
    ConvoyBench bench = grown<Convoy>();
    bench.state.epoch = epoch;
    bench.state.phase = Phase::select_parent;
    bench.state.label_cm = 200;
    bench.state.old_parent = 2;
    bench.send({0.0F, 0.1F});
    bench.put(2, {1.5F, 0.0F}).label_cm = 100;
    bench.put(3, {0.0F, 0.5F}).label_cm = 50;
    EXPECT_EQ(bench.step().message.parent, 2) << epoch;
  }
}

// Over a longer link comes a label with which no parent is found.
TEST(Convoy, ARobotOfATreeThatHasArrivedWaitsForALabelOverALinkThatMayBeAnEdge) {
  const auto label_after = [](int ticks, bool member, std::uint16_t want_cm) {
    ConvoyBench bench = grown<Convoy>();
    bench.state.phase = Phase::start_tree;
    bench.state.label_cm = unknown_label;
    bench.state.parent = nobody;
    if (member) {
      ConvoyMessage& worker = bench.put_child(4, {0.5F, 0}, Role::worker);
      worker.label_cm = unknown_label;
      worker.subtree_workers = 1;
      worker.want_cm = want_cm;
    }
    bench.put(9, {1.95F, 0}).label_cm = 0;
    bench.steps(ticks);
    return bench.state.label_cm;
  };
  EXPECT_EQ(label_after(20, true, 0), unknown_label);
  EXPECT_EQ(label_after(40, true, 0), 195) << "not for ever";
  EXPECT_EQ(label_after(20, true, 100), 195) << "its worker has not arrived";
  EXPECT_EQ(label_after(20, false, 0), 195) << "a spare needs no parent";
}

}  // namespace
}  // namespace banyan
