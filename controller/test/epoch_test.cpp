// SPDX-License-Identifier: MIT
// Gossip of epoch, phase and root token; the root's barriers; handing the token on.
#include "banyan/controller/epoch.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "bench.hpp"

namespace banyan {
namespace {

RC_GTEST_PROP(Gossip, TheLargestIsAdoptedAndNothingEverFallsBack, ()) {
  Bench bench;
  for (int t = 0; t < 30; ++t) {
    Message& m = bench.put(static_cast<RobotId>(*rc::gen::inRange(2, 8)), {1.0F, 0.5F});
    m.epoch = *rc::gen::inRange<std::uint16_t>(0, 5);
    m.phase = static_cast<Phase>(*rc::gen::inRange(0, 5));
    m.root = {*rc::gen::inRange<std::uint16_t>(0, 5), *rc::gen::inRange<std::uint16_t>(2, 9)};
    const State before = bench.state;
    bench.step();
    const State& now = bench.state;
    RC_ASSERT(now.epoch > before.epoch || (now.epoch == before.epoch && now.phase >= before.phase));
    RC_ASSERT(!newer(before.root, now.root));
    RC_ASSERT(now.epoch > m.epoch || (now.epoch == m.epoch && now.phase >= m.phase));
    RC_ASSERT(!newer(m.root, now.root));
  }
}

TEST(Epoch, ANewOneMakesTheParentTheOldParentAndForgets) {
  Bench bench = grown();
  bench.state.parent = 5;
  bench.state.label_cm = 77;
  bench.state.pulse = 12;
  bench.state.need = Need::await;
  bench.state.grant = 30;
  Robot robot = bench.tick();
  enter(robot, 2, Phase::start_tree);
  EXPECT_EQ(bench.state.old_parent, 5);
  EXPECT_EQ(bench.state.parent, nobody);
  EXPECT_EQ(bench.state.label_cm, unknown_label);
  EXPECT_EQ(bench.state.pulse, 0);
  EXPECT_EQ(bench.state.grant, nobody);
  EXPECT_EQ(bench.state.need, Need::no_need);
  enter(robot, 3, Phase::start_tree);
  EXPECT_EQ(bench.state.old_parent, 5) << "an old parent is never replaced by none";
}

TEST(Epoch, GrowTreeDropsTheOldParentOfWhoHasANewOne) {
  Bench bench = grown();
  bench.state.phase = Phase::select_parent;
  bench.state.role = Role::connector;
  bench.state.old_parent = 5;
  bench.state.parent = 6;
  Robot robot = bench.tick();
  enter(robot, 1, Phase::grow_tree);
  EXPECT_EQ(bench.state.old_parent, nobody);

  Bench lone = grown();
  lone.state.phase = Phase::select_parent;
  lone.state.role = Role::connector;
  lone.state.old_parent = 5;
  Robot held = lone.tick();
  enter(held, 1, Phase::grow_tree);
  EXPECT_EQ(lone.state.old_parent, 5) << "who has found no new one stays tied to the old one";
}

TEST(Barriers, ALoneRootPassesThemAllAndComesBack) {
  Bench bench;
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
  EXPECT_EQ(grow_ticks, bench.params.ticks(bench.params.reconfiguration_period_s));
  seen.resize(3);
  EXPECT_EQ(seen, (std::vector<Phase>{Phase::start_tree, Phase::select_parent, Phase::grow_tree}));
}

TEST(Barriers, NeverWaitLongerThanTheTimeout) {
  Bench bench;
  bench.state.root = {1, 1};
  bench.step();
  bench.put(5, {1.0F, 0});  // never takes a label
  const int timeout = bench.params.ticks(bench.params.barrier_timeout_s);
  bench.steps(timeout - 1);
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
  bench.steps(2);
  EXPECT_EQ(bench.state.phase, Phase::select_parent);
  bench.state.flood_robots = 99;  // who never arrive
  bench.steps(timeout + 1);
  EXPECT_EQ(bench.state.phase, Phase::grow_tree);
}

// A root with its centroid at x = 2, and neighbour 5 on the way there.
Bench handing_over() {
  Bench bench = grown();
  bench.state.root = {1, 1};
  bench.state.role = Role::root;
  bench.state.phase = Phase::select_root;
  bench.state.centroid = {2, 0};
  bench.state.centroid_known = true;
  bench.put(5, {1.0F, 0});
  return bench;
}

TEST(RootSelection, OffersTheTokenToTheNeighborNearestToTheCentroid) {
  Bench bench = handing_over();
  bench.put(6, {0.5F, 0});
  bench.put(7, {1.9F, 0}).role = Role::worker;
  const Message m = bench.step().message;
  EXPECT_EQ(m.new_root, 5);
  EXPECT_EQ(m.centroid_x_cm, 100) << "from the addressee, along the edge";
  EXPECT_EQ(m.centroid_y_cm, 0);
  EXPECT_EQ(bench.steps(5).message.new_root, 5) << "until it is acknowledged";
}

TEST(RootSelection, WhoIsOfferedTheTokenTakesItOnce) {
  Bench bench = grown();
  bench.state.phase = Phase::select_root;
  bench.state.parent = 9;
  bench.state.role = Role::connector;
  Message& m = bench.put(9, {-1.0F, 0});
  m.root = {4, 9};
  m.new_root = 1;
  m.centroid_x_cm = 100;
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{5, 1}));
  EXPECT_EQ(bench.state.role, Role::root);
  EXPECT_EQ(bench.state.parent, nobody);
  EXPECT_EQ(bench.state.old_parent, 9) << "the edge stays an edge of the tree";
  EXPECT_EQ(bench.state.tally.handovers, 1U);
  EXPECT_NEAR(bench.state.centroid.x, 1.0F, 1e-5F);
  bench.step();
  EXPECT_EQ(bench.state.tally.handovers, 1U) << "a repeated offer is no news";

