// SPDX-License-Identifier: MIT
// Whole numbers as far as they go: ties are exact, and no order of summation can change a bit.
#include "banyan/study/paired.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "normal.hpp"

namespace banyan::study {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr double unbounded = std::numeric_limits<double>::infinity();

void require_alpha(double alpha) {
  if (!(alpha > 0.0 && alpha < 1.0)) throw std::invalid_argument("alpha must lie between 0 and 1");
}

void require_pairs(const PairedValues& pairs) {
  const std::size_t n = pairs.first.size();
  if (pairs.second.size() != n || (!pairs.stratum.empty() && pairs.stratum.size() != n))
    throw std::invalid_argument("paired samples must be of one length");
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(pairs.first[i] - pairs.second[i]))
      throw std::invalid_argument("paired tests need finite values and differences");
}

// A power of ten that makes the largest value a whole number of 14 digits: decimals with fewer become whole, and so
// do their differences.
double scale_of(const PairedValues& pairs) noexcept {
  constexpr double digits = 1e14;
  double size = 0.0;
  for (const auto* values : {&pairs.first, &pairs.second})
    for (const double value : *values) size = std::max(size, std::abs(value));
  double scale = 1.0;
  while (size > 0.0 && size * (scale * 10.0) < digits) scale *= 10.0;
  while (size * scale >= digits) scale /= 10.0;
  return scale;
}

constexpr std::size_t exact_pairs = 50;          // every count of signings stays under 2^53
constexpr std::int64_t exact_total = 1 << 20;    // places of the table
constexpr std::int64_t finest_weight = 1 << 30;  // weights of strata of many different sizes are rounded to 1 / this

double walsh_averages(double n) noexcept { return n * (n + 1.0) / 2.0; }

}  // namespace

// The signed-rank test ----------------------------------------------------------------------------

SignedRank::SignedRank(const PairedValues& pairs) : pairs_(pairs.first.size()) {
  require_pairs(pairs);
  scale_ = scale_of(pairs);
  std::map<std::size_t, std::vector<std::int64_t>> strata;
  for (std::size_t i = 0; i < pairs_; ++i) {
    const std::int64_t d = std::llround(pairs.first[i] * scale_) - std::llround(pairs.second[i] * scale_);
    strata[pairs.stratum.empty() ? 0 : pairs.stratum[i]].push_back(d);
    first_larger_ += d > 0 ? 1 : 0;
    second_larger_ += d < 0 ? 1 : 0;
  }
  for (auto& [number, differences] : strata) {
    std::sort(differences.begin(), differences.end());
    strata_.push_back({std::move(differences), 1});
  }
  weigh();
  toss();
}

// Weights as whole numbers in the proportion of 1 / (n_s + 1).
void SignedRank::weigh() {
  std::int64_t common = 1;
  for (const auto& stratum : strata_) {
    const auto n = static_cast<std::int64_t>(stratum.differences.size());
    if (common < finest_weight) common = std::lcm(common, n + 1);
  }
  common = std::min(common, finest_weight);
  std::int64_t divisor = 0;
  for (auto& stratum : strata_) {
    const auto n = static_cast<std::int64_t>(stratum.differences.size());
    stratum.weight = std::max<std::int64_t>(1, (common + (n + 1) / 2) / (n + 1));
    divisor = std::gcd(divisor, stratum.weight);
  }
  double variance = 0.0, least = unbounded;
  for (auto& stratum : strata_) {
    stratum.weight /= divisor;
    const auto size = static_cast<std::int64_t>(stratum.differences.size());
    total_ += stratum.weight * (size * (size + 1) / 2);
    const auto n = static_cast<double>(size), weight = static_cast<double>(stratum.weight);
    variance += weight * weight * walsh_averages(n) * (2.0 * n + 1.0) / 12.0;
    least = std::min(least, weight);
  }
  deviation_ = std::sqrt(variance);
  continuity_ = strata_.empty() ? 0.0 : 0.5 * least;
}

// Ranks 1 to n of each stratum are above or not with equal probability: sums of subsets, by dynamic programming.
void SignedRank::toss() {
  if (pairs_ == 0 || pairs_ > exact_pairs || total_ > exact_total) return;
  tossed_.assign(static_cast<std::size_t>(total_ / 2) + 1, 0.0);
  tossed_[0] = 1.0;
  for (const auto& stratum : strata_) {
    for (std::size_t rank = 1; rank <= stratum.differences.size(); ++rank) {
      const auto weight = rank * static_cast<std::size_t>(stratum.weight);
      for (std::size_t sum = tossed_.size(); sum-- > weight;) tossed_[sum] += tossed_[sum - weight];
    }
  }
  std::partial_sum(tossed_.begin(), tossed_.end(), tossed_.begin());
  for (double& ways : tossed_) ways = std::ldexp(ways, -static_cast<int>(pairs_));
}

double SignedRank::tail(std::int64_t weight) const {
  if (weight < 0) return 0.0;
  if (2 * weight >= total_) return 0.5;
  if (!tossed_.empty()) return std::min(0.5, tossed_[static_cast<std::size_t>(weight)]);
  const double below = 0.5 * static_cast<double>(total_) - static_cast<double>(weight) - continuity_;
  return below <= 0.0 ? 0.5 : upper_tail(below / deviation_);
}

