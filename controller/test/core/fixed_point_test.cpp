// SPDX-License-Identifier: MIT
// Lengths and places as they travel, against exact arithmetic.
#include "banyan/controller/core/fixed_point.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "numbers.hpp"

namespace banyan {
namespace {

// The finest of the four steps with which 14 bits reach so far, and where it ends, C.
struct Scale {
  double step, reach;
};
constexpr std::array<Scale, 4> scales{
    {{1.0 / 256, 8191.0 / 256}, {1.0 / 64, 8191.0 / 64}, {1.0 / 16, 8191.0 / 16}, {0.25, 8191.0 / 4}}};

// Of a length near a step of any scale, near the end of one, or anywhere, with any sign.
float place() {
  const Scale s = *rc::gen::elementOf(scales);
  const float sign = *rc::gen::arbitrary<bool>() ? 1.0F : -1.0F;
  switch (*rc::gen::inRange(0, 3)) {
    case 0: return sign * number(0.0F, static_cast<float>(s.reach));
    case 1: return sign * static_cast<float>(s.reach) * number(0.999F, 1.001F);
    default:
      return sign * static_cast<float>(s.step) * (static_cast<float>(*rc::gen::inRange(0, 8192)) + number(-1, 1));
  }
}

RC_GTEST_PROP(Coordinate, ErrsByHalfAStepOfTheFinestScaleThatReaches, ()) {
  const float x = place();
  for (const Scale& s : scales) {
    if (std::fabs(static_cast<double>(x)) > s.reach) continue;
    RC_LOG() << x << " as " << Coordinate::of(x).value();
    RC_ASSERT(std::fabs(static_cast<double>(Coordinate::of(x).value()) - static_cast<double>(x)) <= 0.5 * s.step);
    return;
  }
  RC_ASSERT(std::fabs(Coordinate::of(x).value()) == 8191.0F / 4.0F);  // the nearest there is
}

RC_GTEST_PROP(Coordinate, KeepsTheOrder, ()) {
  const float a = place(), b = place();
  const float c = a + 0.01F * number(-1, 1);  // and of two that are close together
  for (const float other : {b, c})
    RC_ASSERT(Coordinate::of(std::min(a, other)).value() <= Coordinate::of(std::max(a, other)).value());
}

// A place that is passed on and on does not drift.
RC_GTEST_PROP(Coordinate, IsExactForWhatItHasWritten, ()) {
  const Coordinate once = Coordinate::of(place());
  RC_ASSERT(Coordinate::of(once.value()) == once);
}

TEST(Coordinate, WhateverBitsArriveAreAPlace) {
  for (int bits = INT16_MIN; bits <= INT16_MAX; ++bits) {
    const float value = Coordinate{static_cast<std::int16_t>(bits)}.value();
    ASSERT_TRUE(std::fabs(value) <= 2048.0F) << bits;
    ASSERT_EQ(Coordinate::of(value).value(), std::clamp(value, -2047.75F, 2047.75F)) << bits;
  }
}

TEST(Coordinate, HasKnownValues) {
  EXPECT_EQ(Coordinate{}.value(), 0.0F);
  EXPECT_EQ(Coordinate::of(0.0F), Coordinate{});
  EXPECT_EQ(Coordinate::of(-0.0F), Coordinate{});
  EXPECT_EQ(Coordinate::of(1.0F).value(), 1.0F);
  EXPECT_EQ(Coordinate::of(-0.5F).value(), -0.5F);
  EXPECT_EQ(Coordinate::of(200.0F).value(), 200.0F);
  EXPECT_EQ(Coordinate::of(2000.0F).value(), 2000.0F) << "not cut off";
  EXPECT_EQ(Coordinate::of(-2000.0F).value(), -2000.0F);
  EXPECT_EQ(Coordinate::of(1e9F).value(), 2047.75F);
  EXPECT_EQ(Coordinate::of(-1e9F).value(), -2047.75F);
}

RC_GTEST_PROP(Length, ErrsByHalfAStepAndIsCutOffAt255C, ()) {
  const float x = number(0.0F, 300.0F);
  const float back = from_fixed(to_fixed<std::uint16_t>(x, per_range));
  if (x < 65535.0F / 256.0F) RC_ASSERT(std::fabs(static_cast<double>(back) - static_cast<double>(x)) <= 0.5 / 256);
  else RC_ASSERT(back == 65535.0F / 256.0F);
}

}  // namespace
}  // namespace banyan
