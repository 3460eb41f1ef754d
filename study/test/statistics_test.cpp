// SPDX-License-Identifier: MIT
// Statistics against SciPy 1.10.1 (numbers quoted with their command), against enumeration of
// everything there is to enumerate, and against what must hold for any input.
#include "banyan/study/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "banyan/world/random.hpp"

namespace banyan::study {
namespace {

using Values = std::vector<double>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

double uniform(std::uint64_t seed, std::uint64_t i) { return world::to_uniform(world::mix(world::mix(~seed) + i)); }

void expect_same(const Interval& a, const Interval& b) {
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
}

void shuffle(Values& values, std::uint64_t seed) {
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1], values[static_cast<std::size_t>(uniform(seed, i) * static_cast<double>(i))]);
}

const Values sample{12.5, 3.25, -1.0, 8.0, 8.0, 0.0, 21.75, 5.5, 13.0, -4.5, 9.125};

// Quantiles and summaries -------------------------------------------------------------------------

TEST(StatisticsQuantile, AgreesWithNumpy) {  // numpy.quantile(sample, q)
  Values sorted = sample;
  std::sort(sorted.begin(), sorted.end());
  const std::pair<double, double> oracles[] = {{0, -4.5}, {0.1, -1.0},     {0.25, 1.625},    {0.33, 3.925},
                                               {0.5, 8},  {0.75, 10.8125}, {0.975, 19.5625}, {1, 21.75}};
  for (const auto& [q, value] : oracles) EXPECT_NEAR(quantile(sorted, q), value, 1e-14) << q;
}

TEST(StatisticsQuantile, NoValuesOneValueAndBeyondTheRange) {
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  EXPECT_TRUE(std::isnan(quantile(sample, nan)));
  const Values one{3.5};
  for (const double q : {0.0, 0.3, 1.0}) EXPECT_EQ(quantile(one, q), 3.5);
  const Values two{1.0, 2.0};
  EXPECT_EQ(quantile(two, -1.0), 1.0);
  EXPECT_EQ(quantile(two, 7.0), 2.0);
}

TEST(StatisticsSummary, AgreesWithPandas) {  // s = pandas.Series(sample); s.mean(), s.std(), (s > 0).mean()
  const Summary s = summarize(sample);
  EXPECT_EQ(s.count, 11U);
  EXPECT_EQ(s.minimum, -4.5);
  EXPECT_EQ(s.lower_quartile, 1.625);
  EXPECT_EQ(s.median, 8.0);
  EXPECT_EQ(s.upper_quartile, 10.8125);
  EXPECT_EQ(s.maximum, 21.75);
  EXPECT_NEAR(s.mean, 6.875, 1e-14);
  EXPECT_NEAR(s.standard_deviation, 7.42777725837279, 1e-13);
  EXPECT_NEAR(s.positive, 0.7272727272727273, 1e-15);
  expect_same(s.positive_interval, wilson(8, 11, 0.95));
}

TEST(StatisticsSummary, NothingIsNaN) {
  const Summary s = summarize({});
  EXPECT_EQ(s.count, 0U);
  for (const double v : {s.minimum, s.lower_quartile, s.median, s.upper_quartile, s.maximum, s.mean,
                         s.standard_deviation, s.positive, s.median_interval.low, s.median_interval.high,
                         s.mean_interval.low, s.mean_interval.high, s.positive_interval.low, s.positive_interval.high})
    EXPECT_TRUE(std::isnan(v));
}

// 0.1 is no binary fraction: a plain sum of seven would not divide back to it.
TEST(StatisticsSummary, EqualValuesHaveNoSpreadAtAll) {
  for (const std::size_t n : {1U, 2U, 7U, 50U}) {
    const Summary s = summarize(Values(n, 0.1));
    for (const double v : {s.minimum, s.lower_quartile, s.median, s.upper_quartile, s.maximum, s.mean,
                           s.median_interval.low, s.median_interval.high, s.mean_interval.low, s.mean_interval.high})
      EXPECT_EQ(v, 0.1) << n;
    EXPECT_EQ(s.standard_deviation, 0.0) << n;
    EXPECT_EQ(s.positive, 1.0) << n;
  }
}

