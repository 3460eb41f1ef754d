// SPDX-License-Identifier: MIT
// The end of a torn branch goes where the robot below it was.
#include "banyan/controller/healing/healing.hpp"

#include <gtest/gtest.h>

#include "watch.hpp"

namespace banyan {
namespace {

// A connector between the root and the only robot that hangs on it.
struct Branch : Watch {
  Branch() : Watch({-0.75F, 0.0F}) {
    auto& state = bench.state;
    state.role = Role::connector;
    state.parent = root_id;
    state.label = 150;
    auto& below = bench.put(3, {0.8F, 0.0F});
    below.role = Role::connector;
    below.parent = state.id;
    below.label = 300;
    below.committed = true;
    hear_root(3);
  }
};

TEST(DanglingBranch, WhoLosesTheOnlyRobotBelowGoesWhereItWas) {
  Branch branch;
  ConvoyBench& bench = branch.bench;
  bench.state.turn = 200;  // no end of a thin start
  bench.silence(3);
  branch.hear_root(2 * whole(bench.params.liveness_rounds));
  EXPECT_EQ(bench.state.role, Role::connector);
  EXPECT_EQ(bench.state.parent, root_id);
  EXPECT_NEAR(bench.state.want, 0.8F, 0.025F) << "its chain comes along";
  EXPECT_GT(bench.step().motion.forward, 0.0F);
  branch.hear_root(bench.params.rounds(2.0F));
  EXPECT_EQ(bench.state.role, Role::spare) << "nobody came";
}

TEST(DanglingBranch, NotForOneThatLeftOrWhileAnotherHangsOnIt) {
  Branch left;
  left.bench.say(3).parent = root_id;
  left.hear_root(1);
  left.bench.silence(3);
  left.hear_root(30);
  EXPECT_EQ(left.bench.state.role, Role::spare);
  Branch other;
  auto& m = other.bench.put(4, {0.0F, 0.5F});
  m = other.bench.say(3);
  m.id = 4;
  other.hear_root(2);
  other.bench.silence(3);
  other.hear_root(30);
  EXPECT_EQ(other.bench.state.dangling_ticks, 0);
}

// Of more targets than a robot remembers, in a swarm that its root counts: large, but not so large that spares are
// minutes away.
void see_many_targets(ConvoyBench& bench) {
  bench.state.forgets = true;
  bench.state.root_size = bench.say(root_id).root_size = 300;
}

TEST(DanglingBranch, WithManyTargetsTheUpperEndWaitsWhereItsChildDied) {
  const auto ticks_as_connector = [](bool many) {
    Branch branch;
    ConvoyBench& bench = branch.bench;
    bench.state.turn = 200;
    bench.move(3, {0.1F, 0.0F});
    branch.hear_root(1);
    if (many) see_many_targets(bench);
    bench.silence(3);
    int ticks = 0;
    for (; ticks < 300 && bench.state.role == Role::connector; ++ticks) branch.hear_root(1);
    return ticks;
  };
  const ConvoyParams p = convoy_defaults();
  EXPECT_LT(ticks_as_connector(false), p.rounds(0.4F));
  EXPECT_GT(ticks_as_connector(true), p.rounds(p.pursue_for_drives));
}

// A junction goes there, too, if robots hang on the one that is lost.
TEST(DanglingBranch, WithManyTargetsAJunctionSeeksALostBranch) {
  const auto seeks = [](std::uint16_t root_size, std::uint16_t subtree) {
    Branch branch;
    ConvoyBench& bench = branch.bench;
    bench.state.turn = 200;
    auto& m = bench.put(4, {0.0F, 0.5F});
    m = bench.say(3);
    m.id = 4;
    bench.say(3).subtree = subtree;
    branch.hear_root(2);
    see_many_targets(bench);
    bench.state.root_size = bench.say(root_id).root_size = root_size;
    bench.silence(3);
    branch.hear_root(20);
    return bench.state.dangling_ticks > 0 && bench.step().motion.forward > 0.25F;
  };
  EXPECT_TRUE(seeks(300, 2));
  EXPECT_FALSE(seeks(300, 1));
  EXPECT_FALSE(seeks(451, 2)) << "the large swarms of docs/scale.md stay as they are";
  EXPECT_FALSE(seeks(0, 2)) << "nor before the root has counted";
}

}  // namespace
}  // namespace banyan
