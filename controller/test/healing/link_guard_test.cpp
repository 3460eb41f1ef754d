// SPDX-License-Identifier: MIT
// Whom a robot must not push: one that is pushed does not notice.
#include "banyan/controller/healing/link_guard.hpp"

#include <gtest/gtest.h>

#include "bench.hpp"

namespace banyan {
namespace {

constexpr Vec2 at_full_speed{0.2F, 0.0F};

// Just ahead of me is robot 5.
struct Crowd {
  ConvoyBench bench = grown<Convoy>();
  bool passes_targets_on = false;
  ConvoyMessage& ahead = bench.put(5, {0.15F, 0.0F});

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
  Crowd crowd;
  crowd.passes_targets_on = true;
  EXPECT_LT(crowd.allowed(at_full_speed).x, 0.02F);
  EXPECT_EQ(crowd.allowed(-at_full_speed), -at_full_speed);
  EXPECT_EQ(crowd.allowed({0.0F, 0.2F}).y, 0.2F);
}

TEST(PushNobody, ElsewhereRobotsMay) {
  Crowd crowd;
  EXPECT_TRUE(crowd.may_push());
}

TEST(PushNobody, AWorkerThatKnowsItsTargetFromOthersIsNotPushed) {
  struct Case { Role role; RobotId serves; bool may; };
  for (const Case c : {Case{Role::worker, 7, false}, Case{Role::worker, 5, true}, Case{Role::connector, nobody, true}}) {
    Crowd crowd;
    crowd.ahead.role = c.role;
    crowd.ahead.serves = c.serves;
    EXPECT_EQ(crowd.may_push(), c.may) << static_cast<int>(c.role) << ' ' << c.serves;
  }
}

TEST(PushNobody, NorDoesSuchAWorkerPush) {
  for (const bool by_memory : {false, true}) {
    Crowd crowd;
    crowd.bench.state.is_worker = true;
    crowd.bench.state.serves = by_memory ? RobotId{7} : crowd.bench.state.id;
    EXPECT_EQ(crowd.may_push(), !by_memory);
  }
}

}  // namespace
}  // namespace banyan
