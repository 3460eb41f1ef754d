// SPDX-License-Identifier: MIT
// Fig. 1: what the root waits for, and how "go" spreads.
#include <gtest/gtest.h>

#include "bench.hpp"

namespace banyan::paper {
namespace {

template <class Kind> BenchOf<Kind> root_in(Phase phase) {
  BenchOf<Kind> bench = grown<Kind>();
  bench.state.root = {1, 1};
  bench.state.role = Role::root;
  bench.state.phase = phase;
  return bench;
}

TEST(PaperEpoch, TheRootBeginsAndTheOthersWaitForIt) {
  BenchOf<Outwards> alone;
  EXPECT_EQ(alone.steps(20).message.phase, Phase::init);
  BenchOf<Outwards> root;
  root.state = Outwards::initial(1, false, true);
  EXPECT_EQ(root.step().message.phase, Phase::start_tree);
  alone.put(9, {0.5F, 0}).phase = Phase::start_tree;
  alone.say(9).epoch = 1;
  EXPECT_EQ(alone.step().message.phase, Phase::start_tree);
}

TEST(PaperEpoch, EverybodyFollowsTheLargestEpochAndPhaseAndNobodyGoesBack) {
  BenchOf<Inwards> bench = grown<Inwards>();
  auto& m = bench.put(5, {0.5F, 0});
  m.epoch = 2;
  m.phase = Phase::start_tree;
  bench.step();
  EXPECT_EQ(bench.state.epoch, 2);
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
  m.epoch = 1;
  m.phase = Phase::select_root;
  bench.step();
  EXPECT_EQ(bench.state.epoch, 2);
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
}

TEST(PaperEpoch, ANewTreeKeepsTheOldEdgeUntilItGrows) {
  BenchOf<Outwards> bench = grown<Outwards>();
  bench.state.parent = 5;
  bench.state.label = 100;
  bench.state.role = Role::connector;
  auto& m = bench.put(5, {0.5F, 0});
  m.label = 50;
  m.committed = true;
  m.epoch = 2;
  m.phase = Phase::start_tree;
  const auto in_both = bench.step().message;
  EXPECT_EQ(in_both.old_parent, 5);
  EXPECT_EQ(in_both.parent, nobody);
  EXPECT_FALSE(in_both.committed);
  m.phase = Phase::select_parent;
  bench.steps(4);
  EXPECT_EQ(bench.state.parent, 5) << "again";
  EXPECT_EQ(bench.state.old_parent, 5);
  m.phase = Phase::grow_tree;
  EXPECT_EQ(bench.step().message.old_parent, nobody);
}

TEST(PaperEpoch, ARobotWithoutANewParentKeepsTheOldOne) {
  BenchOf<Outwards> bench = grown<Outwards>();
  bench.state.phase = Phase::select_parent;
  bench.state.role = Role::connector;
  bench.state.old_parent = 5;
  bench.put(5, {0.5F, 0}).phase = Phase::grow_tree;
  EXPECT_EQ(bench.step().message.old_parent, 5);
  bench.state.role = Role::spare;
  bench.state.phase = Phase::select_parent;
  EXPECT_EQ(bench.step().message.old_parent, nobody);
}

TEST(PaperEpoch, SelectParentEndsWhenAllAreCountedOrAfterAHundredRounds) {
  for (const bool counted : {true, false}) {
    BenchOf<Outwards> bench = root_in<Outwards>(Phase::select_parent);
    bench.state.flood_robots = 3;
    auto& child = bench.put_child(5, {0.5F, 0}, Role::connector);
    child.phase = Phase::select_parent;
    child.subtree = counted ? 2 : 1;
    int ticks = 0;
    while (bench.state.phase == Phase::select_parent && ticks < 200) bench.step(), ++ticks;
    EXPECT_EQ(ticks, counted ? 3 : 100);
  }
}

TEST(PaperEpoch, InwardsCountsWorkersInstead) {
  BenchOf<Inwards> bench = root_in<Inwards>(Phase::select_parent);
  bench.state.flood_robots = 30;
  bench.state.flood_workers = 2;
  auto& child = bench.put_child(5, {0.5F, 0}, Role::connector);
  child.phase = Phase::select_parent;
  child.subtree_workers = 1;
  bench.steps(10);
  EXPECT_EQ(bench.state.phase, Phase::select_parent);
  child.subtree_workers = 2;
  bench.steps(2);
  EXPECT_EQ(bench.state.phase, Phase::grow_tree);
}

TEST(PaperEpoch, TheTreeIsBuiltAgainAfterR) {
  BenchOf<Outwards> bench = root_in<Outwards>(Phase::grow_tree);
  const int rounds = bench.params.rounds(bench.params.reconfiguration_drives);
  bench.steps(rounds - 1);
  EXPECT_EQ(bench.state.epoch, 1);
  bench.steps(2);
  EXPECT_EQ(bench.state.epoch, 2) << "nobody is nearer to the centroid";
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
}

// Steps that are longer count for more.
TEST(PaperEpoch, RIsATimeAndNoNumberOfSteps) {
  BenchOf<Inwards> bench = root_in<Inwards>(Phase::grow_tree);
  bench.elapsed_s = 4.0F * test_platform.tick_s;
  const int rounds = bench.params.rounds(bench.params.reconfiguration_drives);
  bench.steps(rounds / 4 - 1);
  EXPECT_EQ(bench.state.epoch, 1);
  bench.steps(3);
  EXPECT_EQ(bench.state.epoch, 2);
}

}  // namespace
}  // namespace banyan::paper
