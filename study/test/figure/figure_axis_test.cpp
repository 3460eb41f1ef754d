// SPDX-License-Identifier: MIT
// Ranges and ticks of axes.
#include "../../src/figure/figure_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

namespace banyan::study {
namespace {

Extent of(std::initializer_list<double> values) {
  Extent extent;
  for (const double v : values) extent.add(v);
  return extent;
}

TEST(FigureAxis, BeginsAtZeroUnlessAValueIsBelow) {
  const FigureAxis shares = axis_over(of({0.3, 1.0}), {}, {}, true, 0.04, 6);
  EXPECT_EQ(shares.low, 0.0);
  EXPECT_DOUBLE_EQ(shares.high, 1.04);
  EXPECT_EQ(shares.first_tick, 0.0);
  EXPECT_DOUBLE_EQ(shares.step, 0.2);
  EXPECT_EQ(shares.format(), "%.1f");
  EXPECT_LT(axis_over(of({-0.3, 1.0}), {}, {}, true, 0.04, 6).low, -0.3);
  EXPECT_EQ(axis_over(of({20.0, 40.0}), {}, {}, false, 0.0, 6).low, 20.0);
}

TEST(FigureAxis, KeepsGivenEnds) {
  const FigureAxis axis = axis_over(of({0.3, 5.0}), 0.2, 0.8, true, 0.04, 6);
  EXPECT_EQ(axis.low, 0.2);
  EXPECT_EQ(axis.high, 0.8);
  EXPECT_EQ(axis_over(of({0.3, 5.0}), 7.0, {}, true, 0.04, 6).low, 7.0) << "all values below it";
  const FigureAxis below = axis_over(of({0.3, 5.0}), {}, -7.0, true, 0.04, 6);
  EXPECT_EQ(below.high, -7.0) << "all values above it";
  EXPECT_LT(below.low, -7.0);
}

TEST(FigureAxis, HasRoundTicksAndASizeForAnyValues) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::optional<double>, std::optional<double>>> ends{
      {{}, {}}, {-2e13, {}}, {2e13, {}}, {{}, -2e13}, {{}, 2e13}, {0.0, {}}, {{}, 0.0}, {-1.0, 3.0}};
  for (const Extent& extent : {of({}), of({nan}), of({0.0}), of({0.0, 0.0}), of({-3.0}), of({5.0}), of({1e-9, 3e-9}),
                               of({1e6, 1e6 + 1}), of({-1e12, 1e12}), of({1e-300}), of({-0.1, -0.05})}) {
    for (const bool zero : {true, false}) {
      for (const auto& [low, high] : ends) {
        const FigureAxis axis = axis_over(extent, low, high, zero, 0.04, 6);
        ASSERT_LT(axis.low, axis.high) << extent.low;
        ASSERT_LE(axis.low, axis.first_tick + 1e-6 * axis.step);
        const double ticks = (axis.high - axis.first_tick) / axis.step;
        EXPECT_GE(ticks, 1.0) << extent.low << " " << extent.high;
        EXPECT_LE(ticks, 6.0 + 1e-9);
        const double digit = axis.step / std::pow(10.0, std::floor(std::log10(axis.step) + 1e-9));
        EXPECT_TRUE(std::fabs(digit - 1) < 1e-6 || std::fabs(digit - 2) < 1e-6 || std::fabs(digit - 5) < 1e-6) << digit;
        EXPECT_GT(axis.label_width_px(12.0), 0.0);
        EXPECT_LT(axis.label_width_px(12.0), 120.0);
      }
    }
  }
}

}  // namespace
}  // namespace banyan::study
