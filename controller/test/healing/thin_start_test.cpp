// SPDX-License-Identifier: MIT
// Where few neighbours were heard at the start, all of them far away, others may not have been heard yet.
#include <gtest/gtest.h>

#include "bench.hpp"
#include "healing/healing.hpp"
#include "healing/hold.hpp"
#include "healing/link_guard.hpp"
#include "healing/tie.hpp"

namespace banyan {
namespace {

// Robot 2 alone is heard.
struct AtEnd {
  ConvoyBench bench;
  explicit AtEnd(float range, Phase phase = Phase::grow_tree, int steps = 12) : bench(grown<Convoy>()) {
    bench.params.line_of_sight = false;
    bench.state.phase = phase;
    bench.state.turn = 0;
    bench.put(2, {range, 0.0F});
    bench.steps(steps);
  }
  bool awaits(Vec2& u) {
    auto robot = bench.tick();
    return awaits_others(robot, u);
  }
  bool awaits() {
    Vec2 u;
    return awaits(u);
  }
};

TEST(ThinStart, TheEndWaitsForWhoMayHearItAndGoesTowardsIt) {
  Vec2 u;
  AtEnd f(0.6F);
  f.bench.state.turn = 60;
  EXPECT_FALSE(f.awaits(u)) << "no packet has been lost";
  f.bench.state.usual_silence = 32;
  EXPECT_TRUE(f.awaits(u));
  EXPECT_LT(u.x, 0.0F) << "away from the only neighbour";
  u = {};
  f.bench.move(2, {0.75F, 0.0F});
  EXPECT_TRUE(f.awaits(u));
  EXPECT_EQ(u, Vec2{}) << "far enough";
  f.bench.state.turn = 160;
  EXPECT_FALSE(f.awaits(u)) << "only in the first seconds";
  f.bench.state.turn = UINT16_MAX;
  f.bench.steps(30);
  EXPECT_FALSE(f.awaits(u)) << "nor when its count of ticks wraps";
  AtEnd near(0.25F);
  near.bench.state.usual_silence = 32;
  EXPECT_FALSE(near.awaits(u)) << "a compact start";
}

TEST(ThinStart, ABurstIsASignOfLostPackets) {
  AtEnd f(0.6F);
  f.bench.state.turn = 60;
  EXPECT_FALSE(f.awaits());
  f.bench.state.burst_ticks = 20;
  EXPECT_TRUE(f.awaits());
}

TEST(ThinStart, NobodyMovesInTheFirstSecondsOrBeforeItHasHeardOfARoot) {
  for (const Phase phase : {Phase::init, Phase::start_tree, Phase::grow_tree}) {
    EXPECT_EQ(AtEnd(0.75F, phase).awaits(), phase == Phase::init) << "no link is near C";
    AtEnd f(0.85F, phase);
    Vec2 u;
    EXPECT_TRUE(f.awaits(u)) << "a burst may hide a neighbour";
    EXPECT_EQ(u, Vec2{});
    f.bench.state.turn = 60;
    EXPECT_EQ(f.awaits(), phase == Phase::init);
    EXPECT_FALSE(AtEnd(0.25F, phase).awaits()) << "a compact start";
  }
  EXPECT_TRUE(AtEnd(0.6F, Phase::init, 3).awaits()) << "before it is known whether the start is thin";
  AtEnd early(0.85F, Phase::start_tree, 3);
  EXPECT_TRUE(early.awaits());
  early.bench.state.missed_in_the_clear = 1;
  EXPECT_TRUE(early.awaits());
}

TEST(ThinStart, WhoHasHeardNobodyIsAtAnEnd) {
  for (const Phase phase : {Phase::init, Phase::grow_tree}) {
    ConvoyBench bench = grown<Convoy>();
    bench.state.phase = phase;
    bench.state.turn = 0;
    bench.steps(9);
    EXPECT_EQ(bench.state.neighbors_at_start, 0) << "too early to tell";
    bench.steps(3);
    EXPECT_EQ(bench.state.neighbors_at_start, 1);
  }
}

TEST(ThinStart, WhoIsHeardLateCountsUntilARootIsHeardOf) {
  for (const Phase phase : {Phase::init, Phase::grow_tree}) {
    AtEnd f(0.6F, phase);
    f.bench.put(3, {-0.75F, 0.0F});
    f.bench.steps(2);
    EXPECT_EQ(f.bench.state.neighbors_at_start, phase == Phase::init ? 2 : 1);
  }
}

TEST(ThinStart, TheFirstSilenceIsALossAndLaterAFirstOneMayBeADeath) {
  for (const int turn : {20, 60}) {
    AtEnd f(0.6F);
    f.bench.state.turn = static_cast<std::uint16_t>(turn);
    f.bench.silence(2);
    f.bench.step();
    EXPECT_EQ(f.bench.state.usual_silence > 0, turn == 20);
  }
}

// It may have been hidden by a burst, and the way to it may lead away from others that have not been heard yet.
TEST(ThinStart, NobodyDrivesToWhoDoesNotHearItWhereLinksAreNearC) {
  for (const float range : {0.75F, 0.85F}) {
    AtEnd f(range);
    auto robot = f.bench.tick();
    robot.gap = robot.table().find(2);
    Vec2 u{0.5F, 0.0F};
    EXPECT_TRUE(closes_gap(robot, u));
    EXPECT_EQ(u == Vec2{}, range > 0.8F);
    f.bench.state.turn = 60;
    EXPECT_TRUE(closes_gap(robot, u));
    EXPECT_GT(u.x, 0.9F) << "later it does";
  }
}

// Else a burst in the first second hides a neighbour of which nobody knows any more when the start is found to be thin.
TEST(ThinStart, WhoFallsSilentBeforeItIsFoundToBeThinIsKept) {
  for (const float range : {0.25F, 0.75F}) {
    AtEnd f(range, Phase::start_tree, 2);
    f.bench.put(3, {-range, 0.0F});
    f.bench.steps(2);
    f.bench.silence(3);
    f.bench.steps(20);
    EXPECT_EQ(f.bench.tick().table().find(3) >= 0, range > 0.5F) << "not in a crowd";
  }
}

// It is pulled to nobody: by those that it hears less well it is held as much.
TEST(ThinStart, BeforeARootIsHeardOfNobodyStrays) {
  for (const Phase phase : {Phase::init, Phase::start_tree}) {
    AtEnd f(0.9F, phase);
    f.bench.state.usual_silence = 32;
    f.bench.silence(2);
    f.bench.steps(20);
    auto robot = f.bench.tick();
    const int k = robot.table().find(2);
    ASSERT_GE(k, 0);
    EXPECT_EQ(strayed_way(robot, k) > 0.0F, phase != Phase::init);
  }
}

// In a grown tree; robot 5 has no parent and no hold.
TEST(ThinStart, WhoHasNotHeardOfARootWaitsForAHold) {
  for (const Phase phase : {Phase::init, Phase::grow_tree}) {
    ConvoyBench bench = grown<Convoy>();
    bench.put(2, {0.0F, -0.5F});
    ConvoyMessage& m = bench.put(5, {0.0F, 0.95F});
    m.role = Role::spare;
    m.phase = phase;
    m.epoch = static_cast<Serial>(bench.state.epoch - 1);
    m.parent = m.old_parent = m.grant = nobody;
    bench.steps(2);
    auto robot = bench.tick();
    robot.hold = robot.table().find(2);
    Guard guard;
    guard_links(robot, false, guard);
    EXPECT_EQ(guard.apply({0.0F, -1.0F}).y > -0.5F, phase == Phase::init) << "of another epoch: cut off";
  }
}

}  // namespace
}  // namespace banyan
