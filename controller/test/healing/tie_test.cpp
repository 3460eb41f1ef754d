// SPDX-License-Identifier: MIT
// Which silent neighbours may depend on a robot.
#include "banyan/controller/healing/tie.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "bench.hpp"

namespace banyan {
namespace {

constexpr RobotId speaker = 7;
using Speech = std::function<void(TreeMessage&)>;

// Robot 1 has parent 2, or a hold, or nothing that ties it to others; neighbour 7 says what a test lets it say.
bool may_depend_on_me(bool tied, const Speech& speech, RobotId hold = nobody) {
  BenchOf<Convoy> bench;
  bench.state.role = Role::connector;
  bench.put(2, {0.5F, 0.0F});
  if (tied) bench.state.parent = 2;
  bench.state.hold = hold;
  TreeMessage& m = bench.put(speaker, {0.0F, 0.5F});
  m.role = Role::connector;
  m.parent = 3;
  speech(m);
  const auto robot = bench.tick();
  return may_depend(robot, robot.table().find(speaker));
}

TEST(Tie, AChildDependsOnItsParentUnlessItIsASpare) {
  EXPECT_TRUE(may_depend_on_me(true, [](TreeMessage& m) { m.parent = 1; }));
  EXPECT_TRUE(may_depend_on_me(true, [](TreeMessage& m) { m.old_parent = 1; }));
  EXPECT_FALSE(may_depend_on_me(true, [](TreeMessage& m) { m.parent = 1, m.role = Role::spare; }))
      << "another one will do";
  EXPECT_FALSE(may_depend_on_me(false, [](TreeMessage& m) { m.parent = 1, m.role = Role::spare; }));
}

TEST(Tie, ARobotWithoutParentDependsOnItsHoldOrOnAnybody) {
  const auto without_parent = [](RobotId hold) {
    return [hold](TreeMessage& m) { m.parent = nobody, m.grant = hold; };
  };
  EXPECT_TRUE(may_depend_on_me(true, without_parent(1)));
  EXPECT_TRUE(may_depend_on_me(true, without_parent(nobody))) << "it may have had nobody else";
  EXPECT_FALSE(may_depend_on_me(true, without_parent(3)));
}

TEST(Tie, WhoHasAnotherParentDependsOnMeOnlyIfIMayDependOnIt) {
  const Speech nothing = [](TreeMessage&) {};
  EXPECT_FALSE(may_depend_on_me(true, nothing));
  EXPECT_TRUE(may_depend_on_me(false, nothing));
  EXPECT_TRUE(may_depend_on_me(false, nothing, speaker)) << "it is my hold";
  EXPECT_FALSE(may_depend_on_me(false, nothing, 2));
}

// Robot 7, a child, has not been heard for two seconds, and robot 2 is near the line to it.
TEST(Tie, InAThinStartWithLineOfSightWhoIsSilentMayOnlyBeHidden) {
  const auto is_missed = [](int neighbors_at_start, bool line_of_sight, int ticks) {
    BenchOf<Convoy> bench;
    bench.state.turn = 200;
    bench.state.neighbors_at_start = static_cast<std::uint8_t>(neighbors_at_start);
    bench.params.line_of_sight = line_of_sight;
    bench.state.parent = 2;
    bench.put(2, {0.5F, 0.05F});
    bench.put_child(speaker, {0.95F, 0.0F}, Role::worker);
    bench.tick();
    bench.silence(speaker);
    for (int k = 1; k < ticks; ++k) bench.tick();
    const auto robot = bench.tick();
    const int k = robot.table().find(speaker);
    EXPECT_EQ(k >= 0 && is_tie(robot, k), missed_tie(robot) >= 0);
    return missed_tie(robot) == k && k >= 0;
  };
  EXPECT_TRUE(is_missed(2, true, 20));
  EXPECT_TRUE(is_missed(2, true, 100));
  EXPECT_FALSE(is_missed(2, true, 101)) << "it has gone";
  EXPECT_FALSE(is_missed(2, false, 20)) << "nothing hides it";
  EXPECT_FALSE(is_missed(0, true, 20)) << "in a crowd others hear it";
}

}  // namespace
}  // namespace banyan