TEST(StatisticsSummary, OrderDoesNotChangeABit) {
  Values values = sample;
  values.insert(values.end(), {0.1, 0.7, 1e-9, -0.0, 1.0 / 3.0});
  const Summary s = summarize(values);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    shuffle(values, seed);
    const Summary t = summarize(values);
    EXPECT_EQ(t.mean, s.mean);
    EXPECT_EQ(t.standard_deviation, s.standard_deviation);
    expect_same(t.mean_interval, s.mean_interval);
    expect_same(t.median_interval, s.median_interval);
  }
  EXPECT_FALSE(std::signbit(summarize(Values{-0.0, 0.0, 0.0}).minimum));
  EXPECT_FALSE(std::signbit(summarize(Values{0.0, 0.0, -0.0}).maximum));
}

// Quarters and a shift by a power of two are exact, so the same draws must give the same interval.
TEST(StatisticsSummary, ShiftAndScaleCarryOver) {
  Values values(16);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::floor(64.0 * uniform(5, i)) / 4.0;
  const Summary s = summarize(values);
  for (double& v : values) v = 1024.0 + 2.0 * v;
  const Summary t = summarize(values);
  EXPECT_EQ(t.standard_deviation, 2.0 * s.standard_deviation);
  expect_same(t.median_interval, {1024.0 + 2.0 * s.median_interval.low, 1024.0 + 2.0 * s.median_interval.high});
  EXPECT_NEAR(t.mean_interval.low, 1024.0 + 2.0 * s.mean_interval.low, 1e-11);
  EXPECT_NEAR(t.mean_interval.high, 1024.0 + 2.0 * s.mean_interval.high, 1e-11);
}

TEST(StatisticsSummary, RefusesWhatHasNoMeaning) {
  for (const double bad : {nan, infinity, -infinity})
    EXPECT_THROW((void)summarize(Values{1, bad}), std::invalid_argument);
  for (const double bad : {0.0, 1.0, -0.5, 95.0, nan}) {
    EXPECT_THROW((void)summarize(sample, {.confidence = bad}), std::invalid_argument);
    EXPECT_THROW((void)summarize({}, {.confidence = bad}), std::invalid_argument);
  }
}

// The bootstrap -----------------------------------------------------------------------------------

// All n^n resamples of a few values are equally likely: the share of them with a statistic below,
// and with one up to, the end of an interval.
std::pair<double, double> ideal_share(const Values& values, double end,
                                      const std::function<double(Values&)>& statistic) {
  const std::size_t n = values.size();
  const auto all = static_cast<std::size_t>(std::pow(n, n));
  std::size_t below = 0, upto = 0;
  Values drawn(n);
  for (std::size_t code = 0; code < all; ++code) {
    for (std::size_t i = 0, rest = code; i < n; ++i, rest /= n) drawn[i] = values[rest % n];
    const double value = statistic(drawn);
    below += value < end - 1e-9;
    upto += value <= end + 1e-9;
  }
  return {static_cast<double>(below) / static_cast<double>(all), static_cast<double>(upto) / static_cast<double>(all)};
}

