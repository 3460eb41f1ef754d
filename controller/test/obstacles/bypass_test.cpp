// SPDX-License-Identifier: MIT
// The way round obstacles in a plane world of points.
#include "banyan/controller/obstacles/bypass.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "banyan/controller/core/trig.hpp"
#include "banyan/controller/tree/motion.hpp"
#include "bench.hpp"
#include "numbers.hpp"

namespace banyan {
namespace {

constexpr float body_m = 0.0706F;

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
  float nearest_m = 1e9F;
  float path_m = 0.0F;

  // Whether it comes within 5 cm of the goal before it has gone `limit_m`.
  bool reaches(Vec2 goal, float limit_m) {
    constexpr float step_m = 0.02F;
    Vec2 moved;
    while (distance(position, goal) > 0.05F) {
      bench.obstacles.clear();
      for (const Segment& wall : walls) {
        const Vec2 o = wall.nearest(position) - position;
        nearest_m = std::min(nearest_m, norm(o));
        if (norm(o) <= 0.30F) bench.obstacles.push_back(o);
      }
      for (const Vec2 body : bodies) {
        const Vec2 o = (body - position) * (1.0F - body_m / distance(body, position));
        nearest_m = std::min(nearest_m, norm(o));
        if (norm(o) <= 0.30F) bench.obstacles.push_back(o);
      }
      carry_detour(bench.state.detour, Carry({moved.x, moved.y, 0.0F}));
      auto robot = bench.tick();
      moved = bypass(robot, goal - position) * step_m;
      position += moved;
      path_m += step_m;
      if (path_m > limit_m) return false;
    }
    return true;
  }
};

// ---- The way round ----

TEST(Bypass, LeadsStraightWhereNothingIsInTheWay) {
  ConvoyBench bench = grown<Convoy>();
  EXPECT_EQ(bypass(bench.tick(), {3.0F, 4.0F}), (Vec2{0.6F, 0.8F}));
  EXPECT_EQ(bypass(bench.tick(), {}), Vec2{});
  bench.obstacles = {{-0.15F, 0.0F}};  // behind
  EXPECT_EQ(bypass(bench.tick(), {2.0F, 0.0F}), (Vec2{1.0F, 0.0F}));
  EXPECT_EQ(bench.state.detour.side, 0);
}

TEST(Bypass, TakesTheSideThatIsNearerToTheGoal) {
  for (const float y : {1.0F, -1.0F}) {
    ConvoyBench bench = grown<Convoy>();
    bench.obstacles = {{0.11F, 0.0F}};
    const auto robot = bench.tick();
    const Vec2 u = bypass(robot, {2.0F, y});
    EXPECT_GT(u.y * y, 0.9F);
    EXPECT_LT(u.x, 0.05F);
  }
}

RC_GTEST_PROP(Bypass, NeverLeadsIntoAnObstacle, ()) {
  ConvoyBench bench = grown<Convoy>();
  const Vec2 o = unit_vector(number(-3.1F, 3.1F)) * number(0.08F, 0.30F);
  bench.obstacles = {o};
  const auto robot = bench.tick();
  const Vec2 u = bypass(robot, unit_vector(number(-3.1F, 3.1F)) * number(0.1F, 5.0F));
  RC_ASSERT(std::abs(norm(u) - 1.0F) < 1e-3F);
  // Straight on for 5 cm it is still a body away, unless it was nearer and leaves.
  RC_ASSERT(distance(u * 0.05F, o) > std::min(norm(o), body_m + 0.01F) - 1e-3F);
}

RC_GTEST_PROP(Bypass, GoesRoundAnyWall, ()) {
  const float up = number(0.1F, 1.5F);
  const float down = number(0.1F, 1.5F);
  Walker walker{{{{1.0F, up}, {1.0F, -down}}}, {0.0F, number(-0.3F, 0.3F)}};
  RC_ASSERT(walker.reaches({2.0F, number(-0.3F, 0.3F)}, 20.0F));
  RC_ASSERT(walker.nearest_m > body_m);
}

// The gap is on one side, on the other the wall goes on: the first side may be the wrong one, and is
// given up in time.
RC_GTEST_PROP(Bypass, FindsTheGapInALongWall, ()) {
  const float gap = number(0.5F, 2.0F);
  Walker walker{{{{1.0F, 50.0F}, {1.0F, gap + 0.5F}}, {{1.0F, gap}, {1.0F, -50.0F}}}, {0.0F, 0.0F}};
  RC_ASSERT(walker.reaches({2.0F, number(-0.5F, 0.5F)}, 40.0F));
  RC_ASSERT(walker.nearest_m > body_m);
}

TEST(Bypass, LeavesAPocket) {
  Walker walker{{{{1.0F, 0.5F}, {1.0F, -0.5F}}, {{0.3F, 0.5F}, {1.0F, 0.5F}}, {{0.3F, -0.5F}, {1.0F, -0.5F}}},
                {0.0F, 0.05F}};
  EXPECT_TRUE(walker.reaches({2.0F, 0.0F}, 30.0F));
  EXPECT_GT(walker.nearest_m, body_m);
}

// Each side leads from body to body and looks like the way round for a while.
TEST(Bypass, LeavesAFieldOfBodies) {
  for (const Vec2 start : {Vec2{0.72F, -0.60F}, Vec2{0.72F, -0.20F}, Vec2{1.0F, -0.5F}, Vec2{1.07F, 0.05F}}) {
    // clang-format off
    Walker walker{{}, start, {{-0.15F, -0.77F}, {-0.14F, 0.41F}, {0.09F, -0.37F}, {0.36F, 0.0F}, {0.50F, 0.27F},
        {0.71F, 0.87F},
                              {0.86F, -0.74F}, {1.09F, -0.80F}, {1.24F, -0.53F}, {1.27F, 0.01F}, {1.43F, -0.27F},
                                  {1.56F, 0.0F}}};
    // clang-format on
    EXPECT_TRUE(walker.reaches({9.0F, 0.0F}, 20.0F)) << "from " << start.x << ", " << start.y;
    EXPECT_GT(walker.nearest_m, body_m);
  }
}

TEST(Bypass, PassesADoorWithWallsOnBothSides) {
  Walker walker{{{{1.0F, 3.0F}, {1.0F, 0.25F}}, {{1.0F, -0.25F}, {1.0F, -3.0F}}}, {0.0F, 0.2F}};
  EXPECT_TRUE(walker.reaches({2.0F, 0.2F}, 4.0F));
}

// Nobody can: the goal is walled in. The robot goes on looking, without end and without harm.
TEST(Bypass, DoesNotBreakThroughToAGoalThatIsWalledIn) {
  const Vec2 c[] = {{1.0F, 1.0F}, {1.0F, -1.0F}, {3.0F, -1.0F}, {3.0F, 1.0F}};
  Walker walker{{{c[0], c[1]}, {c[1], c[2]}, {c[2], c[3]}, {c[3], c[0]}}, {0.0F, 0.1F}};
  EXPECT_FALSE(walker.reaches({2.0F, 0.0F}, 60.0F));
  EXPECT_GT(walker.nearest_m, body_m);
}

// ---- Guards ----

TEST(Bypass, WhatIsAskedOfADetourShrinksWithTheWayDriven) {
  ConvoyBench bench = grown<Convoy>();
  bench.obstacles = {{0.2F, 0.0F}};
  bench.state.detour.side = 1;
  bench.state.detour.leave_m = 1.0F;
  for (int tick = 0; tick < 10; ++tick) bench.step({.forward_m = 0.02F});
  EXPECT_NEAR(bench.state.detour.leave_m, 1.05F, 1e-4F);
}

TEST(KeepOff, SlidesAlongAndDoesNotPush) {
  ConvoyBench bench = grown<Convoy>();
  bench.obstacles = {{body_m + 0.02F, 0.0F}};
  const auto robot = bench.tick();
  Guard guard;
  keep_off(robot, guard);
  const Vec2 v = guard.apply({0.15F, 0.1F});
  EXPECT_NEAR(v.x, 0.0F, 1e-3F);
  EXPECT_NEAR(v.y, 0.1F, 1e-3F);
  EXPECT_EQ(guard.apply({-0.1F, 0.1F}), (Vec2{-0.1F, 0.1F}));
}

TEST(KeepOff, HoldsForThePapersAlgorithmsInTheCorrectedReadingOnly) {
  const auto drives_on = []<class Kind>(BenchOf<Kind> bench) {
    bench.send({3.0F, 0.0F});
    bench.state.parent = 9;
    bench.put(9, {-1.0F, 0.0F}).role = Role::root;
    bench.obstacles = {{0.09F, 0.0F}};
    return bench.steps(3).velocity.forward_m_s > 0.01F;
  };
  EXPECT_TRUE(drives_on(grown<OutwardsLiteral>()));
  EXPECT_FALSE(drives_on(grown<Outwards>()));
}

}  // namespace
}  // namespace banyan
