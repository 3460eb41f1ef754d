// SPDX-License-Identifier: MIT
// The numbers of a box plot (box_numbers.hpp).
#include "box_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "banyan/study/statistics.hpp"

namespace banyan::study {

namespace {

constexpr double whisker_reach = 1.5;  // times the box
constexpr double never = std::numeric_limits<double>::infinity();

// The quantile of `sorted` with `missed` infinite values behind it.
double quantile_with(const std::vector<double>& sorted, std::size_t missed, double q) {
  if (missed == 0) return quantile(sorted, q);
  const double at = q * static_cast<double>(sorted.size() + missed - 1);
  const auto below = static_cast<std::size_t>(at), above = static_cast<std::size_t>(std::ceil(at));
  if (above >= sorted.size()) return never;
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

BoxNumbers numbers_of(std::vector<double> values, std::size_t missed) {
  std::sort(values.begin(), values.end());
  const auto part = [&](double q) { return quantile_with(values, missed, q); };
  BoxNumbers box{0.0, part(0.25), part(0.5), part(0.75), 0.0, {}};
  if (std::isinf(box.lower)) return {never, never, never, never, never, std::move(values)};
  const double reach = whisker_reach * (box.upper - box.lower);
  const double lowest = box.lower - reach, highest = box.upper + reach;
  // With few values the quartiles lie between values, and the last one within reach can be inside
  // the box: the whisker has no length then.
  const auto first = std::find_if(values.begin(), values.end(), [=](double v) { return v >= lowest; });
  const auto last = std::find_if(values.rbegin(), values.rend(), [=](double v) { return v <= highest; });
  box.low = first == values.end() ? box.lower : std::min(*first, box.lower);
  box.high = last == values.rend() ? box.upper : std::max(*last, box.upper);
  for (const double v : values) {
    if (v < lowest || v > highest) box.outliers.push_back(v);
  }
  return box;
}

}  // namespace banyan::study
