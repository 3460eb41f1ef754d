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

void expect_relative(double value, double oracle, double tolerance, const std::string& what) {
  EXPECT_NEAR(value, oracle, tolerance * std::abs(oracle)) << what;
}

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

// Wilcoxon's signed-rank test ---------------------------------------------------------------------

PairedTest wilcoxon_of(const Values& differences) { return wilcoxon(differences, Values(differences.size(), 0.0)); }

// Hollander & Wolfe's depression scores: scipy.stats.wilcoxon(x, y, mode='exact').pvalue
TEST(StatisticsWilcoxon, AgreesWithTheTextbook) {
  const Values x{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const Values y{0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  const PairedTest t = wilcoxon(x, y);
  EXPECT_EQ(t.pairs, 9U);
  EXPECT_EQ(t.first_larger, 7U);
  EXPECT_EQ(t.second_larger, 2U);
  EXPECT_NEAR(t.median_difference, 0.49, 1e-15);
  EXPECT_LE(t.difference_interval.low, 0.49);
  EXPECT_GE(t.difference_interval.high, 0.49);
  EXPECT_NEAR(t.effect, 35.0 / 45.0, 1e-15);
  EXPECT_EQ(t.p, 0.0390625);
}

// Ties and a zero. All 2^9 signings of the mid-ranks counted: 324 / 512.
TEST(StatisticsWilcoxon, TiesAndZerosAreExact) {
  const Values a{125, 115, 130, 140, 140, 115, 140, 125, 140, 135};
  const Values b{110, 122, 125, 120, 140, 124, 123, 137, 135, 145};
  const PairedTest t = wilcoxon(a, b);
  EXPECT_EQ(t.first_larger, 5U);
  EXPECT_EQ(t.second_larger, 4U);
  EXPECT_NEAR(t.effect, (27.0 - 18.0) / 45.0, 1e-15);
  EXPECT_EQ(t.p, 0.6328125);
}

std::pair<Values, Values> pairs_of(std::uint64_t n, bool coarse) {
  Values a, b;
  for (std::uint64_t i = 1; i <= n; ++i) {
    a.push_back(static_cast<double>(i * 37 * 7919 % 1009) / 8.0);
    b.push_back(static_cast<double>(i * i * 31 % 997) / 8.0 + static_cast<double>(i) / 1024.0);
    if (coarse) {
      a.back() = std::floor(a.back() / 8.0);
      b.back() = std::floor(b.back() / 8.0);
    }
  }
  return {a, b};
}

// d = a - b; d = d[d != 0]; r = scipy.stats.rankdata(abs(d))
// scipy.stats.wilcoxon(d, correction=True, mode='exact' if n <= 50 else 'approx').pvalue; with ties scipy
// has no exact p: 30 coarse is from counting sums of doubled ranks in a dictionary, in whole numbers
// (r[d > 0].sum() - r[d < 0].sum()) / r.sum(), numpy.median(a - b)
TEST(StatisticsWilcoxon, AgreesWithScipyOnBothSidesOfTheExactLimit) {
  struct Case {
    std::uint64_t n;
    bool coarse;
    double p, effect, median;
  };
  for (const Case& c : {
           Case{50, false, 0.5786292137562761, -0.09176470588235294, -7.5302734375},
           Case{51, false, 0.5770347251282728, -0.09049773755656108, -7.16796875},
           Case{200, false, 0.7654500810141874, 0.02437810945273632, -1.5595703125},
           Case{30, true, 0.4298993069678545, 0.16774193548387098, 2.0},
           Case{300, true, 0.38423564124130505, 0.06015832495294087, 0.0},
       }) {
    const auto [a, b] = pairs_of(c.n, c.coarse);
    const PairedTest t = wilcoxon(a, b);
    const std::string what = std::to_string(c.n) + (c.coarse ? " coarse" : "");
    expect_relative(t.p, c.p, 1e-12, what);
    EXPECT_NEAR(t.effect, c.effect, 1e-14) << what;
    EXPECT_EQ(t.median_difference, c.median) << what;
  }
}

// Of all ways to sign the ranks, the share whose sums are at least as far apart.
double enumerated_p(const Values& differences) {
  Values sizes;
  for (const double d : differences) sizes.push_back(std::abs(d));
  std::vector<long> rank;  // doubled, because a mid-rank may be half a number
  long observed = 0;
  for (const double d : differences) {
    const auto below = std::count_if(sizes.begin(), sizes.end(), [&](double s) { return s < std::abs(d); });
    rank.push_back(2 * below + 1 + std::count(sizes.begin(), sizes.end(), std::abs(d)));
    observed += d > 0 ? rank.back() : -rank.back();
  }
  std::size_t extreme = 0;
  for (std::size_t signs = 0; signs < std::size_t{1} << rank.size(); ++signs) {
    long apart = 0;
    for (std::size_t i = 0; i < rank.size(); ++i) apart += signs >> i & 1 ? rank[i] : -rank[i];
    extreme += std::abs(apart) >= std::abs(observed);
  }
  return std::ldexp(static_cast<double>(extreme), -static_cast<int>(rank.size()));
}

TEST(StatisticsWilcoxon, AgreesWithAllSignings) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Values differences(1 + seed % 12);
    for (std::size_t i = 0; i < differences.size(); ++i)
      differences[i] = uniform(seed, i) - 0.1 * static_cast<double>(seed % 7);
    EXPECT_EQ(wilcoxon_of(differences).p, enumerated_p(differences)) << seed;
    Values with_zeros = differences;
    with_zeros.insert(with_zeros.begin() + 1, {0.0, 0.0});
    EXPECT_EQ(wilcoxon_of(with_zeros).p, enumerated_p(differences)) << seed;
  }
}

