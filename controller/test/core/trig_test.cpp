// SPDX-License-Identifier: MIT
// Our own sine, cosine and arc tangent against the C library's, to the accuracy that trig.hpp
// states; vectors and edge frames built on them.
#include "banyan/controller/core/trig.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "banyan/controller/core/edge_frame.hpp"

namespace banyan {
namespace {

double double_between(double low, double high) {
  constexpr int steps = 1 << 30;
  return low + (high - low) * static_cast<double>(*rc::gen::inRange(0, steps)) / steps;
}
Vec2 vector(double limit) {
  return {static_cast<float>(double_between(-limit, limit)), static_cast<float>(double_between(-limit, limit))};
}

TEST(Trig, UnitVectorAgreesWithTheLibraryInDoublePrecision) {
  double worst = 0.0;
  for (int k = -400'000; k <= 400'000; ++k) {
    const double angle = k * 0.0249;  // up to 9960
    const BasicVec2<double> v = unit_vector(angle);
    worst = std::max({worst, std::fabs(v.x - std::cos(angle)), std::fabs(v.y - std::sin(angle))});
  }
  EXPECT_LT(worst, 4e-11);
}

TEST(Trig, UnitVectorAgreesWithTheLibraryInSinglePrecision) {
  for (int k = -40'000; k <= 40'000; ++k) {
    const float angle = static_cast<float>(k) * 0.001F;
    const Vec2 v = unit_vector(angle);
    ASSERT_NEAR(v.x, std::cos(static_cast<double>(angle)), 1e-6) << angle;
    ASSERT_NEAR(v.y, std::sin(static_cast<double>(angle)), 1e-6) << angle;
  }
}

TEST(Trig, AngleOfAgreesWithTheLibrary) {
  double worst = 0.0;
  for (int k = 0; k < 500'000; ++k) {
    const double angle = -3.141592 + k * 1.25663e-5;
    const double length = 1e-3 + (k % 97) * 13.0;
    const BasicVec2<double> v{length * std::cos(angle), length * std::sin(angle)};
    worst = std::max(worst, std::fabs(angle_of(v) - std::atan2(v.y, v.x)));
    const Vec2 f{static_cast<float>(v.x), static_cast<float>(v.y)};
    ASSERT_NEAR(angle_of(f), std::atan2(static_cast<double>(f.y), static_cast<double>(f.x)), 1e-6) << angle;
  }
  EXPECT_LT(worst, 2e-11);
}

TEST(Trig, AngleOfTheAxes) {
  EXPECT_EQ(angle_of(Vec2{}), 0.0F);
  EXPECT_EQ(angle_of(Vec2{1, 0}), 0.0F);
  EXPECT_FLOAT_EQ(angle_of(Vec2{0, 1}), pi<float> / 2);
  EXPECT_FLOAT_EQ(angle_of(Vec2{-1, 0}), pi<float>);
  EXPECT_FLOAT_EQ(angle_of(Vec2{0, -1}), -pi<float> / 2);
  EXPECT_FLOAT_EQ(angle_of(Vec2{-1, -1}), -3 * pi<float> / 4);
}

RC_GTEST_PROP(Trig, AngleOfUndoesUnitVector, ()) {
  const double angle = double_between(-3.14159, 3.14159);
  RC_ASSERT(std::fabs(angle_of(unit_vector(angle)) - angle) < 1e-10);
}

TEST(Vec2, TheZeroVectorHasNoDirection) { EXPECT_EQ(unit(Vec2{}), Vec2{}); }

RC_GTEST_PROP(Vec2, RotatingBackUndoesARotation, ()) {
  const Vec2 rotation = unit_vector(static_cast<float>(double_between(-10, 10)));
  const Vec2 v = vector(10);
  RC_ASSERT(distance(rotate_back(rotation, rotate(rotation, v)), v) < 1e-4F);
  RC_ASSERT(std::fabs(norm(rotate(rotation, v)) - norm(v)) < 1e-4F);
}

// Two robots with random headings see each other, and nothing else of the world. A vector that one
// sends over the edge arrives as the same arrow in the world.
RC_GTEST_PROP(EdgeFrame, AnArrowArrivesAsTheSameArrow, ()) {
  using W = BasicVec2<double>;
  const W sender_at{double_between(-5, 5), double_between(-5, 5)};
  const W edge = unit_vector(double_between(-3.14, 3.14)) * double_between(0.1, 2.0);
  const W sender_heading = unit_vector(double_between(-3.14, 3.14));
  const W addressee_heading = unit_vector(double_between(-3.14, 3.14));
  const W arrow{double_between(-9, 9), double_between(-9, 9)};
  const auto seen = [](W heading, W from, W to) {
    const W d = rotate_back(heading, to - from);
    return Vec2{static_cast<float>(d.x), static_cast<float>(d.y)};
  };
  const W own = rotate_back(sender_heading, arrow);
  const Vec2 sent = to_edge_frame({static_cast<float>(own.x), static_cast<float>(own.y)},
                                  seen(sender_heading, sender_at, sender_at + edge));
  const Vec2 got = from_edge_frame(sent, seen(addressee_heading, sender_at + edge, sender_at));
  const W expected = rotate_back(addressee_heading, arrow);
  RC_ASSERT(std::fabs(got.x - expected.x) < 1e-4);
  RC_ASSERT(std::fabs(got.y - expected.y) < 1e-4);
}

TEST(EdgeFrame, TheXAxisPointsFromTheSenderToTheAddressee) {
  const Vec2 addressee{0, 2};
  EXPECT_NEAR(to_edge_frame({0, 3}, addressee).x, 3.0F, 1e-6F);   // straight towards it
  EXPECT_NEAR(to_edge_frame({-1, 0}, addressee).y, 1.0F, 1e-6F);  // to the left of the edge
}

}  // namespace
}  // namespace banyan
