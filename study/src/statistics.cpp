// SPDX-License-Identifier: MIT
// Everything is computed from sorted values by + - * / and sqrt: neither the order in which runs
// finished nor the machine's C library can change a bit of a report.
#include "banyan/study/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "banyan/world/random.hpp"
#include "normal.hpp"

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

namespace {

// The tests that take part in Holm's procedure, the smallest p first.
std::vector<std::size_t> in_order(std::span<const double> p) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!std::isnan(p[i])) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  return order;
}

}  // namespace

std::vector<double> holm(std::span<const double> p) {
  const auto order = in_order(p);
  std::vector<double> adjusted(p.size(), nan);
  double least = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    least = std::max(least, std::min(1.0, static_cast<double>(order.size() - i) * p[order[i]]));
    adjusted[order[i]] = least;
  }
  return adjusted;
}

std::vector<double> holm_levels(std::span<const double> p, double alpha) {
  const auto order = in_order(p);
  std::vector<double> levels(p.size(), alpha);
  bool rejected = true;  // all tests so far: the first that is not stops the procedure
  double level = alpha;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (rejected) level = alpha / static_cast<double>(order.size() - i);
    rejected = rejected && p[order[i]] < level;
    levels[order[i]] = level;
  }
  return levels;
}

}  // namespace banyan::study
