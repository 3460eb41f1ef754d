// SPDX-License-Identifier: MIT
// Everything is computed from sorted values by + - * / and sqrt: neither the order in which runs
// finished nor the machine's C library can change a bit of a report.
#include "banyan/study/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "banyan/world/random.hpp"

namespace banyan::study {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void require_that(bool condition, const char* otherwise) {
  if (!condition) throw std::invalid_argument(otherwise);
}

void require_confidence(double confidence) {
  require_that(confidence > 0.0 && confidence < 1.0, "confidence must lie between 0 and 1");
}

std::vector<double> sorted_copy(std::span<const double> values) {
  for (const double v : values) require_that(std::isfinite(v), "statistics need finite values");
  std::vector<double> sorted(values.begin(), values.end());
  for (double& v : sorted) v += 0.0;  // -0 becomes 0: sorting could leave them in any order
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

// The normal distribution -------------------------------------------------------------------------

// e^x for x <= 0: 2^k e^r with |r| <= ln(2) / 2, and Taylor's series of e^r. ln(2) is in two parts
// (fdlibm's), of which k times the first is exact.
double exponential(double x) noexcept {
  if (x < -745.2) return 0.0;  // below half the smallest double
  const double k = std::floor(x * std::numbers::log2e + 0.5);
  const double r = (x - k * 6.93147180369123816490e-01) - k * 1.90821492927058770002e-10;
  double sum = 1.0;
  for (int i = 17; i >= 1; --i) sum = 1.0 + sum * r / i;
  return std::ldexp(sum, static_cast<int>(k));
}

double normal_density(double z) noexcept {
  return exponential(-0.5 * z * z) * (std::numbers::inv_sqrtpi / std::numbers::sqrt2);
}

// P(Z > z) of a standard normal, z >= 0; relative error < 1e-13 as far as doubles reach. The series loses
// digits where the tail is small, the continued fraction (Laplace) converges only away from 0.
double upper_tail(double z) noexcept {
  if (z >= 2.5) {
    double fraction = z;
    for (int k = 120; k >= 1; --k) fraction = z + k / fraction;
    return normal_density(z) / fraction;
  }
  double term = z;
  double sum = z;
  for (int k = 3; term > 1e-17 * sum; k += 2) {
    term *= z * z / k;
    sum += term;
  }
  return 0.5 - normal_density(z) * sum;
}

// The z with P(-z < Z < z) = confidence. The tail is convex, so Newton's steps from 0 rise to the
// root and never pass it but by rounding.
double two_sided_quantile(double confidence) noexcept {
  const double tail = 0.5 * (1.0 - confidence);
  double z = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double next = z + (upper_tail(z) - tail) / normal_density(z);
    if (!(next > z)) break;
    z = next;
  }
  return z;
}

// The bootstrap -----------------------------------------------------------------------------------

// How often each of n values is drawn in one resample of n; the draws are a function of (seed,
// resample) alone. One draw of 64 bits gives two indices, uniform up to n / 2^32; n < 2^32.
void resample(std::uint64_t seed, std::size_t number, std::span<std::uint32_t> times) noexcept {
  std::fill(times.begin(), times.end(), 0U);
  const std::size_t n = times.size();
  const std::uint64_t key = world::mix(world::mix(seed) ^ number);
  for (std::size_t i = 0; i < n; i += 2) {
    const std::uint64_t bits = world::mix(key ^ i);
    ++times[(bits >> 32) * n >> 32];
    if (i + 1 < n) ++times[(bits & 0xFFFFFFFFULL) * n >> 32];
  }
}

// The median of sorted values of which the i-th comes times[i] times, as many as there are values.
double median_of(std::span<const double> sorted, std::span<const std::uint32_t> times) noexcept {
  const std::size_t n = sorted.size();
  std::size_t i = 0;
  std::size_t upto = times[0];
  while (upto <= (n - 1) / 2) upto += times[++i];
  const double low = sorted[i];
  while (upto <= n / 2) upto += times[++i];
  return low + 0.5 * (sorted[i] - low);
}

struct Bootstrap {
  Interval median{nan, nan};
  Interval mean{nan, nan};
};

Interval central(std::vector<double>& values, double confidence) {
  std::sort(values.begin(), values.end());
  const double tail = 0.5 * (1.0 - confidence);
  return {quantile(values, tail), quantile(values, 1.0 - tail)};
}

// Percentile intervals of the median and the mean of `sorted`, both from the same resamples. Means
// are taken from the median on, so that equal values have exactly their value as mean.
Bootstrap bootstrap(std::span<const double> sorted, const SummaryOptions& options) {
  if (sorted.empty()) return {};
  const double center = quantile(sorted, 0.5);
  std::vector<double> medians(options.resamples);
  std::vector<double> means(options.resamples);
  std::vector<std::uint32_t> times(sorted.size());
  for (std::size_t r = 0; r < options.resamples; ++r) {
    resample(options.seed, r, times);
    medians[r] = median_of(sorted, times);
    double sum = 0.0;
    for (std::size_t i = 0; i < sorted.size(); ++i) sum += times[i] * (sorted[i] - center);
    means[r] = center + sum / static_cast<double>(sorted.size());
  }
  return {central(medians, options.confidence), central(means, options.confidence)};
}

// Paired tests ------------------------------------------------------------------------------------

struct Difference {
  double value;  // first - second; 0 if they are equal up to rounding
  double noise;  // what the rounding of the two values may amount to
};

std::vector<Difference> differences(std::span<const double> first, std::span<const double> second) {
  require_that(first.size() == second.size(), "paired samples must be of one length");
  std::vector<Difference> result;
  result.reserve(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double value = first[i] - second[i];
    require_that(std::isfinite(value), "paired tests need finite values and differences");
    const double noise = 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(first[i]), std::abs(second[i]));
    result.push_back({std::abs(value) <= noise ? 0.0 : value, noise});
  }
  return result;
}

