// SPDX-License-Identifier: MIT
// The values of a study's axis `compare`, two by two: runs with the same seed and the same values of all other axes
// are pairs, and the pairs of a group are ranked within each combination of the axes that the group pools, its worlds.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "banyan/study/paired.hpp"
#include "banyan/study/results.hpp"

namespace banyan::study {

// One test, as it stands by itself and in its family: the tests of one claim, which is two values, a metric and a
// grouping of one part. Holm's correction is over a family, and the verdict is by the interval at Holm's level, which
// excludes 0 if and only if p_holm < 1 - confidence.
struct Judged {
  double estimate = 0.0;  // of first - second
  Interval interval;      // at the study's confidence: excludes 0 if and only if p < 1 - confidence
  double p = 1.0, p_holm = 1.0;
  Interval holm_interval;
  double effect = 0.0, margin = 0.0;
  std::size_t first_larger = 0, second_larger = 0;
  Verdict verdict = Verdict::undecided;
};

struct Comparison {
  std::size_t part = 0;
  std::vector<std::size_t> group;  // a value index per axis of the part; npos for one that is pooled
  std::size_t grouping = 0;        // number of the grouping within the part
  std::string metric, first, second;
  bool boolean = false;   // McNemar's test of a share; else signed ranks
  std::size_t pairs = 0;  // both runs are there
  // A miss is a run that did not reach what the metric is the time of. It has no rank: `test` is of the pairs without.
  bool can_miss = false;
  std::size_t ranked = 0, first_missed = 0, second_missed = 0, both_missed = 0;
  Judged test;
  Judged misses;                                   // McNemar's test of them
  double first_median = 0.0, second_median = 0.0;  // of the pairs that are ranked; NaN for a boolean
  double first_mean = 0.0, second_mean = 0.0;      // of all pairs: a miss counts with the limit, a restricted mean
  double mean_difference = 0.0;                    // NaN where a miss has no limit
  Interval mean_interval;  // bootstrap over pairs; only for metrics that can be missed, else NaN
};

// All of a study: the groupings of its tables. Or one grouping per part that pools everything but the compared axis,
// for metrics of one's own choice.
[[nodiscard]] std::vector<Comparison> compare(const Study& study, const Results& results);
[[nodiscard]] std::vector<Comparison> compare_pooled(const Study& study, const Results& results,
                                                     const std::vector<std::string>& metrics);

// "faster", "slower (within margin)", "no difference", "undecided" of the first of the two; for metrics that are no
// time "lower" and "higher", for booleans "less often" and "more often".
[[nodiscard]] std::string verdict_text(const Comparison& comparison);
// Likewise of the misses: "fewer", "more", "no difference", "undecided"; "" where nothing can be missed.
[[nodiscard]] std::string misses_text(const Comparison& comparison);

}  // namespace banyan::study
