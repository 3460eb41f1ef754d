// SPDX-License-Identifier: MIT
// Two ways of doing the same runs, compared pair by pair. In each class the estimate, its interval and p are of one
// test: the interval holds the values that the test does not reject. Pure functions; the same input gives the same
// bits on any machine. Two-sided; alpha is an error rate in (0, 1), such as 0.05.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "banyan/study/statistics.hpp"

namespace banyan::study {

// The pairs stand at the same index. Ranks are given within each stratum, such as a world; none: all are of one.
struct PairedValues {
  std::vector<double> first, second;
  std::vector<std::size_t> stratum;
};

// Wilcoxon's signed-rank test (1945) and what Hodges and Lehmann (1963) made of it. In terms of Walsh averages, the
// means (d_i + d_j) / 2, i <= j, of two differences first - second (or of one with itself) of the same stratum:
//
//   T(x) = sum over strata s of w_s * (number of Walsh averages > x),   w_s = 1 / (n_s + 1)
//
// is the rank sum of the differences above x (Tukey 1949), with van Elteren's weights (1960) of strata of n_s pairs.
// Shift: the x at which as much weight lies above as below, for one stratum the median of the Walsh averages.
// p(x): T(x) as if signs were tossed, exact for up to 50 pairs, beyond them by the normal approximation with
// continuity correction. A Walsh average equal to x counts for either side: ties, and zero differences too, can only
// make p larger, as the least favourable way to break them would. Tests of tied ranks as others have them (mid-ranks,
// zeros dropped) cannot be inverted: their p is not monotone in x.
// Values are taken as decimals of 14 digits, those of the largest: 0.3 - 0.2 and 0.2 - 0.1 are ties.
class SignedRank {
 public:
  // Throws std::invalid_argument if lengths differ or a value or difference is not finite.
  explicit SignedRank(const PairedValues& pairs);

  [[nodiscard]] std::size_t pairs() const noexcept { return pairs_; }
  [[nodiscard]] std::size_t first_larger() const noexcept { return first_larger_; }
  [[nodiscard]] std::size_t second_larger() const noexcept { return second_larger_; }  // the rest are equal
  [[nodiscard]] double shift() const;  // of first against second; NaN for no pairs
  // Matched-pairs rank-biserial correlation (Kerby 2014), -1 to 1: the share of the weight of Walsh averages above 0
  // less that below. 0 for no pairs.
  [[nodiscard]] double effect() const;
  [[nodiscard]] double p(double shift = 0.0) const;  // 1 for no pairs
  // The shifts with p >= alpha. Without bounds where there are too few pairs to reject any; NaN for none.
  [[nodiscard]] Interval interval(double alpha) const;

 private:
  struct Stratum {
    std::vector<std::int64_t> differences;  // ascending, in units
    std::int64_t weight = 1;
  };
  // Sums of two differences are twice a Walsh average: whole numbers of half a unit.
  [[nodiscard]] std::int64_t at_least(std::int64_t sum) const noexcept;  // weight of those >= sum
  [[nodiscard]] std::int64_t at_most(std::int64_t sum) const noexcept { return total_ - at_least(sum + 1); }
  [[nodiscard]] std::int64_t largest(std::int64_t weight) const noexcept;   // sum with at least that weight above
  [[nodiscard]] std::int64_t smallest(std::int64_t weight) const noexcept;  // and below
  void weigh();
  void toss();
  [[nodiscard]] double tail(std::int64_t weight) const;  // P(T <= weight) if signs are tossed, at most 0.5
  [[nodiscard]] double in_values(std::int64_t sum) const noexcept;

  std::vector<Stratum> strata_;
  std::size_t pairs_ = 0, first_larger_ = 0, second_larger_ = 0;
  std::int64_t total_ = 0;      // weight of all Walsh averages
  double scale_ = 1.0;          // units in 1
  double deviation_ = 0.0;      // standard, of T
  double continuity_ = 0.0;     // half of the smallest step of T
  std::vector<double> tossed_;  // P(T <= index) up to half of total_, where it is exact
};

// McNemar's exact test: how often only the first, and only the second, of a pair has a property.
struct PairedShares {
  std::size_t pairs = 0;
  std::size_t first_only = 0, second_only = 0;
  [[nodiscard]] double difference() const noexcept;  // of the shares, first - second; NaN for no pairs
  [[nodiscard]] double effect() const noexcept;      // the same of the pairs that differ, -1 to 1; 0 if none does
  [[nodiscard]] double p() const noexcept;           // binomial, on the pairs that differ; 1 if none does
  // Of the difference. Among the pairs that differ Clopper and Pearson's interval (1934), the inversion of p;
  // times Wilson's interval of the share of pairs that differ, the end that makes it wider. It excludes 0 if and only
  // if p < alpha. NaN for no pairs.
  [[nodiscard]] Interval interval(double alpha) const;
};

// What an interval of a difference says, if differences up to +-margin do not matter.
enum class Verdict { undecided, no_difference, lower, lower_within, higher, higher_within };  // "within" the margin
[[nodiscard]] Verdict judge(const Interval& interval, double margin) noexcept;

}  // namespace banyan::study