  Bench worker = grown();
  worker.state.is_worker = true;
  worker.put(9, {-1.0F, 0}) = m;
  worker.step();
  EXPECT_NE(worker.state.root.id, 1) << "a worker never takes it";
}

TEST(RootSelection, TheHeirsGossipEndsTheOldRoot) {
  Bench bench = handing_over();
  bench.step();
  bench.say(5).root = {2, 5};
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{2, 5}));
  EXPECT_NE(bench.state.role, Role::root);
  EXPECT_EQ(bench.state.new_root, nobody);
}

TEST(RootSelection, TheLargerFragmentKeepsItsRoot) {
  Bench bench = handing_over();
  bench.state.phase = Phase::grow_tree;
  bench.state.root_size = 20;
  bench.say(5).root = {7, 30};
  bench.say(5).root_size = 19;
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{8, 1}));
  EXPECT_EQ(bench.state.epoch, 2) << "all have to hear of it";
  bench.say(5).root = {9, 30};
  bench.say(5).root_size = 20;
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{9, 30})) << "not smaller";
}

TEST(RootSelection, NobodyContestsItsOwnHandOver) {
  Bench bench = handing_over();
  bench.state.root_size = 20;
  EXPECT_EQ(bench.step().message.root_size, 20);
  bench.say(5).root = {2, 5};
  bench.say(5).root_size = 3;
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{2, 5}));
  // The heir, whose acceptance was never heard, inherits the size and so yields to the old root.
  Bench heir = grown();
  heir.state.phase = Phase::select_root;
  Message& m = heir.put(9, {-1.0F, 0});
  m.root = {4, 9};
  m.root_size = 20;
  m.new_root = 1;
  heir.step();
  ASSERT_EQ(heir.state.root, (RootToken{5, 1}));
  EXPECT_EQ(heir.state.root_size, 20);
  m.root = {6, 9};
  m.new_root = nobody;
  heir.step();
  EXPECT_EQ(heir.state.root, (RootToken{6, 9}));
}

TEST(RootSelection, AnUnansweredOfferIsTakenBackWithALargerToken) {
  Bench bench = handing_over();
  bench.steps(bench.params.ticks(bench.params.handover_timeout_s) + 1);
  EXPECT_EQ(bench.state.root, (RootToken{1, 1}));
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{3, 1}));
  EXPECT_EQ(bench.state.epoch, 2);
  EXPECT_TRUE(newer(bench.state.root, {2, 5})) << "beats an acceptance that was never heard";
}

TEST(RootSelection, WithoutABetterNeighborTheNextEpochOpens) {
  Bench bench = handing_over();
  bench.state.centroid = {0.52F, 0};  // the neighbour is nearer by less than 5 cm
  bench.step();
  EXPECT_EQ(bench.state.epoch, 2);
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
  EXPECT_EQ(bench.state.root, (RootToken{1, 1}));
}

}  // namespace
}  // namespace banyan
