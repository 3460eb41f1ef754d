// SPDX-License-Identifier: MIT
// Sec. III-G: the control law against the paper's equations, and what corrected adds.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "banyan/controller/core/trig.hpp"
#include "bench.hpp"
#include "numbers.hpp"

namespace banyan::paper {
namespace {

// ---- u_tree ----

// Table I is in centimetres, for a radio of 200 cm.
RC_GTEST_PROP(PaperInteraction, IsThePapersFormulaInCentimeters, ()) {
  const bool out = *rc::gen::arbitrary<bool>();
  const double delta = out ? 190.0 : 154.0841, epsilon = 10.0;
  const float length = number(0.075F, 1.5F);
  const double d = 200.0 * static_cast<double>(length);
  const double expected = epsilon / d * (std::pow(delta / d, 2) - std::pow(delta / d, 4));
  const float u = interaction(length, out ? outwards_column() : inwards_column());
  RC_ASSERT(std::fabs(static_cast<double>(u) - expected) <= 1e-4 * std::fabs(expected) + 1e-5);
}

TEST(PaperInteraction, IsFiniteOnTheSameSpot) {
  for (const float d : {0.0F, 1e-30F, 1e-23F, 1e-19F, 1e-10F, 1e-6F, 1.1e-6F, 1e-5F}) {
    EXPECT_EQ(std::clamp(interaction(d, outwards_column()), -1.0F, 1.0F), -1.0F) << d;
    BenchOf<Outwards> bench = grown<Outwards>();
    bench.put(5, {0.0F, d});
    bench.obstacles = {{d, 0.0F}};
    EXPECT_TRUE(std::isfinite(bench.step().motion.forward)) << d;
  }
}

// A robot of the tree that drives where it wants.
template <class Kind> BenchOf<Kind> driving(Vec2 parent, bool worker = true) {
  BenchOf<Kind> bench = grown<Kind>();
  bench.params.drive = Drive::holonomic;
  bench.state.role = worker ? Role::worker : Role::connector;
  bench.state.parent = 9;
  auto& m = bench.put(9, parent);
  m.depth = 1;
  m.committed = true;
  if (worker) bench.send({1e-4F, 0});
  else bench.put_child(20, {0, -0.95F}, Role::worker);  // at delta: its spring is slack
  return bench;
}
template <class Kind> Vec2 velocity(BenchOf<Kind>& bench) {
  const Motion motion = bench.step().motion;
  return {motion.forward, motion.sideways};
}

// An edge of both trees counts twice as printed, once as corrected.
TEST(PaperTree, AnEdgeOfBothTreesCountsTwiceAsPrinted) {
  const auto pull = []<class Kind>(BenchOf<Kind> bench, bool old_too) {
    if (old_too) bench.state.phase = bench.say(9).phase = Phase::select_parent, bench.state.old_parent = 9;
    return velocity(bench).x;
  };
  const float once = pull(driving<OutwardsLiteral>({0.675F, 0}), false);
  ASSERT_LT(once, -0.05F);
  EXPECT_NEAR(pull(driving<OutwardsLiteral>({0.675F, 0}), true), 2.0F * once, 1e-3F);
  EXPECT_NEAR(pull(driving<Outwards>({0.675F, 0}), true), once, 1e-3F);
}

// ---- f ----

TEST(PaperF, IsOneUpToSAndNothingBeyondAsPrinted) {
  const float S = outwards_column().safe_range;
  const auto along = [](auto bench) {
    bench.params.interaction_gain = 0.0F;
    bench.send({0, 2.0F});  // across
    return velocity(bench).y;
  };
  EXPECT_NEAR(along(driving<OutwardsLiteral>({S - 1e-3F, 0})), 0.49F, 1e-4F);
  EXPECT_EQ(along(driving<OutwardsLiteral>({S + 1e-3F, 0})), 0.0F);
  EXPECT_NEAR(along(driving<Outwards>({S + 1e-3F, 0})), 0.49F, 1e-4F);
}

RC_GTEST_PROP(PaperF, CorrectedTakesTheAwayPartAlone, ()) {
  BenchOf<Inwards> bench = driving<Inwards>({});
  bench.params.interaction_gain = 0.0F;
  const Params& p = bench.params;
  const Vec2 parent = polar(number(p.safe_range + 5e-4F, p.ideal_distance - 0.01F), number(-3, 3));
  const Vec2 target = polar(2.0F, number(-3, 3));
  bench.move(9, parent);
  bench.send(target);
  const Vec2 u = unit(target) * p.target_gain;
  const Vec2 safe = velocity(bench);
  const Vec2 to = unit(parent);
  RC_ASSERT(dot(safe, to) >= -1e-5F);                                      // never away
  const bool stands = safe == Vec2{} && std::fabs(cross(u, to)) < 6e-4F;   // so slow that it is no motion
  RC_ASSERT(stands || std::fabs(cross(safe, to) - cross(u, to)) < 1e-5F);  // sideways untouched
  if (dot(u, to) >= 0.0F) RC_ASSERT(distance(safe, u) < 1e-5F);            // towards untouched
}

// ---- The whole law ----

TEST(PaperMotion, BeyondTheEmergencyRangeIsStraightToTheParent) {
  for (const bool silent : {false, true}) {
    auto bench = driving<Outwards>(silent ? Vec2{0, 0.5F} : Vec2{0, 0.96F});
    bench.send({2.0F, 0});
    bench.step();
    if (silent) bench.silence(9), bench.steps(12);
    const Vec2 v = velocity(bench);
    EXPECT_NEAR(v.x, 0.0F, 1e-4F) << silent;
    EXPECT_NEAR(v.y, 1.0F, 1e-3F) << silent;
  }
}

TEST(PaperMotion, AWorkerGoesForItsTargetAndSpringsAdd) {
  auto bench = driving<Outwards>({-0.65F, 0});
  bench.send({2.5F, 0});
  const Params& p = bench.params;
  const float expected = std::min(1.0F, p.target_gain - interaction(0.65F, p));
  const float guarded = 0.5F * (p.ideal_distance - 0.65F) * p.guard_rate;
  EXPECT_NEAR(velocity(bench).x, std::min(expected, guarded), 5e-4F);
}

TEST(PaperMotion, AConnectorIsPulledByItsChild) {
  auto bench = driving<OutwardsLiteral>({0, 0.5F}, false);
  bench.params.interaction_gain = 0.0F;
  bench.say(20).pull_x = 0;
  bench.say(20).pull_y = -8192;  // to the right of the edge from the child to me, which is to the right here
  const Vec2 v = velocity(bench);
  EXPECT_NEAR(v.x, 0.5F, 1e-3F);
  EXPECT_NEAR(v.y, 0.0F, 1e-3F);
}

TEST(PaperMotion, StrangersWithinARepel) {
  auto bench = driving<Outwards>({0, 0.65F});
  bench.params.interaction_gain = 0.0F;
  bench.put(20, {0.1F, 0});
  const Params& p = bench.params;
  EXPECT_NEAR(velocity(bench).x, -std::min(1.0F, p.avoidance_gain * (p.avoidance_range / 0.1F - 1)), 1e-2F);
  bench.move(20, {p.avoidance_range + 0.005F, 0});
  EXPECT_NEAR(velocity(bench).x, 0.0F, 1e-2F);
}

TEST(PaperMotion, ObstaclesRepelAndAreNotPushedAsCorrected) {
  const auto drives_on = [](auto bench) {
    bench.send({1.5F, 0.0F});
    bench.obstacles = {{0.045F, 0.0F}};
    return velocity(bench).x > 0.05F;
  };
  EXPECT_TRUE(drives_on(driving<OutwardsLiteral>({-0.5F, 0})));
  EXPECT_FALSE(drives_on(driving<Outwards>({-0.5F, 0})));
}

TEST(PaperMotion, AnOrphanStandsStill) {
  auto bench = driving<Outwards>({0, 0.5F});
  bench.say(9).depth = invalid_depth;
  bench.send({2.0F, 0});
  bench.steps(5);
  EXPECT_GT(velocity(bench).x + 1.0F, 0.99F);
  EXPECT_EQ(velocity(bench), Vec2{});
}

TEST(PaperMotion, BeforeAnybodyIsHeardNobodyDrivesAsCorrected) {
  const auto drives = []<class Kind>(BenchOf<Kind> bench) {
    bench.state = Kind::initial(1, true, false);
    bench.send({2.5F, 0.0F});
    return bench.step().motion.forward > 0.1F;
  };
  EXPECT_FALSE(drives(BenchOf<Outwards>{}));
  EXPECT_TRUE(drives(BenchOf<OutwardsLiteral>{}));
}

// ---- The guard ----

// Whatever a robot wants, it lengthens no edge faster than its half of the room divided by the time constant.
RC_GTEST_PROP(PaperGuard, NoEdgeIsLengthenedFasterThanItsHalf, ()) {
  auto bench = driving<Outwards>({});
  const Params& p = bench.params;
  const Vec2 parent = polar(number(0.3F, p.ideal_distance - 0.001F), number(-3, 3));
  const Vec2 child = polar(number(0.3F, p.ideal_distance - 0.001F), number(-3, 3));
  bench.move(9, parent);
  bench.put_child(20, child, Role::connector);
  bench.send(polar(number(0.2F, 3.0F), number(-3, 3)));
  const Vec2 v = velocity(bench);
  for (const Vec2 end : {parent, child}) {
    const float limit = 0.5F * (p.ideal_distance - norm(end)) * p.guard_rate;
    RC_ASSERT(-dot(v, unit(end)) <= limit + 1e-3F);
  }
}

// A robot that has no parent stays in range of the neighbour through which it is tied, and says which.
TEST(PaperHold, TiesARobotWithoutAParent) {
  auto bench = grown<Outwards>();
  bench.params.drive = Drive::holonomic;
  bench.state.label = 300;
  bench.send({2.0F, 0});
  auto& m = bench.put_connector(5, {-0.94F, 0}, 100, 0);
  m.parent = 9;
  m.epoch = 1;
  bench.state.search_ticks = 0;
  const auto output = bench.step();
  if (output.message.parent == nobody) { EXPECT_EQ(output.message.hold, 5); }
  EXPECT_LE(output.motion.forward, 0.5F * (0.95F - 0.94F) * bench.params.guard_rate + 1e-3F);
}

TEST(PaperHold, IsNamedByFreeSparesOfTheCorrectedReadingOnly) {
  const auto hold = []<class Kind>(BenchOf<Kind> bench) {
    bench.state.label = 300;
    bench.put_connector(5, {0.5F, 0}, 100, 0);
    bench.put_connector(6, {0, 0.7F}, 50, 0);
    return bench.step().message.hold;
  };
  EXPECT_EQ(hold(grown<Outwards>()), 5) << "the nearest of the tree";
  EXPECT_EQ(hold(grown<OutwardsLiteral>()), nobody);
}

}  // namespace
}  // namespace banyan::paper
