// SPDX-License-Identifier: MIT
// Obstacles: the way round them in a plane world of points, and what is kept clear of corners.
#include "banyan/controller/bypass.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "banyan/controller/motion.hpp"
#include "banyan/controller/trig.hpp"
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
  Bench bench = grown(convoy());
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
      Detour& detour = bench.state.detour;
      for (Vec2* v : {&detour.contact, &detour.origin, &detour.goal}) *v -= moved;
      Robot robot = bench.tick();
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
  Bench bench = grown(convoy());
  EXPECT_EQ(bypass(bench.tick(), {3.0F, 4.0F}), (Vec2{0.6F, 0.8F}));
  EXPECT_EQ(bypass(bench.tick(), {}), Vec2{});
  bench.obstacles = {{-0.15F, 0.0F}};  // behind
  EXPECT_EQ(bypass(bench.tick(), {2.0F, 0.0F}), (Vec2{1.0F, 0.0F}));
  EXPECT_EQ(bench.state.detour.side, 0);
}

TEST(Bypass, TakesTheSideThatIsNearerToTheGoal) {
  for (const float y : {1.0F, -1.0F}) {
    Bench bench = grown(convoy());
    bench.obstacles = {{0.11F, 0.0F}};
    const Robot robot = bench.tick();
    const Vec2 u = bypass(robot, {2.0F, y});
    EXPECT_GT(u.y * y, 0.9F);
    EXPECT_LT(u.x, 0.05F);
  }
}

RC_GTEST_PROP(Bypass, NeverLeadsIntoAnObstacle, ()) {
  Bench bench = grown(convoy());
  const Vec2 o = unit_vector(number(-3.1F, 3.1F)) * number(0.08F, 0.30F);
  bench.obstacles = {o};
  const Robot robot = bench.tick();
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
  Walker walker{{{{1.0F, 0.5F}, {1.0F, -0.5F}}, {{0.3F, 0.5F}, {1.0F, 0.5F}}, {{0.3F, -0.5F}, {1.0F, -0.5F}}}, {0.0F, 0.05F}};
  EXPECT_TRUE(walker.reaches({2.0F, 0.0F}, 30.0F));
  EXPECT_GT(walker.nearest_m, body_m);
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
  Bench bench = grown(convoy());
  bench.obstacles = {{0.2F, 0.0F}};
  bench.state.detour.side = 1;
  bench.state.detour.leave_m = 1.0F;
  for (int tick = 0; tick < 10; ++tick) bench.step({.forward_m = 0.02F});
  EXPECT_NEAR(bench.state.detour.leave_m, 1.05F, 1e-4F);
}

TEST(KeepSight, OnlyWhereTheRadioNeedsIt) {
  for (const bool needed : {true, false}) {
    Bench bench = grown(convoy());
    bench.params.line_of_sight = needed;
    bench.obstacles = {{0.2F, 0.08F}};
    bench.put(9, {1.0F, 0.0F}).role = Role::root;
    bench.state.parent = 9;
    Robot robot = bench.tick();
    remember_obstacles(robot);
    Guard guard;
    keep_sight(robot, guard);
    EXPECT_EQ(guard.size > 0, needed);
    EXPECT_EQ(clear_sight(robot) != Vec2{}, needed);
  }
}

TEST(KeepOff, SlidesAlongAndDoesNotPush) {
  Bench bench = grown(convoy());
  bench.obstacles = {{body_m + 0.02F, 0.0F}};
  const Robot robot = bench.tick();
  Guard guard;
  keep_off(robot, guard);
  const Vec2 v = guard.apply({0.15F, 0.1F});
  EXPECT_NEAR(v.x, 0.0F, 1e-3F);
  EXPECT_NEAR(v.y, 0.1F, 1e-3F);
  EXPECT_EQ(guard.apply({-0.1F, 0.1F}), (Vec2{-0.1F, 0.1F}));
}

TEST(KeepOff, HoldsForThePapersPoliciesInTheCorrectedReadingOnly) {
  const Vec2 target{3.0F, 0.0F};
  for (const Reading reading : {Reading::corrected, Reading::literal}) {
    Bench bench = grown(outwards(), reading);
    bench.state.is_worker = true;
    bench.target = &target;
    bench.state.parent = 9;
    bench.put(9, {-1.0F, 0.0F}).role = Role::root;
    bench.obstacles = {{0.09F, 0.0F}};
    const Output output = bench.steps(3);
    EXPECT_EQ(output.velocity.forward_m_s > 0.01F, reading == Reading::literal);
  }
}

