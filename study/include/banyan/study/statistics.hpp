// SPDX-License-Identifier: MIT
// The statistics of a study. Pure functions; the same input gives the same bits on any machine.
// Values are finite, in any unit; results named after a value are in its unit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace banyan::study {

// The q-quantile, q in [0, 1], by linear interpolation between order statistics (type 7 of Hyndman
// & Fan 1996: the default of R, NumPy and pandas). `sorted` ascends. q beyond its range counts as
// its nearer end. NaN for no values or if q is NaN.
[[nodiscard]] double quantile(std::span<const double> sorted, double q) noexcept;

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

// What one group of runs came to in one metric.
struct Summary {
  std::size_t count = 0;
  double minimum = 0.0, lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0, maximum = 0.0;
  double mean = 0.0, standard_deviation = 0.0;  // n - 1; 0 for one value
  double positive = 0.0;                        // share of values above 0
  Interval median_interval, mean_interval;      // bootstrap
  Interval positive_interval;                   // Wilson score
};
struct SummaryOptions {
  double confidence = 0.95;      // in (0, 1)
  std::size_t resamples = 2000;  // of the bootstrap; with 0, its intervals are NaN
  std::uint64_t seed = 1;
};
// `values` in any order, finite. All NaN with count 0. Intervals: percentile bootstrap (Efron &
// Tibshirani 1993, ch. 13). The order of the values does not change a bit of the result.
// Throws std::invalid_argument if a value is not finite or the confidence not in (0, 1).
[[nodiscard]] Summary summarize(std::span<const double> values, const SummaryOptions& options = {});
// Wilson's interval of a share: `hits` of `count` (Wilson 1927). {0, 1} for no trials.
// Throws std::invalid_argument if hits > count or the confidence is not in (0, 1).
[[nodiscard]] Interval wilson(std::size_t hits, std::size_t count, double confidence);

// Holm's step-down correction (Holm 1979) of a family of p values: adjusted values in the same
// order, each at most 1, monotone with the raw ones. NaN stays NaN and does not count.
[[nodiscard]] std::vector<double> holm(std::span<const double> p);
// The level at which Holm's procedure tests each of them in a family of error rate alpha: p < its level if and only
// if the adjusted p < alpha. So an interval at that level says the same as the adjusted p. NaN: alpha.
[[nodiscard]] std::vector<double> holm_levels(std::span<const double> p, double alpha);

}  // namespace banyan::study
