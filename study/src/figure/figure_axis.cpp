// SPDX-License-Identifier: MIT
// The range of an axis (figure_axis.hpp).
#include "figure_axis.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "figure_text.hpp"

namespace banyan::study {

namespace {

constexpr int most_decimals = 6;
constexpr double too_long = 1e6;  // from here on, "%g"
constexpr int significant = 6;    // digits of gnuplot's "%g"

double round_step(double range, int most_ticks) {
  const double rough = range / most_ticks;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

int decimals_of(double step, double largest) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  return decimals > most_decimals || largest >= too_long ? -1 : decimals;
}

std::string general(double value) {
  std::array<char, 40> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, significant).ptr;
  return {buffer.data(), end};
}

}  // namespace

void Extent::add(double value) noexcept {
  if (!std::isfinite(value)) return;
  low = any ? std::min(low, value) : value;
  high = any ? std::max(high, value) : value;
  any = true;
}

std::string FigureAxis::format() const { return decimals < 0 ? "%g" : "%." + std::to_string(decimals) + "f"; }

double FigureAxis::label_width_px(double size_px) const {
  double widest = 0.0;
  const int ticks = static_cast<int>((high - first_tick) / step + 1e-9);
  for (int i = 0; i <= ticks; ++i) {
    const double at = first_tick + i * step;
    widest = std::max(widest, text_width_px(decimals < 0 ? general(at) : fixed(at, decimals), size_px));
  }
  return widest;
}

FigureAxis axis_over(const Extent& extent, std::optional<double> minimum, std::optional<double> maximum, bool from_zero,
               double margin, int most_ticks) {
  double low = minimum.value_or(extent.any ? extent.low : 0.0);
  double high = maximum.value_or(extent.any ? extent.high : 1.0);
  const bool zero = from_zero && low >= 0.0 && !minimum && maximum.value_or(1.0) > 0.0;
  if (zero) low = 0.0;
  if (!(low < high)) {  // one value only, or all beyond a given end
    const double half =
        std::max(std::fabs(low), std::fabs(high)) > 0.0 ? 0.5 * std::fabs(high) + 0.5 * std::fabs(low) : 1.0;
    if (!minimum && !zero) low = std::min(low, high) - half;
    if (!maximum) high = std::max(low, high) + half;
  }
  const double size = high - low;
  FigureAxis axis;
  axis.low = minimum || zero ? low : low - margin * size;
  axis.high = maximum ? high : high + margin * size;
  axis.step = round_step(axis.high - axis.low, most_ticks);
  axis.first_tick = std::ceil(axis.low / axis.step - 1e-9) * axis.step;
  if (axis.first_tick == 0.0) axis.first_tick = 0.0;  // not -0
  axis.decimals = decimals_of(axis.step, std::max(std::fabs(axis.low), std::fabs(axis.high)));
  return axis;
}

}  // namespace banyan::study