// Everything about the pairs but the test itself.
PairedTest describe(std::span<const Difference> pairs, const SummaryOptions& options) {
  require_confidence(options.confidence);
  std::vector<double> values;
  values.reserve(pairs.size());
  for (const Difference& d : pairs) values.push_back(d.value);
  values = sorted_copy(values);
  PairedTest result;
  result.pairs = values.size();
  result.median_difference = quantile(values, 0.5);
  result.difference_interval = bootstrap(values, options).median;
  for (const double v : values) {
    result.first_larger += v > 0.0;
    result.second_larger += v < 0.0;
  }
  return result;
}

struct SignedRanks {
  std::size_t count = 0;  // of differences other than 0
  double plus = 0.0;      // sum of the ranks of the positive ones
  double minus = 0.0;
  double ties = 0.0;               // sum of t^3 - t over groups of t differences of one size
  std::vector<std::size_t> twice;  // every rank, doubled: a mid-rank may be half a number
};

// Ranks of the sizes from 1 on; those of one size share the mean of their ranks.
SignedRanks signed_ranks(std::vector<Difference> pairs) {
  std::erase_if(pairs, [](const Difference& d) { return d.value == 0.0; });
  const auto size = [](const Difference& d) { return std::abs(d.value); };
  std::sort(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) { return size(a) < size(b); });
  SignedRanks result;
  result.count = pairs.size();
  for (std::size_t begin = 0, end = 0; begin < pairs.size(); begin = end) {
    const auto tied = [&](const Difference& a, const Difference& b) {
      return size(b) - size(a) <= std::max(a.noise, b.noise);
    };
    for (end = begin + 1; end < pairs.size() && tied(pairs[end - 1], pairs[end]);) ++end;
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);
    result.twice.insert(result.twice.end(), end - begin, begin + 1 + end);
    for (std::size_t i = begin; i < end; ++i) (pairs[i].value > 0.0 ? result.plus : result.minus) += rank;
    const auto t = static_cast<double>(end - begin);
    result.ties += t * (t * t - 1.0);
  }
  return result;
}

constexpr std::size_t exact_limit = 50;  // of differences: every count below stays under 2^53

// Of the 2^n equally likely ways to sign the ranks, how many have a smaller sum no larger than
// observed: subset sums of the doubled ranks by dynamic programming. Exact, with ties too.
double exact_p(const SignedRanks& ranks) {
  const auto smaller = static_cast<std::size_t>(2.0 * std::min(ranks.plus, ranks.minus));
  std::vector<double> ways(smaller + 1, 0.0);
  ways[0] = 1.0;
  for (const std::size_t twice : ranks.twice)
    for (std::size_t sum = smaller; sum >= twice; --sum) ways[sum] += ways[sum - twice];
  const double tail = std::accumulate(ways.begin(), ways.end(), 0.0);
  return std::min(1.0, std::ldexp(tail, 1 - static_cast<int>(ranks.count)));
}

double normal_p(const SignedRanks& ranks) noexcept {
  const auto n = static_cast<double>(ranks.count);
  const double variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ranks.ties / 48.0;
  const double distance = std::abs(ranks.plus - ranks.minus) / 2.0;  // of either sum from its mean
  return 2.0 * upper_tail(std::max(0.0, distance - 0.5) / std::sqrt(variance));
}

