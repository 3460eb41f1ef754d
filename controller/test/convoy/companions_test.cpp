// SPDX-License-Identifier: MIT
// Which spare stands beside which robot of the tree, where, and what it leaves to others.
#include "convoy/companions.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>

#include "bench.hpp"
#include "convoy/towing.hpp"

namespace banyan {
namespace {

// A spare (id 1) near the chain 9 (root) - 2 - 3 (worker), 0.9 C an edge, whose middle is where the test puts it.
class SpareByAChain : public ::testing::Test {
 protected:
  SpareByAChain() {
    bench.params.link_redundancy = 2;
    bench.params.line_of_sight = false;
    put_chain({0.0F, 0.5F}, {1.0F, 0.0F});
  }
  void put_chain(Vec2 middle, Vec2 along) {
    bench.put(9, middle - along * 0.9F).role = Role::root;
    auto& connector = bench.put(2, middle);
    connector.role = Role::connector;
    connector.parent = 9;
    connector.child_count = 1;
    auto& worker = bench.put(3, middle + along * 0.9F);
    worker.role = Role::worker;
    worker.parent = 2;
  }
  // Another spare that says whom it accompanies.
  void put_spare(RobotId id, Vec2 at, RobotId beside) { bench.put(id, at).below = beside; }
  RobotId chosen() {
    auto robot = bench.tick();
    keep_company(robot);
    return bench.state.accompanies;
  }
  ConvoyBench bench = grown<Convoy>();
};

TEST_F(SpareByAChain, StandsBesideTheRobotThatTheOthersDependOn) {
  EXPECT_EQ(chosen(), 2);
  EXPECT_EQ(bench.step().message.below, 2);  // and says so
}

TEST_F(SpareByAChain, WithOnePathItIsASpareLikeAnyOther) {
  bench.params.link_redundancy = 1;
  EXPECT_EQ(chosen(), nobody);
}

TEST_F(SpareByAChain, IsNotNeededWhereTheNeighboursHearEachOther) {
  bench.params.line_of_sight = false;
  bench.move(9, {-0.35F, 0.5F});
  bench.move(3, {0.35F, 0.5F});
  EXPECT_EQ(chosen(), nobody);
}

TEST_F(SpareByAChain, ALeafNeedsNoneEvenIfItsParentIsNotHeard) {
  bench.silence(9);
  bench.silence(2);
  bench.move(3, {0.5F, 0.25F});
  EXPECT_EQ(chosen(), nobody);
}

TEST_F(SpareByAChain, LeavesItToTheOneThatIsThereOrNearer) {
  put_spare(7, {0.15F, 0.5F}, 2);
  EXPECT_EQ(chosen(), nobody);
  bench.say(7).below = nobody;  // free, and nearer: it will go
  EXPECT_EQ(chosen(), nobody);
  bench.say(2).call_hops = companion_call;  // but it has not for long
  EXPECT_EQ(chosen(), 2);
}

TEST_F(SpareByAChain, OfTwoThatChooseAtOnceTheSmallerIdStays) {
  ASSERT_EQ(chosen(), 2);
  put_spare(7, {0.475F, 0.5F}, 2);
  EXPECT_EQ(chosen(), 2);
  bench.silence(7);
  for (int k = 0; k < 10; ++k) chosen();  // until it is forgotten
  put_spare(0, {0.475F, 0.5F}, 2);
  EXPECT_EQ(chosen(), nobody);
  bench.params.link_redundancy = 3;  // there is room for both
  EXPECT_EQ(chosen(), 2);
}

TEST_F(SpareByAChain, OfTwoTheOneThatIsThereStaysWhateverItsId) {
  ASSERT_EQ(chosen(), 2);
  put_spare(0, {0.8F, 0.5F}, 2);
  EXPECT_EQ(chosen(), 2);
  put_spare(7, {0.15F, 0.5F}, 2);
  EXPECT_EQ(chosen(), nobody);
}

TEST_F(SpareByAChain, OneMoreComesAlongWhileTheWorkerTravels) {
  put_spare(7, {0.15F, 0.5F}, 2);
  bench.say(2).want = bench.say(3).want = 300;
  EXPECT_EQ(chosen(), 2);
  bench.params.line_of_sight = true;  // it would hide edges; but the worker has one, too
  EXPECT_EQ(chosen(), 3);
  put_spare(6, {0.9F, 0.4F}, 3);
  EXPECT_EQ(chosen(), nobody);
  bench.silence(6);
  bench.params.line_of_sight = false;
  EXPECT_EQ(chosen(), 2);
  bench.say(2).want = bench.say(3).want = 0;
  EXPECT_EQ(chosen(), nobody);  // the nearer one is enough
}

// The body between two robots that are near to each other stays where it is, even if it dies.
TEST_F(SpareByAChain, WithSightItIsNeededWhereARobotHidesItsNeighbours) {
  bench.params.line_of_sight = true;
  bench.say(2).want = 300;
  bench.move(9, {-0.15F, 0.5F});
  bench.move(3, {0.15F, 0.5F});
  EXPECT_EQ(chosen(), 2);
  bench.move(2, {0.0F, 0.65F});  // out of their line
  EXPECT_EQ(chosen(), nobody);
}

// A worker that has lost its tree is not followed.
TEST_F(SpareByAChain, FollowsOnlyAWorkerThatLeadsABranch) {
  bench.params.line_of_sight = true;
  bench.silence(9);
  bench.silence(2);
  bench.move(3, {0.5F, 0.25F});
  bench.say(3).want = 300;
  EXPECT_EQ(chosen(), 3);
  bench.say(3).parent = nobody;
  EXPECT_EQ(chosen(), nobody);
}

// Where a branch folds only the robot itself knows: spares may be hidden from its neighbours.
TEST_F(SpareByAChain, GoesByWhatARobotSaysOnceItsBranchFolds) {
  bench.params.line_of_sight = true;
  EXPECT_EQ(chosen(), nobody);
  bench.say(2).request = 2;
  EXPECT_EQ(chosen(), 2);
}

// My robot's child lacks a companion: I go there, unless another spare is nearer to it.
TEST_F(SpareByAChain, MovesOutwardsToFillAGap) {
  ASSERT_EQ(chosen(), 2);
  auto& worker = bench.say(3);
  worker.role = Role::connector;
  worker.child_count = 1;
  EXPECT_EQ(chosen(), 2);
  worker.request = 3;
  put_spare(7, {0.5F, 0.3F}, nobody);
  EXPECT_EQ(chosen(), 2);
  bench.silence(7);
  for (int k = 0; k < 20; ++k) {
    static_cast<void>(bench.tick());  // until that one is forgotten
  }
  EXPECT_EQ(chosen(), 3);
}

// Its robot dies: it keeps its links until others have taken it as their parent.
TEST_F(SpareByAChain, StaysForAWhileWhenItsRobotHasDied) {
  bench.params.line_of_sight = false;
  ASSERT_EQ(chosen(), 2);
  bench.silence(2);
  const int dead_after = whole(bench.params.liveness_rounds);
  for (int k = 0; k < 3 * dead_after; ++k) ASSERT_EQ(chosen(), 2) << k;
  chosen();
  EXPECT_EQ(chosen(), nobody);
}

// The worker is out of reach from here, so it is not opposite to the root, where it would be heard. The other side of
// the chain hears both.
TEST_F(SpareByAChain, GoesToTheSideFromWhichItHearsTheOneThatIsOutOfReach) {
  const auto way = [&] {
    auto robot = bench.tick();
    return companion_motion(robot, robot.table().find(2));
  };
  bench.move(9, {0.9F, -0.15F});
  bench.move(2, {0.0F, -0.15F});
  bench.silence(3);
  bench.say(2).child_count = 1;
  for (int k = 0; k < 20; ++k) way();  // until it is forgotten
  bench.params.line_of_sight = true;
  EXPECT_GT(way().y, -0.1F);  // it may be hidden
  bench.params.line_of_sight = false;
  EXPECT_LT(way().y, -0.1F);
}

// In its place it keeps clear of edges, but not so far that it could not cross one to get there.
TEST_F(SpareByAChain, NearEdgesOnlyWithSight) {
  auto robot = bench.tick();
  const int near = robot.table().find(2);
  bench.params.line_of_sight = false;
  EXPECT_EQ(companion_width(robot, near), 0.0F);
  bench.params.line_of_sight = true;
  const float under_way = companion_width(robot, near);
  bench.move(2, {0.15F, 0.0F});
  auto there = bench.tick();
  EXPECT_GT(companion_width(there, there.table().find(2)), bench.params.clearance);
  EXPECT_LT(companion_width(there, there.table().find(2)), under_way);
}

TEST_F(SpareByAChain, JoinsAnEdgeOnlyIfThatHasBegunToCall) {
  ASSERT_EQ(chosen(), 2);
  bench.state.request = 3;
  chosen();
  EXPECT_EQ(bench.state.request, nobody);
  bench.state.request = 3;
  bench.say(3).call_hops = 0;
  chosen();
  EXPECT_EQ(bench.state.request, 3);
  bench.say(3).call_hops = nobody_calls;
  bench.params.line_of_sight = true;  // it folds
  bench.say(2).request = 2;
  chosen();
  EXPECT_EQ(bench.state.request, 3);
}

// Wherever the chain is and however it runs: following the motion leads to a place from which the companion hears both
// neighbours of its robot, beside it, and not upon the line between any two.
RC_GTEST_FIXTURE_PROP(SpareByAChain, ItsPlaceHearsWhatItsRobotHears, ()) {
  const float angle = static_cast<float>(*rc::gen::inRange(0, 628)) / 100.0F;
  const float far = static_cast<float>(*rc::gen::inRange(30, 100)) / 200.0F;
  bench.params.line_of_sight = *rc::gen::arbitrary<bool>();
  const Vec2 along = unit_vector(angle);
  Vec2 middle = unit_vector(0.7F * angle + 1.0F) * far;
  bench.state.accompanies = 2;
  for (int k = 0; k < 200; ++k) {
    put_chain(middle, along);
    auto robot = bench.tick();
    middle -= clamped(companion_motion(robot, robot.table().find(2)), 1.0F) *
              0.01F;  // it moves, seen from itself the chain does
  }
  RC_ASSERT(norm(middle - along * 0.9F) < 0.97F);
  RC_ASSERT(norm(middle + along * 0.9F) < 0.97F);
  RC_ASSERT(norm(middle) > 0.1F);
  RC_ASSERT(std::fabs(cross(along, middle)) > bench.params.clearance);
}

// While branches change their parents nobody may be below the root for a tick.
TEST(CompanionsOfATree, ItIsNotReconstructedOnceItHasArrived) {
  const auto is_reconstructed = [](int paths, int settled_ticks, bool with_worker) {
    ConvoyBench bench = grown<Convoy>();
    bench.params.link_redundancy = paths;
    bench.state.root = {1, 1};
    bench.state.role = Role::root;
    bench.state.phase_ticks = bench.state.stalled_ticks = 1000;
    bench.state.settled_ticks = static_cast<std::uint16_t>(settled_ticks);
    bench.state.subtree_workers = with_worker ? 1 : 0;
    bench.put_child(2, {0.5F, 0.0F}, Role::connector).subtree_workers = with_worker ? 1 : 0;
    bench.step();
    return bench.state.phase != Phase::grow_tree;
  };
  EXPECT_FALSE(is_reconstructed(2, 100, true));
  EXPECT_FALSE(is_reconstructed(2, 100, false));
  EXPECT_FALSE(is_reconstructed(2, 30, true));
  EXPECT_TRUE(is_reconstructed(2, 30, false)) << "the workers have been missed for long";
  EXPECT_TRUE(is_reconstructed(1, 100, true));
}

// A connector (id 1) between 2 and 3.
class ConnectorAlone : public ::testing::Test {
 protected:
  ConnectorAlone() {
    bench.params.link_redundancy = 2;
    bench.state.role = Role::connector;
    bench.state.parent = 2;
    bench.put(2, {-0.85F, 0.0F}).role = Role::root;
    bench.put_child(3, {0.85F, 0.0F}, Role::worker);
  }
  std::uint8_t hops_after(int ticks) {
    for (int k = 0; k < ticks; ++k) {
      auto robot = bench.tick();
      bench.state.call_hops = nobody_calls;
      keep_company(robot);
    }
    return bench.state.call_hops;
  }
  ConvoyBench bench = grown<Convoy>();
};

TEST_F(ConnectorAlone, CallsAfterAWhile) {
  const int patience = whole(bench.params.call_after_rounds);
  EXPECT_EQ(hops_after(patience), nobody_calls);
  EXPECT_EQ(hops_after(1), companion_call);
  bench.put(7, {0.15F, 0.15F}).below = 1;
  EXPECT_EQ(hops_after(1), nobody_calls);
}

// It says so at once, in a field that means nothing else of a robot of the tree.
TEST_F(ConnectorAlone, SaysThatItLacksOne) {
  bench.params.line_of_sight = false;  // as well as with it
  hops_after(3);
  EXPECT_EQ(bench.state.request, nobody);
  hops_after(1);
  EXPECT_EQ(bench.state.request, 1);
  EXPECT_EQ(bench.step().message.request, 1);
  bench.state.request = nobody;  // as at each step
  bench.put(7, {0.15F, 0.15F}).below = 1;
  hops_after(1);
  EXPECT_EQ(bench.state.request, nobody);
}

// Once its branch has arrived, it says so as long as it needs one, whether it has one or not: spares go by that alone.
TEST_F(ConnectorAlone, WithSightSaysThatItNeedsOne) {
  bench.params.line_of_sight = true;
  bench.put(7, {0.15F, 0.15F}).below = 1;
  const auto says = [&](float want) {
    bench.state.request = nobody;
    bench.state.want = want;
    hops_after(1);
    return bench.state.request == 1;
  };
  EXPECT_TRUE(says(0.0F));
  EXPECT_FALSE(says(1.5F));
  bench.move(2, {-0.45F, 0.15F});
  bench.move(3, {0.45F, 0.15F});
  EXPECT_FALSE(says(0.0F));  // they hear each other
}

// With sight it hides its child from its parent, although they are near: it lets the child go past.
TEST_F(ConnectorAlone, StepsAsideOnceItIsSuperfluous) {
  bench.params.line_of_sight = true;
  bench.say(2).subtree_workers = 1;
  bench.say(3).subtree_workers = 1;
  const auto way = [&] {
    auto robot = bench.tick();
    bench.state.subtree_workers = 1;
    bench.state.want = 0.0F;
    robot.useful_children = 1;
    Vec2 out;
    return steps_aside(robot, out) ? out : Vec2{};
  };
  EXPECT_EQ(way(), Vec2{});  // too far from each other
  bench.move(2, {-0.35F, 0.025F});
  bench.move(3, {0.3F, 0.025F});
  EXPECT_LT(way().y, -0.5F);
  bench.move(2, {-0.35F, 0.15F});
  bench.move(3, {0.3F, 0.15F});
  EXPECT_EQ(way(), Vec2{});  // it is aside
  bench.move(2, {-0.35F, 0.025F});
  bench.move(3, {0.3F, 0.025F});
  bench.params.link_redundancy = 1;
  EXPECT_EQ(way(), Vec2{});
}

// With thrift a straight chain whose slack would save a robot cannot, for that robot stands in the way: it steps aside
// as soon as its child may release it.
TEST_F(ConnectorAlone, WithThriftStepsAsideToBeReleased) {
  bench.params.link_redundancy = 1;
  bench.say(2).subtree_workers = 1;
  bench.say(3).subtree_workers = 1;
  const float reach = 0.944F;  // merge_distance with thrift 1
  for (const bool sight : {false, true}) {
    bench.params.line_of_sight = sight;
    const auto steps_from = [&](float apart, float thrift, float aside) {
      bench.params.thrift = thrift;
      bench.move(2, {-0.1F, aside});
      bench.move(3, {apart - 0.1F, aside});
      auto robot = bench.tick();
      bench.state.subtree_workers = 1;
      bench.state.want = 0.0F;
      robot.useful_children = 1;
      Vec2 out;
      return steps_aside(robot, out) && out.y < -0.5F;
    };
    EXPECT_TRUE(steps_from(reach - 0.005F, 1.0F, 0.01F)) << sight;
    EXPECT_FALSE(steps_from(reach + 0.005F, 1.0F, 0.01F)) << "too far from each other";
    EXPECT_FALSE(steps_from(reach - 0.005F, 1.0F, 0.15F)) << "it is aside";
    EXPECT_FALSE(steps_from(reach - 0.005F, 0.0F, 0.01F)) << "without thrift";
  }
}

// What a robot said before it was hidden may be over.
TEST_F(ConnectorAlone, WithSightHeedsOnlyCallsThatItHasJustHeard) {
  const auto hops_after_silence = [&](int paths, bool sight) {
    bench.params.link_redundancy = paths;
    bench.params.line_of_sight = sight;
    bench.put(7, {0.15F, 0.3F}).call_hops = 5;
    EXPECT_EQ(bench.step().message.call_hops, 6);
    bench.silence(7);
    EXPECT_EQ(bench.step().message.call_hops, 6);
    return bench.step().message.call_hops;
  };
  EXPECT_EQ(hops_after_silence(2, true), nobody_calls);
  EXPECT_EQ(hops_after_silence(2, false), 6);
  EXPECT_EQ(hops_after_silence(1, true), 6);
}

TEST_F(ConnectorAlone, CallsForNobodyWithOnePath) {
  bench.params.link_redundancy = 1;
  EXPECT_EQ(hops_after(100), nobody_calls);
}

}  // namespace
}  // namespace banyan