TEST(StatisticsWilcoxon, AgreesWithAllSigningsOfTies) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Values differences(1 + seed % 12);
    for (std::size_t i = 0; i < differences.size(); ++i) {
      const double size = 1.0 + std::floor(3.0 * uniform(seed, i));
      differences[i] = uniform(seed + 1000, i) < 0.1 * static_cast<double>(seed % 10) ? -size : size;
    }
    EXPECT_EQ(wilcoxon_of(differences).p, enumerated_p(differences)) << seed;
  }
}

TEST(StatisticsWilcoxon, AllOfOneSizeOnOneSide) {
  for (const std::size_t n : {1U, 2U, 5U, 10U, 50U}) {
    EXPECT_EQ(wilcoxon_of(Values(n, 0.5)).p, std::ldexp(1.0, 1 - static_cast<int>(n))) << n;
    EXPECT_EQ(wilcoxon_of(Values(n, -0.5)).p, std::ldexp(1.0, 1 - static_cast<int>(n))) << n;
  }
}

TEST(StatisticsWilcoxon, AllOnOneSide) {
  Values differences(50);
  std::iota(differences.begin(), differences.end(), 1.0);
  const PairedTest t = wilcoxon_of(differences);
  EXPECT_EQ(t.p, std::ldexp(1.0, -49));
  EXPECT_EQ(t.effect, 1.0);
  differences.resize(60);
  std::iota(differences.begin(), differences.end(), 1.0);
  // scipy.stats.wilcoxon(numpy.arange(1, 61) * 1.0, correction=True, mode='approx').pvalue
  expect_relative(wilcoxon_of(differences).p, 1.6713285696526423e-11, 1e-11, "normal tail");
}

TEST(StatisticsWilcoxon, NothingToCompare) {
  const PairedTest none = wilcoxon({}, {});
  EXPECT_EQ(none.pairs, 0U);
  EXPECT_TRUE(std::isnan(none.median_difference) && std::isnan(none.difference_interval.low));
  EXPECT_EQ(none.p, 1.0);
  EXPECT_EQ(none.effect, 0.0);
  const PairedTest same = wilcoxon(sample, sample);
  EXPECT_EQ(same.first_larger + same.second_larger, 0U);
  EXPECT_EQ(same.median_difference, 0.0);
  EXPECT_EQ(same.p, 1.0);
  EXPECT_EQ(same.effect, 0.0);
  EXPECT_EQ(wilcoxon_of({-3.0}).p, 1.0);
  EXPECT_EQ(wilcoxon_of({-3.0}).effect, -1.0);
  // One size, half of them on either side: the sums are equal.
  EXPECT_EQ(wilcoxon_of({2.0, -2.0, 2.0, -2.0}).p, 1.0);
}

