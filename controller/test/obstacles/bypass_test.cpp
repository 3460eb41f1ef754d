// SPDX-License-Identifier: MIT
// The way round obstacles in a plane world of points.
#include "obstacles/bypass.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "banyan/controller/core/trig.hpp"
#include "bench.hpp"
#include "numbers.hpp"
#include "tree/motion.hpp"

namespace banyan {
namespace {

constexpr float body = 0.0352F;

struct Segment {
  Vec2 a, b;
  [[nodiscard]] Vec2 nearest(Vec2 p) const {
    const Vec2 d = b - a;
    return a + d * std::clamp(dot(p - a, d) / squared_norm(d), 0.0F, 1.0F);
  }
};

// A robot that can move in any direction, in a world of walls; its frame is the world's.
struct Walker {
  std::vector<Segment> walls;
  Vec2 position;
  std::vector<Vec2> bodies{};
  ConvoyBench bench = grown<Convoy>();
  float nearest = 1e9F;
  float path = 0.0F;

  // Whether it comes within 0.025 C of the goal before it has gone so far.
  bool reaches(Vec2 goal, float limit) {
    constexpr float step = 0.01F;
    Vec2 moved;
    while (distance(position, goal) > 0.025F) {
      bench.obstacles.clear();
      for (const Segment& wall : walls) {
        const Vec2 o = wall.nearest(position) - position;
        nearest = std::min(nearest, norm(o));
        if (norm(o) <= 0.15F) bench.obstacles.push_back(o);
      }
      for (const Vec2 other : bodies) {
        const Vec2 o = (other - position) * (1.0F - body / distance(other, position));
        nearest = std::min(nearest, norm(o));
        if (norm(o) <= 0.15F) bench.obstacles.push_back(o);
      }
      carry_detour(bench.state.detour, Carry(moved, 0.0F));
      auto robot = bench.tick();
      moved = bypass(robot, goal - position) * step;
      position += moved;
      path += step;
      if (path > limit) return false;
    }
    return true;
  }
};

// ---- The way round ----

TEST(Bypass, LeadsStraightWhereNothingIsInTheWay) {
  ConvoyBench bench = grown<Convoy>();
  EXPECT_EQ(bypass(bench.tick(), {1.5F, 2.0F}), (Vec2{0.6F, 0.8F}));
  EXPECT_EQ(bypass(bench.tick(), {}), Vec2{});
  bench.obstacles = {{-0.075F, 0.0F}};  // behind
  EXPECT_EQ(bypass(bench.tick(), {1.0F, 0.0F}), (Vec2{1.0F, 0.0F}));
  EXPECT_EQ(bench.state.detour.side, 0);
}

TEST(Bypass, TakesTheSideThatIsNearerToTheGoal) {
  for (const float y : {0.5F, -0.5F}) {
    ConvoyBench bench = grown<Convoy>();
    bench.obstacles = {{0.055F, 0.0F}};
    const auto robot = bench.tick();
    const Vec2 u = bypass(robot, {1.0F, y});
    EXPECT_GT(u.y * y, 0.45F);
    EXPECT_LT(u.x, 0.05F);
  }
}

RC_GTEST_PROP(Bypass, NeverLeadsIntoAnObstacle, ()) {
  ConvoyBench bench = grown<Convoy>();
  const Vec2 o = unit_vector(number(-3.1F, 3.1F)) * number(0.04F, 0.15F);
  bench.obstacles = {o};
  const auto robot = bench.tick();
  const Vec2 u = bypass(robot, unit_vector(number(-3.1F, 3.1F)) * number(0.05F, 2.5F));
  RC_ASSERT(std::abs(norm(u) - 1.0F) < 1e-3F);
  // Straight on for a little way it is still a body away, unless it was nearer and leaves.
  RC_ASSERT(distance(u * 0.025F, o) > std::min(norm(o), body + 0.005F) - 5e-4F);
}

RC_GTEST_PROP(Bypass, GoesRoundAnyWall, ()) {
  const float up = number(0.05F, 0.75F);
  const float down = number(0.05F, 0.75F);
  Walker walker{{{{0.5F, up}, {0.5F, -down}}}, {0.0F, number(-0.15F, 0.15F)}};
  RC_ASSERT(walker.reaches({1.0F, number(-0.15F, 0.15F)}, 10.0F));
  RC_ASSERT(walker.nearest > body);
}

// The gap is on one side, on the other the wall goes on: the first side may be the wrong one, and is
// given up in time.
RC_GTEST_PROP(Bypass, FindsTheGapInALongWall, ()) {
  const float gap = number(0.25F, 1.0F);
  Walker walker{{{{0.5F, 25.0F}, {0.5F, gap + 0.25F}}, {{0.5F, gap}, {0.5F, -25.0F}}}, {0.0F, 0.0F}};
  RC_ASSERT(walker.reaches({1.0F, number(-0.25F, 0.25F)}, 20.0F));
  RC_ASSERT(walker.nearest > body);
}

TEST(Bypass, LeavesAPocket) {
  Walker walker{{{{0.5F, 0.25F}, {0.5F, -0.25F}}, {{0.15F, 0.25F}, {0.5F, 0.25F}}, {{0.15F, -0.25F}, {0.5F, -0.25F}}},
                {0.0F, 0.025F}};
  EXPECT_TRUE(walker.reaches({1.0F, 0.0F}, 15.0F));
  EXPECT_GT(walker.nearest, body);
}

// Each side leads from body to body and looks like the way round for a while.
TEST(Bypass, LeavesAFieldOfBodies) {
  for (const Vec2 start : {Vec2{0.36F, -0.3F}, Vec2{0.36F, -0.1F}, Vec2{0.5F, -0.25F}, Vec2{0.535F, 0.025F}}) {
    // clang-format off
    Walker walker{{}, start, {{-0.075F, -0.385F}, {-0.07F, 0.205F}, {0.045F, -0.185F}, {0.18F, 0.0F}, {0.25F, 0.135F},
                              {0.355F, 0.435F}, {0.43F, -0.37F}, {0.545F, -0.4F}, {0.62F, -0.265F}, {0.635F, 0.005F},
                              {0.715F, -0.135F}, {0.78F, 0.0F}}};
    // clang-format on
    EXPECT_TRUE(walker.reaches({4.5F, 0.0F}, 10.0F)) << "from " << start.x << ", " << start.y;
    EXPECT_GT(walker.nearest, body);
  }
}

TEST(Bypass, PassesADoorWithWallsOnBothSides) {
  Walker walker{{{{0.5F, 1.5F}, {0.5F, 0.125F}}, {{0.5F, -0.125F}, {0.5F, -1.5F}}}, {0.0F, 0.1F}};
  EXPECT_TRUE(walker.reaches({1.0F, 0.1F}, 2.0F));
}

// Nobody can: the goal is walled in. The robot goes on looking, without end and without harm.
TEST(Bypass, DoesNotBreakThroughToAGoalThatIsWalledIn) {
  const Vec2 c[] = {{0.5F, 0.5F}, {0.5F, -0.5F}, {1.5F, -0.5F}, {1.5F, 0.5F}};
  Walker walker{{{c[0], c[1]}, {c[1], c[2]}, {c[2], c[3]}, {c[3], c[0]}}, {0.0F, 0.05F}};
  EXPECT_FALSE(walker.reaches({1.0F, 0.0F}, 30.0F));
  EXPECT_GT(walker.nearest, body);
}

// ---- Guards ----

TEST(Bypass, WhatIsAskedOfADetourShrinksWithTheWayDriven) {
  ConvoyBench bench = grown<Convoy>();
  bench.obstacles = {{0.1F, 0.0F}};
  bench.state.detour.side = 1;
  bench.state.detour.leave = 0.5F;
  for (int tick = 0; tick < 10; ++tick) bench.step({.forward_m = 0.01F});
  EXPECT_NEAR(bench.state.detour.leave, 0.525F, 5e-5F);
}

TEST(KeepOff, SlidesAlongAndDoesNotPush) {
  ConvoyBench bench = grown<Convoy>();
  bench.obstacles = {{body + 0.01F, 0.0F}};
  const auto robot = bench.tick();
  Guard guard;
  keep_off(robot, guard);
  const Vec2 v = guard.apply({0.75F, 0.5F});
  EXPECT_NEAR(v.x, 0.0F, 5e-3F);
  EXPECT_NEAR(v.y, 0.5F, 5e-3F);
  EXPECT_EQ(guard.apply({-0.5F, 0.5F}), (Vec2{-0.5F, 0.5F}));
}

}  // namespace
}  // namespace banyan
