// SPDX-License-Identifier: MIT
// Ranges and ticks of axes.
#include "../../src/figure/figure_axis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

namespace banyan::study {
namespace {

AxisExtent of(std::initializer_list<double> values) {
  AxisExtent extent;
  for (const double v : values) extent.add(v);
  return extent;
}

TEST(FigureAxis, BeginsAtZeroUnlessAValueIsBelow) {
  const FigureAxis shares = axis_over(of({0.3, 1.0}), {}, {}, true, 0.04, 6);
  EXPECT_EQ(shares.low, 0.0);
  EXPECT_DOUBLE_EQ(shares.high, 1.04);
  ASSERT_EQ(shares.ticks.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(shares.ticks[i].at, 0.2 * static_cast<double>(i), 1e-12);
  EXPECT_EQ(shares.ticks[0].label + shares.ticks[5].label, "0.01.0");
  EXPECT_EQ(axis_over(of({0.0, 2.0}), {}, {}, true, 0.0, 2).tick_list(), "(\"0\" 0, \"1\" 1, \"2\" 2)");
  EXPECT_EQ(axis_over(of({0.0, 2.0}), {}, {}, true, 0.0, 2).tick_list(false), "(\"\" 0, \"\" 1, \"\" 2)");
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
  for (const AxisExtent& extent :
       {of({}), of({nan}), of({0.0}), of({0.0, 0.0}), of({-3.0}), of({5.0}), of({1e-9, 3e-9}), of({1e6, 1e6 + 1}),
        of({-1e12, 1e12}), of({1e-300}), of({-0.1, -0.05})}) {
    for (const bool zero : {true, false}) {
      for (const auto& [low, high] : ends) {
        const FigureAxis axis = axis_over(extent, low, high, zero, 0.04, 6);
        ASSERT_LT(axis.low, axis.high) << extent.low;
        ASSERT_GE(axis.ticks.size(), 2U) << extent.low << " " << extent.high;
        EXPECT_LE(axis.ticks.size(), 7U);
        const double step = axis.ticks[1].at - axis.ticks[0].at;
        EXPECT_GE(axis.ticks.front().at, axis.low - 1e-6 * step);
        EXPECT_LE(axis.ticks.back().at, axis.high + 1e-6 * step);
        const double digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
        EXPECT_TRUE(std::fabs(digit - 1) < 1e-3 || std::fabs(digit - 2) < 1e-3 || std::fabs(digit - 5) < 1e-3) << digit;
        EXPECT_GT(axis.label_width(12.0), 0.0);
        EXPECT_LT(axis.label_width(12.0), 120.0);
      }
    }
  }
}

// Powers of ten with their double and fivefold; without these where there are many; round steps within a decade.
TEST(FigureAxis, ALogarithmicOneHasTicksAtPowers) {
  const auto labels = [](const FigureAxis& axis) {
    std::string text;
    for (const AxisTick& tick : axis.ticks) text += tick.label + " ";
    return text;
  };
  EXPECT_EQ(labels(log_axis_over(of({0.3, 12.0}), {}, {}, false, 6)), "0.5 1 2 5 10 ");
  EXPECT_EQ(labels(log_axis_over(of({0.03, 120.0}), {}, {}, false, 6)), "0.1 1 10 100 ");
  EXPECT_EQ(labels(log_axis_over(of({1e-9, 1e9}), {}, {}, false, 5)), "1e-08 0.0001 1 10000 1e+08 ");
  EXPECT_EQ(labels(log_axis_over(of({1.3, 4.9}), {}, {}, false, 5)), "2 3 4 5 ");
  EXPECT_EQ(labels(log_axis_over(of({0.5, 10.0}), {}, {}, true, 6)), "0 0.5 1 2 5 10 ");
  EXPECT_EQ(labels(log_axis_over(of({0.5, 10.0}), 0.2, 20.0, true, 7)), "0.2 0.5 1 2 5 10 20 ") << "a given end stays";
}

TEST(FigureAxis, ALogarithmicOneHasASizeForAnyValues) {
  const std::vector<std::pair<std::optional<double>, std::optional<double>>> ends{{{}, {}},   {2e13, {}}, {{}, 2e13},
                                                                                  {{}, 1e-9}, {1e-9, {}}, {0.1, 3.0}};
  for (const AxisExtent& extent :
       {of({}), of({5.0}), of({1e-9, 3e-9}), of({1e6, 1e6 + 1}), of({1e-300}), of({1e-12, 1e12})}) {
    for (const bool zeros : {true, false}) {
      for (const auto& [low, high] : ends) {
        const FigureAxis axis = log_axis_over(extent, low, high, zeros, 6);
        ASSERT_GT(axis.low, 0.0);
        ASSERT_LT(axis.low, axis.high);
        EXPECT_GE(axis.ticks.size(), 1U) << axis.low << " " << axis.high;
        EXPECT_LE(axis.ticks.size(), 9U);
        for (std::size_t i = 1; i < axis.ticks.size(); ++i) EXPECT_GT(axis.ticks[i].at, axis.ticks[i - 1].at);
        if (!low) { EXPECT_LE(axis.low, extent.any ? std::min(extent.low, high.value_or(extent.low)) : 1e300); }
      }
    }
  }
}

}  // namespace
}  // namespace banyan::study
