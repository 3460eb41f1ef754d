// SPDX-License-Identifier: MIT
// Convoy's rules for fewer robots: who re-parents to whom once all workers below have arrived, and
// how a branch slides together (docs/convoy.md).
#include "convoy/shortcut.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <initializer_list>

#include "bench.hpp"
#include "convoy/towing.hpp"

namespace banyan {
namespace {

// A worker at its target; its parent 5, a connector 0.75 C away that serves only it, hangs on 6, which
// is out of the worker's reach.
class Arrived : public testing::Test {
 protected:
  void SetUp() override {
    bench.state.role = Role::worker;
    bench.state.label = 900;
    bench.state.seqno = 50;
    bench.state.parent = 5;
    bench.state.committed = true;
    bench.send({0.025F, 0});
    auto& parent = member(5, {0.75F, 0}, 700, 51);
    parent.parent = 6;
    parent.child_count = 1;
  }
  ConvoyMessage& member(RobotId id, Vec2 position, std::uint16_t label, std::uint16_t seqno) {
    auto& m = bench.put(id, position);
    m.role = Role::connector;
    m.committed = true;
    m.label = label;
    m.seqno = seqno;
    m.depth = 5;
    m.parent = 9;
    m.child_count = 2;
    return m;
  }
  // All in the tree get the root's next seqno.
  void count(std::initializer_list<RobotId> ids, int ticks) {
    for (int k = 0; k < ticks; ++k) {
      for (const RobotId id : ids) ++bench.say(id).seqno;
      bench.step();
    }
  }
  ConvoyBench bench = grown<Convoy>();
};

TEST_F(Arrived, MergesWithTheRobotNearestToTheRoot) {
  member(20, {0, 0.85F}, 600, 55);
  member(21, {0, -0.9F}, 300, 55);
  count({5, 20, 21}, 40);
  EXPECT_EQ(bench.state.parent, 21);
}

TEST_F(Arrived, StaysWhileItTravels) {
  bench.send({-1.5F, 0});
  member(21, {0, -0.9F}, 300, 55);
  count({5, 21}, 40);
  EXPECT_EQ(bench.state.parent, 5);
}

TEST_F(Arrived, StaysWhenTheRulesAreOff) {
  bench.params.merge_distance = 0.0F;
  member(21, {0, -0.7F}, 300, 55);
  count({5, 21}, 40);
  EXPECT_EQ(bench.state.parent, 5);
}

TEST_F(Arrived, DoesNotMergeWithABranchThatStillTravels) {
  member(21, {0, -0.9F}, 300, 55).want = 512;
  count({5, 21}, 40);
  EXPECT_EQ(bench.state.parent, 5);
}

TEST_F(Arrived, DoesNotMergeBeyondMergeDistance) {
  member(21, {0, -0.935F}, 300, 55);
  count({5, 21}, 40);
  EXPECT_EQ(bench.state.parent, 5);
}

TEST_F(Arrived, DoesNotMergePastARobotInTheWay) {
  member(21, {0, -0.9F}, 300, 55);
  bench.put(30, {0.025F, -0.45F}).role = Role::spare;
  count({5, 21}, 40);
  EXPECT_EQ(bench.state.parent, 5);
}

// Tree edges whose parent serves others too save nobody, unless they become shorter.
TEST_F(Arrived, LeavesABusyParentOnlyForANearerOne) {
  bench.say(5).child_count = 2;
  member(21, {0, -0.725F}, 300, 55);
  count({5, 21}, 40);
  EXPECT_EQ(bench.state.parent, 5);
  bench.move(21, {0, -0.6F});
  count({5, 21}, 80);
  EXPECT_EQ(bench.state.parent, 21);
}

TEST_F(Arrived, HangsOnAWorkerThatHasArrived) {
  auto& other = member(21, {0, -0.5F}, 300, 55);
  other.role = Role::worker;
  other.child_count = 0;
  other.want = 128;
  count({5, 21}, 40);
  EXPECT_EQ(bench.state.parent, 5);
  bench.say(21).want = 0;
  count({5, 21}, 40);
  EXPECT_EQ(bench.state.parent, 21);
}

// 21's label is larger and its seqno is as old as mine: it is behind me until my own seqno rests.
TEST_F(Arrived, WaitsForARobotOfAnotherBranchThatIsBehind) {
  member(21, {0, -0.5F}, 1500, 47);
  count({5, 21}, 40);
  EXPECT_EQ(bench.state.parent, 21);
}

// 21 hangs on me over 22: its seqno is mine of two ticks ago. It must never become my parent.
TEST_F(Arrived, NeverHangsOnItsOwnDescendant) {
  member(21, {0, -0.5F}, 1500, 40);
  member(22, {0, 0.25F}, 1400, 40).parent = 1;
  bench.say(21).parent = 22;
  std::deque<std::uint16_t> sent{40, 40};
  for (int k = 0; k < 200; ++k) {
    ++bench.say(5).seqno;
    bench.say(21).seqno = sent.front();
    sent.pop_front();
    sent.push_back(bench.step().message.seqno);
    ASSERT_NE(bench.state.parent, 21) << k;
  }
  EXPECT_GT(bench.state.seqno, 150);  // and the seqno goes on between two waits
}

TEST_F(Arrived, ReleasesItsParentForAGrandparentInReach) {
  member(6, {0.92F, 0.1F}, 500, 52).child_count = 2;
  bench.move(5, {0.5F, -0.2F});
  count({5, 6}, 3);
  EXPECT_EQ(bench.state.parent, 6);
}

// With a second path and line of sight a branch that has arrived folds: it neither merges nor releases robots that its
// short edges need.
TEST_F(Arrived, KeepsItsParentWhereItFolds) {
  bench.params.link_redundancy = 2;
  bench.params.line_of_sight = true;
  member(21, {0, -0.9F}, 300, 55);                    // would be taken to merge
  member(6, {0.92F, 0.1F}, 500, 52).child_count = 2;  // or this one, to release the parent
  bench.move(5, {0.5F, -0.2F});
  count({5, 6, 21}, 40);
  EXPECT_EQ(bench.state.parent, 5);
  const auto changes_parent = [&, before = bench.state, params = bench.params](auto make_otherwise) {
    bench.state = before;
    bench.params = params;
    make_otherwise();
    count({5, 6, 21}, 3);
    return bench.state.parent != 5;
  };
  EXPECT_FALSE(changes_parent([] {}));
  bench.state.pending_parent = 21;  // of when its edge was about to be hidden: its seqno does not rest any longer
  count({5, 6, 21}, 1);
  EXPECT_EQ(bench.state.pending_parent, nobody);
  EXPECT_TRUE(changes_parent([&] { bench.params.line_of_sight = false; }));
  EXPECT_TRUE(changes_parent([&] { bench.params.thrift = 1.0F; })) << "robots are to be saved";
  EXPECT_TRUE(changes_parent([&] { bench.state.forgets = true; })) << "there are many targets";
  EXPECT_TRUE(changes_parent([&] { member(21, {0, -0.9F}, 300, 55).call_hops = 5; })) << "an edge in need calls";
  bench.move(6, {0.425F, 0.1F});
  bench.move(5, {0.25F, -0.2F});
  EXPECT_TRUE(changes_parent([] {})) << "the edge is short without 5, too";
}

// A connector between parent 5 and worker 7.
TEST(Compaction, SlidesTowardsTheParentUntilTheOtherEdgeIsStretched) {
  ConvoyBench bench = grown<Convoy>();
  bench.state.label = 500;
  bench.state.parent = 5;
  bench.state.committed = true;
  bench.state.role = Role::connector;
  for (const RobotId id : {RobotId{5}, RobotId{7}}) {
    auto& m = bench.put(id, {id == 5 ? 0.6F : -0.6F, 0});
    m.role = id == 5 ? Role::connector : Role::worker;
    m.label = id == 5 ? 300 : 800;
    m.seqno = id == 5 ? 9 : 0;
    m.depth = id == 5 ? 4 : 6;
    m.parent = id == 5 ? RobotId{9} : RobotId{1};
    m.subtree_workers = 1;
    m.child_count = 2;
    m.committed = true;
  }
  bench.say(7).want = 0;
  bench.steps(2);
  auto robot = bench.tick();
  ASSERT_TRUE(has_arrived(robot));
  EXPECT_GT(towed_motion(robot).x, 0.5F);
  bench.params.link_redundancy = 2;
  bench.params.line_of_sight = true;
  EXPECT_LT(towed_motion(robot).x, -0.3F);  // it folds: far out robots are missed first
  bench.params.link_redundancy = 1;
  EXPECT_GT(towed_motion(robot).x, 0.5F);
  bench.state.forgets = true;  // there are more targets than a robot remembers
  EXPECT_NEAR(towed_motion(robot).x, 0.0F, 0.1F);
  bench.state.root_size = 451;  // but spares are far
  EXPECT_GT(towed_motion(robot).x, 0.5F);
  bench.state.root_size = 0;
  bench.state.forgets = false;
  bench.move(7, {-bench.params.compact_distance - 0.01F, 0});
  auto stretched = bench.tick();
  EXPECT_LT(towed_motion(stretched).x, 0.0F);
}

// A junction between parent 5, on the right, and two branches that have arrived, to workers 7 and 8.
TEST(Compaction, WithThriftAJunctionSlidesToEachNeighborInTurn) {
  ConvoyBench bench = grown<Convoy>();
  bench.params.thrift = 1.0F;
  bench.params.line_of_sight = true;
  bench.state.label = 500;
  bench.state.parent = 5;
  bench.state.committed = true;
  bench.state.role = Role::connector;
  bench.put_connector(5, {0.6F, 0}, 300, 9).child_count = 1;
  for (const RobotId id : {RobotId{7}, RobotId{8}}) {
    auto& m = bench.put_child(id, {-0.45F, id == 7 ? 0.45F : -0.45F}, Role::worker);
    m.label = 700;
    m.depth = 6;
    m.subtree_workers = 1;
    m.committed = true;
  }
  bench.steps(2);
  const auto way_after = [&](float drives) {
    bench.state.phase_ticks = static_cast<std::uint16_t>(bench.params.rounds(drives));
    auto robot = bench.tick();
    EXPECT_TRUE(has_arrived(robot));
    return towed_motion(robot);
  };
  EXPECT_GT(way_after(0.1F).x, 0.4F) << "to the parent";
  EXPECT_GT(way_after(1.3F).y, 0.4F);
  EXPECT_LT(way_after(2.5F).y, -0.4F);
  EXPECT_GT(way_after(3.7F).x, 0.4F) << "and again";
  bench.put(30, {-0.3F, -0.2F}).role = Role::spare;
  EXPECT_GT(way_after(1.3F).x, 0.2F) << "the edge to 8 would be drawn across a spare";
  bench.params.line_of_sight = false;
  EXPECT_GT(way_after(1.3F).y, 0.4F) << "where robots hide no edges it may";
  bench.silence(30);
  bench.params.thrift = 0.0F;
  EXPECT_GT(way_after(1.3F).x, 0.4F) << "without thrift";
}

}  // namespace
}  // namespace banyan
