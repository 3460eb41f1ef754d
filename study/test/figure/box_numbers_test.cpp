// SPDX-License-Identifier: MIT
// The numbers of a box, against R 4's quantile(type = 7) and against counting.
#include "../../src/figure/box_numbers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "banyan/world/random.hpp"

namespace banyan::study {
namespace {

using Values = std::vector<double>;

TEST(FigureNumbers, AreTukeysForAKnownSet) {
  // quantile(c(1:10, 100), c(.25, .5, .75)) is 3.5, 6, 8.5: whiskers may reach from -4 to 16.
  const BoxNumbers box = numbers_of({7, 100, 3, 1, 10, 5, 2, 8, 4, 6, 9});
  EXPECT_EQ(box.low, 1.0);
  EXPECT_EQ(box.lower, 3.5);
  EXPECT_EQ(box.median, 6.0);
  EXPECT_EQ(box.upper, 8.5);
  EXPECT_EQ(box.high, 10.0);
  EXPECT_EQ(box.outliers, (Values{100}));
}

TEST(FigureNumbers, HaveOutliersBelowToo) {
  // quantile(c(-50, -40, 10:19), ...) is 11.75 - ... of 12 values: 10.75, 13.5, 16.25; reach 8.25.
  const BoxNumbers box = numbers_of({-50, -40, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19});
  EXPECT_EQ(box.lower, 10.75);
  EXPECT_EQ(box.median, 13.5);
  EXPECT_EQ(box.upper, 16.25);
  EXPECT_EQ(box.low, 10.0);
  EXPECT_EQ(box.high, 19.0);
  EXPECT_EQ(box.outliers, (Values{-50, -40}));
}

TEST(FigureNumbers, OfOneOrEqualValuesAreThatValue) {
  for (const Values& values : {Values{0.25}, Values(50, 0.25)}) {
    const BoxNumbers box = numbers_of(values);
    for (const double v : {box.low, box.lower, box.median, box.upper, box.high}) EXPECT_EQ(v, 0.25);
    EXPECT_TRUE(box.outliers.empty());
  }
}

TEST(FigureNumbers, AValueOnTheReachIsNoOutlier) {
  // Quartiles 1 and 3 (quantile(c(0, 1, 2, 3, 6), ...)): reach to 6 exactly.
  EXPECT_EQ(numbers_of({0, 1, 2, 3, 6}).high, 6.0);
  EXPECT_TRUE(numbers_of({0, 1, 2, 3, 6}).outliers.empty());
  EXPECT_EQ(numbers_of({0, 1, 2, 3, 6.001}).outliers.size(), 1U);
}

TEST(FigureNumbers, HoldForRandomSets) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Values values;
    for (std::uint64_t i = 0; i < 1 + seed % 23; ++i) {
      values.push_back(std::pow(world::to_uniform(world::mix(world::mix(~seed) + i)), 6.0));
    }
    const BoxNumbers box = numbers_of(values);
    EXPECT_LE(box.low, box.lower);
    EXPECT_LE(box.lower, box.median);
    EXPECT_LE(box.median, box.upper);
    EXPECT_LE(box.upper, box.high);
    EXPECT_TRUE(std::is_sorted(box.outliers.begin(), box.outliers.end()));
    const double reach = 1.5 * (box.upper - box.lower);
    std::size_t beyond = 0;
    for (const double v : values) {
      if (v < box.lower - reach || v > box.upper + reach) ++beyond;
      else EXPECT_TRUE(v >= box.low && v <= box.high) << "neither point nor within the whiskers";
    }
    EXPECT_EQ(box.outliers.size(), beyond);
  }
}

// As if each miss were a value far beyond all others: that it is one, and not which.
TEST(FigureNumbers, MissesAreBeyondAllValues) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::size_t count = seed % 17, missed = 1 + seed % 5;
    Values values;
    for (std::uint64_t i = 0; i < count; ++i) values.push_back(world::to_uniform(world::mix(world::mix(~seed) + i)));
    Values all = values;
    all.insert(all.end(), missed, 1e12);
    const BoxNumbers with = numbers_of(values, missed), far = numbers_of(all);
    const auto expect = [&](double is, double stands_for) {
      if (stands_for > 1e6) EXPECT_TRUE(std::isinf(is)) << is << " " << stands_for;
      else EXPECT_DOUBLE_EQ(is, stands_for);
    };
    expect(with.lower, far.lower);
    expect(with.median, far.median);
    expect(with.upper, far.upper);
    if (!std::isinf(with.upper)) expect(with.low, far.low);
    for (const double v : with.outliers) EXPECT_TRUE(std::isfinite(v));
  }
  EXPECT_TRUE(std::isinf(numbers_of({}, 3).median));
  EXPECT_EQ(numbers_of({1, 2}, 8).outliers, (Values{1, 2})) << "points where there is no box";
}

}  // namespace
}  // namespace banyan::study