TEST(StatisticsWilcoxon, SwapNegatesOrderAndShiftDoNothing) {
  const auto [a, b] = pairs_of(40, false);
  const PairedTest t = wilcoxon(a, b);
  const PairedTest swapped = wilcoxon(b, a);
  EXPECT_EQ(swapped.p, t.p);
  EXPECT_EQ(swapped.effect, -t.effect);
  EXPECT_EQ(swapped.median_difference, -t.median_difference);
  EXPECT_EQ(swapped.first_larger, t.second_larger);
  Values a_reversed(a.rbegin(), a.rend()), b_reversed(b.rbegin(), b.rend());
  for (std::size_t i = 0; i < a.size(); ++i) {  // exact in binary
    a_reversed[i] += 4096.0;
    b_reversed[i] += 4096.0;
  }
  const PairedTest moved = wilcoxon(a_reversed, b_reversed);
  EXPECT_EQ(moved.p, t.p);
  EXPECT_EQ(moved.effect, t.effect);
  EXPECT_EQ(moved.median_difference, t.median_difference);
  expect_same(moved.difference_interval, t.difference_interval);
}

// Tenths and whole numbers must tell the same story, though 0.3 - 0.2 < 0.2 - 0.1 in binary.
TEST(StatisticsWilcoxon, RoundingBreaksNoTies) {
  Values a, b, a_tenths, b_tenths;
  for (std::uint64_t i = 0; i < 40; ++i) {
    a.push_back(std::floor(3000.0 * uniform(1, i)));
    b.push_back(a.back() + std::floor(9.0 * uniform(2, i)) - 3.0);
    a_tenths.push_back(a.back() * 0.1);
    b_tenths.push_back(b.back() / 10.0);
  }
  const PairedTest whole = wilcoxon(a, b);
  const PairedTest tenths = wilcoxon(a_tenths, b_tenths);
  ASSERT_LT(whole.first_larger + whole.second_larger, 40U);  // there are zeros
  EXPECT_EQ(tenths.first_larger, whole.first_larger);
  EXPECT_EQ(tenths.second_larger, whole.second_larger);
  EXPECT_EQ(tenths.effect, whole.effect);
  EXPECT_EQ(tenths.p, whole.p);
}

TEST(StatisticsWilcoxon, RefusesWhatHasNoMeaning) {
  EXPECT_THROW((void)wilcoxon(Values{1, 2}, Values{1}), std::invalid_argument);
  for (const double bad : {nan, infinity}) {
    EXPECT_THROW((void)wilcoxon(Values{1, bad}, Values{1, 2}), std::invalid_argument);
    EXPECT_THROW((void)wilcoxon(Values{1, bad}, Values{1, bad}), std::invalid_argument);
  }
  EXPECT_THROW((void)wilcoxon(Values{1e308}, Values{-1e308}), std::invalid_argument);
  EXPECT_THROW((void)wilcoxon(Values{1}, Values{2}, {.confidence = 1.0}), std::invalid_argument);
}

// McNemar's test ----------------------------------------------------------------------------------

PairedTest mcnemar_of(std::size_t first_only, std::size_t second_only, std::size_t both = 0) {
  Values first(first_only, 1.0), second(first_only, 0.0);
  first.resize(first_only + second_only, 0.0);
  second.resize(first_only + second_only, 1.0);
  first.resize(first.size() + both, 1.0);
  second.resize(second.size() + both, 1.0);
  return mcnemar(first, second, {.resamples = 20});
}

TEST(StatisticsMcNemar, AgreesWithScipy) {  // scipy.stats.binomtest(fewer, n).pvalue
  struct Case {
    std::size_t fewer, n;
    double p;
  };
  for (const Case& c : {Case{0, 1, 1.0}, Case{1, 5, 0.375}, Case{3, 12, 0.14599609375}, Case{6, 13, 1.0},
                        Case{400, 1000, 2.728464156065976e-10}, Case{100, 1000, 1.3403435580012363e-161},
                        Case{2400, 5000, 0.00488364973751758}, Case{1900, 5000, 4.210554001517878e-65},
                        Case{499, 1000, 0.9747749818216398}, Case{500, 1000, 1.0}}) {
    expect_relative(mcnemar_of(c.fewer, c.n - c.fewer).p, c.p, 1e-10, std::to_string(c.fewer));
    expect_relative(mcnemar_of(c.n - c.fewer, c.fewer).p, c.p, 1e-10, std::to_string(c.fewer));
  }
}

