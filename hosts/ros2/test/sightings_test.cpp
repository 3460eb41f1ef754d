// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/sightings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace banyan::ros2 {
namespace {

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t now = 1'700'000'000 * second;
constexpr double pi = 3.14159265358979323846;

StampedPose sighting(double heading_rad = 0.0) {
  return {now, "map", 1.0, -2.0, {0.0, 0.0, std::sin(heading_rad / 2.0), std::cos(heading_rad / 2.0)}};
}

std::string verdict(Sightings& judge, const StampedPose& sighting, std::int64_t at = now) {
  Refusal why{};
  return judge.take(0, sighting, at, why) ? "taken" : name_of(why);
}
std::string verdict(const StampedPose& sighting) {
  Sightings judge(1, "map", 0.3);
  return verdict(judge, sighting);
}

TEST(Sightings, TheHeadingIsTheTurnAboutTheVertical) {
  for (const double heading : {0.0, 0.5, -0.5, pi / 2, 3.1, -3.1}) {
    Sightings judge(1, "map", 0.3);
    Refusal why{};
    const auto pose = judge.take(0, sighting(heading), now, why);
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->heading_rad, heading, 1e-12);
    EXPECT_EQ(pose->position.x, 1.0);
    EXPECT_EQ(pose->position.y, -2.0);
  }
  // Yaw 0.7, then pitch 0.2, then roll -0.1, multiplied out by hand: q = qz * qy * qx.
  const double cz = std::cos(0.35), sz = std::sin(0.35), cy = std::cos(0.1), sy = std::sin(0.1), cx = std::cos(-0.05),
               sx = std::sin(-0.05);
  const Quaternion leaning{sx * cy * cz - cx * sy * sz, cx * sy * cz + sx * cy * sz, cx * cy * sz - sx * sy * cz,
                           cx * cy * cz + sx * sy * sz};
  EXPECT_NEAR(heading_of(leaning), 0.7, 1e-12);
  EXPECT_NEAR(heading_of({0.0, 0.0, -std::sin(0.25), -std::cos(0.25)}), 0.5, 1e-12);  // the same rotation
}

TEST(Sightings, WhatCannotBeBelieved) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const auto changed = [](const auto& change) {
    StampedPose s = sighting();
    change(s);
    return verdict(s);
  };
  EXPECT_EQ(changed([](auto& /*s*/) {}), "taken");
  EXPECT_EQ(changed([](auto& s) { s.rotation.z = nan; }), "not finite");
  EXPECT_EQ(changed([](auto& s) { s.rotation.w = infinite; }), "not finite");
  EXPECT_EQ(changed([](auto& s) { s.x_m = nan; }), "not finite");
  EXPECT_EQ(changed([](auto& s) { s.y_m = -infinite; }), "not finite");
  EXPECT_EQ(changed([](auto& s) { s.rotation.w = 1e200; }), "not finite");  // its square is not
  EXPECT_EQ(changed([](auto& s) { s.rotation = {0, 0, 0, 0}; }), "of a quaternion that is no rotation");
  EXPECT_EQ(changed([](auto& s) { s.rotation = {0, 0, 0, 1.02}; }), "of a quaternion that is no rotation");
  EXPECT_EQ(changed([](auto& s) { s.rotation = {0, 0, 0, 1.005}; }), "taken");
  EXPECT_EQ(changed([](auto& s) {
              s.rotation = {0.7071, 0, 0, 0.7071};
            }),
            "tilted by more than 45 degrees");  // y is up
  EXPECT_EQ(changed([](auto& s) { s.rotation = {1, 0, 0, 0}; }), "tilted by more than 45 degrees");
  EXPECT_EQ(changed([](auto& s) { s.x_m = 1e6; }), "farther than 100 km from the origin");
  EXPECT_EQ(changed([](auto& s) { s.frame = "odom"; }), "of another frame");
  EXPECT_EQ(changed([](auto& s) { s.frame = ""; }), "of another frame");
  EXPECT_EQ(changed([](auto& s) { s.stamp_ns = 0; }), "too old");
  EXPECT_EQ(changed([](auto& s) { s.stamp_ns -= 310'000'000; }), "too old");
  EXPECT_EQ(changed([](auto& s) { s.stamp_ns -= 290'000'000; }), "taken");
  EXPECT_EQ(changed([](auto& s) { s.stamp_ns += 310'000'000; }), "from the future");
}

TEST(Sightings, AreCountedAndTheLastOneStays) {
  Sightings judge(2, "map", 0.3);
  StampedPose s = sighting();
  EXPECT_EQ(verdict(judge, s), "taken");
  EXPECT_EQ(verdict(judge, s), "not newer than the last");
  s.stamp_ns -= 1;
  EXPECT_EQ(verdict(judge, s), "not newer than the last");
  s.stamp_ns += 2;
  EXPECT_EQ(verdict(judge, s), "taken");
  Refusal why{};
  EXPECT_FALSE(judge.has_seen(1));
  EXPECT_TRUE(judge.take(1, sighting(), now, why));  // each robot has a last one of its own
  EXPECT_TRUE(judge.has_seen(1));
  EXPECT_EQ(judge.taken(), 3U);
  EXPECT_EQ(judge.refused().at(static_cast<std::size_t>(Refusal::overtaken)), 2U);
}

TEST(Sightings, WithoutTheClockASimulationMayBeginAnew) {
  Sightings judge(1, "map", 0.0);
  StampedPose s = sighting();
  s.stamp_ns = 100 * second;
  EXPECT_EQ(verdict(judge, s), "taken");
  s.stamp_ns = 100 * second - second / 2;
  EXPECT_EQ(verdict(judge, s), "not newer than the last");
  s.stamp_ns = second / 10;
  EXPECT_EQ(verdict(judge, s), "taken");
}

TEST(Sightings, OdometryKeepsTheFrameOfItsBeginning) {
  Sightings judge(1, "", 0.3);
  StampedPose s = sighting();
  s.frame = "robot_0/odom";
  EXPECT_EQ(verdict(judge, s), "taken");
  s.stamp_ns += 1;
  EXPECT_EQ(verdict(judge, s), "taken");
  s.stamp_ns += 1;
  s.frame = "map";
  EXPECT_EQ(verdict(judge, s), "of another frame");
  EXPECT_EQ(judge.frame(0), "robot_0/odom");
}

}  // namespace
}  // namespace banyan::ros2
