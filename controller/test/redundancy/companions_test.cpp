// SPDX-License-Identifier: MIT
// Which spare stands beside which robot of the tree, where, and what it leaves to others.
#include "banyan/controller/redundancy/companions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <rapidcheck/gtest.h>

#include "banyan/controller/convoy/towing.hpp"
#include "bench.hpp"

namespace banyan {
namespace {

// A spare (id 1) near the chain 9 (root) - 2 - 3 (worker), 1.8 m an edge, whose middle is where the test puts it.
class SpareByAChain : public ::testing::Test {
 protected:
  SpareByAChain() {
    bench.params.link_redundancy = 2;
    put_chain({0.0F, 1.0F}, {1.0F, 0.0F});
  }
  void put_chain(Vec2 middle, Vec2 along) {
    bench.put(9, middle - along * 1.8F).role = Role::root;
    auto& connector = bench.put(2, middle);
    connector.role = Role::connector;
    connector.parent = 9;
    connector.child_count = 1;
    auto& worker = bench.put(3, middle + along * 1.8F);
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
  bench.move(9, {-0.7F, 1.0F});
  bench.move(3, {0.7F, 1.0F});
  EXPECT_EQ(chosen(), nobody);
}

TEST_F(SpareByAChain, ALeafNeedsNoneEvenIfItsParentIsNotHeard) {
  bench.silence(9);
  bench.silence(2);
  bench.move(3, {1.0F, 0.5F});
  EXPECT_EQ(chosen(), nobody);
}

TEST_F(SpareByAChain, LeavesItToTheOneThatIsThereOrNearer) {
  put_spare(7, {0.3F, 1.0F}, 2);
  EXPECT_EQ(chosen(), nobody);
  bench.say(7).below = nobody;  // free, and nearer: it will go
  EXPECT_EQ(chosen(), nobody);
  bench.say(2).call_hops = companion_call;  // but it has not for long
  EXPECT_EQ(chosen(), 2);
}

TEST_F(SpareByAChain, OfTwoThatChooseAtOnceTheSmallerIdStays) {
  ASSERT_EQ(chosen(), 2);
  put_spare(7, {0.95F, 1.0F}, 2);
  EXPECT_EQ(chosen(), 2);
  bench.silence(7);
  for (int k = 0; k < 10; ++k) chosen();  // until it is forgotten
  put_spare(0, {0.95F, 1.0F}, 2);
  EXPECT_EQ(chosen(), nobody);
  bench.params.link_redundancy = 3;  // there is room for both
  EXPECT_EQ(chosen(), 2);
}

TEST_F(SpareByAChain, OfTwoTheOneThatIsThereStaysWhateverItsId) {
  ASSERT_EQ(chosen(), 2);
  put_spare(0, {1.6F, 1.0F}, 2);
  EXPECT_EQ(chosen(), 2);
  put_spare(7, {0.3F, 1.0F}, 2);
  EXPECT_EQ(chosen(), nobody);
}

TEST_F(SpareByAChain, OneMoreComesAlongWhileTheWorkerTravels) {
  put_spare(7, {0.3F, 1.0F}, 2);
  bench.say(2).want_cm = bench.say(3).want_cm = 300;
  bench.params.line_of_sight = true;  // it would hide edges
  EXPECT_EQ(chosen(), nobody);
  bench.params.line_of_sight = false;
  EXPECT_EQ(chosen(), 2);
  bench.say(2).want_cm = bench.say(3).want_cm = 0;
  EXPECT_EQ(chosen(), nobody);  // the nearer one is enough
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
}

// Wherever the chain is and however it runs: following the motion leads to a place from which the companion hears both
// neighbours of its robot, beside it, and not upon the line between any two.
RC_GTEST_FIXTURE_PROP(SpareByAChain, ItsPlaceHearsWhatItsRobotHears, ()) {
  const float angle = static_cast<float>(*rc::gen::inRange(0, 628)) / 100.0F;
  const float far = static_cast<float>(*rc::gen::inRange(30, 100)) / 100.0F;
  bench.params.line_of_sight = *rc::gen::arbitrary<bool>();
  const Vec2 along = unit_vector(angle);
  Vec2 middle = unit_vector(0.7F * angle + 1.0F) * far;
  bench.state.accompanies = 2;
  for (int k = 0; k < 200; ++k) {
    put_chain(middle, along);
    auto robot = bench.tick();
    middle -= clamped(companion_motion(robot, robot.table().find(2)), 1.0F) * 0.02F;  // it moves, seen from itself the chain does
  }
  const float c = bench.params.communication_range_m;
  RC_ASSERT(norm(middle - along * 1.8F) < 0.97F * c);
  RC_ASSERT(norm(middle + along * 1.8F) < 0.97F * c);
  RC_ASSERT(norm(middle) > 0.2F);
  RC_ASSERT(std::fabs(cross(along, middle)) > bench.params.clearance_m);
}

// A connector (id 1) between 2 and 3.
class ConnectorAlone : public ::testing::Test {
 protected:
  ConnectorAlone() {
    bench.params.link_redundancy = 2;
    bench.state.role = Role::connector;
    bench.state.parent = 2;
    bench.put(2, {-1.7F, 0.0F}).role = Role::root;
    bench.put_child(3, {1.7F, 0.0F}, Role::worker);
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
  const int patience = bench.params.ticks(bench.params.call_after_s);
  EXPECT_EQ(hops_after(patience), nobody_calls);
  EXPECT_EQ(hops_after(1), companion_call);
  bench.put(7, {0.3F, 0.3F}).below = 1;
  EXPECT_EQ(hops_after(1), nobody_calls);
}

TEST_F(ConnectorAlone, CallsForNobodyWithOnePath) {
  bench.params.link_redundancy = 1;
  EXPECT_EQ(hops_after(100), nobody_calls);
}

}  // namespace
}  // namespace banyan
