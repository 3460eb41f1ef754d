// SPDX-License-Identifier: MIT
// The two state machines of the paper's Fig. 5: the owner of a stretched edge and the spare that
// joins it.
#include "tree/spare_management.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "bench.hpp"

namespace banyan {
namespace {

// A worker at the origin; the edge to its parent 5 is longer than E, and its target is far.
template <class Kind> class OwnerOf : public testing::Test {
 protected:
  void SetUp() override {
    bench.send({-2.5F, 0});
    bench.state.label = 300;
    bench.state.parent = 5;
    bench.state.committed = true;
    auto& m = bench.put(5, {edge, 0});
    m.role = Role::connector;
    m.committed = true;
    m.label = 100;
    m.depth = 2;
    m.parent = 9;
  }
  auto& spare(RobotId id, Vec2 position) {
    auto& m = bench.put(id, position);
    m.role = Role::spare;
    m.request = 1;
    return m;
  }
  BenchOf<Kind> bench = grown<Kind>();
  const float edge = bench.params.recruitment_distance + 0.05F;
  const float half = 0.5F * edge;  // of the way to its midpoint
};
using Owner = OwnerOf<Convoy>;

TEST_F(Owner, NeedsASpareBeyondEWhileItsWorkerTravels) {
  EXPECT_EQ(bench.step().message.need, Need::need);
  bench.move(5, {bench.params.recruitment_distance - 0.005F, 0});
  EXPECT_EQ(bench.step().message.need, Need::no_need);
  bench.move(5, {edge, 0});
  bench.send({-0.03F, 0});  // arrived
  EXPECT_EQ(bench.step().message.need, Need::no_need);
}

TEST_F(Owner, GrantsTheSpareNearestToTheMidpointAndWaits) {
  bench.step();
  spare(20, {half - 0.12F, 0.25F});
  spare(21, {half, 0.15F});
  spare(22, {half, 0.05F}).request = 8;  // asks somebody else
  const auto m = bench.step().message;
  EXPECT_EQ(m.grant, 21);
  EXPECT_EQ(m.need, Need::await);
  spare(23, {half, 0.0F});
  EXPECT_EQ(bench.steps(5).message.grant, 21) << "one at a time";
}

TEST_F(Owner, GrantsInGrowTreeOnly) {
  bench.state.phase = Phase::select_root;
  spare(20, {half, 0});
  bench.say(5).phase = bench.say(20).phase = Phase::select_root;
  EXPECT_EQ(bench.steps(5).message.grant, nobody);
}

TEST_F(Owner, TakesTheInsertedSpareAsParent) {
  bench.step();
  auto& m = spare(20, {half, 0});
  bench.steps(2);
  ASSERT_EQ(bench.state.grant, 20);
  m.request = nobody;
  m.role = Role::connector;
  m.parent = 5;
  m.committed = true;
  m.inserted_child = 1;
  m.label = 200;
  m.depth = 3;
  const auto said = bench.step().message;
  EXPECT_EQ(said.parent, 20);
  EXPECT_EQ(said.grant, nobody);
  EXPECT_EQ(said.need, Need::no_need);
}

TEST_F(Owner, WaitsForAnInsertedSpareThatIsBehindItsOwnSeqno) {
  bench.say(5).seqno = 6;
  bench.step();
  auto& m = spare(20, {half, 0});
  bench.steps(2);
  m.request = nobody;
  m.role = Role::connector;
  m.parent = 5;
  m.inserted_child = 1;
  m.label = 200;
  m.seqno = 5;
  bench.say(5).seqno = 7;
  EXPECT_EQ(bench.steps(10).message.parent, 5);
  EXPECT_EQ(bench.state.seqno, 6) << "it must not run ahead meanwhile";
  EXPECT_EQ(bench.state.grant, 20);
  m.seqno = 6;
  EXPECT_EQ(bench.step().message.parent, 20);
}

TEST_F(Owner, EndsTheGrantWhenTheSpareFallsSilentOrThinksBetter) {
  bench.step();
  spare(20, {half, 0});
  bench.steps(2);
  ASSERT_EQ(bench.state.grant, 20);
  bench.silence(20);
  bench.steps(whole(bench.params.liveness_rounds) + 1);
  EXPECT_EQ(bench.state.grant, nobody);
  auto& m = spare(21, {half, 0});
  bench.steps(3);
  ASSERT_EQ(bench.state.grant, 21);
  m.request = 8;
  bench.steps(16);
  EXPECT_EQ(bench.state.grant, nobody);
}

TEST_F(Owner, PassesUpHowFarAChildHasToTravel) {
  bench.call_back();
  auto& child = bench.put(7, {-0.5F, 0});
  child.role = Role::worker;
  child.parent = 1;
  child.label = 400;
  child.want = 500;
  EXPECT_EQ(bench.step().message.want, 500);
}

// A free spare at the origin; 7 owns a stretched edge to 5.
template <class Kind> class SpareOf : public testing::Test {
 protected:
  void SetUp() override {
    bench.params.drive = Drive::holonomic;
    auto& parent = bench.put(5, {0.5F, 0.5F});
    parent.role = Role::connector;
    parent.committed = true;
    parent.label = 100;
    parent.depth = 2;
    parent.tree_hops = 0;
    parent.seqno = 5;
    auto& owner = bench.put(7, {0.5F, -0.3F});
    owner.role = Role::worker;
    owner.committed = true;
    owner.label = 260;
    owner.depth = 3;
    owner.seqno = 5;
    owner.parent = 5;
    owner.need = Need::need;
  }
  BenchOf<Kind> bench = grown<Kind>();
};
using Spare = SpareOf<Convoy>;

TEST_F(Spare, AsksForTheEdgeInNeed) {
  EXPECT_EQ(bench.step().message.request, 7);
  bench.say(7).need = Need::no_need;
  bench.steps(17);
  EXPECT_EQ(bench.state.request, nobody) << "gives up without grant";
}

TEST_F(Spare, MustHearBothEnds) {
  bench.silence(5);
  EXPECT_EQ(bench.steps(3).message.request, nobody);
}

TEST_F(Spare, OnceGrantedDrivesToTheMidpointAndJoins) {
  bench.move(5, {0.85F, 0.35F});  // too far away to join at once
  bench.move(7, {0.85F, -0.35F});
  bench.state.turn = 100;  // no longer the first seconds of a thin start
  bench.step();
  bench.say(7).grant = 1;
  bench.say(7).need = Need::await;
  const auto output = bench.steps(2);
  EXPECT_EQ(bench.state.spare_state, SpareState::extend_edge);
  EXPECT_GT(output.motion.forward, 0.75F);
  bench.say(5).seqno = 9;  // what I follow as a free spare may be fresher than the edge
  bench.move(5, {0.0F, 0.4F});
  bench.move(7, {0.025F, -0.4F});
  const auto m = bench.step().message;
  EXPECT_EQ(m.parent, 5);
  EXPECT_EQ(m.inserted_child, 7);
  EXPECT_EQ(m.role, Role::connector);
  EXPECT_EQ(m.label, 180) << "the mean of both ends";
  EXPECT_EQ(m.seqno, 9);
  EXPECT_EQ(bench.state.tally.insertions, 1U);
  bench.say(7).parent = 1;
  bench.step();
  EXPECT_EQ(bench.state.inserted_child, nobody);
  EXPECT_EQ(bench.state.role, Role::connector);
}

TEST_F(Spare, GivesUpWhenAnotherIsGrantedOrTimeIsUp) {
  bench.step();
  bench.say(7).grant = 30;
  bench.step();
  EXPECT_NE(bench.state.request, 7);
  bench.say(7).grant = nobody;
  bench.steps(2);
  bench.say(7).grant = 1;
  bench.say(7).need = Need::await;
  bench.steps(bench.params.rounds(bench.params.insertion_drives) + 3);
  EXPECT_EQ(bench.state.request, nobody);
}

TEST_F(Spare, StaysWithTheTree) {
  bench.state.turn = 100;  // no longer the first seconds of a thin start
  bench.state.label = 300;
  bench.say(5).parent = 9;
  bench.say(7).need = Need::no_need;
  bench.move(5, {0.9F, 0});
  bench.move(7, {0.95F, 0.15F});
  const auto output = bench.step();
  EXPECT_EQ(bench.state.spare_state, SpareState::adjust_position);
  EXPECT_EQ(bench.state.reference, 5) << "the nearest of the tree";
  EXPECT_EQ(output.message.grant, 5) << "which is told";
  EXPECT_NEAR(output.motion.forward, 1.0F, 5e-3F);
}

TEST(Call, AnUnansweredNeedSpreadsHopByHop) {
  ConvoyBench bench = grown();
  bench.put(5, {0.5F, 0}).call_hops = 3;
  bench.put(6, {0, 0.5F}).call_hops = 7;
  EXPECT_EQ(bench.step().message.call_hops, 4);
  EXPECT_TRUE(bench.state.called);
  EXPECT_EQ(bench.state.reference, 5);
  bench.silence(5);
  bench.silence(6);
  bench.steps(20);
  EXPECT_EQ(bench.state.call_hops, nobody_calls);
}

}  // namespace
}  // namespace banyan