double mean_of(Values& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median_of(Values& values) {
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2.0;
}

void expect_ideal(const Values& values, const Interval& interval, const std::function<double(Values&)>& statistic) {
  constexpr double chance = 0.004;  // some four standard deviations of a share of 0.05 in 50,000
  const auto [below_low, upto_low] = ideal_share(values, interval.low, statistic);
  EXPECT_LT(below_low, 0.05 + chance) << values.size();
  EXPECT_GT(upto_low, 0.05 - chance) << values.size();
  const auto [below_high, upto_high] = ideal_share(values, interval.high, statistic);
  EXPECT_LT(below_high, 0.95 + chance) << values.size();
  EXPECT_GT(upto_high, 0.95 - chance) << values.size();
}

TEST(StatisticsBootstrap, AgreesWithAllResamples) {
  for (const Values& values :
       {Values{1, 2}, Values{2, 7, 1}, Values{0, 1, 5, 7}, Values{8, 1, 2.5, -4, 3.25}, Values{1, 1, 9, 4, 4, -2}}) {
    const Summary s = summarize(values, {.confidence = 0.9, .resamples = 50000});
    expect_ideal(values, s.mean_interval, mean_of);
    expect_ideal(values, s.median_interval, median_of);
  }
}

// The median of a resample of 21 is at most the k-th value if at least 11 draws are: binomial, so
//   next(x[k - 1] for k in range(1, 22) if scipy.stats.binom.sf(10, 21, k / 21) > q)
// is 5.75 for q = 0.025 (k = 7: 0.056, k = 6: 0.018) and 17 for 0.975 (k = 15: 0.982, k = 14: 0.944).
TEST(StatisticsBootstrap, MedianAgreesWithItsBinomialDistribution) {
  Values x;
  for (int i = 0; i < 21; ++i) x.push_back((i * i * 7 + 3 * i) % 101 / 4.0);
  for (const std::uint64_t seed : {1U, 2U, 3U})
    expect_same(summarize(x, {.resamples = 20000, .seed = seed}).median_interval, {5.75, 17.0});
}

// Four standard deviations of a share of 0.95 in 400 are 0.044; percentile intervals of skewed
// samples of 40 are known to cover a few hundredths less than they promise.
TEST(StatisticsBootstrap, CoversTheTruthAsOftenAsPromised) {
  constexpr std::size_t samples = 400;
  std::size_t mean_covered = 0, median_covered = 0;
  for (std::uint64_t seed = 0; seed < samples; ++seed) {
    Values values(40);  // exponential: mean 1, median ln 2
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = -std::log(1.0 - uniform(seed, i));
    const Summary s = summarize(values, {.resamples = 1000, .seed = seed});
    mean_covered += s.mean_interval.low <= 1.0 && 1.0 <= s.mean_interval.high;
    median_covered += s.median_interval.low <= M_LN2 && M_LN2 <= s.median_interval.high;
  }
  for (const std::size_t covered : {mean_covered, median_covered}) {
    EXPECT_GT(covered, 0.88 * samples);
    EXPECT_LT(covered, 0.99 * samples);
  }
}

TEST(StatisticsBootstrap, TheSeedDecidesAndNothingElse) {
  const Summary a = summarize(sample, {.seed = 7});
  expect_same(summarize(sample, {.seed = 7}).mean_interval, a.mean_interval);
  EXPECT_NE(summarize(sample, {.seed = 8}).mean_interval.low, a.mean_interval.low);
  EXPECT_TRUE(std::isnan(summarize(sample, {.resamples = 0}).mean_interval.low));
}

TEST(StatisticsBootstrap, WiderWithMoreConfidence) {
  const Summary a = summarize(sample, {.confidence = 0.8});
  const Summary b = summarize(sample, {.confidence = 0.99});
  EXPECT_LT(b.mean_interval.low, a.mean_interval.low);
  EXPECT_GT(b.mean_interval.high, a.mean_interval.high);
}

// Wilson's interval -------------------------------------------------------------------------------

TEST(StatisticsWilson, AgreesWithScipy) {  // binomtest(hits, count).proportion_ci(confidence, method='wilson')
  struct Case {
    std::size_t hits, count;
    double confidence, low, high;
  };
  for (const Case& c : {Case{0, 20, 0.95, 0.0, 0.16112515805281935}, Case{20, 20, 0.95, 0.8388748419471808, 1.0},
                        Case{7, 20, 0.95, 0.1811918241010821, 0.5671457233147637},
                        Case{1, 3, 0.9, 0.07826572633372841, 0.7464661317187758},
                        Case{499, 500, 0.99, 0.9831912267084774, 0.9997651455056117},
                        Case{50, 100, 0.999, 0.343717075474757, 0.6562829245252431},
                        Case{3, 7, 0.5, 0.3106034777497514, 0.5552572159915451}}) {
    const Interval interval = wilson(c.hits, c.count, c.confidence);
    EXPECT_NEAR(interval.low, c.low, 1e-13) << c.hits << " of " << c.count;
    EXPECT_NEAR(interval.high, c.high, 1e-13) << c.hits << " of " << c.count;
  }
}

TEST(StatisticsWilson, EndsAreExactAndSidesMirror) {
  for (std::size_t n = 1; n <= 200; ++n) {
    EXPECT_EQ(wilson(0, n, 0.95).low, 0.0);
    EXPECT_EQ(wilson(n, n, 0.95).high, 1.0);
    for (std::size_t hits = 0; hits <= n; ++hits)
      EXPECT_NEAR(wilson(hits, n, 0.95).low, 1.0 - wilson(n - hits, n, 0.95).high, 1e-14);
  }
  expect_same(wilson(0, 0, 0.95), {0.0, 1.0});
}

TEST(StatisticsWilson, RefusesWhatHasNoMeaning) {
  EXPECT_THROW((void)wilson(3, 2, 0.95), std::invalid_argument);
  for (const double bad : {0.0, 1.0, nan}) EXPECT_THROW((void)wilson(1, 2, bad), std::invalid_argument);
}

// Holm's correction -------------------------------------------------------------------------------

// Holm's is the closed procedure over Bonferroni's tests: each hypothesis gets the largest p of all
// intersections it is part of.
Values closed_bonferroni(const Values& p) {
  Values adjusted(p.size(), 0.0);
  for (std::size_t set = 1; set < std::size_t{1} << p.size(); ++set) {
    double smallest = 1.0;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (set >> i & 1) smallest = std::min(smallest, p[i]);
    const double together = std::min(1.0, smallest * std::popcount(set));
    for (std::size_t i = 0; i < p.size(); ++i)
      if (set >> i & 1) adjusted[i] = std::max(adjusted[i], together);
  }
  return adjusted;
}

Values family(std::uint64_t seed) {
  Values p(1 + seed % 9);
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = std::pow(uniform(seed, i), 1.0 + static_cast<double>(seed % 4));
  if (seed % 3 == 0) p.back() = p.front();
  return p;
}

TEST(StatisticsHolm, AgreesWithTheClosedProcedure) {
  for (std::uint64_t seed = 0; seed < 300; ++seed)
    EXPECT_EQ(holm(family(seed)), closed_bonferroni(family(seed))) << seed;
}

TEST(StatisticsHolm, ByHand) {
  const Values adjusted = holm(Values{0.01, 0.04, 0.03, 0.005});
  const Values expected{0.03, 0.06, 0.06, 0.02};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(adjusted[i], expected[i], 1e-15);
  EXPECT_EQ(holm(Values{0.7, 0.6}), (Values{1.0, 1.0}));
  EXPECT_EQ(holm(Values{0.3}), Values{0.3});
  EXPECT_TRUE(holm({}).empty());
}

TEST(StatisticsHolm, MonotoneAndNeverBelowRaw) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Values p = family(seed);
    const Values adjusted = holm(p);
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_GE(adjusted[i], p[i]);
      EXPECT_LE(adjusted[i], 1.0);
      for (std::size_t j = 0; j < p.size(); ++j)
        if (p[i] <= p[j]) { EXPECT_LE(adjusted[i], adjusted[j]); }
    }
  }
}

