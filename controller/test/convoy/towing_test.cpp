// SPDX-License-Identifier: MIT
// How robots of convoy move.
#include "convoy/towing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "chain.hpp"

namespace banyan {
namespace {

TEST_F(ConvoyChain, AStretchedChildTowsItsParentAlong) {
  EXPECT_GT(motion().x, 0.5F);
  bench.say(3).want = 0;  // arrived: nothing but the tension of both edges is left
  EXPECT_LT(motion().x, 0.3F);
  bench.say(3).want = 512;
  bench.move(3, {0.5F, 0.0F});  // slack
  EXPECT_LT(motion().x, 0.3F);
}

TEST_F(ConvoyChain, WhileRobotsAreShortWhoIsAsGoodAsThereDoesNotTow) {
  bench.say(3).want = 19;
  EXPECT_GT(motion().x, 0.5F);
  bench.state.call_hops = 3;  // an edge waits in vain for a spare
  const float gives_way = motion().x;
  bench.say(3).want = 512;
  EXPECT_GT(motion().x, gives_way + 0.5F);
}

TEST_F(ConvoyChain, AJunctionStaysUntilItsEdgesAreNearTheirLimit) {
  auto& other = bench.put(4, {0.0F, 0.8F});
  other = bench.say(3);
  other.id = 4;
  const Vec2 waits = motion();
  EXPECT_LT(norm(waits), 0.7F);
  bench.move(3, {0.94F, 0.0F});
  bench.move(4, {0.0F, 0.94F});
  EXPECT_GT(norm(motion()), norm(waits) + 0.2F);
}

// A worker (id 1) whose edge is long, near an edge that waits in vain for a spare.
class WorkerWhereRobotsAreShort : public ConvoyChain {
 protected:
  WorkerWhereRobotsAreShort() {
    bench.silence(3);
    bench.state.role = Role::worker;
    bench.state.is_worker = true;
    bench.state.call_hops = 2;
    bench.move(2, {-0.9F, 0.0F});
  }
  float pace_to(Vec2 target, float gain) {
    bench.params.target_gain = gain;
    bench.send(target);
    bench.state.pull = unit(target) * (gain * std::min(1.0F, norm(target) / bench.params.arrival_distance));
    return motion().x;
  }
};

// Else the slack that it gives holds it where its edge is too short to ask for a spare, for ever.
TEST_F(WorkerWhereRobotsAreShort, InsistsUntilItIsThereHoweverWeaklyItsTargetAttractsIt) {
  for (const float gain : {1.0F, 0.49F, 0.25F}) {
    EXPECT_NEAR(pace_to({1.5F, 0.0F}, gain), gain, 1e-5F);
    EXPECT_LT(pace_to({0.05F, 0.0F}, gain), 0.0F) << "there, it gives way";
  }
}

TEST_F(ConvoyChain, HoldsStillInAReconstructionWhenAllHaveArrived) {
  bench.move(3, {0.4F, 0.5F});  // not in line with the parent: tension
  bench.state.phase = Phase::start_tree;
  EXPECT_GT(norm(motion()), 0.0F);
  bench.say(3).want = 0;
  EXPECT_EQ(norm(motion()), 0.0F);
  bench.state.phase = Phase::grow_tree;
  EXPECT_GT(norm(motion()), 0.0F);
}

// A spare 0.1 C beside the middle of the edge 2-3.
class SpareBesideAnEdge : public ::testing::Test {
 protected:
  SpareBesideAnEdge() {
    bench.put(2, {-0.4F, 0.1F}).role = Role::connector;
    bench.put(3, {0.4F, 0.1F}).role = Role::root;
  }
  Vec2 motion() { return waiting_motion(bench.tick()); }
  ConvoyBench bench = grown<Convoy>();
};

TEST_F(SpareBesideAnEdge, MakesWayForItAlsoWhenOneEndIsHiddenFromIt) {
  EXPECT_EQ(norm(motion()), 0.0F);
  bench.say(2).parent = 3;
  EXPECT_LT(motion().y, 0.0F);
  bench.silence(2);
  EXPECT_LT(motion().y, 0.0F);
}

TEST_F(SpareBesideAnEdge, MakesWayForAnEdgeOfTheOldTree) {
  bench.say(2).old_parent = 3;
  EXPECT_LT(motion().y, 0.0F);
}

// While the tree is reconstructed nobody can mend a line of sight.
TEST_F(SpareBesideAnEdge, HoldsStillInAReconstructionWhenAllHaveArrived) {
  bench.say(2).old_parent = 3;
  bench.state.phase = Phase::start_tree;
  EXPECT_EQ(norm(motion()), 0.0F);
  bench.say(2).want = 128;
  EXPECT_LT(motion().y, 0.0F);
}

// Spare 5 has passed the call on and stands next to me; the tree's nearest robot 2 drives away.
TEST(Convoy, ACalledSpareKeepsUpWithTheTree) {
  ConvoyBench bench = grown<Convoy>();
  bench.put(5, {-0.15F, 0.0F}).role = Role::spare;
  bench.put(2, {0.7F, 0.0F}).role = Role::connector;
  bench.state.called = true;
  bench.state.reference = 5;
  const auto towards_tree = [&] {
    auto robot = bench.tick();
    robot.hold = robot.table().find(2);
    return waiting_motion(robot).x;
  };
  EXPECT_LT(towards_tree(), 0.5F);
  bench.move(2, {0.8F, 0.0F});
  EXPECT_GT(towards_tree(), 0.5F);
  bench.state.usual_silence = 32;
  EXPECT_GT(towards_tree(), 0.5F);
  bench.state.neighbors_at_start = 2;
  EXPECT_LT(towards_tree(), 0.5F) << "in a thin start nobody waits for others to move";
  bench.move(2, {0.925F, 0.0F});
  EXPECT_GT(towards_tree(), 0.5F);
}

}  // namespace
}  // namespace banyan
