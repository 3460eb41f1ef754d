// SPDX-License-Identifier: MIT
// The way back to where the others must be.
#include "banyan/controller/healing/healing.hpp"

#include <gtest/gtest.h>

#include "watch.hpp"

namespace banyan {
namespace {

TEST(Retreat, WhoHearsOfNoRootDrivesToWhereItWas) {
  Watch watch({1.9F, 0.0F});
  watch.hear_root(200);
  watch.bench.state.root_at = {6.0F, 0.0F};
  watch.bench.silence(root_id);
  const ConvoyParams& p = watch.bench.params;
  watch.bench.steps(p.ticks(p.retreat_after_s) + 2 * p.ticks(p.liveness_period_s) + 1);
  auto robot = watch.bench.tick();
  EXPECT_TRUE(is_retreating(robot, false));
  EXPECT_GT(retreat_motion(robot, false, true).x, 0.9F);
  EXPECT_GT(watch.bench.step().velocity.forward_m_s, 0.15F);
  watch.bench.put(root_id, {1.9F, 0.0F}).heartbeat = watch.count;
  watch.bench.step();
  auto back = watch.bench.tick();
  EXPECT_FALSE(is_retreating(back, false));
}

TEST(Retreat, TheSilentHoldNobodyBack) {
  Watch watch({-1.9F, 0.0F});
  watch.hear_root(3);
  auto& state = watch.bench.state;
  state.parent = root_id;
  state.committed = true;
  watch.hear_root(2);
  state.root_at = {6.0F, 0.0F};  // as if somebody had told
  state.parent = root_id;
  watch.bench.silence(root_id);
  state.silence_ticks = 100;
  watch.bench.steps(8);
  state.parent = root_id;
  EXPECT_GT(watch.bench.step().velocity.forward_m_s, 0.15F);
}

TEST(Regroup, AWorkerWhoseEdgeWaitsInVainDrivesHomeAndTakesAnInnerHold) {
  Watch watch({-1.5F, 0.0F});
  ConvoyBench& bench = watch.bench;
  bench.state.parent = 5;
  bench.state.label_cm = 400;
  bench.send({1.0F, 0.0F});
  auto& m = bench.put(5, {-1.85F, 0.0F});
  m.role = Role::connector;
  m.parent = root_id;
  m.depth = 2;
  m.tree_hops = 0;
  m.label_cm = 100;
  m.committed = true;
  m.child_count = 2;
  bench.move(root_id, {-1.89F, 0.6F});
  watch.hear_root(350);
  EXPECT_FALSE(is_left_waiting(bench.tick()));
  EXPECT_EQ(bench.state.parent, 5);
  watch.hear_root(150);
  EXPECT_TRUE(is_left_waiting(bench.tick()));
  bench.move(root_id, {-1.7F, 0.6F});
  watch.hear_root(2);
  EXPECT_EQ(bench.state.parent, root_id);
  EXPECT_FALSE(is_left_waiting(bench.tick())) << "it sets out anew";
}

}  // namespace
}  // namespace banyan
