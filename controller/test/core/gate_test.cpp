// SPDX-License-Identifier: MIT
// The gate: what no working sensor says does not pass, and all else does, lengths in C and times in rounds.
#include "banyan/controller/core/gate.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "garbage.hpp"

namespace banyan {
namespace {

const Platform platform;  // C = 2 m, ticks of 0.1 s
constexpr std::array some_ranges_m{1.0F, 2.0F, 3.0F};

Platform with_range(float range_m) {
  Platform p;
  p.communication_range_m = range_m;
  return p;
}

std::vector<Vec2> obstacles_of(const Gate& gate) { return {gate.obstacles().begin(), gate.obstacles().end()}; }

void expect_near(Vec2 a, Vec2 b, const char* what) {
  EXPECT_FLOAT_EQ(a.x, b.x) << what;
  EXPECT_FLOAT_EQ(a.y, b.y) << what;
}

struct Measured {
  int name;
  Vec2 position;
  float age_s = 0.0F;
};

// All from the same numbers of metres.
TEST(Gate, MakesMetresMultiplesOfC) {
  for (const float c : some_ranges_m) {
    const std::array obstacles{Vec2{0.1F, 0.2F}, Vec2{-0.3F, 0.0F}};
    Gate gate({.odometry = {0.02F, -0.01F, 0.3F}, .orders = {true, Vec2{9.0F, -4.0F}, 7}, .obstacles = obstacles},
              with_range(c));
    std::array heard{Measured{5, {1.5F, -0.6F}}};
    const auto passed = gate.packets(std::span<Measured>(heard), with_range(c));
    EXPECT_EQ(gate.rejected(), 0U) << c;
    expect_near(gate.carry().shift, {0.02F / c, -0.01F / c}, "odometry");
    expect_near(gate.carry().rotation, {std::cos(0.3F), std::sin(0.3F)}, "a turn has no length");
    ASSERT_TRUE(gate.orders().target.has_value());
    expect_near(*gate.orders().target, {9.0F / c, -4.0F / c}, "target");
    EXPECT_TRUE(gate.orders().sent);
    EXPECT_EQ(gate.orders().given_up, 7);
    ASSERT_EQ(gate.obstacles().size(), 2U);
    expect_near(gate.obstacles()[0], {0.1F / c, 0.2F / c}, "obstacle");
    expect_near(gate.obstacles()[1], {-0.3F / c, 0.0F}, "obstacle");
    ASSERT_EQ(passed.size(), 1U);
    EXPECT_EQ(passed[0].name, 5);
    expect_near(passed[0].position, {1.5F / c, -0.6F / c}, "sender");
  }
}

// A robot that drives 1 m/s along x and turns 0.5 rad/s; the sender stands still.
TEST(Gate, CarriesAMeasurementOverTheSecondsSince) {
  constexpr float step_s = 0.4F, age_s = 0.3F;
  for (const float c : some_ranges_m)
    for (const float tick_s : {0.1F, 0.05F}) {
      Platform p = with_range(c);
      p.tick_s = tick_s;
      const auto seen = [](Vec2 place, float t) {
        return rotate_back({std::cos(0.5F * t), std::sin(0.5F * t)}, place - Vec2{t, 0.0F});
      };
      const Vec2 sender{1.2F, 0.9F};
      std::array heard{Measured{5, seen(sender, step_s - age_s), age_s}};
      Gate gate({.odometry = {step_s, 0.0F, 0.5F * step_s}, .elapsed_s = step_s}, p);
      const auto passed = gate.packets(std::span<Measured>(heard), p);
      EXPECT_LT(distance(passed[0].position, seen(sender, step_s) / c), 1e-6F) << c << ' ' << tick_s;
      EXPECT_EQ(passed[0].age_s, 0.0F) << "it is as of now";
    }
}

TEST(Gate, ImpossibleOdometryCountsAsNoMotion) {
  for (const Odometry& bad :
       {Odometry{nan_m, 0, 0}, Odometry{0, nan_m, 0}, Odometry{0, 0, nan_m}, Odometry{infinite_m, 0, 0},
        Odometry{0, -infinite_m, 0}, Odometry{0, 0, infinite_m}, Odometry{20.1F, 0, 0}, Odometry{0, -20.1F, 0},
        Odometry{15, 15, 0}, Odometry{0, 0, -1001}}) {
    const Gate gate({.odometry = bad}, platform);
    EXPECT_EQ(gate.rejected(), 1U);
    EXPECT_EQ(gate.carry().shift, Vec2{});
    EXPECT_EQ(gate.carry().rotation, (Vec2{1.0F, 0.0F}));
  }
  const Gate wide({.odometry = {19.9F, 0, -999}}, platform);
  EXPECT_EQ(wide.rejected(), 0U);
  EXPECT_FLOAT_EQ(wide.carry().shift.x, 9.95F);
}

TEST(Gate, AnImpossibleTargetCountsAsNotSensed) {
  for (const float c : some_ranges_m) {
    for (const Vec2 bad : {Vec2{nan_m, 0}, Vec2{0, nan_m}, Vec2{infinite_m, 0}, Vec2{0, -infinite_m},
                           Vec2{1001.0F * c, 0}, Vec2{3e38F, 3e38F}}) {
      const Gate gate({.orders = {true, bad}}, with_range(c));
      EXPECT_EQ(gate.rejected(), 1U);
      EXPECT_FALSE(gate.orders().target.has_value());
      EXPECT_TRUE(gate.orders().sent) << "it is still under way";
    }
    EXPECT_TRUE(Gate({.orders = {true, Vec2{999.0F * c, 0}}}, with_range(c)).orders().target.has_value());
  }
}

TEST(Gate, AnImpossibleChargeCountsAsNotMeasured) {
  for (const float bad : {nan_m, infinite_m, -0.01F, 1.01F}) {
    const Gate gate({.charge = Charge{bad, true}}, platform);
    EXPECT_EQ(gate.rejected(), 1U) << bad;
    EXPECT_FALSE(gate.charge().has_value()) << bad;
  }
  for (const float good : {0.0F, 0.5F, 1.0F})
    EXPECT_TRUE(Gate({.charge = Charge{good, true}}, platform).charge().has_value()) << good;
}

TEST(Gate, CountsWholeTicksAndAtLeastOne) {
  const auto ticks = [](float elapsed_s, const Platform& p = platform) {
    return Gate({.elapsed_s = elapsed_s}, p).elapsed_ticks();
  };
  EXPECT_EQ(ticks(0.0F), 1);
  EXPECT_EQ(ticks(0.01F), 1);
  EXPECT_EQ(ticks(0.1F), 1);
  EXPECT_EQ(ticks(0.22F), 2);
  EXPECT_EQ(ticks(0.5F), 5);
  EXPECT_EQ(ticks(3600.0F), 36000);
  for (const float bad : {nan_m, infinite_m, -0.1F, 3601.0F}) {
    EXPECT_EQ(ticks(bad), 1) << bad;
    EXPECT_EQ(Gate({.elapsed_s = bad}, platform).rejected(), 1U) << bad;
    EXPECT_EQ(Gate({.elapsed_s = bad}, platform).elapsed(), 1.0F) << bad;
  }
  Platform slow;
  slow.tick_s = 0.5F;
  EXPECT_EQ(ticks(0.5F, slow), 1);
  EXPECT_EQ(ticks(3.1F, slow), 6);
  EXPECT_EQ(ticks(18'000.0F, slow), 36'000);
  EXPECT_EQ(ticks(18'001.0F, slow), 1) << "nobody sleeps for so many rounds";
}

TEST(Gate, TellsHowManyRoundsHavePassed) {
  EXPECT_EQ(Gate({}, platform).elapsed(), 1.0F) << "an untimed step lasts one";
  EXPECT_FLOAT_EQ(Gate({.elapsed_s = 0.22F}, platform).elapsed(), 2.2F);
  EXPECT_FLOAT_EQ(Gate({.elapsed_s = 0.01F}, platform).elapsed(), 0.1F);
}

TEST(Gate, DropsImpossibleObstaclesAndKeepsTheOrderOfTheOthers) {
  const std::vector<Vec2> sensed{{1, 0}, {nan_m, 0}, {2, 0}, {0, infinite_m}, {20.1F, 0}, {3, 0}};
  const Gate gate({.obstacles = sensed}, platform);
  EXPECT_EQ(obstacles_of(gate), (std::vector<Vec2>{{0.5F, 0}, {1, 0}, {1.5F, 0}}));
  EXPECT_EQ(gate.rejected(), 3U);
}

TEST(Gate, KeepsAsManyObstaclesAsItHoldsAsTheyAre) {
  std::vector<Vec2> sensed, same;
  for (std::size_t k = 0; k < most_obstacles; ++k) {
    sensed.push_back({0.1F, 0.01F * static_cast<float>(k)});
    same.push_back(sensed.back() * 0.5F);
  }
  EXPECT_EQ(obstacles_of(Gate({.obstacles = sensed}, platform)), same);
}

// A lidar's turn in a room, from any direction on: whatever is left out has a point that is kept before it.
TEST(Gate, OfMoreObstaclesThanItHoldsTheNearestOnEachSideCount) {
  for (int first = 0; first < 720; first += 37) {
    std::vector<Vec2> sensed;
    for (int k = 0; k < 720; ++k) {
      const float angle = static_cast<float>(k + first) * 2.0F * pi<float> / 720.0F;
      sensed.push_back((1.0F + 0.5F * std::sin(5.0F * angle) + (k % 7 == 0 ? 0.3F : 0.0F)) * unit_vector(angle));
    }
    sensed[3] = sensed.back() = {nan_m, 0};
    const Gate gate({.obstacles = sensed}, platform);
    EXPECT_EQ(gate.rejected(), 2U) << "the others are possible";
    const std::vector<Vec2> kept = obstacles_of(gate);
    EXPECT_LE(kept.size(), most_obstacles);
    for (const Vec2 o : sensed) {
      if (std::isnan(o.x)) continue;
      const Vec2 point = o * 0.5F;
      EXPECT_TRUE(
          std::any_of(kept.begin(), kept.end(),
                      [&](Vec2 k) { return norm(k) <= norm(point) && dot(k, point) >= 0.98F * norm(k) * norm(point); }))
          << point.x << ' ' << point.y;
    }
  }
}

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
  const Platform p = with_range(*rc::gen::elementOf(some_ranges_m));
  const auto c = static_cast<double>(p.communication_range_m);
  std::vector<Vec2> obstacles(*rc::gen::inRange<std::size_t>(0, 100));
  for (Vec2& o : obstacles) o = {garbage(), garbage()};
  std::vector<Measured> heard(*rc::gen::inRange<std::size_t>(0, 20));
  for (Measured& m : heard) m = {0, {garbage(), garbage()}, garbage()};
  const Vec2 target{garbage(), garbage()};
  const Odometry odometry{garbage(), garbage(), garbage()};
  Gate gate({.odometry = odometry, .orders = {true, target}, .obstacles = obstacles, .elapsed_s = garbage()}, p);

  const auto within = [](Vec2 v, double limit) {
    return std::isfinite(v.x) && std::isfinite(v.y) &&
           std::hypot(static_cast<double>(v.x), static_cast<double>(v.y)) <= limit * 1.000001;
  };
  RC_ASSERT(within(gate.carry().shift, 10.0));
  RC_ASSERT(std::fabs(norm(gate.carry().rotation) - 1.0F) < 1e-5F);
  RC_ASSERT(gate.orders().target.has_value() == within(target, 1000.0 * c));
  RC_ASSERT(gate.elapsed_ticks() >= 1 && gate.elapsed_ticks() <= 36000);
  RC_ASSERT(gate.elapsed() > 0.0F && gate.elapsed() <= 36000.0F);
  for (const Vec2 o : gate.obstacles()) RC_ASSERT(within(o, 10.0));
  RC_ASSERT(gate.obstacles().size() <= most_obstacles);
  const auto good = std::count_if(heard.begin(), heard.end(), [&](const Measured& m) {
    return within(m.position, 10.0 * c) && m.age_s >= 0.0F && m.age_s <= 3600.0F;
  });
  RC_ASSERT(static_cast<long>(gate.packets(std::span<Measured>(heard), p).size()) == good);
}

}  // namespace
}  // namespace banyan
