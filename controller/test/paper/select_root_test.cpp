// SPDX-License-Identifier: MIT
// SELECT ROOT: the token goes to whoever is closer to the centroid, and comes back if nobody takes it.
#include <gtest/gtest.h>

#include "bench.hpp"

namespace banyan::paper {
namespace {

TEST(PaperRoot, OffersTheTokenToTheNeighborClosestToTheCentroid) {
  auto bench = handing_over<Outwards>();
  bench.put(6, {0.9F, 0}).role = Role::connector;
  bench.put(7, {0.94F, 0}).role = Role::worker;
  bench.put(8, {0.98F, 0}).role = Role::connector;
  const auto m = bench.step().message;
  EXPECT_EQ(m.new_root, 6) << "7 is a worker, 8 about to leave";
  EXPECT_EQ(m.root.id, 1) << "until it is acknowledged";
  EXPECT_NEAR(m.centroid_x.value(), 0.1F, 5e-3F);
  EXPECT_EQ(handing_over<OutwardsLiteral>().step().message.new_root, 5);
}

TEST(PaperRoot, RemainsRootIfNobodyIsCloserAndOpensTheNextTree) {
  auto bench = handing_over<Inwards>();
  bench.state.centroid = {-0.5F, 0};
  EXPECT_EQ(bench.step().message.new_root, nobody);
  EXPECT_EQ(bench.state.epoch, 2);
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
}

TEST(PaperRoot, TakesTheTokenBackIfNobodyAcknowledges) {
  auto bench = handing_over<Outwards>();
  bench.steps(21);
  EXPECT_EQ(bench.state.epoch, 1);
  bench.step();
  EXPECT_EQ(bench.state.root.sequence, 3) << "beats an acceptance that was not heard";
  EXPECT_EQ(bench.state.root.id, 1);
  EXPECT_EQ(bench.state.epoch, 2);
}

TEST(PaperRoot, TheNewRootKeepsItsEdgeAndTheCentroid) {
  auto bench = grown<Outwards>();
  bench.state.phase = Phase::select_root;
  bench.state.parent = 5;
  bench.put(5, {0.5F, 0});
  auto& old = bench.put(9, {0.25F, 0});
  old.role = Role::root;
  old.phase = Phase::select_root;
  old.new_root = 1;
  old.centroid_x = Coordinate::of(0.5F);  // ahead, as the old root sees it, of where I am
  bench.step();
  EXPECT_EQ(bench.state.root.id, 1);
  EXPECT_EQ(bench.state.root.sequence, 2);
  EXPECT_EQ(bench.state.old_parent, 5);
  EXPECT_EQ(report(bench.state).tally.handovers, 1U);
  // 0.5 along the edge from 9 to me is 0.5 to the left: nobody is closer, so the next tree begins.
  EXPECT_EQ(bench.state.epoch, 2);
}

TEST(PaperRoot, AWorkerDoesNotTakeTheToken) {
  auto bench = grown<Outwards>();
  bench.send({2.0F, 0});
  auto& old = bench.put(9, {0.25F, 0});
  old.role = Role::root;
  old.new_root = 1;
  bench.step();
  EXPECT_EQ(bench.state.root.id, 9);
}

TEST(PaperRoot, TheOldRootStaysWithItsHeirAsCorrected) {
  const auto old_parent = [](auto bench) {
    bench.step();
    bench.say(5).root = {2, 5};
    bench.step();
    EXPECT_EQ(bench.state.root.id, 5);
    return bench.state.old_parent;
  };
  EXPECT_EQ(old_parent(handing_over<Outwards>()), 5);
  EXPECT_EQ(old_parent(handing_over<OutwardsLiteral>()), nobody);
}

TEST(PaperRoot, AnHeirOutOfReachIsNotToldWithoutTheCentroid) {
  auto bench = handing_over<Outwards>();
  bench.step();
  bench.silence(5);
  EXPECT_EQ(bench.steps(14).message.new_root, nobody);
  EXPECT_EQ(bench.state.new_root, 5) << "it may come back";
}

}  // namespace
}  // namespace banyan::paper
