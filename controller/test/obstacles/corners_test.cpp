// SPDX-License-Identifier: MIT
// What is kept clear of corners, and what is remembered of them.
#include "obstacles/corners.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "banyan/controller/core/trig.hpp"
#include "bench.hpp"
#include "numbers.hpp"
#include "tree/motion.hpp"

namespace banyan {
namespace {

TEST(KeepSight, OnlyWhereTheRadioNeedsIt) {
  for (const bool needed : {true, false}) {
    ConvoyBench bench = grown<Convoy>();
    bench.params.line_of_sight = needed;
    bench.obstacles = {{0.1F, 0.04F}};
    bench.put(9, {0.5F, 0.0F}).role = Role::root;
    bench.state.parent = 9;
    auto robot = bench.tick();
    remember_corners(robot, bench.state.corners);
    Guard guard;
    keep_sight(robot, bench.state.corners, guard);
    EXPECT_EQ(guard.size > 0, needed);
    EXPECT_EQ(clear_sight(robot, bench.state.corners) != Vec2{}, needed);
  }
}

// Whatever the robot wants, in the next tick what is beside the edge to its parent has as much room, or so much.
void expect_room_beside_edge(ConvoyBench& bench, Vec2 parent, Vec2 beside, float least) {
  bench.state.parent = 9;
  bench.put(9, parent).role = Role::root;
  const auto robot = bench.tick();
  Guard guard;
  keep_sight(robot, bench.state.corners, guard);
  const Vec2 moved = guard.apply(unit_vector(number(-3.1F, 3.1F))) * robot.params.way_in_a_round();
  const auto room = [&](Vec2 from) { return cross(parent - from, beside - from) / distance(parent, from) * -1.0F; };
  RC_ASSERT(room(moved) > std::min(least, room({})) - 1e-3F);
}

RC_GTEST_PROP(KeepSight, NoMotionOfMyOwnBringsACornerIntoTheEdge, ()) {
  ConvoyBench bench = grown<Convoy>();
  const Vec2 parent{number(-0.9F, -0.25F), 0.0F};
  const Vec2 corner{number(0.025F, 0.125F) * -1.0F, number(0.015F, 0.1F)};
  bench.obstacles = {corner};
  expect_room_beside_edge(bench, parent, corner, 0.01F);
}

TEST(Landmarks, ACornerIsTakenAlongAndForgottenWhenItProvesWrong) {
  ConvoyBench bench = grown<Convoy>();
  bench.obstacles = {{0.05F, 0.025F}};
  {
    auto robot = bench.tick();
    remember_corners(robot, bench.state.corners);
  }
  ASSERT_EQ(bench.state.corners.landmarks.size, 1);
  bench.obstacles.clear();
  auto robot = bench.tick();
  remember_corners(robot, bench.state.corners);
  EXPECT_EQ(bench.state.corners.landmarks.size, 0) << "it is near, and the sensor sees nothing";
  bench.state.corners.landmarks = {{Vec2{0.25F, 0.0F}}, 1};
  remember_corners(robot, bench.state.corners);
  EXPECT_EQ(bench.state.corners.landmarks.size, 1) << "out of the sensor's reach";
  EXPECT_FALSE(is_free(robot, bench.state.corners, {}, {0.5F, 0.01F}, 0.025F));
  EXPECT_TRUE(is_free(robot, bench.state.corners, {}, {0.5F, 0.15F}, 0.025F));
  bench.state.corners.landmarks = {{Vec2{1.25F, 0.0F}}, 1};
  remember_corners(robot, bench.state.corners);
  EXPECT_EQ(bench.state.corners.landmarks.size, 0) << "no edge reaches so far";
}

// The child tells its parent of a corner that only the child can see; their frames differ.
TEST(Landmarks, ParentsHearOfCornersFromTheirChildren) {
  const float turn = 1.1F;  // the child's frame, seen from the parent's
  const Vec2 child_at{0.6F, 0.35F};
  const Vec2 corner{0.45F, 0.28F};  // parent's frame
  ConvoyBench child = grown<Convoy>();
  child.state.parent = 9;
  child.send(rotate_back(unit_vector(turn), Vec2{1.5F, 0.0F}));
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
  EXPECT_LT(distance(parent.state.corners.landmarks.points[0], corner), 0.0075F);
  EXPECT_TRUE(said.message.pinned);
}

// A child of robot 9, at `parent`, which dies in plain sight; it has looked at its memory in every tick since.
struct Bereaved {
  explicit Bereaved(Vec2 parent = {-0.9F, 0.0F}) {
    bench.params.line_of_sight = true;
    bench.state.parent = 9;
    bench.put(9, parent).role = Role::root;
    look();
    bench.silence(9);
  }
  void look(int ticks = 1, const Odometry& odometry = {}) {
    for (int k = 0; k < ticks; ++k) {
      auto robot = bench.tick(odometry);
      remember_corners(robot, bench.state.corners);
    }
  }
  [[nodiscard]] const KnownBodies& bodies() const { return bench.state.corners.bodies; }
  ConvoyBench bench = grown<Convoy>();
};
constexpr int past_liveness_ticks = 8;

TEST(Bodies, ATreeNeighborThatFallsSilentInPlainSightIsRemembered) {
  Bereaved child;
  child.look(3);
  EXPECT_EQ(child.bodies().size, 0) << "a packet may be lost";
  child.look(past_liveness_ticks);
  ASSERT_EQ(child.bodies().size, 1);
  EXPECT_EQ(child.bodies().ids[0], 9);
  EXPECT_LT(distance(child.bodies().centers[0], {-0.9F, 0.0F}), 1e-4F);
  // A body, and 0.025 C beside it; a point would hide no more than that.
  const auto is_free_at = [&](float y) {
    return is_free(child.bench.tick(), child.bench.state.corners, {-0.5F, y}, {-1.3F, y}, 0.025F);
  };
  EXPECT_FALSE(is_free_at(0.05F));
  EXPECT_TRUE(is_free_at(0.07F));
  child.look(1, {.forward_m = -0.25F});
  ASSERT_EQ(child.bodies().size, 1);
  EXPECT_LT(distance(child.bodies().centers[0], {-0.65F, 0.0F}), 1e-4F) << "so much nearer";
}

TEST(Bodies, WhoMayOnlyBeHiddenIsNone) {
  Bereaved child;
  child.bench.put(4, {-0.5F, 0.05F});
  child.look(past_liveness_ticks);
  EXPECT_EQ(child.bodies().size, 0) << "robot 4 is in between";
  Bereaved far({-0.975F, 0.0F});
  far.look(past_liveness_ticks);
  EXPECT_EQ(far.bodies().size, 0) << "it may have gone out of range";
  Bereaved free_radio;
  free_radio.bench.params.line_of_sight = false;
  free_radio.look(past_liveness_ticks);
  EXPECT_EQ(free_radio.bodies().size, 0) << "bodies hide nothing";
  Bereaved stranger;
  stranger.bench.state.parent = nobody;
  stranger.look(past_liveness_ticks);
  EXPECT_EQ(stranger.bodies().size, 0) << "no edge of mine ended there";
}

TEST(Bodies, TheyAreForgottenWhenTheyProveWrong) {
  Bereaved child;
  child.look(past_liveness_ticks);
  ASSERT_EQ(child.bodies().size, 1);
  child.bench.put(9, {-0.85F, 0.0F});
  child.look();
  EXPECT_EQ(child.bodies().size, 0) << "it is heard again";
  Bereaved near;
  near.look(past_liveness_ticks);
  near.look(1, {.forward_m = -0.825F});
  EXPECT_EQ(near.bodies().size, 0) << "it is near, and the sensor sees nothing";
  Bereaved seen;
  seen.look(past_liveness_ticks);
  seen.bench.obstacles = {{-0.04F, 0.0F}};
  seen.look(1, {.forward_m = -0.825F});
  EXPECT_EQ(seen.bodies().size, 1);
  seen.bench.obstacles.clear();
  seen.look(1, {.forward_m = 0.975F});
  EXPECT_EQ(seen.bodies().size, 0) << "no edge reaches so far";
}

// Bodies may vanish. What is not there must not bend the edges of those who meet across it.
TEST(Bodies, TheyAreForgottenWhenANeighborIsHeardThroughThem) {
  const auto is_kept = [](Vec2 heard_at) {
    Bereaved child;
    child.look(past_liveness_ticks);
    child.bench.put(4, heard_at);
    child.look();
    return child.bodies().size == 1;
  };
  EXPECT_FALSE(is_kept({-0.99F, 0.005F}));
  EXPECT_TRUE(is_kept({-0.985F, 0.05F})) << "past it";
  EXPECT_TRUE(is_kept({-0.8F, 0.0F})) << "in front of it";
}

// A worker does not drive to where its line of sight to the parent is hidden by the body between them.
RC_GTEST_PROP(Bodies, NoMotionOfMyOwnBringsABodyIntoTheEdge, ()) {
  ConvoyBench bench = grown<Convoy>();
  bench.params.line_of_sight = true;
  const Vec2 parent{number(-0.9F, -0.6F), 0.0F};
  const Vec2 center{parent.x + number(0.075F, 0.45F), number(0.0375F, 0.1F)};
  bench.state.corners.bodies = {{center}, {4}, 1};
  expect_room_beside_edge(bench, parent, center, 0.045F);
}

// It hears where the edge would pass the body at its surface: it has not known the robot that died.
TEST(Bodies, ParentsHearOfThemFromTheirChildren) {
  ConvoyBench bench = grown<Convoy>();
  bench.state.parent = 9;
  bench.put(9, {-0.75F, 0.0F}).role = Role::root;
  bench.state.corners.bodies = {{Vec2{-0.5F, 0.075F}}, {4}, 1};
  Vec2 hinge;
  ASSERT_TRUE(find_hinge(bench.tick(), bench.state.corners, hinge));
  EXPECT_LT(distance(hinge, {-0.5F, 0.04F}), 1e-3F);
  bench.state.corners.bodies = {{Vec2{-0.5F, -0.075F}}, {4}, 1};
  ASSERT_TRUE(find_hinge(bench.tick(), bench.state.corners, hinge));
  EXPECT_LT(distance(hinge, {-0.5F, -0.04F}), 1e-3F);
}

TEST(Pinned, OnlyWhoHasToGoOnAndHasACornerAtItsEdge) {
  ConvoyBench bench = grown<Convoy>();
  const auto pinned = [&] { return is_pinned(bench.tick(), bench.state.corners, 0.675F); };
  bench.state.parent = 9;
  bench.put(9, {-0.5F, 0.0F}).role = Role::root;
  bench.obstacles = {{-0.05F, 0.015F}};
  bench.state.want = 1.0F;
  bench.state.is_worker = true;
  EXPECT_TRUE(pinned());
  bench.state.want = 0.0F;
  EXPECT_FALSE(pinned());
  bench.state.want = 1.0F;
  bench.obstacles = {{0.05F, 0.015F}};
  EXPECT_FALSE(pinned()) << "ahead of me, not beside the edge";
  bench.obstacles = {{-0.05F, 0.015F}};
  bench.move(9, {-0.1F, 0.0F});
  EXPECT_FALSE(pinned()) << "the parent is there";
}

}  // namespace
}  // namespace banyan
