// SPDX-License-Identifier: MIT
// START TREE: the distance to the root, and the echo that tells the root that all have one.
#include <gtest/gtest.h>

#include "bench.hpp"

namespace banyan::paper {
namespace {

BenchOf<Outwards> starting() {
  BenchOf<Outwards> bench = grown<Outwards>();
  bench.state.phase = Phase::start_tree;
  return bench;
}

TEST(PaperLabel, IsTheShortestWayOverANeighbor) {
  BenchOf<Outwards> bench = starting();
  bench.put(5, {0.25F, 0}).label = 256;
  bench.put(6, {0, 0.5F}).label = 128;
  bench.put(7, {0, -0.125F}).label = unknown_label;
  bench.steps(3);
  EXPECT_EQ(bench.state.label, 256);
  EXPECT_EQ(bench.state.flood_parent, 6);
  bench.say(5).label = 10;
  bench.steps(5);
  EXPECT_EQ(bench.state.label, 256) << "fixed once an epoch";
}

TEST(PaperLabel, WaitsForNearerOnesWhereTheFirstAreFar) {
  BenchOf<Outwards> bench = starting();
  bench.put(9, {0.95F, 0}).label = 0;
  bench.steps(6);
  EXPECT_EQ(bench.state.label, unknown_label);
  bench.step();
  EXPECT_EQ(bench.state.label, 243);
}

TEST(PaperLabel, GrowsAlongEveryEdgeAndEndsAtTheScalesEnd) {
  EXPECT_EQ(label_below(7, 0.0F), 8);
  EXPECT_EQ(label_below(7, 0.5F), 135);
  EXPECT_EQ(label_below(65'500, 1.0F), largest_label);
  EXPECT_EQ(label_below(largest_label, 1.0F), largest_label);
}

TEST(PaperLabel, ARobotAtTheEndOfTheScaleTakesNoChildAndSaysSo) {
  BenchOf<Outwards> bench = grown<Outwards>();
  bench.state.phase = Phase::select_parent;
  bench.state.label = largest_label;
  EXPECT_TRUE(report(bench.state).out_of_scale);
  bench.state.label = 300;
  EXPECT_FALSE(report(bench.state).out_of_scale);
  auto& m = bench.put(5, {0.5F, 0});
  m.committed = true;
  m.seqno = 3;  // ahead of me but for its label
  m.label = largest_label;
  bench.steps(12);
  EXPECT_EQ(bench.state.parent, nobody);
  m.label = 100;
  bench.step();
  EXPECT_EQ(bench.state.parent, 5);
}

TEST(PaperEcho, IsDoneWhenAllHaveALabelAndThoseBelowAreDone) {
  BenchOf<Outwards> bench = starting();
  bench.state.root = {1, 1};
  bench.state.role = Role::root;
  auto& below = bench.put(5, {0.5F, 0});
  auto& beside = bench.put(6, {0, 0.5F});
  below.label = 128;
  below.flood_parent = 1;
  below.flood_robots = 4;
  below.flood_workers = 2;
  EXPECT_FALSE(bench.step().message.flood_done) << "6 has no label";
  beside.label = 128;
  EXPECT_FALSE(bench.step().message.flood_done) << "5 is not done";
  below.flood_done = true;
  const auto m = bench.step().message;
  EXPECT_TRUE(m.flood_done);
  EXPECT_EQ(m.flood_robots, 5) << "6 has its label from somebody else";
  EXPECT_EQ(m.flood_workers, 2);
  bench.steps(2);
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
  bench.step();
  EXPECT_EQ(bench.state.phase, Phase::select_parent) << "once it has held for three rounds";
}

TEST(PaperEcho, WaitsNoLongerThanItsTime) {
  BenchOf<OutwardsLiteral> bench = grown<OutwardsLiteral>();
  bench.state.root = {1, 1};
  bench.state.role = Role::root;
  bench.state.phase = Phase::start_tree;
  bench.put(7, {0.25F, 0}).epoch = 0;  // who never follows
  bench.steps(99);
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
  bench.step();
  EXPECT_EQ(bench.state.phase, Phase::select_parent);
}

}  // namespace
}  // namespace banyan::paper
