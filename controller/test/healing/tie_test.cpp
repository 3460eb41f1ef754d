// SPDX-License-Identifier: MIT
// Which silent neighbours may depend on a robot.
#include "healing/tie.hpp"

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

}  // namespace
}  // namespace banyan
