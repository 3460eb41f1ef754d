// SPDX-License-Identifier: MIT
// The two state machines of Fig. 5: the owner of a stretched edge, and the spare that joins it.
#include <gtest/gtest.h>

#include <cmath>

#include "bench.hpp"

namespace banyan::paper {
namespace {

// A worker at the origin; the edge to its parent 5 is longer than E, and its target is far.
template <class Kind> class PaperOwnerOf : public testing::Test {
 protected:
  void SetUp() override {
    bench.send({-2.5F, 0});
    bench.state.label = 300;
    bench.state.parent = 5;
    bench.state.committed = true;
    auto& m = bench.put_connector(5, {edge, 0}, 100, 0);
    m.committed = true;
  }
  auto& spare(RobotId id, Vec2 position) {
    auto& m = bench.put(id, position);
    m.role = Role::spare;
    m.request = 1;
    return m;
  }
  BenchOf<Kind> bench = grown<Kind>();
  const float edge = bench.params.recruitment_distance + 0.03F;
};
using PaperOwner = PaperOwnerOf<Outwards>;
using PaperLiteralOwner = PaperOwnerOf<OutwardsLiteral>;

TEST_F(PaperOwner, NeedsASpareBeyondEWhileItsWorkerTravels) {
  EXPECT_EQ(bench.step().message.need, Need::need);
  bench.move(5, {bench.params.recruitment_distance - 0.005F, 0});
  EXPECT_EQ(bench.step().message.need, Need::no_need);
  bench.move(5, {edge, 0});
  bench.send({-0.03F, 0});  // arrived
  EXPECT_EQ(bench.step().message.need, Need::no_need);
}

TEST_F(PaperLiteralOwner, NeedsASpareEvenWhenEverybodyHasArrived) {
  bench.send({-0.05F, 0});
  EXPECT_EQ(bench.step().message.need, Need::need);
}

TEST_F(PaperOwner, PassesAChildsNeedUp) {
  bench.move(5, {0.25F, 0});
  bench.call_back();
  auto& child = bench.put_child(7, {-0.5F, 0}, Role::worker);
  child.label = 400;
  child.need = Need::need;
  EXPECT_EQ(bench.step().message.need, Need::need);
  child.role = Role::spare;
  EXPECT_EQ(bench.step().message.need, Need::no_need);
}

TEST_F(PaperOwner, GrantsTheSpareNearestToTheMidpointOneAtATime) {
  bench.step();
  spare(20, {0.2F, 0.25F});
  spare(21, {0.35F, 0.15F});
  spare(22, {0.35F, 0.05F}).request = 8;  // asks somebody else
  spare(24, {0.35F, 0.01F}).role = Role::connector;
  const auto m = bench.step().message;
  EXPECT_EQ(m.grant, 21);
  EXPECT_EQ(m.need, Need::await);
  spare(23, {0.35F, 0.0F});
  EXPECT_EQ(bench.steps(5).message.grant, 21);
}

TEST_F(PaperOwner, WaitsWhileItsParentHasGrantedItsOwnEdge) {
  bench.step();
  bench.say(5).need = Need::await;
  bench.say(5).grant = 20;
  spare(21, {0.35F, 0.15F});
  const auto m = bench.step().message;
  EXPECT_EQ(m.need, Need::await);
  EXPECT_EQ(m.grant, nobody);
  bench.say(5).grant = nobody;  // awaits for a reason farther up
  EXPECT_EQ(bench.step().message.need, Need::no_need);
}

TEST_F(PaperOwner, TakesTheSpareAsParentOnceThatHasJoinedAndIsAhead) {
  bench.step();
  auto& m = spare(21, {0.35F, 0.0F});
  bench.step();
  m.role = Role::connector;
  m.parent = 5;
  m.label = 400;  // not yet ahead
  EXPECT_EQ(bench.step().message.parent, 5);
  m.label = 200;
  const auto said = bench.step().message;
  EXPECT_EQ(said.parent, 21);
  EXPECT_EQ(said.need, Need::no_need);
  EXPECT_EQ(said.grant, nobody);
}

TEST_F(PaperOwner, EndsAGrantThatTheSpareDoesNotUse) {
  bench.step();
  auto& m = spare(21, {0.35F, 0.0F});
  bench.step();
  m.request = nobody;
  EXPECT_EQ(bench.steps(14).message.grant, 21) << "it may not know yet";
  EXPECT_EQ(bench.step().message.grant, nobody);
}

// A free spare that hears both ends of an edge in need.
template <class Kind> class PaperSpareOf : public testing::Test {
 protected:
  void SetUp() override {
    bench.params.drive = Drive::holonomic;
    bench.state.label = 250;
    owner = &bench.put_connector(7, {0.5F, 0.3F}, 300, 0);
    owner->parent = 5;
    owner->need = Need::need;
    bench.put_connector(5, {0.5F, -0.3F}, 100, 0).committed = true;
    bench.step();
  }
  BenchOf<Kind> bench = grown<Kind>();
  Message* owner = nullptr;
};
using PaperSpare = PaperSpareOf<Outwards>;
using PaperLiteralSpare = PaperSpareOf<OutwardsLiteral>;

TEST_F(PaperSpare, AsksAndWaitsForAnAnswer) {
  EXPECT_EQ(bench.state.request, 7);
  EXPECT_EQ(bench.state.spare_state, SpareState::wait);
  bench.steps(13);
  EXPECT_EQ(bench.state.request, 7);
  owner->need = Need::no_need;
  bench.steps(3);
  EXPECT_EQ(bench.state.request, nobody);
  EXPECT_EQ(bench.state.spare_state, SpareState::adjust_position) << "nobody needs it";
}

TEST_F(PaperSpare, DrivesToTheMidpointOnceGrantedAndJoinsThere) {
  owner->grant = 1;
  const Motion towards = bench.step().motion;
  EXPECT_EQ(bench.state.spare_state, SpareState::extend_edge);
  EXPECT_GT(towards.forward, 0.9F);
  EXPECT_NEAR(towards.sideways, 0.0F, 1e-3F);
  bench.move(7, {0.03F, 0.3F});
  bench.move(5, {0.03F, -0.3F});
  const auto m = bench.step().message;
  EXPECT_EQ(m.role, Role::connector);
  EXPECT_EQ(m.parent, 5);
  EXPECT_EQ(m.request, 7) << "until the owner names it";
  EXPECT_EQ(m.label, 200) << "between both";
  owner->parent = 1;
  EXPECT_EQ(bench.step().message.request, nobody);
  EXPECT_EQ(report(bench.state).tally.insertions, 1U);
}

TEST_F(PaperSpare, WaitsUntilItsFutureParentIsAheadOfIt) {
  owner->grant = 1;
  bench.say(5).label = 260;
  bench.move(7, {0.03F, 0.3F});
  bench.move(5, {0.03F, -0.3F});
  EXPECT_EQ(bench.step().message.role, Role::spare);
  bench.say(5).label = 100;
  EXPECT_EQ(bench.step().message.role, Role::connector);
}

TEST_F(PaperSpare, GivesUpWhatIsGrantedToAnother) {
  owner->grant = 30;
  bench.step();
  EXPECT_EQ(bench.state.request, nobody);
}

TEST_F(PaperSpare, GivesUpAnEdgeThatItDoesNotReach) {
  owner->grant = 1;
  bench.steps(bench.params.rounds(2.5F));
  EXPECT_EQ(bench.state.request, 7);
  bench.step();
  EXPECT_EQ(bench.state.request, nobody);
}

TEST_F(PaperSpare, ThatIsNamedAsParentForgetsItsRequest) {
  bench.put_child(8, {-0.4F, 0}, Role::worker);
  const auto m = bench.step().message;
  EXPECT_EQ(m.role, Role::connector);
  EXPECT_EQ(m.request, nobody) << "it has not joined that edge";
}

TEST_F(PaperLiteralSpare, OrbitsItsReference) {
  bench.silence(7);
  bench.steps(14);
  bench.move(5, {0.5F, 0});
  const Motion v = bench.step().motion;
  EXPECT_NEAR(v.forward, 0.0F, 5e-4F);
  EXPECT_NEAR(std::fabs(v.sideways), 0.49F, 1e-3F) << "at tau";
  bench.move(5, {0.75F, 0});
  EXPECT_GT(bench.step().motion.forward, 0.99F) << "beyond S straight to it";
}

TEST_F(PaperSpare, StandsStillNearItsReference) {
  bench.silence(7);
  bench.steps(14);
  bench.move(5, {0.3F, 0});
  EXPECT_EQ(bench.step().motion.sideways, 0.0F);
  EXPECT_EQ(bench.step().motion.forward, 0.0F);
  bench.move(5, {0.4F, 0});
  EXPECT_GT(bench.step().motion.forward, 0.9F) << "beyond E/2";
}

TEST_F(PaperSpare, FollowsACallOfWhichItSeesNoEdge) {
  bench.silence(7);
  bench.move(5, {0.3F, 0});
  auto& far = bench.put(12, {0, 0.6F});
  far.call_hops = 2;
  far.tree_hops = 1;
  bench.steps(14);
  bench.say(5).call_hops = unreachable;
  far.call_hops = 1;
  const auto output = bench.step();
  EXPECT_EQ(output.message.call_hops, 2);
  EXPECT_GT(output.motion.sideways, 0.9F);
  far.call_hops = 3;  // it counts up: the call is over
  EXPECT_LT(bench.step().motion.sideways, 0.1F);
}

}  // namespace
}  // namespace banyan::paper
