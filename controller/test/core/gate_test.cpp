// SPDX-License-Identifier: MIT
// The gate: what no working sensor says does not pass, and all else does, as it is.
#include "banyan/controller/core/gate.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "garbage.hpp"

namespace banyan {
namespace {

const Platform platform;  // C = 2 m, ticks of 0.1 s
constexpr float limit_m = 20.0F;

std::vector<Vec2> obstacles_of(const Gate& gate) {
  return {gate.senses().obstacles.begin(), gate.senses().obstacles.end()};
}

TEST(Gate, LetsPassWhatAWorkingSensorSays) {
  const std::vector<Vec2> obstacles{{0.1F, 0.2F}, {-0.3F, 0.0F}};
  const Senses senses{.odometry = {0.02F, -0.01F, 0.3F},
                      .orders = {true, Vec2{9.0F, -4.0F}, 7},
                      .obstacles = obstacles,
                      .elapsed_s = 0.1F};
  const Gate gate(senses, platform);
  EXPECT_EQ(gate.rejected(), 0U);
  EXPECT_EQ(gate.senses().odometry.forward_m, 0.02F);
  EXPECT_EQ(gate.senses().odometry.sideways_m, -0.01F);
  EXPECT_EQ(gate.senses().odometry.turn_rad, 0.3F);
  EXPECT_EQ(gate.senses().orders.target, (Vec2{9.0F, -4.0F}));
  EXPECT_TRUE(gate.senses().orders.sent);
  EXPECT_EQ(gate.senses().orders.given_up, 7);
  EXPECT_EQ(gate.senses().obstacles.data(), obstacles.data()) << "nothing is copied without need";
  EXPECT_EQ(gate.senses().obstacles.size(), 2U);
}

TEST(Gate, ImpossibleOdometryCountsAsNoMotion) {
  for (const Odometry& bad :
       {Odometry{nan_m, 0, 0}, Odometry{0, nan_m, 0}, Odometry{0, 0, nan_m}, Odometry{infinite_m, 0, 0},
        Odometry{0, -infinite_m, 0}, Odometry{0, 0, infinite_m}, Odometry{20.1F, 0, 0}, Odometry{0, -20.1F, 0},
        Odometry{15, 15, 0}, Odometry{0, 0, -1001}}) {
    const Gate gate({.odometry = bad}, platform);
    EXPECT_EQ(gate.rejected(), 1U);
    EXPECT_EQ(gate.senses().odometry.forward_m, 0.0F);
    EXPECT_EQ(gate.senses().odometry.sideways_m, 0.0F);
    EXPECT_EQ(gate.senses().odometry.turn_rad, 0.0F);
  }
  const Gate wide({.odometry = {19.9F, 0, -999}}, platform);
  EXPECT_EQ(wide.rejected(), 0U);
  EXPECT_EQ(wide.senses().odometry.forward_m, 19.9F);
}

TEST(Gate, AnImpossibleTargetCountsAsNotSensed) {
  for (const Vec2 bad : {Vec2{nan_m, 0}, Vec2{0, nan_m}, Vec2{infinite_m, 0}, Vec2{0, -infinite_m}, Vec2{1.1e6F, 0},
                         Vec2{3e38F, 3e38F}}) {
    const Gate gate({.orders = {true, bad}}, platform);
    EXPECT_EQ(gate.rejected(), 1U);
    EXPECT_FALSE(gate.senses().orders.target.has_value());
    EXPECT_TRUE(gate.senses().orders.sent) << "it is still under way";
  }
  EXPECT_TRUE(Gate({.orders = {true, Vec2{0.9e6F, 0}}}, platform).senses().orders.target.has_value());
}

TEST(Gate, AnImpossibleChargeCountsAsNotMeasured) {
  for (const float bad : {nan_m, infinite_m, -0.01F, 1.01F}) {
    const Gate gate({.charge = Charge{bad, true}}, platform);
    EXPECT_EQ(gate.rejected(), 1U) << bad;
    EXPECT_FALSE(gate.senses().charge.has_value()) << bad;
  }
  for (const float good : {0.0F, 0.5F, 1.0F})
    EXPECT_TRUE(Gate({.charge = Charge{good, true}}, platform).senses().charge.has_value()) << good;
}

TEST(Gate, CountsWholeTicksAndAtLeastOne) {
  const auto ticks = [](float elapsed_s) { return Gate({.elapsed_s = elapsed_s}, platform).elapsed_ticks(); };
  EXPECT_EQ(ticks(0.0F), 1);
  EXPECT_EQ(ticks(0.01F), 1);
  EXPECT_EQ(ticks(0.1F), 1);
  EXPECT_EQ(ticks(0.22F), 2);
  EXPECT_EQ(ticks(0.5F), 5);
  EXPECT_EQ(ticks(3600.0F), 36000);
  for (const float bad : {nan_m, infinite_m, -0.1F, 3601.0F}) {
    EXPECT_EQ(ticks(bad), 1) << bad;
    EXPECT_EQ(Gate({.elapsed_s = bad}, platform).rejected(), 1U) << bad;
    EXPECT_EQ(Gate({.elapsed_s = bad}, platform).senses().elapsed_s, 0.0F) << bad;
  }
}

TEST(Gate, DropsImpossibleObstaclesAndKeepsTheOrderOfTheOthers) {
  const std::vector<Vec2> sensed{{1, 0}, {nan_m, 0}, {2, 0}, {0, infinite_m}, {20.1F, 0}, {3, 0}};
  const Gate gate({.obstacles = sensed}, platform);
  EXPECT_EQ(obstacles_of(gate), (std::vector<Vec2>{{1, 0}, {2, 0}, {3, 0}}));
  EXPECT_EQ(gate.rejected(), 3U);
}

TEST(Gate, OfMoreObstaclesThanItHoldsTheFirstCount) {
  std::vector<Vec2> sensed;
  for (std::size_t k = 0; k < most_obstacles; ++k) sensed.push_back({0.1F, 0.01F * static_cast<float>(k)});
  EXPECT_EQ(obstacles_of(Gate({.obstacles = sensed}, platform)), sensed) << "just as many";
  const std::vector<Vec2> first = sensed;
  for (int k = 0; k < 500; ++k) sensed.push_back({-0.2F, 0});
  const Gate gate({.obstacles = sensed}, platform);
  EXPECT_EQ(obstacles_of(gate), first);
  EXPECT_EQ(gate.rejected(), 0U) << "none of them is impossible";
  sensed[3] = sensed.back() = {nan_m, 0};
  const Gate other({.obstacles = sensed}, platform);
  EXPECT_EQ(obstacles_of(other).back(), (Vec2{-0.2F, 0})) << "the next moves up";
  EXPECT_EQ(other.rejected(), 2U) << "wherever they stand";
}

struct Measured {
  int name;
  Vec2 position;
  float age_s = 0.0F;
};

TEST(Gate, DropsPacketsWhoseSenderCannotBeThere) {
  std::vector<Measured> heard{{0, {1, 0}},          {1, {nan_m, 0}}, {2, {0, 19.9F}},
                              {3, {0, infinite_m}}, {4, {15, 15}},   {5, {-1, 0}}};
  Gate gate({}, platform);
  const std::span<Measured> passed = gate.packets(std::span<Measured>(heard), platform);
  std::vector<int> names;
  for (const Measured& m : passed) names.push_back(m.name);
  EXPECT_EQ(names, (std::vector<int>{0, 2, 5}));
  EXPECT_EQ(gate.rejected(), 3U);
}

TEST(Gate, DropsPacketsOfAnImpossibleAge) {
  std::vector<Measured> heard{
      {0, {1, 0}, 0.05F}, {1, {1, 0}, nan_m}, {2, {1, 0}, -0.01F}, {3, {1, 0}, infinite_m}, {4, {1, 0}, 3600.0F}};
  Gate gate({}, platform);
  const std::span<Measured> passed = gate.packets(std::span<Measured>(heard), platform);
  ASSERT_EQ(passed.size(), 2U);
  EXPECT_EQ(passed[0].name, 0);
  EXPECT_EQ(passed[1].name, 4);
  EXPECT_EQ(gate.rejected(), 3U);
}

RC_GTEST_PROP(Gate, NothingBeyondItsLimitsPassesWhateverTheSensorsSay, ()) {
  std::vector<Vec2> obstacles(*rc::gen::inRange<std::size_t>(0, 100));
  for (Vec2& o : obstacles) o = {garbage(), garbage()};
  std::vector<Measured> heard(*rc::gen::inRange<std::size_t>(0, 20));
  for (Measured& m : heard) m = {0, {garbage(), garbage()}, garbage()};
  const Vec2 target{garbage(), garbage()};
  const Odometry odometry{garbage(), garbage(), garbage()};
  Gate gate({.odometry = odometry, .orders = {true, target}, .obstacles = obstacles, .elapsed_s = garbage()}, platform);

  const auto within = [](Vec2 v, double limit) {
    return std::isfinite(v.x) && std::isfinite(v.y) &&
           std::hypot(static_cast<double>(v.x), static_cast<double>(v.y)) <= limit * 1.000001;
  };
  const Senses& passed = gate.senses();
  RC_ASSERT(within({passed.odometry.forward_m, passed.odometry.sideways_m}, limit_m));
  RC_ASSERT(std::fabs(passed.odometry.turn_rad) <= 1000.0F);
  RC_ASSERT(passed.orders.target.has_value() == within(target, 1e6));
  RC_ASSERT(gate.elapsed_ticks() >= 1 && gate.elapsed_ticks() <= 36000);
  for (const Vec2 o : passed.obstacles) RC_ASSERT(within(o, limit_m));
  RC_ASSERT(passed.obstacles.size() <= most_obstacles);
  const auto good = std::count_if(heard.begin(), heard.end(), [&](const Measured& m) {
    return within(m.position, limit_m) && m.age_s >= 0.0F && m.age_s <= 3600.0F;
  });
  RC_ASSERT(static_cast<long>(gate.packets(std::span<Measured>(heard), platform).size()) == good);
}

}  // namespace
}  // namespace banyan