// For each difference, from the smallest on, the partners that lift the sum to the bound: their first one moves down.
std::int64_t SignedRank::at_least(std::int64_t sum) const noexcept {
  std::int64_t weight = 0;
  for (const auto& stratum : strata_) {
    const auto& d = stratum.differences;
    std::size_t count = 0, partner = d.size();
    for (std::size_t i = 0; i < d.size(); ++i) {
      while (partner > 0 && d[i] + d[partner - 1] >= sum) --partner;
      count += d.size() - std::max(partner, i);
    }
    weight += stratum.weight * static_cast<std::int64_t>(count);
  }
  return weight;
}

std::int64_t SignedRank::largest(std::int64_t weight) const noexcept {
  std::int64_t low = std::numeric_limits<std::int64_t>::max(), high = std::numeric_limits<std::int64_t>::min();
  for (const auto& stratum : strata_) {
    low = std::min(low, 2 * stratum.differences.front());
    high = std::max(high, 2 * stratum.differences.back());
  }
  while (low < high) {  // low has the weight, what is above high has not
    const std::int64_t middle = high - (high - low) / 2;
    if (at_least(middle) >= weight) low = middle;
    else high = middle - 1;
  }
  return low;
}

// The smallest sum with that weight at or below it is the largest with the rest above, or equal to it.
std::int64_t SignedRank::smallest(std::int64_t weight) const noexcept { return largest(total_ - weight + 1); }

double SignedRank::in_values(std::int64_t sum) const noexcept { return static_cast<double>(sum) / scale_ * 0.5; }

double SignedRank::shift() const {
  if (pairs_ == 0) return no_value;
  const std::int64_t half = total_ - total_ / 2;
  const std::int64_t low = smallest(half), high = largest(half);
  return in_values(low) + 0.5 * (in_values(high) - in_values(low));
}

double SignedRank::effect() const {
  if (pairs_ == 0) return 0.0;
  return static_cast<double>(at_least(1) - at_most(-1)) / static_cast<double>(total_);
}

double SignedRank::p(double shift) const {
  if (pairs_ == 0) return 1.0;
  const std::int64_t sum = std::llround(2.0 * shift * scale_);
  return 2.0 * tail(std::min(at_least(sum), at_most(sum)));
}

Interval SignedRank::interval(double alpha) const {
  require_alpha(alpha);
  if (pairs_ == 0) return {no_value, no_value};
  std::int64_t low = 0, high = total_ / 2 + 1;  // the smallest weight that is not rejected is among these
  while (low < high) {
    const std::int64_t middle = low + (high - low) / 2;
    if (2.0 * tail(middle) >= alpha) high = middle;
    else low = middle + 1;
  }
  if (low == 0) return {-unbounded, unbounded};
  return {in_values(smallest(low)), in_values(largest(low))};
}

// McNemar's test ----------------------------------------------------------------------------------

namespace {

// Of n fair coins, the probability that the rarer side comes up at most `fewer` times, or the other does. n choose
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

// P(X >= hits) of a binomial, 0 < share < 1: terms relative to that of the mode, so that none overflows.
double binomial_tail(std::size_t hits, std::size_t n, double share) noexcept {
  const auto mode = std::min(n, static_cast<std::size_t>(share * static_cast<double>(n + 1)));
  const double odds = share / (1.0 - share);
  double above = mode >= hits ? 1.0 : 0.0, all = 1.0, term = 1.0;
  for (std::size_t k = mode; k < n && term > 0.0; ++k) {
    term *= static_cast<double>(n - k) / static_cast<double>(k + 1) * odds;
    all += term;
    if (k + 1 >= hits) above += term;
  }
  term = 1.0;
  for (std::size_t k = mode; k > 0 && term > 0.0; --k) {
    term *= static_cast<double>(k) / static_cast<double>(n - k + 1) / odds;
    all += term;
    if (k - 1 >= hits) above += term;
  }
  return above / all;
}

// The share below which `hits` of n or more would be too many.
double lower_share(std::size_t hits, std::size_t n, double alpha) noexcept {
  if (hits == 0) return 0.0;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (2.0 * binomial_tail(hits, n, middle) < alpha ? low : high) = middle;
  }
  return low;
}

}  // namespace

double PairedShares::difference() const noexcept {
  return (static_cast<double>(first_only) - static_cast<double>(second_only)) / static_cast<double>(pairs);
}

double PairedShares::effect() const noexcept {
  const std::size_t differing = first_only + second_only;
  if (differing == 0) return 0.0;
  return (static_cast<double>(first_only) - static_cast<double>(second_only)) / static_cast<double>(differing);
}

double PairedShares::p() const noexcept {
  return fair_coin_p(std::min(first_only, second_only), first_only + second_only);
}

Interval PairedShares::interval(double alpha) const {
  require_alpha(alpha);
  if (pairs == 0) return {no_value, no_value};
  const std::size_t differing = first_only + second_only;
  const Interval share = wilson(differing, pairs, 1.0 - alpha);
  const double low = 2.0 * lower_share(first_only, differing, alpha) - 1.0;
  const double high = 1.0 - 2.0 * lower_share(second_only, differing, alpha);
  return {low * (low < 0.0 ? share.high : share.low), high * (high < 0.0 ? share.low : share.high)};
}

Verdict judge(const Interval& interval, double margin) noexcept {
  const bool within = margin > 0.0 && interval.low >= -margin && interval.high <= margin;
  if (interval.high < 0.0) return within ? Verdict::lower_within : Verdict::lower;
  if (interval.low > 0.0) return within ? Verdict::higher_within : Verdict::higher;
  return within ? Verdict::no_difference : Verdict::undecided;
}

}  // namespace banyan::study
