// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/readings.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace banyan::argos {
namespace {

constexpr double right_angle = pi<double> / 2.0;

TEST(Readings, PacketComesFromRangeAndBearing) {
  const Vec2 left = position_of(200.0, right_angle, 0.0);
  EXPECT_NEAR(left.x, 0.0, 1e-6);
  EXPECT_NEAR(left.y, 2.0, 1e-6);
  const Vec2 behind = position_of(50.0, -pi<double>, 0.0);
  EXPECT_NEAR(behind.x, -0.5, 1e-6);
  // A sender 0.3 m higher and 0.4 m ahead is 0.5 m away.
  const Vec2 ahead = position_of(50.0, 0.0, std::atan2(0.3, 0.4));
  EXPECT_NEAR(ahead.x, 0.4, 1e-6);
}

TEST(Readings, SilenceIsZeros) {
  std::array<std::uint8_t, 4> bytes{};
  EXPECT_TRUE(is_silence(bytes));
  bytes[3] = 1;
  EXPECT_FALSE(is_silence(bytes));
  EXPECT_TRUE(is_silence({}));
}

// Against the motion itself, integrated in small steps.
TEST(Readings, OdometryIsTheWayOfTheWheels) {
  for (const auto& [left, right] :
       std::array<std::pair<double, double>, 5>{{{20, 20}, {-20, 20}, {5, 20}, {20, -3}, {0, 0}}}) {
    double x = 0.0, y = 0.0, turn = 0.0;
    constexpr int steps = 20000;
    for (int k = 0; k < steps; ++k) {
      const double dt = 0.1 / steps, forward = 0.005 * (left + right);
      x += forward * std::cos(turn) * dt;
      y += forward * std::sin(turn) * dt;
      turn += 0.01 * (right - left) / 0.1054 * dt;
    }
    const Odometry odometry = odometry_of(left, right, 0.1054, 0.1);
    EXPECT_NEAR(odometry.forward_m, x, 1e-6) << left << " " << right;
    EXPECT_NEAR(odometry.sideways_m, y, 1e-6) << left << " " << right;
    EXPECT_NEAR(odometry.turn_rad, turn, 1e-6) << left << " " << right;
  }
}

TEST(Readings, WheelsTurnAsTheControllerWantsAndNoFaster) {
  Platform platform;
  platform.wheel_distance_m = 0.14F;
  const WheelCommand wheels = wheel_command({.forward_m_s = 0.1F, .sideways_m_s = 0.0F, .turn_rad_s = 0.5F}, platform);
  EXPECT_NEAR(0.5 * (wheels.left_cm_s + wheels.right_cm_s), 10.0, 1e-5);
  EXPECT_NEAR((wheels.right_cm_s - wheels.left_cm_s) / 14.0, 0.5, 1e-5);
  const WheelCommand fast = wheel_command({.forward_m_s = 0.2F, .sideways_m_s = 0.0F, .turn_rad_s = -2.0F}, platform);
  EXPECT_NEAR(fast.left_cm_s, 20.0, 1e-5);
  EXPECT_NEAR(fast.right_cm_s, 6.0, 1e-4);
}

TEST(Readings, TargetIsSeenFromTheBody) {
  const Vec2 seen = in_body_frame({3.0, 4.0}, {3.0, 1.0}, right_angle);
  EXPECT_NEAR(seen.x, 3.0, 1e-6);
  EXPECT_NEAR(seen.y, 0.0, 1e-6);
}

// Against ARGoS' characteristics, written out as its manual has them.
TEST(Readings, ProximityIsTheInverseOfTheSensor) {
  for (double d = 0.041; d < 0.11; d += 0.003) {
    const auto khepera = obstacle_at(kheperaiv_proximity, 4.14 * std::exp(-33.0 * d) - 0.085, 0.0);
    ASSERT_TRUE(khepera) << d;
    EXPECT_NEAR(khepera->x, 0.0704 + d, 1e-5);
  }
  for (double d = 0.011; d < 0.1; d += 0.005) {
    const auto footbot = obstacle_at(footbot_proximity, 0.0100527 / (d + 0.000163144), right_angle);
    ASSERT_TRUE(footbot) << d;
    EXPECT_NEAR(footbot->y, 0.085036758 + d, 1e-5);
    EXPECT_NEAR(footbot->x, 0.0, 1e-6);
  }
  EXPECT_NEAR(obstacle_at(kheperaiv_proximity, 1.0, 0.0)->x, 0.0704 + 0.04, 1e-6);
  for (const ProximityModel* model : {&kheperaiv_proximity, &footbot_proximity}) {
    EXPECT_FALSE(obstacle_at(*model, 0.0, 0.0));
    EXPECT_FALSE(obstacle_at(*model, std::nan(""), 0.0));
    EXPECT_FALSE(obstacle_at(*model, -0.1, 0.0));
  }
}

// Against the ring as the foot-bot's is simulated.
TEST(Readings, LightIsWhereTheRingIsBrightest) {
  constexpr double intensity_m = 2.0;
  for (double bearing = -3.0; bearing < 3.1; bearing += 0.37) {
    for (const double distance_m : {0.1, 0.5, 2.0, 4.5}) {
      std::vector<LightReading> ring;
      for (int k = 0; k < 24; ++k) {
        const double angle = (k + 0.5) * pi<double> / 12.0 - pi<double>;
        const double off = std::abs(std::remainder(bearing - angle, 2.0 * pi<double>));
        ring.push_back(
            {std::exp(-2.0 * distance_m / intensity_m) * std::max(0.0, 1.0 - 2.0 * off / pi<double>), angle});
      }
      const auto seen = light_at(ring, intensity_m);
      ASSERT_TRUE(seen);
      EXPECT_NEAR(norm(*seen), distance_m, 0.02) << bearing;
      EXPECT_NEAR(std::remainder(std::atan2(seen->y, seen->x) - bearing, 2.0 * pi<double>), 0.0, 0.02) << distance_m;
    }
  }
  EXPECT_FALSE(light_at(std::vector<LightReading>(24), intensity_m));
  EXPECT_FALSE(light_at({}, intensity_m));
}

TEST(Readings, IdsEndNames) {
  EXPECT_EQ(id_of("kh12"), RobotId{12});
  EXPECT_EQ(id_of("robot0"), RobotId{0});
  EXPECT_EQ(id_of("7"), RobotId{7});
  EXPECT_EQ(id_of("a1b20"), RobotId{20});
  EXPECT_FALSE(id_of("robot"));
  EXPECT_FALSE(id_of(""));
  EXPECT_FALSE(id_of("kh65535"));  // nobody
  EXPECT_FALSE(id_of("kh700000"));
}

}  // namespace
}  // namespace banyan::argos
