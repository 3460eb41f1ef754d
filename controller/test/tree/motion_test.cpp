// SPDX-License-Identifier: MIT
// Emergencies, avoidance, and the control law against the paper's equations.
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

TEST(Avoidance, IsFiniteOnTheSameSpot) {
  for (const float d : {0.0F, 1e-30F, 1e-23F, 1e-19F, 1e-10F, 1e-6F, 1.1e-6F, 1e-5F}) {
    ConvoyBench bench = grown();
    bench.put(5, {0.0F, d});
    bench.obstacles = {{d, 0.0F}};
    const Vec2 u = avoidance(bench.tick());
    EXPECT_TRUE(std::isfinite(u.x) && std::isfinite(u.y)) << d;
  }
}

// ---- The whole law ----

template <class Kind> class MovingOf : public testing::Test {
 protected:
  BenchOf<Kind> bench = grown<Kind>();
  void become_worker(Vec2 parent) {
    bench.params.drive = Drive::holonomic;
    if constexpr (requires { bench.state.turn; })
      bench.state.turn = 100;  // no longer the first seconds of a thin start
    bench.state.role = Role::worker;
    bench.state.parent = 9;
    auto& m = bench.put(9, parent);
    m.role = Role::root;
    m.depth = 1;
    m.label = 0;
    bench.state.label = 200;
    bench.state.depth = 2;
  }
};
using Moving = MovingOf<Convoy>;

TEST_F(Moving, BeyondDeltaARobotHurriesToItsParent) {
  become_worker({0, 0.975F});
  bench.send({0, -2.5F});
  const Motion v = bench.step().motion;
  EXPECT_NEAR(v.sideways, 1.0F, 5e-5F);
  EXPECT_NEAR(v.forward, 0.0F, 5e-5F);
}

TEST_F(Moving, TheTargetsPullFadesOnArrival) {
  become_worker({-0.65F, 0});
  bench.send({0.05F, 0});
  bench.step();
  EXPECT_NEAR(norm(bench.state.pull), bench.params.target_gain * 0.5F, 1e-4F) << "half-way into the arrival distance";
}

TEST_F(Moving, ASilentParentIsSoughtWhereItMustBe) {
  become_worker({0, 0.5F});
  bench.send({0, -2.5F});
  bench.step();
  bench.silence(9);
  const auto output = bench.steps(20);
  EXPECT_NEAR(output.motion.sideways, 1.0F, 5e-4F);
  EXPECT_TRUE(output.message.parent_silent);
}

// ---- paper ----

// ---- u_tree ----

TEST(Interaction, HasTheValuesOfTableI) {
  const HealingParams out = outwards_defaults();
  EXPECT_NEAR(interaction(0.5F, out), -0.942F, 5e-4F);
  EXPECT_NEAR(interaction(0.695F, out), -0.117F, 5e-4F);
  EXPECT_NEAR(interaction(0.95F, out), 0.0F, 1e-6F);
  EXPECT_NEAR(interaction(0.1F, out), -4027.0F, 1.0F);
  const HealingParams in = inwards_defaults();
  EXPECT_NEAR(interaction(0.5F, in), -0.326F, 5e-4F);
  EXPECT_NEAR(interaction(0.675F, in), -0.029F, 5e-4F);
  EXPECT_NEAR(interaction(0.1F, in), -1732.0F, 1.0F);
}

// Table I is in centimetres, for a radio of 2 m.
RC_GTEST_PROP(Interaction, IsThePapersFormulaInCentimeters, ()) {
  struct Column {
    HealingParams params;
    double delta, epsilon;
  };
  const Column column = *rc::gen::arbitrary<bool>() ? Column{outwards_defaults(), 190.0, 10.0}
                                                    : Column{inwards_defaults(), 154.0841, 10.0};
  const float length = number(0.075F, 1.5F);
  const double d = 200.0 * static_cast<double>(length);
  const double expected = column.epsilon / d * (std::pow(column.delta / d, 2) - std::pow(column.delta / d, 4));
  RC_ASSERT(std::fabs(static_cast<double>(interaction(length, column.params)) - expected) <=
            1e-4 * std::fabs(expected) + 1e-5);
}

TEST(Interaction, IsFiniteOnTheSameSpot) {
  for (const float d : {0.0F, 1e-30F, 1e-23F, 1e-19F, 1e-10F, 1e-6F, 1.1e-6F, 1e-5F}) {
    EXPECT_EQ(std::clamp(interaction(d, TreeParams{}), -1.0F, 1.0F), -1.0F) << d;
  }
}

// u_tree,new + u_tree,old: as printed an edge of both trees counts twice, as corrected once.
template <class Kind> float pull_of_an_edge(bool old_too) {
  BenchOf<Kind> bench = grown<Kind>();
  bench.state.role = Role::connector;
  bench.state.parent = 5;
  if (old_too) bench.state.old_parent = 5;
  auto& parent = bench.put(5, {0.675F, 0.0F});  // beyond A, within S: the spring alone
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
    EXPECT_EQ(safe_part(u, {p.safe_range - 5e-5F, 0}, p, reading), u);
    EXPECT_EQ(safe_part(u, {0, 0.15F}, p, reading), u);
  }
}

TEST(SafePart, LiteralIsNothingBeyondS) {
  const HealingParams p = outwards_defaults();
  EXPECT_EQ(safe_part({0.5F, 0.5F}, {p.safe_range + 5e-4F, 0}, p, literal_reading), Vec2{});
}

RC_GTEST_PROP(SafePart, CorrectedTakesTheAwayPartAlone, ()) {
  const HealingParams p = inwards_defaults();
  const Vec2 parent = polar(number(p.safe_range + 0.0005F, 1.0F), number(-3, 3));
  const Vec2 u = polar(number(0, 1), number(-3, 3));
  const Vec2 safe = safe_part(u, parent, p, corrected_reading);
  const Vec2 to = unit(parent);
  RC_ASSERT(dot(safe, to) >= -1e-6F);                            // never away
  RC_ASSERT(std::fabs(cross(safe, to) - cross(u, to)) < 1e-6F);  // sideways untouched
  if (dot(u, to) >= 0.0F) RC_ASSERT(distance(safe, u) < 1e-6F);  // towards untouched
}

using MovingOnPaper = MovingOf<Outwards>;

TEST_F(MovingOnPaper, AWorkerGoesForItsTarget) {
  become_worker({-0.65F, 0});
  bench.send({2.5F, 0});
  const auto& p = bench.params;
  const float expected = std::min(1.0F, p.target_gain - interaction(0.65F, p));
  const float guarded = 0.5F * (p.ideal_distance - 0.65F) * p.guard_rate;
  EXPECT_NEAR(bench.step().motion.forward, std::min(expected, guarded), 5e-4F);
}

TEST_F(MovingOnPaper, StrangersWithinARepel) {
  become_worker({0, 0.65F});
  bench.params.interaction_gain = 0.0F;
  bench.send({5e-4F, 0});
  bench.put(20, {0.1F, 0});
  const auto& p = bench.params;
  EXPECT_NEAR(bench.step().motion.forward, -std::min(1.0F, p.avoidance_gain * (p.avoidance_range / 0.1F - 1)), 1e-2F);
  bench.move(20, {p.avoidance_range + 0.005F, 0});
  EXPECT_NEAR(bench.step().motion.forward, 0.0F, 1e-2F);
}

}  // namespace
}  // namespace banyan
