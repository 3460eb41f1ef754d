// SPDX-License-Identifier: MIT
// What is kept clear of corners, and what is remembered of them.
#include "banyan/controller/obstacles/corners.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "banyan/controller/core/trig.hpp"
#include "banyan/controller/tree/motion.hpp"
#include "bench.hpp"
#include "numbers.hpp"

namespace banyan {
namespace {

TEST(KeepSight, OnlyWhereTheRadioNeedsIt) {
  for (const bool needed : {true, false}) {
    ConvoyBench bench = grown<Convoy>();
    bench.params.line_of_sight = needed;
    bench.obstacles = {{0.2F, 0.08F}};
    bench.put(9, {1.0F, 0.0F}).role = Role::root;
    bench.state.parent = 9;
    auto robot = bench.tick();
    remember_corners(robot, bench.state.corners);
    Guard guard;
    keep_sight(robot, bench.state.corners, guard);
    EXPECT_EQ(guard.size > 0, needed);
    EXPECT_EQ(clear_sight(robot, bench.state.corners) != Vec2{}, needed);
  }
}

// A corner beside the edge to the parent: whatever the robot wants, in the next tick it does not cut it.
RC_GTEST_PROP(KeepSight, NoMotionOfMyOwnBringsACornerIntoTheEdge, ()) {
  ConvoyBench bench = grown<Convoy>();
  bench.state.parent = 9;
  const Vec2 parent{number(-1.8F, -0.5F), 0.0F};
  bench.put(9, parent).role = Role::root;
  const Vec2 corner{number(0.05F, 0.25F) * -1.0F, number(0.03F, 0.2F)};
  bench.obstacles = {corner};
  const auto robot = bench.tick();
  Guard guard;
  keep_sight(robot, bench.state.corners, guard);
  const Vec2 moved = guard.apply(unit_vector(number(-3.1F, 3.1F)) * 0.2F) * robot.params.tick_s;
  const auto room = [&](Vec2 from) { return cross(parent - from, corner - from) / distance(parent, from) * -1.0F; };
  RC_ASSERT(room(moved) > std::min(0.02F, room({})) - 2e-3F);
}

TEST(Landmarks, ACornerIsTakenAlongAndForgottenWhenItProvesWrong) {
  ConvoyBench bench = grown<Convoy>();
  bench.obstacles = {{0.1F, 0.05F}};
  {
    auto robot = bench.tick();
    remember_corners(robot, bench.state.corners);
  }
  ASSERT_EQ(bench.state.corners.landmarks.size, 1);
  bench.obstacles.clear();
  auto robot = bench.tick();
  remember_corners(robot, bench.state.corners);
  EXPECT_EQ(bench.state.corners.landmarks.size, 0) << "0.11 m away, and the sensor sees nothing";
  bench.state.corners.landmarks = {{Vec2{0.5F, 0.0F}}, 1};
  remember_corners(robot, bench.state.corners);
  EXPECT_EQ(bench.state.corners.landmarks.size, 1) << "out of the sensor's reach";
  EXPECT_FALSE(is_free(robot, bench.state.corners, {}, {1.0F, 0.02F}, 0.05F));
  EXPECT_TRUE(is_free(robot, bench.state.corners, {}, {1.0F, 0.3F}, 0.05F));
  bench.state.corners.landmarks = {{Vec2{2.5F, 0.0F}}, 1};
  remember_corners(robot, bench.state.corners);
  EXPECT_EQ(bench.state.corners.landmarks.size, 0) << "no edge reaches so far";
}

// The child tells its parent of a corner that only the child can see; their frames differ.
TEST(Landmarks, ParentsHearOfCornersFromTheirChildren) {
  const float turn = 1.1F;  // the child's frame, seen from the parent's
  const Vec2 child_at{1.2F, 0.7F};
  const Vec2 corner{0.9F, 0.56F};  // parent's frame
  ConvoyBench child = grown<Convoy>();
  child.state.parent = 9;
  child.send(rotate_back(unit_vector(turn), Vec2{3.0F, 0.0F}));
  auto& root = child.put(9, rotate_back(unit_vector(turn), -child_at));
  root.role = Role::root;
  child.obstacles = {rotate_back(unit_vector(turn), corner - child_at)};
  const auto said = child.steps(2);
  ConvoyBench parent = grown<Convoy>();
  parent.state.id = 9;
  parent.state.role = Role::root;
  parent.state.root = {1, 9};
  parent.put(1, child_at) = said.message;
  auto robot = parent.tick();
  remember_corners(robot, parent.state.corners);
  ASSERT_EQ(parent.state.corners.landmarks.size, 1);
  EXPECT_LT(distance(parent.state.corners.landmarks.points[0], corner), 0.015F);
  EXPECT_TRUE(said.message.pinned);
}

TEST(Pinned, OnlyWhoHasToGoOnAndHasACornerAtItsEdge) {
  ConvoyBench bench = grown<Convoy>();
  const auto pinned = [&] { return is_pinned(bench.tick(), bench.state.corners, 1.35F); };
  bench.state.parent = 9;
  bench.put(9, {-1.0F, 0.0F}).role = Role::root;
  bench.obstacles = {{-0.1F, 0.03F}};
  bench.state.want_m = 2.0F;
  bench.state.is_worker = true;
  EXPECT_TRUE(pinned());
  bench.state.want_m = 0.0F;
  EXPECT_FALSE(pinned());
  bench.state.want_m = 2.0F;
  bench.obstacles = {{0.1F, 0.03F}};
  EXPECT_FALSE(pinned()) << "ahead of me, not beside the edge";
  bench.obstacles = {{-0.1F, 0.03F}};
  bench.move(9, {-0.2F, 0.0F});
  EXPECT_FALSE(pinned()) << "the parent is there";
}

}  // namespace
}  // namespace banyan
