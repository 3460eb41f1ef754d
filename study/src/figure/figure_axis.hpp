// SPDX-License-Identifier: MIT
// The range of an axis and its round tick marks.
#pragma once

#include <optional>
#include <string>

namespace banyan::study {

// The finite values that an axis has to show.
struct Extent {
  bool any = false;
  double low = 0.0, high = 0.0;
  void add(double value) noexcept;  // what is not finite does not count
};

struct FigureAxis {
  double low = 0.0, high = 1.0;  // low < high
  double first_tick = 0.0, step = 0.2;
  int decimals = 1;  // of the tick labels; -1: "%g", for what is very large or small

  [[nodiscard]] std::string format() const;                   // of the tick labels, for gnuplot
  [[nodiscard]] double label_width_px(double size_px) const;  // of the widest tick label
};

// Covers `extent` with `margin` times its size on both sides (an extent without values counts as
// 0 to 1); from 0 if `from_zero` and no value is below it. Given ends are kept. About
// `most_ticks` ticks at most, at multiples of 1, 2 or 5 times a power of ten.
[[nodiscard]] FigureAxis axis_over(const Extent& extent, std::optional<double> minimum, std::optional<double> maximum,
                             bool from_zero, double margin, int most_ticks);

}  // namespace banyan::study