// Of n fair coins, the probability that the rarer side comes up at most `fewer` times. n choose
// `fewer` would overflow: it is halved on the way.
double fair_coin_p(std::size_t fewer, std::size_t n) noexcept {
  if (2 * fewer + 1 >= n) return 1.0;
  double probability = 1.0;
  std::size_t halvings = n;
  for (std::size_t i = 1; i <= fewer; ++i) {
    probability *= static_cast<double>(n - fewer + i) / static_cast<double>(i);
    for (; probability > 1.0 && halvings > 0; --halvings) probability *= 0.5;
  }
  double term = 1.0;
  double sum = 1.0;  // of the probabilities of fewer, fewer - 1, ..., 0, relative to the first
  for (std::size_t i = fewer; i >= 1; --i) {
    term *= static_cast<double>(i) / static_cast<double>(n - i + 1);
    sum += term;
  }
  constexpr std::size_t vanishing = 4000;  // halvings that leave nothing of a double, and fit an int
  return std::ldexp(2.0 * probability * sum, -static_cast<int>(std::min(halvings, vanishing)));
}

}  // namespace

double quantile(std::span<const double> sorted, double q) noexcept {
  if (sorted.empty() || std::isnan(q)) return nan;
  const double position = std::clamp(q, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const double fraction = position - static_cast<double>(below);
  if (fraction == 0.0) return sorted[below];
  return sorted[below] + fraction * (sorted[below + 1] - sorted[below]);
}

Summary summarize(std::span<const double> values, const SummaryOptions& options) {
  require_confidence(options.confidence);
  if (values.empty()) return {0, nan, nan, nan, nan, nan, nan, nan, nan, {nan, nan}, {nan, nan}, {nan, nan}};
  const std::vector<double> sorted = sorted_copy(values);
  const auto n = static_cast<double>(sorted.size());
  Summary s;
  s.count = sorted.size();
  s.minimum = sorted.front();
  s.lower_quartile = quantile(sorted, 0.25);
  s.median = quantile(sorted, 0.5);
  s.upper_quartile = quantile(sorted, 0.75);
  s.maximum = sorted.back();
  double sum = 0.0;  // from the median on: equal values have exactly their value as mean
  for (const double v : sorted) sum += v - s.median;
  s.mean = std::clamp(s.median + sum / n, s.minimum, s.maximum);
  double squares = 0.0;
  for (const double v : sorted) squares += (v - s.mean) * (v - s.mean);
  if (s.count > 1) s.standard_deviation = std::sqrt(squares / (n - 1.0));
  const auto above = std::count_if(sorted.begin(), sorted.end(), [](double v) { return v > 0.0; });
  s.positive = static_cast<double>(above) / n;
  s.positive_interval = wilson(static_cast<std::size_t>(above), s.count, options.confidence);
  const Bootstrap intervals = bootstrap(sorted, options);
  s.median_interval = intervals.median;
  s.mean_interval = intervals.mean;
  return s;
}

Interval wilson(std::size_t hits, std::size_t count, double confidence) {
  require_confidence(confidence);
  require_that(hits <= count, "a share cannot have more hits than trials");
  if (count == 0) return {0.0, 1.0};
  const auto n = static_cast<double>(count);
  const double share = static_cast<double>(hits) / n;
  const double z = two_sided_quantile(confidence);
  const double center = share + z * z / (2.0 * n);
  const double reach = z * std::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
  const double scale = 1.0 + z * z / n;
  // The ends 0 and 1 are exact in theory but not after rounding.
  return {hits == 0 ? 0.0 : (center - reach) / scale, hits == count ? 1.0 : (center + reach) / scale};
}

PairedTest wilcoxon(std::span<const double> first, std::span<const double> second, const SummaryOptions& options) {
  const std::vector<Difference> pairs = differences(first, second);
  PairedTest result = describe(pairs, options);
  const SignedRanks ranks = signed_ranks(pairs);
  if (ranks.count == 0) return result;
  result.effect = (ranks.plus - ranks.minus) / (ranks.plus + ranks.minus);
  result.p = ranks.count <= exact_limit ? exact_p(ranks) : normal_p(ranks);
  return result;
}

PairedTest mcnemar(std::span<const double> first, std::span<const double> second, const SummaryOptions& options) {
  for (const auto values : {first, second})
    for (const double v : values) require_that(v == 0.0 || v == 1.0, "McNemar's test needs values that are 0 or 1");
  PairedTest result = describe(differences(first, second), options);
  const std::size_t differing = result.first_larger + result.second_larger;
  if (differing == 0) return result;
  const auto more = static_cast<double>(result.first_larger) - static_cast<double>(result.second_larger);
  result.effect = more / static_cast<double>(differing);
  result.p = fair_coin_p(std::min(result.first_larger, result.second_larger), differing);
  return result;
}

std::vector<double> holm(std::span<const double> p) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!std::isnan(p[i])) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> adjusted(p.size(), nan);
  double least = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    least = std::max(least, std::min(1.0, static_cast<double>(order.size() - i) * p[order[i]]));
    adjusted[order[i]] = least;
  }
  return adjusted;
}

}  // namespace banyan::study