TEST(StatisticsHolm, OrderDoesNotMatterAndNaNDoesNotCount) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Values p = family(seed);
    Values sorted = holm(p);
    shuffle(p, seed);
    Values shuffled = holm(p);
    std::sort(sorted.begin(), sorted.end());
    std::sort(shuffled.begin(), shuffled.end());
    EXPECT_EQ(shuffled, sorted);
    Values adjusted = holm(p);
    const auto at = static_cast<std::ptrdiff_t>(seed % (p.size() + 1));
    p.insert(p.begin() + at, nan);
    Values with_nan = holm(p);
    ASSERT_EQ(with_nan.size(), p.size());
    EXPECT_TRUE(std::isnan(with_nan[static_cast<std::size_t>(at)]));
    with_nan.erase(with_nan.begin() + at);
    EXPECT_EQ(with_nan, adjusted);
  }
}

// An interval at a test's level and its adjusted p must say the same.
TEST(StatisticsHolm, LevelsRejectWhatTheAdjustedValuesReject) {
  std::size_t rejected = 0, kept = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Values p = family(seed);
    p.push_back(nan);
    for (const double alpha : {0.01, 0.05, 0.3}) {
      const Values adjusted = holm(p), levels = holm_levels(p, alpha);
      for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        EXPECT_EQ(p[i] < levels[i], adjusted[i] < alpha) << seed << " " << i;
        EXPECT_LE(levels[i], alpha);
        EXPECT_GE(levels[i], alpha / static_cast<double>(p.size() - 1));
        (p[i] < levels[i] ? rejected : kept) += 1;
      }
      EXPECT_EQ(levels.back(), alpha);
    }
  }
  EXPECT_GT(rejected, 300U);
  EXPECT_GT(kept, 300U);
}

// Bits --------------------------------------------------------------------------------------------

// Recorded here with gcc 12 on x86-64: another machine, library or build type must not differ.
TEST(StatisticsBits, AreTheSameEverywhere) {
  const Summary s = summarize(sample);
  EXPECT_EQ(s.standard_deviation, 0x1.db60b3ddabc15p+2);
  expect_same(s.median_interval, {0.0, 12.5});
  expect_same(s.mean_interval, {0x1.62d61bed61befp+1, 0x1.645d1745d1746p+3});
  expect_same(s.positive_interval, {0x1.bcc77a693ff47p-2, 0x1.ce19a529b0776p-1});
}

}  // namespace
}  // namespace banyan::study
