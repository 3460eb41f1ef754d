// SPDX-License-Identifier: MIT
// The root token moves from neighbour to neighbour towards the centroid.
#include "tree/root_selection.hpp"

#include <gtest/gtest.h>

#include "bench.hpp"

namespace banyan {
namespace {

TEST(RootSelection, OffersTheTokenToTheNeighborNearestToTheCentroid) {
  ConvoyBench bench = handing_over();
  bench.put(6, {0.25F, 0}).role = Role::connector;
  bench.put(7, {0.95F, 0}).role = Role::worker;
  const auto m = bench.step().message;
  EXPECT_EQ(m.new_root, 5);
  EXPECT_EQ(m.centroid_x.value(), 0.5F) << "from the addressee, along the edge";
  EXPECT_EQ(m.centroid_y.value(), 0.0F);
  EXPECT_EQ(bench.steps(5).message.new_root, 5) << "until it is acknowledged";
}

// Heir and old root share an edge of the old tree: it would break in the next moment.
TEST(RootSelection, NobodyAboutToLeaveIsAnHeir) {
  for (const float away : {0.945F, 0.955F}) {
    ConvoyBench bench = handing_over();
    bench.put(6, {away, 0}).role = Role::connector;
    EXPECT_EQ(bench.step().message.new_root, away < 0.95F ? 6 : 5);
  }
}

TEST(RootSelection, WhoIsOfferedTheTokenTakesItOnce) {
  ConvoyBench bench = grown();
  bench.state.phase = Phase::select_root;
  bench.state.parent = 9;
  bench.state.role = Role::connector;
  auto& m = bench.put(9, {-0.5F, 0});
  m.root = {4, 9};
  m.new_root = 1;
  m.centroid_x = Coordinate::of(0.5F);
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{5, 1}));
  EXPECT_EQ(bench.state.role, Role::root);
  EXPECT_EQ(bench.state.parent, nobody);
  EXPECT_EQ(bench.state.old_parent, 9) << "the edge stays an edge of the tree";
  EXPECT_EQ(bench.state.tally.handovers, 1U);
  EXPECT_NEAR(bench.state.centroid.x, 0.5F, 1e-5F);
  bench.step();
  EXPECT_EQ(bench.state.tally.handovers, 1U) << "a repeated offer is no news";

  ConvoyBench worker = grown();
  worker.send({0.5F, 0});
  worker.put(9, {-0.5F, 0}) = m;
  worker.step();
  EXPECT_NE(worker.state.root.id, 1) << "a worker never takes it";
}

TEST(RootSelection, TheHeirsGossipEndsTheOldRoot) {
  ConvoyBench bench = handing_over();
  bench.step();
  bench.say(5).root = {2, 5};
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{2, 5}));
  EXPECT_NE(bench.state.role, Role::root);
  EXPECT_EQ(bench.state.new_root, nobody);
  EXPECT_EQ(bench.state.old_parent, 5) << "whoever hangs on me hangs on the heir through me";
}

// In the old tree's order the heir, and whoever was root before, may hang on whom it has ahead: those are no way
// to the root that is now.
TEST(RootSelection, TheOldRootTakesNoParentOfTheOldTree) {
  ConvoyBench bench = handing_over();
  bench.state.old_parent = 9;  // from which it had the token
  bench.step();
  bench.say(5).root = {2, 5};
  auto& before = bench.put(9, {-0.5F, 0});
  before.role = Role::connector;
  before.committed = true;
  before.label = 0;
  before.seqno = static_cast<Serial>(bench.state.seqno + 1);
  auto& child = bench.put(6, {0, 0.5F});
  child.role = Role::worker;
  child.parent = 1;
  bench.steps(10);
  EXPECT_EQ(bench.state.parent, nobody);
  EXPECT_EQ(bench.state.old_parent, 5);
}

// Where packets are lost, the heir has passed the token on before the old root hears of it.
TEST(RootSelection, TheOldRootIsTiedToAnHeirThatIsRootNoMore) {
  for (const Serial sequence : {Serial{2}, Serial{3}, Serial{7}}) {
    ConvoyBench bench = handing_over();
    bench.step();
    bench.say(5).root = {sequence, 8};
    bench.step();
    EXPECT_EQ(bench.state.old_parent, sequence == 2 ? nobody : 5) << "the offered token itself is a rival's";
  }
}

// An heir that knows nobody better opens an epoch in the tick in which it takes the token.
TEST(RootSelection, TheOldRootIsTiedToAnHeirThatHasOpenedAnEpoch) {
  ConvoyBench bench = handing_over();
  bench.step();
  const Serial epoch = bench.state.epoch;
  auto& m = bench.say(5);
  m.root = {2, 5};
  m.epoch = static_cast<Serial>(epoch + 1);
  m.phase = Phase::start_tree;
  bench.step();
  EXPECT_NE(bench.state.role, Role::root);
  EXPECT_EQ(bench.state.epoch, epoch + 1);
  EXPECT_EQ(bench.state.old_parent, 5);
}

TEST(RootSelection, AnUnansweredOfferIsTakenBackWithALargerToken) {
  ConvoyBench bench = handing_over();
  bench.steps(whole(bench.params.handover_rounds) + 1);
  EXPECT_EQ(bench.state.root, (RootToken{1, 1}));
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{3, 1}));
  EXPECT_EQ(bench.state.epoch, 2);
  EXPECT_TRUE(newer(bench.state.root, {2, 5})) << "beats an acceptance that was never heard";
}

TEST(RootSelection, WithoutABetterNeighborTheNextEpochOpens) {
  ConvoyBench bench = handing_over();
  bench.state.centroid = {0.26F, 0};  // the neighbour is nearer by less than the margin
  bench.step();
  EXPECT_EQ(bench.state.epoch, 2);
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
  EXPECT_EQ(bench.state.root, (RootToken{1, 1}));
}

}  // namespace
}  // namespace banyan
