// SPDX-License-Identifier: MIT
// Robots keep their parent in sight, or take another in time.
#include "convoy/shortcut.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace banyan {
namespace {

// Robot 5 is as fresh as I am and has the larger label: it is behind me, or may hang on me.
class EndangeredEdge : public ConvoyChain {
 protected:
  EndangeredEdge() {
    bench.put_connector(5, {-0.25F, 0.15F}, 400, 50);
    bench.say(2).child_count = 2;
    bench.put(6, {-0.35F, -0.045F}).role = Role::spare;
  }
};

TEST_F(ConvoyChain, AHiddenParentIsReplacedByWhoeverIsAheadAndInSight) {
  auto& spare = bench.put(5, {-0.25F, 0.25F});
  spare.role = Role::spare;
  spare.tree_hops = 1;
  spare.seqno = 52;
  spare.label = 150;
  bench.tick();
  bench.silence(2);
  EXPECT_EQ(parent_after_shortcuts(), 2);  // one lost packet is no reason
  EXPECT_EQ(parent_after_shortcuts(), 5);
}

TEST_F(ConvoyChain, AParentAboutToBeHiddenIsReplacedInTime) {
  bench.put_connector(5, {-0.25F, 0.15F}, 120, 52);
  bench.say(2).child_count = 2;  // or it would be released
  EXPECT_EQ(parent_after_shortcuts(), 2);
  auto& walker = bench.put(6, {-0.35F, -0.045F});
  walker.role = Role::spare;
  EXPECT_EQ(parent_after_shortcuts(), 5);
}

// With two paths companions stand beside edges. Without line of sight nothing there is a reason to change the tree, but
// a silent parent is.
TEST_F(ConvoyChain, WithCompanionsNobodyEndangersAnEdgeWhereRobotsHideNothing) {
  bench.params.link_redundancy = 2;
  bench.put_connector(5, {-0.25F, 0.15F}, 120, 52);
  bench.say(2).child_count = 2;  // or it would be released
  bench.put(6, {-0.35F, -0.045F}).role = Role::spare;
  bench.params.line_of_sight = false;
  EXPECT_EQ(parent_after_shortcuts(), 2);
  auto restore = bench.state;
  bench.params.line_of_sight = true;
  EXPECT_EQ(parent_after_shortcuts(), 5);
  bench.state = restore;
  bench.params.line_of_sight = false;
  bench.silence(2);
  EXPECT_EQ(parent_after_shortcuts(), 2);  // one lost packet is no reason
  EXPECT_EQ(parent_after_shortcuts(), 5);
}

TEST_F(EndangeredEdge, LetsItsSeqnoRestUntilAnotherParentIsAhead) {
  bench.step();
  EXPECT_EQ(bench.state.parent, 2);
  EXPECT_EQ(bench.state.pending_parent, 5);
  for (int t = 0; t < 3; ++t) {
    ++bench.say(2).seqno;
    ++bench.say(5).seqno;
    bench.step();
  }
  EXPECT_EQ(bench.state.parent, 5);
}

TEST_F(EndangeredEdge, NeverHangsOnItsOwnDescendant) {
  for (int t = 0; t < 100; ++t) {
    ++bench.say(2).seqno;
    bench.say(5).seqno = bench.step().message.seqno;
    ASSERT_EQ(bench.state.parent, 2) << t;
  }
  EXPECT_GT(bench.state.seqno, 100);  // and the seqno does not rest for ever
}

// What is about to cut the edge is hidden from me, but not from my parent.
TEST_F(EndangeredEdge, IsGivenUpWhenTheParentWarns) {
  bench.move(6, {0.0F, 0.75F});
  bench.say(5).seqno = 52;
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.say(2).warned = 1;
  EXPECT_EQ(parent_after_shortcuts(), 5);
}

TEST_F(ConvoyChain, WarnsAChildWhoseSightIsAboutToBeCut) {
  bench.put(6, {0.4F, 0.1F}).role = Role::spare;
  EXPECT_EQ(bench.step().message.warned, nobody);
  bench.move(6, {0.4F, 0.05F});
  EXPECT_EQ(bench.step().message.warned, 3);
}

TEST_F(ConvoyChain, StepsBeforeItsParentWhenItHidesItFromTheGrandparent) {
  bench.say(2).child_count = 2;  // or it would be released
  put_root({0.4F, 0.3F});
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.move(9, {0.4F, 0.025F});
  EXPECT_EQ(parent_after_shortcuts(), 9);
}

}  // namespace
}  // namespace banyan
