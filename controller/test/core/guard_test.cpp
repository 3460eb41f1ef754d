// SPDX-License-Identifier: MIT
// The guard against what it promises, and what wheels make of a velocity.
#include "banyan/controller/core/guard.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "banyan/controller/core/trig.hpp"
#include "numbers.hpp"

namespace banyan {
namespace {

constexpr float delta = 0.95F;  // C, the longest an edge may be
constexpr float rate = 10.0F;   // per drive

// A velocity in any direction, v_max.
Vec2 any_velocity() { return polar(number(0, 1), number(-3.14F, 3.14F)); }

struct Edges {
  Guard guard;
  std::vector<Vec2> neighbors;
};

Edges random_edges() {
  Edges edges;
  const int count = *rc::gen::inRange(1, 8);
  for (int k = 0; k < count; ++k) {
    edges.neighbors.push_back(polar(number(0.05F, delta), number(-3.14F, 3.14F)));
    edges.guard.add(edges.neighbors.back(), delta, rate);
  }
  return edges;
}

RC_GTEST_PROP(Guard, LengthensNoEdgeFasterThanItsShare, ()) {
  const Edges edges = random_edges();
  const Vec2 v = edges.guard.apply(any_velocity());
  for (const Vec2 n : edges.neighbors) {
    const float away = -dot(v, unit(n));
    RC_ASSERT(away <= 0.5F * (delta - norm(n)) * rate + 5e-5F);
  }
}

RC_GTEST_PROP(Guard, LeavesAnAllowedVelocityAlone, ()) {
  const Edges edges = random_edges();
  const Vec2 wish = any_velocity();
  for (std::size_t k = 0; k < edges.neighbors.size(); ++k)
    if (dot(wish, edges.guard.planes[k].away()) > edges.guard.planes[k].limit) return;
  RC_ASSERT(edges.guard.apply(wish) == wish);
}

RC_GTEST_PROP(Guard, NeverPushesWhileNoEdgeIsTooLong, ()) {
  const Edges edges = random_edges();
  RC_ASSERT(edges.guard.apply({}) == Vec2{});
  const Vec2 wish = any_velocity();
  RC_ASSERT(norm(edges.guard.apply(wish)) <= norm(wish) + 5e-6F);
}

TEST(Guard, OneEdgeGivesTheNearestVelocity) {
  Guard guard;
  guard.add({0.9F, 0}, delta, rate);  // may move away at a quarter of v_max
  const Vec2 v = guard.apply({-1.0F, 0.5F});
  EXPECT_NEAR(v.x, -0.25F, 5e-6F);
  EXPECT_NEAR(v.y, 0.5F, 5e-6F);
}

// Both ends of an edge wish at random and move at the velocity that the guard leaves of it.
RC_GTEST_PROP(Guard, BothEndsTogetherKeepTheEdgeWithinDelta, ()) {
  Machine m;
  m.rounds_per_drive = *rc::gen::element(25.0F, 100.0F, 2000.0F);
  const float longest = number(0.5F, 0.97F);
  using W = BasicVec2<double>;
  W a{};
  W b = unit_vector(static_cast<double>(number(-3, 3))) * static_cast<double>(number(0.1F, longest));
  for (int t = 0; t < 200; ++t) {
    const auto moved = [&](W here, W there) {
      Guard guard;
      guard.add({static_cast<float>(there.x - here.x), static_cast<float>(there.y - here.y)}, longest, rate);
      const Vec2 v = guard.apply(polar(1.0F, number(-3.14F, 3.14F))) * m.way_in_a_round();
      return W{here.x + static_cast<double>(v.x), here.y + static_cast<double>(v.y)};
    };
    const W next_a = moved(a, b);
    b = moved(b, a);
    a = next_a;
    // Across the edge it grows by (v t)^2 / 2d at most, and what is too long shrinks in the next round.
    const double across = 2.0 * std::pow(static_cast<double>(m.way_in_a_round()), 2.0) / static_cast<double>(longest);
    RC_ASSERT(distance(a, b) <= static_cast<double>(longest) + across + 1e-6);
  }
}

TEST(Guard, AnEdgeBeyondDeltaMayOnlyShrink) {
  Guard guard;
  guard.add({1.0F, 0}, delta, rate);
  EXPECT_LT(dot(guard.apply({-0.5F, 0}), Vec2{-1, 0}), 0.0F);
  EXPECT_EQ(drive({0.5F, 0}, guard, Machine{}).forward, 0.5F) << "towards it is free";
}

// ---- Unicycle ----

RC_GTEST_PROP(Drive, WheelsKeepTheirLimitAndTurnComesFirst, ()) {
  Machine m;
  m.rounds_per_drive = *rc::gen::element(25.0F, 100.0F, 2000.0F);
  m.wheel_distance = number(0.001F, 0.25F);
  const float speed = number(0.005F, 1.0F);
  const float theta = number(-3.1F, 3.1F);
  const Motion v = drive(polar(speed, theta), Guard{}, m);
  const float half = 0.5F * v.turn * m.wheel_distance;
  RC_ASSERT(std::fabs(v.forward - half) <= 1.0F + 5e-5F);
  RC_ASSERT(std::fabs(v.forward + half) <= 1.0F + 5e-5F);
  RC_ASSERT(v.sideways == 0.0F);
  // 0.4 of the angle in a round, as far as the wheels can.
  const float turn_limit = 2.0F / m.wheel_distance;
  const float wanted = 0.4F * theta * m.rounds_per_drive;
  RC_ASSERT(std::fabs(v.turn - std::clamp(wanted, -turn_limit, turn_limit)) < 1e-5F * std::fabs(wanted) + 1e-3F);
  const float wished = speed * std::max(0.0F, std::cos(theta));
  RC_ASSERT(std::fabs(v.forward - std::min(wished, std::max(0.0F, 1.0F - std::fabs(half)))) < 5e-5F);
}

RC_GTEST_PROP(Drive, TheGuardHoldsAlongTheTrueHeadingToo, ()) {
  const Edges edges = random_edges();
  const Motion v = drive(polar(1.0F, number(-1, 1)), edges.guard, Machine{});
  RC_ASSERT(v.forward >= 0.0F);
  for (int k = 0; k < edges.guard.size; ++k) {
    const Guard::HalfPlane& plane = edges.guard.planes[static_cast<std::size_t>(k)];
    RC_ASSERT(v.forward * plane.x <= plane.limit + 5e-5F);
  }
}

// Round a neighbour that it must not leave, with a heading a hair too far outwards at first.
TEST(Drive, AnEdgeAtItsLimitDoesNotHoldItUp) {
  const Machine m;
  Vec2 at{delta, 0};
  Vec2 heading = unit(Vec2{0.02F, 1.0F});
  float way = 0.0F;
  for (int tick = 0; tick < 50; ++tick) {
    Guard guard;
    guard.add(rotate_back(heading, -at), delta, rate);
    const Vec2 along = unit(Vec2{-at.y, at.x});
    const Motion v = drive(guard.apply(rotate_back(heading, along)), guard, m);
    at += heading * (v.forward * m.way_in_a_round());
    heading = unit(rotate(heading, unit_vector(v.turn * m.way_in_a_round())));
    way += v.forward * m.way_in_a_round();
    EXPECT_LT(norm(at), delta + 5e-4F);
  }
  EXPECT_GT(way, 0.25F) << "of half a drive";
}

TEST(Drive, AHolonomicRobotMovesAsTold) {
  Machine m;
  m.drive = Drive::holonomic;
  const Motion v = drive({-0.5F, 0.25F}, Guard{}, m);
  EXPECT_EQ(v.forward, -0.5F);
  EXPECT_EQ(v.sideways, 0.25F);
  EXPECT_EQ(v.turn, 0.0F);
}

TEST(Drive, StandsStillForNothing) {
  const Motion v = drive({}, Guard{}, Machine{});
  EXPECT_EQ(v.forward, 0.0F);
  EXPECT_EQ(v.turn, 0.0F);
}

}  // namespace
}  // namespace banyan
