// SPDX-License-Identifier: MIT
// The end of a torn branch goes where the robot below it was.
#include "healing/healing.hpp"

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

}  // namespace
}  // namespace banyan
