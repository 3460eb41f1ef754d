// SPDX-License-Identifier: MIT
// Whom a robot must not push: one that is pushed does not notice.
#include "healing/link_guard.hpp"

#include <gtest/gtest.h>

#include "bench.hpp"

namespace banyan {
namespace {

constexpr Vec2 at_full_speed{1.0F, 0.0F};

// Just ahead of me is robot 5.
struct Jam {
  ConvoyBench bench = grown<Convoy>();
  bool passes_targets_on = false;
  ConvoyMessage& ahead = bench.put(5, {0.075F, 0.0F});

  [[nodiscard]] Vec2 allowed(Vec2 wanted) {
    auto robot = bench.tick();
    robot.passes_targets_on = passes_targets_on;
    Guard guard;
    push_nobody(robot, guard);
    return guard.apply(wanted);
  }
  [[nodiscard]] bool may_push() { return allowed(at_full_speed) == at_full_speed; }
};

TEST(PushNobody, WhereTargetsChangeHandsNobodyPushesAndEverybodyMayGoAway) {
  Jam jam;
  jam.passes_targets_on = true;
  EXPECT_LT(jam.allowed(at_full_speed).x, 0.1F);
  EXPECT_EQ(jam.allowed(-at_full_speed), -at_full_speed);
  EXPECT_EQ(jam.allowed({0.0F, 1.0F}).y, 1.0F);
}

TEST(PushNobody, ElsewhereRobotsMay) {
  Jam jam;
  EXPECT_TRUE(jam.may_push());
}

TEST(PushNobody, AWorkerThatKnowsItsTargetFromOthersIsNotPushed) {
  struct Case {
    Role role;
    RobotId serves;
    bool may;
  };
  for (const Case c :
       {Case{Role::worker, 7, false}, Case{Role::worker, 5, true}, Case{Role::connector, nobody, true}}) {
    Jam jam;
    jam.ahead.role = c.role;
    jam.ahead.serves = c.serves;
    EXPECT_EQ(jam.may_push(), c.may) << static_cast<int>(c.role) << ' ' << c.serves;
  }
}

TEST(PushNobody, NorDoesSuchAWorkerPush) {
  for (const bool by_memory : {false, true}) {
    Jam jam;
    jam.bench.state.is_worker = true;
    jam.bench.state.serves = by_memory ? RobotId{7} : jam.bench.state.id;
    EXPECT_EQ(jam.may_push(), !by_memory);
  }
}

}  // namespace
}  // namespace banyan
