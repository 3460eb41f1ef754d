// SPDX-License-Identifier: MIT
// Gossip of epoch, phase and root token; the root's barriers.
#include "tree/epoch.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "bench.hpp"

namespace banyan {
namespace {

RC_GTEST_PROP(Listen, TheLargestIsAdoptedAndNothingEverFallsBack, ()) {
  ConvoyBench bench;
  for (int t = 0; t < 30; ++t) {
    auto& m = bench.put(static_cast<RobotId>(*rc::gen::inRange(2, 8)), {0.5F, 0.25F});
    m.epoch = *rc::gen::inRange<std::uint16_t>(0, 5);
    m.phase = static_cast<Phase>(*rc::gen::inRange(0, 5));
    m.root = {*rc::gen::inRange<std::uint16_t>(0, 5), *rc::gen::inRange<std::uint16_t>(2, 9)};
    const auto before = bench.state;
    bench.step();
    const ConvoyState& now = bench.state;
    RC_ASSERT(now.epoch > before.epoch || (now.epoch == before.epoch && now.phase >= before.phase));
    RC_ASSERT(!newer(before.root, now.root));
    RC_ASSERT(now.epoch > m.epoch || (now.epoch == m.epoch && now.phase >= m.phase));
    RC_ASSERT(!newer(m.root, now.root));
  }
}

TEST(Epoch, ANewOneMakesTheParentTheOldParentAndForgets) {
  ConvoyBench bench = grown();
  bench.state.parent = 5;
  bench.state.label = 77;
  bench.state.seqno = 12;
  bench.state.need = Need::await;
  bench.state.grant = 30;
  auto robot = bench.tick();
  enter(robot, 2, Phase::start_tree);
  EXPECT_EQ(bench.state.old_parent, 5);
  EXPECT_EQ(bench.state.parent, nobody);
  EXPECT_EQ(bench.state.label, unknown_label);
  EXPECT_EQ(bench.state.seqno, 0);
  EXPECT_EQ(bench.state.grant, nobody);
  EXPECT_EQ(bench.state.need, Need::no_need);
  enter(robot, 3, Phase::start_tree);
  EXPECT_EQ(bench.state.old_parent, 5) << "an old parent is never replaced by none";
}

TEST(Epoch, GrowTreeDropsTheOldParentOfWhoHasANewOne) {
  ConvoyBench bench = grown();
  bench.state.phase = Phase::select_parent;
  bench.state.role = Role::connector;
  bench.state.old_parent = 5;
  bench.state.parent = 6;
  auto robot = bench.tick();
  enter(robot, 1, Phase::grow_tree);
  EXPECT_EQ(bench.state.old_parent, nobody);

  ConvoyBench lone = grown();
  lone.state.phase = Phase::select_parent;
  lone.state.role = Role::connector;
  lone.state.old_parent = 5;
  auto held = lone.tick();
  enter(held, 1, Phase::grow_tree);
  EXPECT_EQ(lone.state.old_parent, 5) << "who has found no new one stays tied to the old one";
}

TEST(Barriers, ALoneRootPassesThemAllAndComesBack) {
  ConvoyBench bench;
  bench.state.root = {1, 1};
  bench.state.role = Role::root;
  std::vector<Phase> seen;
  int grow_ticks = 0;
  while (bench.state.epoch < 2) {
    bench.step();
    if (seen.empty() || seen.back() != bench.state.phase) seen.push_back(bench.state.phase);
    grow_ticks += bench.state.epoch == 1 && bench.state.phase == Phase::grow_tree ? 1 : 0;
    ASSERT_LT(seen.size(), 8U);
  }
  EXPECT_EQ(grow_ticks, bench.params.rounds(bench.params.reconfiguration_drives));
  seen.resize(3);
  EXPECT_EQ(seen, (std::vector<Phase>{Phase::start_tree, Phase::select_parent, Phase::grow_tree}));
}

TEST(Barriers, WaitWhileTheFloodStillFindsRobotsAndAsLongForTheirParents) {
  ConvoyBench bench;
  bench.state.root = {1, 1};
  bench.step();
  bench.put(5, {0.5F, 0});  // never takes a label
  auto& m = bench.put(6, {0, 0.5F});
  m.label = 100;
  m.flood_parent = 1;
  const int timeout = whole(bench.params.barrier_rounds);
  for (int k = 0; k < 8; ++k) {
    ++bench.say(6).flood_robots;  // one of a long chain after the other, workers all
    ++bench.say(6).flood_workers;
    bench.steps(timeout / 2);
    EXPECT_EQ(bench.state.phase, Phase::start_tree);
  }
  bench.steps(timeout);
  EXPECT_EQ(bench.state.phase, Phase::select_parent);
  bench.state.flood_workers = 99;  // who never arrive
  bench.steps(3 * timeout);
  EXPECT_EQ(bench.state.phase, Phase::select_parent);
  bench.steps(timeout);
  EXPECT_EQ(bench.state.phase, Phase::grow_tree);
}

TEST(Barriers, NeverWaitLongerThanTheTimeout) {
  ConvoyBench bench;
  bench.state.root = {1, 1};
  bench.step();
  bench.put(5, {0.5F, 0});  // never takes a label
  const int timeout = whole(bench.params.barrier_rounds);
  bench.steps(timeout - 1);
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
  bench.steps(2);
  EXPECT_EQ(bench.state.phase, Phase::select_parent);
  bench.state.flood_workers = 99;  // who never arrive
  bench.steps(timeout - 1);
  EXPECT_EQ(bench.state.phase, Phase::select_parent);
  bench.steps(2);
  EXPECT_EQ(bench.state.phase, Phase::grow_tree);
}

}  // namespace
}  // namespace banyan