// A corner beside the edge to the parent: whatever the robot wants, in the next tick it does not cut it.
RC_GTEST_PROP(KeepSight, NoMotionOfMyOwnBringsACornerIntoTheEdge, ()) {
  Bench bench = grown(convoy());
  bench.state.parent = 9;
  const Vec2 parent{number(-1.8F, -0.5F), 0.0F};
  bench.put(9, parent).role = Role::root;
  const Vec2 corner{number(0.05F, 0.25F) * -1.0F, number(0.03F, 0.2F)};
  bench.obstacles = {corner};
  const Robot robot = bench.tick();
  Guard guard;
  keep_sight(robot, guard);
  const Vec2 moved = guard.apply(unit_vector(number(-3.1F, 3.1F)) * 0.2F) * robot.params.tick_s;
  const auto room = [&](Vec2 from) { return cross(parent - from, corner - from) / distance(parent, from) * -1.0F; };
  RC_ASSERT(room(moved) > std::min(0.02F, room({})) - 2e-3F);
}

TEST(Landmarks, ACornerIsTakenAlongAndForgottenWhenItProvesWrong) {
  Bench bench = grown(convoy());
  bench.obstacles = {{0.1F, 0.05F}};
  {
    Robot robot = bench.tick();
    remember_obstacles(robot);
  }
  ASSERT_EQ(bench.state.landmarks.size, 1);
  bench.obstacles.clear();
  Robot robot = bench.tick();
  remember_obstacles(robot);
  EXPECT_EQ(bench.state.landmarks.size, 0) << "0.11 m away, and the sensor sees nothing";
  bench.state.landmarks = {{Vec2{0.5F, 0.0F}}, 1};
  remember_obstacles(robot);
  EXPECT_EQ(bench.state.landmarks.size, 1) << "out of the sensor's reach";
  EXPECT_FALSE(is_free(robot, {}, {1.0F, 0.02F}, 0.05F));
  EXPECT_TRUE(is_free(robot, {}, {1.0F, 0.3F}, 0.05F));
  bench.state.landmarks = {{Vec2{2.5F, 0.0F}}, 1};
  remember_obstacles(robot);
  EXPECT_EQ(bench.state.landmarks.size, 0) << "no edge reaches so far";
}

// The child tells its parent of a corner that only the child can see; their frames differ.
TEST(Landmarks, ParentsHearOfCornersFromTheirChildren) {
  const float turn = 1.1F;  // the child's frame, seen from the parent's
  const Vec2 child_at{1.2F, 0.7F};
  const Vec2 corner{0.9F, 0.56F};  // parent's frame
  Bench child = grown(convoy());
  child.state.parent = 9;
  child.state.is_worker = true;
  const Vec2 target = rotate_back(unit_vector(turn), Vec2{3.0F, 0.0F});
  child.target = &target;
  Message& root = child.put(9, rotate_back(unit_vector(turn), -child_at));
  root.role = Role::root;
  child.obstacles = {rotate_back(unit_vector(turn), corner - child_at)};
  const Output said = child.steps(2);
  Bench parent = grown(convoy());
  parent.state.id = 9;
  parent.state.role = Role::root;
  parent.state.root = {1, 9};
  parent.put(1, child_at) = said.message;
  Robot robot = parent.tick();
  remember_obstacles(robot);
  ASSERT_EQ(parent.state.landmarks.size, 1);
  EXPECT_LT(distance(parent.state.landmarks.points[0], corner), 0.015F);
  EXPECT_TRUE(said.message.pinned);
}

TEST(Pinned, OnlyWhoHasToGoOnAndHasACornerAtItsEdge) {
  Bench bench = grown(convoy());
  bench.state.parent = 9;
  bench.put(9, {-1.0F, 0.0F}).role = Role::root;
  bench.obstacles = {{-0.1F, 0.03F}};
  bench.state.want_m = 2.0F;
  bench.state.is_worker = true;
  EXPECT_TRUE(is_pinned(bench.tick()));
  bench.state.want_m = 0.0F;
  EXPECT_FALSE(is_pinned(bench.tick()));
  bench.state.want_m = 2.0F;
  bench.obstacles = {{0.1F, 0.03F}};
  EXPECT_FALSE(is_pinned(bench.tick())) << "ahead of me, not beside the edge";
  bench.obstacles = {{-0.1F, 0.03F}};
  bench.move(9, {-0.2F, 0.0F});
  EXPECT_FALSE(is_pinned(bench.tick())) << "the parent is there";
}

}  // namespace
}  // namespace banyan
