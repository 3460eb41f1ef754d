// SPDX-License-Identifier: MIT
// The numbers that a box plot shows (box_numbers.hpp).
#include "box_numbers.hpp"

#include <algorithm>

#include "banyan/study/statistics.hpp"

namespace banyan::study {

namespace {

constexpr double whisker_reach = 1.5;  // times the box

}  // namespace

BoxNumbers numbers_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  BoxNumbers box{0.0, quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75), 0.0, {}};
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
