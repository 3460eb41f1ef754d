// SPDX-License-Identifier: MIT
// The numbers that a box plot shows.
#pragma once

#include <vector>

namespace banyan::study {

// Whiskers reach to the last value within 1.5 times the box (Tukey 1977); `outliers` lie beyond.
struct BoxNumbers {
  double low, lower, median, upper, high;  // whisker, quartiles, whisker
  std::vector<double> outliers;            // ascending
};

// `values` in any order, finite, at least one. Quartiles of type 7 (statistics.hpp).
[[nodiscard]] BoxNumbers numbers_of(std::vector<double> values);

}  // namespace banyan::study
