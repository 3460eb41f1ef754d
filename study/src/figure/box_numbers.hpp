// SPDX-License-Identifier: MIT
// The numbers that a box plot shows.
#pragma once

#include <cstddef>
#include <vector>

namespace banyan::study {

// Whiskers reach to the last value within 1.5 times the box (Tukey 1977); `outliers` lie beyond. Infinity: the runs
// there missed.
struct BoxNumbers {
  double low, lower, median, upper, high;  // whisker, quartiles, whisker
  std::vector<double> outliers;            // ascending, finite
};

// `values` in any order, finite; `missed` further ones count as infinite. At least one of both. Quartiles of type 7
// (statistics.hpp); between a value and infinity lies infinity.
[[nodiscard]] BoxNumbers numbers_of(std::vector<double> values, std::size_t missed = 0);

}  // namespace banyan::study
