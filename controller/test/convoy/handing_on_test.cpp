// SPDX-License-Identifier: MIT
// In a large swarm a junction is handed on to the robot below it.
#include "convoy/handing_on.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace banyan {
namespace {

// A connector (id 1) of the chain 9 - 2 - 1; its child 3 is a junction between 4, which has 9.5 C to go and calls in
// vain, and 5, which is nearly there. Both of its edges are as long as they may be.
class BesideAJunction : public ConvoyChain {
 protected:
  BesideAJunction() {
    bench.state.root_size = 1000;
    bench.state.want = 9.5F;
    bench.move(3, {0.3F, 0.0F});
    auto& junction = bench.say(3);
    junction.role = Role::connector;
    junction.child_count = 2;
    junction.want = 2432;
    junction.call_hops = 1;
    put_branch(4, {0.3F, 0.94F}, 2432).call_hops = 0;
    put_branch(5, {0.3F, -0.94F}, 22);
  }
  ConvoyMessage& put_branch(RobotId id, Vec2 position, std::uint16_t want) {
    auto& m = bench.put(id, position);
    m.role = Role::connector;
    m.parent = 3;
    m.want = want;
    return m;
  }
};

TEST_F(BesideAJunction, ItComesUpTowardsTheBranchThatHasLeastToGo) {
  EXPECT_GT(motion().x, 0.5F);
  EXPECT_LT(motion().y, -0.3F);
  bench.move(3, {0.05F, 0.0F});
  EXPECT_LT(motion().y, -0.5F);
}

TEST_F(BesideAJunction, IfItHearsOnlyTheOtherBranchItComesUpOpposite) {
  bench.silence(5);
  EXPECT_LT(motion().y, -0.3F);
}

TEST_F(BesideAJunction, ItStaysWhereNobodyCalls) {
  bench.say(3).call_hops = 5;
  EXPECT_LT(motion().x, 0.3F);
}

// There the spares are near, and missions of the paper's size go as they always did.
TEST_F(BesideAJunction, ItStaysInASmallSwarm) {
  bench.state.root_size = 450;
  EXPECT_LT(motion().x, 0.3F);
}

// Their branches use up the spares that are near, however many robots the root has counted.
TEST_F(BesideAJunction, ItComesUpWhereTargetsAreMoreThanARobotRemembers) {
  bench.state.root_size = 100;
  bench.state.forgets = true;
  EXPECT_GT(motion().x, 0.5F);
  bench.state.root_size = 0;
  EXPECT_LT(motion().x, 0.3F) << "the root has not counted yet: the swarm may be small";
}

// Their spares are spread along the line, however few robots there are.
TEST_F(BesideAJunction, ItComesUpInAThinStart) {
  bench.state.root_size = 40;
  EXPECT_LT(motion().x, 0.3F);
  bench.state.neighbors_at_start = 2;
  EXPECT_GT(motion().x, 0.5F);
}

TEST_F(BesideAJunction, AWorkerWithABranchOfItsOwnIsHelpedTowardsThatBranch) {
  bench.say(3).role = Role::worker;
  bench.say(3).child_count = 1;
  bench.silence(4);
  EXPECT_LT(motion().y, -0.3F);
  bench.say(3).child_count = 0;
  EXPECT_GT(motion().y, -0.3F);
}

// Its own edges would hold it back where robots are short: they share their slack.
TEST_F(BesideAJunction, OnItsWayItSharesNoSlack) {
  bench.state.call_hops = 2;
  bench.move(2, {-0.8F, 0.0F});
  EXPECT_GT(motion().x, 0.5F);
  bench.say(3).call_hops = 5;
  EXPECT_LT(motion().x, 0.0F);
}

TEST_F(ConvoyChain, AJunctionOfALargeSwarmFollowsWhileItsParentIsNear) {
  auto& other = bench.put(4, {0.8F, 0.3F});
  other = bench.say(3);
  other.id = 4;
  bench.move(2, {-0.3F, 0.0F});
  const float waits = motion().x;
  bench.state.root_size = 1000;
  EXPECT_GT(motion().x, waits + 0.5F);
  bench.move(2, {-0.6F, 0.0F});
  EXPECT_LT(motion().x, waits + 0.2F);
}

// Robot 1 is the branch of junction 2, which another branch keeps from going on; 9 has come up beside 2.
class BranchOfAJunction : public ConvoyChain {
 protected:
  BranchOfAJunction() {
    bench.state.root_size = 1000;
    bench.state.want = 2.0F;
    auto& junction = bench.say(2);
    junction.child_count = 2;
    junction.call_hops = 1;
    junction.want = 2432;
    put_root({-0.6F, 0.175F});
  }
};

TEST_F(BranchOfAJunction, TakesTheRobotThatHasComeUp) { EXPECT_EQ(parent_after_shortcuts(), 9); }

TEST_F(BranchOfAJunction, StaysInASmallSwarmOrWhereNobodyCallsOrWhileASpareJoins) {
  bench.state.root_size = 450;
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.state.root_size = 1000;
  bench.say(2).call_hops = 2;
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.say(2).call_hops = 1;
  bench.say(2).need = Need::await;
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.say(2).need = Need::no_need;
  EXPECT_EQ(parent_after_shortcuts(), 9);
}

TEST_F(BranchOfAJunction, OfBranchesThatCallTheOneThatGoesFarthestStays) {
  bench.state.call_hops = 0;
  bench.say(2).want = 512;
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.say(2).want = 2432;
  EXPECT_EQ(parent_after_shortcuts(), 9);
}

// A longer edge would be in need at once; a branch that calls is in need already.
TEST_F(BranchOfAJunction, TakesALongEdgeOnlyIfItCallsItself) {
  bench.move(9, {-0.85F, 0.2F});
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.state.call_hops = 0;
  EXPECT_EQ(parent_after_shortcuts(), 9);
}

}  // namespace
}  // namespace banyan
