// SPDX-License-Identifier: MIT
// Lines of sight past known robots, against sampled points of the segment.
#include "obstacles/sight.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench.hpp"

namespace banyan {
namespace {

Vec2 arbitrary_point() {
  const auto length = [] { return static_cast<float>(*rc::gen::inRange(-950, 951)) * 0.001F; };
  const float x = length();
  return {x, length()};
}

// The distance of p to the segment a-b, by sampling it.
float sampled_distance(Vec2 p, Vec2 a, Vec2 b) {
  float least = 1e9F;
  for (int k = 0; k <= 2000; ++k) least = std::min(least, distance(p, a + (b - a) * (static_cast<float>(k) / 2000.0F)));
  return least;
}

RC_GTEST_PROP(Sight, NearestPointOfASegmentIsNearest, ()) {
  const Vec2 a = arbitrary_point();
  const Vec2 b = arbitrary_point();
  RC_ASSERT(std::fabs(norm(nearest_on_segment(a, b)) - sampled_distance({}, a, b)) < 0.0015F);
}

RC_GTEST_PROP(Sight, ASegmentIsClearWhenNobodyIsBesideItsInside, ()) {
  constexpr float clearance = 0.08F;
  ConvoyBench bench = grown<Convoy>();
  const int count = *rc::gen::inRange(2, 9);
  std::vector<Vec2> at;
  for (int k = 0; k < count; ++k) {
    at.push_back(arbitrary_point());
    bench.put(static_cast<RobotId>(10 + k), at.back());
  }
  const auto robot = bench.tick();
  const Vec2 a = at[0];
  const Vec2 b = at[1];
  float nearest = 1e9F;
  // Whoever is beside an end, not beside the inside, hides nothing.
  const auto look = [&](Vec2 p) {
    const float along = dot(p - a, b - a);
    if (along > 0.0F && along < squared_norm(b - a)) nearest = std::min(nearest, sampled_distance(p, a, b));
  };
  for (std::size_t k = 2; k < at.size(); ++k) look(at[k]);
  look({});
  RC_PRE(std::fabs(nearest - clearance) > 0.0025F);
  const int i = robot.table().find(10);
  const int j = robot.table().find(11);
  RC_ASSERT(is_clear(robot, bench.state.corners, a, b, i, j, clearance) == (nearest > clearance));
}

TEST(Sight, ARobotBetweenHidesAndOneBehindDoesNot) {
  ConvoyBench bench = grown<Convoy>();
  bench.put(2, {0.75F, 0.0F});
  bench.put(3, {0.4F, 0.025F});
  bench.put(4, {0.9F, 0.0F});
  bench.put(5, {-0.5F, 0.0F});
  const auto robot = bench.tick();
  EXPECT_FALSE(sees_clearly(robot, robot.table().find(2), 0.05F));
  EXPECT_TRUE(sees_clearly(robot, robot.table().find(2), 0.02F));
  EXPECT_TRUE(sees_clearly(robot, robot.table().find(3), 0.05F));
  EXPECT_TRUE(sees_clearly(robot, robot.table().find(5), 0.05F));
}

}  // namespace
}  // namespace banyan
