// SPDX-License-Identifier: MIT
// Who may be a parent, whom each algorithm prefers, and what becomes of robots that lose theirs.
#include "tree/parent_selection.hpp"

#include <gtest/gtest.h>

#include "bench.hpp"

namespace banyan {
namespace {

template <class Kind = Convoy> BenchOf<Kind> selecting() {
  BenchOf<Kind> bench;
  bench.state.epoch = 1;
  bench.state.phase = Phase::select_parent;
  bench.state.root = {1, 9};
  bench.state.label = 200;
  return bench;
}

// A neighbour in the tree.
template <class Kind> auto& committed(BenchOf<Kind>& bench, RobotId id, Vec2 position, std::uint16_t label) {
  auto& m = bench.put(id, position);
  m.committed = true;
  m.role = Role::connector;
  m.label = label;
  m.depth = 3;
  m.tree_hops = 0;
  return m;
}

TEST(Candidate, IsAliveOfThisEpochNearEnoughAndAhead) {
  ConvoyBench bench = selecting();
  committed(bench, 5, {0.5F, 0}, 100);
  const auto is = [&] {
    const auto robot = bench.tick();
    return is_candidate(robot, robot.table().find(5));
  };
  EXPECT_TRUE(is());
  bench.say(5).role = Role::worker;
  EXPECT_TRUE(is());
  bench.say(5).role = Role::connector;
  bench.say(5).epoch = 2;
  EXPECT_FALSE(is());
  bench.say(5).epoch = 1;
  bench.say(5).label = 200;
  EXPECT_FALSE(is()) << "the order is strict";
  bench.say(5).label = 199;
  EXPECT_TRUE(is());
  bench.move(5, {bench.params.ideal_distance - 0.005F, 0});
  EXPECT_FALSE(is()) << "a hundredth of C must be left";
  bench.move(5, {bench.params.ideal_distance - 0.0105F, 0});
  EXPECT_TRUE(is());
  bench.state.seqno = 7;
  EXPECT_FALSE(is()) << "staler than what I have sent: it may hang on me";
}

TEST(Ahead, IsFresherOrAsFreshAndNearerToTheRoot) {
  ConvoyBench bench = selecting();
  bench.state.seqno = 10;
  auto& m = committed(bench, 5, {0.5F, 0}, 100);
  const auto ahead = [&](std::uint16_t seqno, std::uint16_t label) {
    m.seqno = seqno;
    m.label = label;
    const auto robot = bench.tick();
    return is_ahead(robot, 0);
  };
  EXPECT_TRUE(ahead(10, 199));
  EXPECT_FALSE(ahead(10, 200));
  EXPECT_FALSE(ahead(9, 0));
  EXPECT_TRUE(ahead(11, 5000));
  EXPECT_FALSE(ahead(11, unknown_label));
}

// The label of a robot after its parent has said one with that sequence number.
template <class Kind> std::uint16_t label_after(BenchOf<Kind> bench, Phase phase, std::uint16_t seqno) {
  bench.state.phase = phase;
  bench.state.is_worker = true;
  bench.state.parent = 5;
  bench.state.label = 5000;
  bench.state.seqno = 10;
  committed(bench, 5, {0.75F, 0}, 300).seqno = seqno;
  bench.step();
  return bench.state.label;
}

// Parents change all the time in a long epoch, and a robot behind the largest label there is could have none.
TEST(Label, ShrinksToTheWayAlongTheTreeWithANewerNumber) {
  EXPECT_EQ(label_after(selecting(), Phase::grow_tree, 11), 492);
  EXPECT_EQ(label_after(selecting(), Phase::grow_tree, 10), 5000) << "it would be ahead of where it was believed";
  EXPECT_EQ(label_after(selecting(), Phase::select_parent, 11), 5000)
      << "the labels of START TREE decide on the parents";
}

TEST(Join, TheFloodParentWillDoAfterFourTicks) {
  ConvoyBench bench = selecting();
  bench.state.is_worker = true;
  bench.state.flood_parent = 5;
  committed(bench, 5, {0.945F, 0}, 50).committed = false;
  bench.steps(4);
  EXPECT_EQ(bench.state.parent, nobody);
  bench.step();
  EXPECT_EQ(bench.state.parent, 5);
}

TEST(Join, AChildlessRobotMaySortItselfInBehindWhoeverIsFresher) {
  ConvoyBench bench = selecting();
  bench.state.is_worker = true;
  committed(bench, 5, {0.5F, 0}, 400).seqno = 3;
  bench.steps(7);
  EXPECT_EQ(bench.state.parent, nobody);
  bench.step();
  EXPECT_EQ(bench.state.parent, 5);
  EXPECT_EQ(bench.state.label, 528);
  EXPECT_EQ(bench.state.seqno, 3);
}

// A worker in GROW TREE that hangs on 5, and 6 beside it.
ConvoyBench working() {
  ConvoyBench bench = grown();
  bench.state.is_worker = true;
  bench.state.label = 200;
  bench.state.parent = 5;
  bench.state.committed = true;
  committed(bench, 5, {0.5F, 0}, 100);
  committed(bench, 6, {0.5F, 0.25F}, 120);
  return bench;
}

TEST(Repair, WithoutReplacementTheParentIsKept) {
  ConvoyBench bench = working();
  bench.step();
  bench.silence(5);
  bench.say(6).label = 250;  // behind me
  bench.steps(40);
  EXPECT_EQ(bench.state.parent, 5);
  EXPECT_EQ(bench.state.depth, invalid_depth);
}

TEST(Orphan, StandsStillAndThenAttachesToWhoeverIsFresherAndNearestToTheTree) {
  ConvoyBench bench = working();
  bench.state.seqno = 5;
  bench.say(5).depth = invalid_depth;  // the chain broke above
  bench.say(5).seqno = 5;
  bench.say(5).tree_hops = unreachable;
  bench.say(6).seqno = 4;  // stale: may be below me
  committed(bench, 7, {0.25F, 0.5F}, 700).seqno = 9;
  bench.steps(6);
  EXPECT_TRUE(is_orphan(bench.tick()));
  EXPECT_EQ(bench.state.parent, 5);
  bench.steps(20);
  EXPECT_EQ(bench.state.parent, 7);
  EXPECT_EQ(bench.state.label, 843);
  EXPECT_NE(bench.state.depth, invalid_depth);
}

TEST(Orphan, CanDraftAFreeSpareThatIsNearerToTheTree) {
  ConvoyBench bench = working();
  bench.say(5).depth = invalid_depth;
  bench.say(5).tree_hops = unreachable;
  bench.silence(6);
  auto& spare = bench.put(8, {0.0F, 0.5F});
  spare.label = 50;
  spare.seqno = 9;
  spare.tree_hops = 1;
  bench.steps(25);
  EXPECT_EQ(bench.state.parent, 8);
}

TEST(Seqno, FlowsFromTheParentAndTakesTheLabelAlongIfNeeded) {
  ConvoyBench bench = working();
  bench.say(5).seqno = 4;
  bench.step();
  EXPECT_EQ(bench.state.seqno, 4);
  EXPECT_EQ(bench.state.label, 200) << "still behind its parent's";
  bench.say(5).label = 260;  // the same seqno: nothing moves
  bench.step();
  EXPECT_EQ(bench.state.label, 200);
  bench.say(5).seqno = 5;
  bench.step();
  EXPECT_EQ(bench.state.label, 388);
}

TEST(Seqno, TheRootCounts) {
  ConvoyBench bench = grown();
  bench.state.root = {1, 1};
  bench.state.role = Role::root;
  bench.state.label = 0;
  EXPECT_EQ(bench.steps(10).message.seqno, 10);
  bench.state.seqno = UINT16_MAX;
  EXPECT_EQ(bench.step().message.seqno, 0) << "it wraps, and is compared as a serial number";
}

TEST(Seqno, WhoHasNotFollowedTheRootForHalfTheRangeHasNoPlaceInTheOrder) {
  ConvoyBench bench = grown();
  bench.state.label = 200;
  bench.state.seqno = 7;
  bench.state.seqno_ticks = serial_half_range - 2;
  bench.step();
  EXPECT_EQ(bench.state.label, 200);
  bench.step();
  EXPECT_EQ(bench.state.label, unknown_label);
  committed(bench, 5, {0.5F, 0}, 100).seqno = 7 + 40000;  // behind, by the numbers alone
  EXPECT_TRUE(is_ahead(bench.tick(), 0));
}

TEST(Prune, ASpareLeafLeavesItsBranchAndOneWithChildrenStays) {
  ConvoyBench bench = grown();
  bench.state.label = 200;
  bench.state.parent = 5;
  bench.state.committed = true;
  committed(bench, 5, {0.5F, 0}, 100);
  auto& child = bench.put(8, {-0.25F, 0});
  child.parent = 1;
  child.label = 300;
  bench.steps(3);
  EXPECT_EQ(bench.state.role, Role::spare) << "its child is a spare";
  EXPECT_EQ(bench.state.parent, 5);
  bench.silence(8);
  bench.steps(whole(bench.params.liveness_rounds) + 2);
  EXPECT_EQ(bench.state.parent, nobody);
  EXPECT_FALSE(bench.state.committed);
}

TEST(Root, HasNoParentAndDepthOne) {
  ConvoyBench bench = grown();
  bench.state.root = {1, 1};
  committed(bench, 5, {0.5F, 0}, 0).seqno = 100;
  bench.steps(30);
  EXPECT_EQ(bench.state.parent, nobody);
  EXPECT_EQ(bench.state.depth, 1);
}

}  // namespace
}  // namespace banyan
