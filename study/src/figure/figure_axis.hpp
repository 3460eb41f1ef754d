// SPDX-License-Identifier: MIT
// The range of an axis and its round tick marks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "banyan/study/figure.hpp"

namespace banyan::study {

// The finite values that an axis has to show.
struct AxisExtent {
  bool any = false;
  double low = 0.0, high = 0.0;
  void add(double value) noexcept;  // what is not finite does not count
};

struct AxisTick {
  double at = 0.0;
  std::string label;
};

struct FigureAxis {
  double low = 0.0, high = 1.0;  // low < high
  std::vector<AxisTick> ticks;   // ascending, from low to high
  Scale scale = Scale::linear;   // logarithmic: low > 0

  [[nodiscard]] std::string tick_list(bool labels = true) const;  // for gnuplot, ("0" 0, "0.5" 0.5)
  [[nodiscard]] double label_width(double size) const;            // of the widest tick label
};

// Covers `extent` with `margin` times its size on both sides (an extent without values counts as
// 0 to 1); from 0 if `from_zero` and no value is below it. Given ends are kept. About
// `most_ticks` ticks at most, at multiples of 1, 2 or 5 times a power of ten.
[[nodiscard]] FigureAxis axis_over(const AxisExtent& extent, std::optional<double> minimum,
                                   std::optional<double> maximum, bool from_zero, double margin, int most_ticks);

// The same with logarithms. `extent` is of positive values, given ends are positive. Ticks at powers of ten, with
// their double and fivefold where these are few, and at round steps where the axis is shorter than that. With
// `zeros`, its lower end is drawn for 0 and below, at a distance from the least value, and labelled so.
[[nodiscard]] FigureAxis log_axis_over(const AxisExtent& extent, std::optional<double> minimum,
                                       std::optional<double> maximum, bool zeros, int most_ticks);

}  // namespace banyan::study
