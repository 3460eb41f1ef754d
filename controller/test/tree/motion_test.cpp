// SPDX-License-Identifier: MIT
// The control law against the paper's equations, and the guard against what it promises.
#include "banyan/controller/tree/motion.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "banyan/controller/core/trig.hpp"
#include "bench.hpp"
#include "numbers.hpp"

namespace banyan {
namespace {

Vec2 polar(float range, float angle) { return unit_vector(angle) * range; }

// ---- u_tree ----

TEST(Interaction, HasTheValuesOfTableI) {
  const HealingParams out = outwards_defaults();
  EXPECT_NEAR(interaction(1.00F, out), -0.942F, 5e-4F);
  EXPECT_NEAR(interaction(1.39F, out), -0.117F, 5e-4F);
  EXPECT_NEAR(interaction(1.90F, out), 0.0F, 1e-6F);
  EXPECT_NEAR(interaction(0.20F, out), -4027.0F, 1.0F);
  const HealingParams in = inwards_defaults();
  EXPECT_NEAR(interaction(1.00F, in), -0.326F, 5e-4F);
  EXPECT_NEAR(interaction(1.35F, in), -0.029F, 5e-4F);
  EXPECT_NEAR(interaction(0.20F, in), -1732.0F, 1.0F);
}

RC_GTEST_PROP(Interaction, IsThePapersFormulaInCentimeters, ()) {
  const HealingParams p = *rc::gen::arbitrary<bool>() ? outwards_defaults() : inwards_defaults();
  const float d_m = number(0.15F, 3.0F);
  const double d = 100.0 * static_cast<double>(d_m);
  const double delta = 100.0 * static_cast<double>(p.ideal_distance_m);
  const double expected =
      static_cast<double>(p.interaction_gain) / d * (std::pow(delta / d, 2) - std::pow(delta / d, 4));
  RC_ASSERT(std::fabs(static_cast<double>(interaction(d_m, p)) - expected) <= 1e-4 * std::fabs(expected) + 1e-5);
}

TEST(Interaction, IsFiniteOnTheSameSpot) {
  for (const float d_m : {0.0F, 1e-30F, 1e-23F, 1e-19F, 1e-10F, 1e-6F, 1.1e-6F, 1e-5F}) {
    EXPECT_EQ(std::clamp(interaction(d_m, TreeParams{}), -1.0F, 1.0F), -1.0F) << d_m;
  }
}

TEST(Avoidance, IsFiniteOnTheSameSpot) {
  for (const float d_m : {0.0F, 1e-30F, 1e-23F, 1e-19F, 1e-10F, 1e-6F, 1.1e-6F, 1e-5F}) {
    Bench bench = grown();
    bench.put(5, {0.0F, d_m});
    bench.obstacles = {{d_m, 0.0F}};
    const Vec2 u = avoidance(bench.tick());
    EXPECT_TRUE(std::isfinite(u.x) && std::isfinite(u.y)) << d_m;
  }
}

// u_tree,new + u_tree,old: as printed an edge of both trees counts twice, as corrected once.
template <class Kind> float pull_of_an_edge(bool old_too) {
  BenchOf<Kind> bench = grown<Kind>();
  bench.state.role = Role::connector;
  bench.state.parent = 5;
  if (old_too) bench.state.old_parent = 5;
  auto& parent = bench.put(5, {1.35F, 0.0F});  // beyond A, within S: the spring alone
  parent.committed = true;
  parent.depth = 1;
  return spring_motion(bench.tick()).x;
}

TEST(TreeForce, AnEdgeOfBothTreesCountsTwiceAsPrinted) {
  const float printed = pull_of_an_edge<OutwardsLiteral>(false);
  ASSERT_NE(printed, 0.0F);
  EXPECT_FLOAT_EQ(pull_of_an_edge<OutwardsLiteral>(true), 2.0F * printed);
  EXPECT_FLOAT_EQ(pull_of_an_edge<Outwards>(true), pull_of_an_edge<Outwards>(false));
}

// ---- f ----

TEST(SafePart, IsAllOfItUpToS) {
  const HealingParams p = outwards_defaults();
  for (const Reading& reading : {literal_reading, corrected_reading}) {
    const Vec2 u{-0.3F, 0.2F};
    EXPECT_EQ(safe_part(u, {p.safe_range_m - 1e-4F, 0}, p, reading), u);
    EXPECT_EQ(safe_part(u, {0, 0.3F}, p, reading), u);
  }
}

TEST(SafePart, LiteralIsNothingBeyondS) {
  const HealingParams p = outwards_defaults();
  EXPECT_EQ(safe_part({0.5F, 0.5F}, {p.safe_range_m + 1e-3F, 0}, p, literal_reading), Vec2{});
}

RC_GTEST_PROP(SafePart, CorrectedTakesTheAwayPartAlone, ()) {
  const HealingParams p = inwards_defaults();
  const Vec2 parent = polar(number(p.safe_range_m + 0.001F, 2.0F), number(-3, 3));
  const Vec2 u = polar(number(0, 1), number(-3, 3));
  const Vec2 safe = safe_part(u, parent, p, corrected_reading);
  const Vec2 to = unit(parent);
  RC_ASSERT(dot(safe, to) >= -1e-6F);                            // never away
  RC_ASSERT(std::fabs(cross(safe, to) - cross(u, to)) < 1e-6F);  // sideways untouched
  if (dot(u, to) >= 0.0F) RC_ASSERT(distance(safe, u) < 1e-6F);  // towards untouched
}

// ---- Guard ----

struct Edges {
  Guard guard;
  std::vector<Vec2> neighbors;
};

Edges random_edges(const TreeParams& p, float longest_m) {
  Edges edges;
  const int count = *rc::gen::inRange(1, 8);
  for (int k = 0; k < count; ++k) {
    edges.neighbors.push_back(polar(number(0.1F, longest_m), number(-3.14F, 3.14F)));
    edges.guard.add(edges.neighbors.back(), p.ideal_distance_m, p.guard_rate_per_s);
  }
  return edges;
}

RC_GTEST_PROP(Guard, LengthensNoEdgeFasterThanItsShare, ()) {
  const HealingParams p = outwards_defaults();
  const Edges edges = random_edges(p, p.ideal_distance_m);
  const Vec2 v = edges.guard.apply(polar(number(0, 0.2F), number(-3.14F, 3.14F)));
  for (const Vec2 n : edges.neighbors) {
    const float away = -dot(v, unit(n));
    RC_ASSERT(away <= 0.5F * (p.ideal_distance_m - norm(n)) * p.guard_rate_per_s + 1e-5F);
  }
}

RC_GTEST_PROP(Guard, LeavesAnAllowedVelocityAlone, ()) {
  const HealingParams p = outwards_defaults();
  const Edges edges = random_edges(p, p.ideal_distance_m);
  const Vec2 wish = polar(number(0, 0.2F), number(-3.14F, 3.14F));
  for (std::size_t k = 0; k < edges.neighbors.size(); ++k)
    if (dot(wish, edges.guard.planes[k].away()) > edges.guard.planes[k].limit_m_s) return;
  RC_ASSERT(edges.guard.apply(wish) == wish);
}

RC_GTEST_PROP(Guard, NeverPushesWhileNoEdgeIsTooLong, ()) {
  const HealingParams p = outwards_defaults();
  const Edges edges = random_edges(p, p.ideal_distance_m);
  RC_ASSERT(edges.guard.apply({}) == Vec2{});
  const Vec2 wish = polar(number(0, 0.2F), number(-3.14F, 3.14F));
  RC_ASSERT(norm(edges.guard.apply(wish)) <= norm(wish) + 1e-6F);
}

TEST(Guard, OneEdgeGivesTheNearestVelocity) {
  const HealingParams p = outwards_defaults();
  Guard guard;
  guard.add({1.8F, 0}, p.ideal_distance_m, p.guard_rate_per_s);  // may move away at 0.05 m/s
  const Vec2 v = guard.apply({-0.2F, 0.1F});
  EXPECT_NEAR(v.x, -0.05F, 1e-6F);
  EXPECT_NEAR(v.y, 0.1F, 1e-6F);
}

// Both ends of an edge wish at random and move at the velocity that the guard leaves of it.
RC_GTEST_PROP(Guard, BothEndsTogetherKeepTheEdgeWithinDelta, ()) {
  const HealingParams p = *rc::gen::arbitrary<bool>() ? outwards_defaults() : inwards_defaults();
  using W = BasicVec2<double>;
  W a{};
  W b = unit_vector(static_cast<double>(number(-3, 3))) * static_cast<double>(number(0.2F, p.ideal_distance_m));
  for (int t = 0; t < 200; ++t) {
    const auto moved = [&](W here, W there) {
      Guard guard;
      guard.add({static_cast<float>(there.x - here.x), static_cast<float>(there.y - here.y)}, p.ideal_distance_m,
                p.guard_rate_per_s);
      const Vec2 v = guard.apply(polar(0.2F, number(-3.14F, 3.14F)));
      return W{here.x + 0.1 * static_cast<double>(v.x), here.y + 0.1 * static_cast<double>(v.y)};
    };
    const W next_a = moved(a, b);
    b = moved(b, a);
    a = next_a;
    // Across the edge it grows by (v t)^2 / 2d at most, far below the share left at the next tick.
    RC_ASSERT(distance(a, b) <= static_cast<double>(p.ideal_distance_m) + 1e-3);
  }
}

TEST(Guard, AnEdgeBeyondDeltaMayOnlyShrink) {
  const HealingParams p = outwards_defaults();
  Guard guard;
  guard.add({2.0F, 0}, p.ideal_distance_m, p.guard_rate_per_s);
  EXPECT_LT(dot(guard.apply({-0.1F, 0}), Vec2{-1, 0}), 0.0F);
  EXPECT_EQ(drive({0.1F, 0}, guard, p).forward_m_s, 0.1F) << "towards it is free";
}

// ---- Unicycle ----

RC_GTEST_PROP(Drive, WheelsKeepTheirLimitAndTurnComesFirst, ()) {
  const HealingParams p = outwards_defaults();
  const float speed = number(0.001F, 0.2F);
  const float theta = number(-3.1F, 3.1F);
  const Velocity v = drive(polar(speed, theta), Guard{}, p);
  const float half = 0.5F * v.turn_rad_s * p.wheel_distance_m;
  RC_ASSERT(std::fabs(v.forward_m_s - half) <= p.wheel_limit_m_s + 1e-5F);
  RC_ASSERT(std::fabs(v.forward_m_s + half) <= p.wheel_limit_m_s + 1e-5F);
  RC_ASSERT(v.sideways_m_s == 0.0F);
  const float turn_limit = 2.0F * p.wheel_limit_m_s / p.wheel_distance_m;
  RC_ASSERT(std::fabs(v.turn_rad_s - std::clamp(4.0F * theta, -turn_limit, turn_limit)) < 1e-4F);
  const float wished = speed * std::max(0.0F, std::cos(theta));
  RC_ASSERT(std::fabs(v.forward_m_s - std::min(wished, std::max(0.0F, p.wheel_limit_m_s - std::fabs(half)))) < 1e-5F);
}

RC_GTEST_PROP(Drive, TheGuardHoldsAlongTheTrueHeadingToo, ()) {
  const HealingParams p = outwards_defaults();
  const Edges edges = random_edges(p, p.ideal_distance_m);
  const Velocity v = drive(polar(0.2F, number(-1, 1)), edges.guard, p);
  RC_ASSERT(v.forward_m_s >= 0.0F);
  for (int k = 0; k < edges.guard.size; ++k) {
    const Guard::HalfPlane& plane = edges.guard.planes[static_cast<std::size_t>(k)];
    RC_ASSERT(v.forward_m_s * plane.x <= plane.limit_m_s + 1e-5F);
  }
}

// Round a neighbour that it must not leave, with a heading a hair too far outwards at first.
TEST(Drive, AnEdgeAtItsLimitDoesNotHoldItUp) {
  const HealingParams p = outwards_defaults();
  Vec2 at{p.ideal_distance_m, 0};
  Vec2 heading = unit(Vec2{0.02F, 1.0F});
  float way_m = 0.0F;
  for (int tick = 0; tick < 50; ++tick) {
    Guard guard;
    guard.add(rotate_back(heading, -at), p.ideal_distance_m, p.guard_rate_per_s);
    const Vec2 along = unit(Vec2{-at.y, at.x});
    const Velocity v = drive(guard.apply(rotate_back(heading, along * 0.2F)), guard, p);
    at += heading * (v.forward_m_s * p.tick_s);
    heading = unit(rotate(heading, unit_vector(v.turn_rad_s * p.tick_s)));
    way_m += v.forward_m_s * p.tick_s;
    EXPECT_LT(norm(at), p.ideal_distance_m + 1e-3F);
  }
  EXPECT_GT(way_m, 0.5F) << "of 1 m";
}

TEST(Drive, AHolonomicRobotMovesAsTold) {
  TreeParams p;
  p.drive = Drive::holonomic;
  const Velocity v = drive({-0.1F, 0.05F}, Guard{}, p);
  EXPECT_EQ(v.forward_m_s, -0.1F);
  EXPECT_EQ(v.sideways_m_s, 0.05F);
  EXPECT_EQ(v.turn_rad_s, 0.0F);
}

TEST(Drive, StandsStillForNothing) {
  const Velocity v = drive({}, Guard{}, TreeParams{});
  EXPECT_EQ(v.forward_m_s, 0.0F);
  EXPECT_EQ(v.turn_rad_s, 0.0F);
}

// ---- The whole law ----

class Moving : public testing::Test {
 protected:
  Bench bench = grown();
  void become_worker(Vec2 parent) {
    bench.params.drive = Drive::holonomic;
    bench.state.role = Role::worker;
    bench.state.parent = 9;
    auto& m = bench.put(9, parent);
    m.role = Role::root;
    m.depth = 1;
    m.label_cm = 0;
    bench.state.label_cm = 200;
    bench.state.depth = 2;
  }
};

TEST_F(Moving, BeyondDeltaARobotHurriesToItsParent) {
  become_worker({0, 1.95F});
  bench.params.communication_range_m = 2.0F;
  bench.send({0, -5});
  const Velocity v = bench.step().velocity;
  EXPECT_NEAR(v.sideways_m_s, 0.2F, 1e-5F);
  EXPECT_NEAR(v.forward_m_s, 0.0F, 1e-5F);
}

TEST_F(Moving, AWorkerGoesForItsTargetAndSlowsDownOnArrival) {
  become_worker({-1.3F, 0});
  bench.send({5, 0});
  const auto& p = bench.params;
  const float expected = std::min(1.0F, p.target_gain - interaction(1.3F, p));
  EXPECT_NEAR(bench.step().velocity.forward_m_s, std::min(0.2F * expected, 0.5F * (p.ideal_distance_m - 1.3F)), 1e-4F);
  bench.move(9, {-1.9F, 0});
  bench.send({0.1F, 0});
  bench.step();
  EXPECT_NEAR(norm(bench.state.pull), p.target_gain * 0.5F, 1e-4F) << "half-way into the arrival distance";
}

TEST_F(Moving, StrangersWithinARepel) {
  become_worker({0, 1.3F});
  bench.params.interaction_gain = 0.0F;
  bench.send({1e-3F, 0});
  bench.put(20, {0.2F, 0});
  const auto& p = bench.params;
  EXPECT_NEAR(bench.step().velocity.forward_m_s,
              -0.2F * std::min(1.0F, p.avoidance_gain * (p.avoidance_range_m / 0.2F - 1)), 2e-3F);
  bench.move(20, {p.avoidance_range_m + 0.01F, 0});
  EXPECT_NEAR(bench.step().velocity.forward_m_s, 0.0F, 2e-3F);
}

TEST_F(Moving, ASilentParentIsSoughtWhereItMustBe) {
  become_worker({0, 1.0F});
  bench.send({0, -5});
  bench.step();
  bench.silence(9);
  const auto output = bench.steps(20);
  EXPECT_NEAR(output.velocity.sideways_m_s, 0.2F, 1e-4F);
  EXPECT_TRUE(output.message.parent_silent);
}

}  // namespace
}  // namespace banyan
