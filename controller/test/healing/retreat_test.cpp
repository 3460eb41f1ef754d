// SPDX-License-Identifier: MIT
// The way back to where the others must be.
#include "healing/healing.hpp"

#include <gtest/gtest.h>

#include "banyan/controller/core/trig.hpp"
#include "convoy/handing_on.hpp"
#include "watch.hpp"

namespace banyan {
namespace {

TEST(Retreat, WhoHearsOfNoRootDrivesToWhereItWas) {
  Watch watch({0.975F, 0.0F});
  watch.bench.state.turn = 200;  // no thin start
  watch.hear_root(200);
  watch.bench.state.root_at = {3.0F, 0.0F};
  watch.bench.silence(root_id);
  const ConvoyParams& p = watch.bench.params;
  watch.bench.steps(whole(p.retreat_after_rounds) + 2 * whole(p.liveness_rounds) + 1);
  auto robot = watch.bench.tick();
  EXPECT_TRUE(is_retreating(robot, false));
  EXPECT_GT(retreat_motion(robot, false).x, 0.9F);
  EXPECT_GT(watch.bench.step().motion.forward, 0.75F);
  watch.bench.put(root_id, {0.975F, 0.0F}).heartbeat = watch.count;
  watch.bench.step();
  auto back = watch.bench.tick();
  EXPECT_FALSE(is_retreating(back, false));
}

// Where packets get lost silence says less, and least before the first tree.
TEST(Retreat, ThePatienceFollowsTheSilencesThatAreUsual) {
  const auto ticks_until = [](std::uint8_t usual_silence, Phase phase, bool thin_start = false) {
    Watch watch({0.975F, 0.0F});
    watch.bench.state.turn = 200;  // so that it does not look now whether its start is thin
    watch.bench.state.neighbors_at_start = thin_start ? 2 : 0;
    watch.hear_root(50);
    auto& state = watch.bench.state;
    state.phase = watch.bench.say(root_id).phase = phase;
    state.root_at = {3.0F, 0.0F};
    watch.bench.silence(root_id);
    int ticks = 0;
    for (; ticks < 1000; ++ticks) {
      state.usual_silence = usual_silence;
      auto robot = watch.bench.tick();
      follow_heartbeat(robot);
      if (is_retreating(robot, false)) break;
    }
    return ticks;
  };
  const int ticks = ticks_until(0, Phase::grow_tree);
  EXPECT_EQ(ticks_until(30, Phase::grow_tree), ticks + 4 * 30 - 2 * whole(convoy_defaults().liveness_rounds));
  EXPECT_EQ(ticks_until(0, Phase::start_tree), ticks);
  EXPECT_EQ(ticks_until(30, Phase::start_tree), ticks + 2 * 100 - 2 * whole(convoy_defaults().liveness_rounds));
  EXPECT_EQ(ticks_until(0, Phase::grow_tree, true), ticks);
  EXPECT_EQ(ticks_until(30, Phase::grow_tree, true), ticks_until(30, Phase::start_tree));
}

TEST(Retreat, TheSilentHoldNobodyBack) {
  Watch watch({-0.975F, 0.0F});
  watch.bench.state.turn = 200;  // no thin start
  watch.hear_root(3);
  auto& state = watch.bench.state;
  state.parent = root_id;
  state.committed = true;
  watch.hear_root(2);
  state.root_at = {3.0F, 0.0F};  // as if somebody had told
  state.parent = root_id;
  watch.bench.silence(root_id);
  state.silence_ticks = 100;
  watch.bench.steps(8);
  state.parent = root_id;
  EXPECT_GT(watch.bench.step().motion.forward, 0.75F);
}

// Drives as it is told, and measures it.
struct Drive {
  ConvoyBench& bench;
  Vec2 place{};
  Vec2 heading{1.0F, 0.0F};
  Odometry moved{};
  void steps(int ticks) {
    for (int tick = 0; tick < ticks; ++tick) {
      const auto v = bench.step(moved).motion;
      const float drives = bench.params.way_in_a_round();  // C, or a drive in a round
      moved = {v.forward * drives, 0.0F, v.turn * drives};
      place += heading * moved.forward_m;
      const Vec2 turn = unit_vector(moved.turn_rad);
      heading = {heading.x * turn.x - heading.y * turn.y, heading.x * turn.y + heading.y * turn.x};
    }
  }
};

TEST(Search, ARootThatHearsNobodyLooksForTheOthers) {
  Watch watch({0.5F, 0.0F});
  watch.hear_root(10);
  ConvoyBench& bench = watch.bench;
  const ConvoyParams& p = bench.params;
  bench.silence(root_id);
  bench.state.root = {9, bench.state.id};
  Drive drive{bench};
  drive.steps(p.rounds(p.regroup_after_drives));
  EXPECT_LT(norm(drive.place), 0.005F) << "a radio may fall silent for a while";
  drive.steps(600);
  EXPECT_GT(norm(drive.place), 0.5F);
  // It comes by on all sides, farther out at every turn.
  bool sides[4] = {};
  const float before = norm(drive.place);
  for (int k = 0; k < 100; ++k) {
    drive.steps(10);
    sides[(drive.place.x > 0.0F ? 1 : 0) + (drive.place.y > 0.0F ? 2 : 0)] = true;
  }
  EXPECT_TRUE(sides[0] && sides[1] && sides[2] && sides[3]);
  EXPECT_GT(norm(drive.place), before + 0.05F);
  EXPECT_LT(norm(drive.place), before + 1.0F) << "nor past anybody";
  // It hears somebody: the search is over, and the next one begins from here.
  watch.bench.put(33, {0.75F, 0.0F});
  bench.step();
  EXPECT_EQ(bench.state.silence_ticks, 0);
  EXPECT_EQ(bench.state.root_at, Vec2{});
  EXPECT_FALSE(is_retreating(bench.tick(), false));
}

TEST(Search, WhoHasNeverHeardAnybodyWaits) {
  ConvoyBench bench = grown<Convoy>();
  bench.state.root = {1, bench.state.id};
  bench.state.role = Role::root;
  Drive drive{bench};
  drive.steps(1000);
  EXPECT_EQ(drive.place, Vec2{});
}

TEST(Regroup, AWorkerWhoseEdgeWaitsInVainDrivesHomeAndTakesAnInnerHold) {
  Watch watch({-0.75F, 0.0F});
  ConvoyBench& bench = watch.bench;
  bench.state.parent = 5;
  bench.state.label = 400;
  bench.send({0.5F, 0.0F});
  auto& m = bench.put(5, {-0.925F, 0.0F});
  m.role = Role::connector;
  m.parent = root_id;
  m.depth = 2;
  m.tree_hops = 0;
  m.label = 100;
  m.committed = true;
  m.child_count = 2;
  bench.move(root_id, {-0.945F, 0.3F});
  watch.hear_root(350);
  EXPECT_FALSE(is_left_waiting(bench.tick()));
  EXPECT_EQ(bench.state.parent, 5);
  watch.hear_root(150);
  EXPECT_TRUE(is_left_waiting(bench.tick()));
  bench.move(root_id, {-0.85F, 0.3F});
  watch.hear_root(2);
  EXPECT_EQ(bench.state.parent, root_id);
  EXPECT_FALSE(is_left_waiting(bench.tick())) << "it sets out anew";
}

}  // namespace
}  // namespace banyan