TEST(StatisticsMcNemar, AgreesWithPascalsTriangle) {
  std::vector<std::uint64_t> row{1};
  for (std::size_t n = 1; n <= 40; ++n) {
    std::vector<std::uint64_t> next(n + 1, 1);
    for (std::size_t k = 1; k < n; ++k) next[k] = row[k - 1] + row[k];
    row = next;
    for (std::size_t k = 0; k <= n; ++k) {
      std::uint64_t as_rare = 0;  // outcomes no likelier than k
      for (const std::uint64_t ways : row) as_rare += ways <= row[k] ? ways : 0;
      const double p = std::ldexp(static_cast<double>(as_rare), -static_cast<int>(n));
      expect_relative(mcnemar_of(k, n - k, 3).p, p, 1e-13, std::to_string(k) + " of " + std::to_string(n));
    }
  }
}

TEST(StatisticsMcNemar, NeitherOverflowsNorUnderflowsTooEarly) {
  EXPECT_EQ(mcnemar_of(0, 1000).p, std::ldexp(1.0, -999));
  EXPECT_EQ(mcnemar_of(1060, 0).p, std::ldexp(1.0, -1059));
  EXPECT_EQ(mcnemar_of(0, 20000).p, 0.0);
  // float(Fraction(2 * sum(math.comb(20000, k) for k in range(9801)), 2**20000)), in Python
  expect_relative(mcnemar_of(9800, 10200).p, 0.004780889455902644, 1e-12, "9800 of 20000");
}

TEST(StatisticsMcNemar, CountsAndEffect) {
  const PairedTest t = mcnemar_of(9, 3, 8);
  EXPECT_EQ(t.pairs, 20U);
  EXPECT_EQ(t.first_larger, 9U);
  EXPECT_EQ(t.second_larger, 3U);
  EXPECT_EQ(t.effect, 0.5);
  EXPECT_EQ(t.median_difference, 0.0);
  EXPECT_EQ(mcnemar_of(0, 0, 5).p, 1.0);
  EXPECT_EQ(mcnemar_of(0, 0, 5).effect, 0.0);
  EXPECT_EQ(mcnemar({}, {}).p, 1.0);
}

TEST(StatisticsMcNemar, RefusesWhatHasNoMeaning) {
  for (const double bad : {0.5, 2.0, -1.0, nan}) {
    EXPECT_THROW((void)mcnemar(Values{bad}, Values{1}), std::invalid_argument);
    EXPECT_THROW((void)mcnemar(Values{1}, Values{bad}), std::invalid_argument);
  }
  EXPECT_THROW((void)mcnemar(Values{1, 0}, Values{1}), std::invalid_argument);
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

// Bits --------------------------------------------------------------------------------------------

// Recorded here with gcc 12 on x86-64: another machine, library or build type must not differ.
TEST(StatisticsBits, AreTheSameEverywhere) {
  const Summary s = summarize(sample);
  EXPECT_EQ(s.standard_deviation, 0x1.db60b3ddabc15p+2);
  expect_same(s.median_interval, {0.0, 12.5});
  expect_same(s.mean_interval, {0x1.62d61bed61befp+1, 0x1.645d1745d1746p+3});
  expect_same(s.positive_interval, {0x1.bcc77a693ff47p-2, 0x1.ce19a529b0776p-1});
  Values a, b;
  for (int i = 1; i <= 60; ++i) {
    a.push_back(i * i % 17);
    b.push_back(i * 3 % 19);
  }
  EXPECT_EQ(wilcoxon(a, b).p, 0x1.11f0f4bac513dp-1);
  EXPECT_EQ(mcnemar_of(230, 170).p, 0x1.9a205bdddcc52p-9);
}

}  // namespace
}  // namespace banyan::study
