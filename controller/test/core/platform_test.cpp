// SPDX-License-Identifier: MIT
// From a host's metres and seconds to a robot's units and back.
#include "banyan/controller/core/platform.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "banyan/controller/core/inputs.hpp"
#include "numbers.hpp"

namespace banyan {
namespace {

Platform arbitrary_platform() {
  return {.communication_range_m = number(0.05F, 100.0F),
          .tick_s = number(0.01F, 1.0F),
          .wheel_limit_m_s = number(0.001F, 10.0F),
          .wheel_distance_m = number(0.01F, 2.0F),
          .body_radius_m = number(0.01F, 2.0F),
          .line_of_sight = *rc::gen::arbitrary<bool>(),
          .drive = *rc::gen::element(Drive::differential, Drive::holonomic),
          .battery = *rc::gen::arbitrary<bool>()};
}

RC_GTEST_PROP(MachineOf, HasTheSameRobotInItsOwnUnits, ()) {
  const Platform p = arbitrary_platform();
  const Machine m = machine_of(p);
  const auto near = [](float a, float b) { return std::fabs(a - b) <= 1e-6F * std::fabs(b); };
  RC_ASSERT(near(m.body_radius * p.communication_range_m, p.body_radius_m));
  RC_ASSERT(near(m.wheel_distance * p.communication_range_m, p.wheel_distance_m));
  // In a drive it comes as far as C, in a round one of so many parts of that.
  const float drive_s = m.rounds_per_drive * p.tick_s;
  RC_ASSERT(near(drive_s * p.wheel_limit_m_s, p.communication_range_m));
  RC_ASSERT(near(m.way_in_a_round() * p.communication_range_m, p.wheel_limit_m_s * p.tick_s));
  RC_ASSERT(m.line_of_sight == p.line_of_sight && m.drive == p.drive && m.battery == p.battery);
}

TEST(MachineOf, DefaultsAreThoseOfTheDefaultPlatform) {
  const Machine m = machine_of(Platform{});
  EXPECT_FLOAT_EQ(m.rounds_per_drive, Machine{}.rounds_per_drive);
  EXPECT_EQ(m.body_radius, Machine{}.body_radius) << "to the bit, or the first body is already larger than the nominal";
  EXPECT_EQ(m.wheel_distance, Machine{}.wheel_distance);
}

// What the odometry of a host that does as it is told says in the next step is what the algorithm asked for.
RC_GTEST_PROP(VelocityOf, IsMeasuredAsTheMotionThatWasAskedFor, ()) {
  const Platform p = arbitrary_platform();
  const Machine m = machine_of(p);
  const Motion asked{number(-1, 1), number(-1, 1), number(-40, 40)};
  const Velocity v = velocity_of(asked, p);
  const Vec2 moved_m = Vec2{v.forward_m_s, v.sideways_m_s} * p.tick_s;
  const float turned_rad = v.turn_rad_s * p.tick_s;
  RC_ASSERT(distance(moved_m / p.communication_range_m, Vec2{asked.forward, asked.sideways} * m.way_in_a_round()) <
            1e-5F * m.way_in_a_round());
  RC_ASSERT(std::fabs(turned_rad * m.rounds_per_drive - asked.turn) < 1e-4F);
}

// The wheels turn at most as fast as the platform's do.
RC_GTEST_PROP(VelocityOf, KeepsWheelsWithinTheirLimit, ()) {
  const Platform p = arbitrary_platform();
  const Machine m = machine_of(p);
  const float forward = number(0, 1);
  const float turn = (1.0F - forward) * 2.0F / m.wheel_distance;  // the outer wheel at v_max
  const WheelSpeeds wheels = wheel_speeds(velocity_of({forward, 0.0F, turn}, p), p.wheel_distance_m);
  RC_ASSERT(std::fabs(wheels.right_m_s - p.wheel_limit_m_s) < 1e-4F * p.wheel_limit_m_s);
  RC_ASSERT(std::fabs(wheels.left_m_s) <= 1.0001F * p.wheel_limit_m_s);
}

TEST(Rounds, AreTheNearestWholeOnes) {
  Machine m;
  EXPECT_EQ(m.rounds(0.0F), 0);
  EXPECT_EQ(m.rounds(1.0F), 100);
  EXPECT_EQ(m.rounds(0.504F), 50);
  EXPECT_EQ(m.rounds(0.506F), 51);
  m.rounds_per_drive = 25.0F;
  EXPECT_EQ(m.rounds(0.1F), 3);
  EXPECT_EQ(whole(4.4F), 4);
  EXPECT_EQ(whole(4.6F), 5);
}

TEST(MachineFault, NamesWhatIsOutsideOfTheLimits) {
  const auto fault = [](float rounds, float radius) {
    Machine m;
    m.rounds_per_drive = rounds;
    m.body_radius = radius;
    return machine_fault(m);
  };
  for (const float rounds : {25.0F, 100.0F, 2000.0F})
    for (const float radius : {0.001F, 0.0352F, 0.17F}) EXPECT_EQ(fault(rounds, radius), "");
  for (const float rounds : {0.0F, 24.9F, 2001.0F, std::nanf("")})
    EXPECT_TRUE(fault(rounds, 0.0352F).starts_with("the radio range C divided by")) << rounds;
  for (const float radius : {0.0F, 0.0009F, 0.171F, std::nanf("")})
    EXPECT_TRUE(fault(100.0F, radius).starts_with("the body's radius")) << radius;
}

}  // namespace
}  // namespace banyan
