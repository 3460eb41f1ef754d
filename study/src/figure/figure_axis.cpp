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
constexpr double too_long = 1e6;       // from here on, like "%g"
constexpr int significant = 6;         // digits of these
constexpr double log_margin = 1.07;    // factor beyond the extreme values
constexpr double zero_distance = 1.6;  // factor from the least value to the end that stands for 0

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

// Multiples of a round step within the axis.
std::vector<AxisTick> even_ticks(double low, double high, int most_ticks) {
  const double step = round_step(high - low, most_ticks);
  const int decimals = decimals_of(step, std::max(std::fabs(low), std::fabs(high)));
  std::vector<AxisTick> ticks;
  const double first = std::ceil(low / step - 1e-9);
  for (double n = 0.0; (first + n) * step <= high + 1e-9 * step; n += 1.0) {
    const double at = first + n == 0.0 ? 0.0 : (first + n) * step;  // not -0
    ticks.push_back({at, decimals < 0 ? general(at) : fixed(at, decimals)});
  }
  return ticks;
}

// `digits` times every `stride`-th power of ten within the axis.
std::vector<AxisTick> power_ticks(double low, double high, std::initializer_list<double> digits, int stride) {
  std::vector<AxisTick> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low))), last = static_cast<int>(std::ceil(std::log10(high)));
  for (int power = first; power <= last; ++power) {
    if (power % stride != 0) continue;
    for (const double digit : digits) {
      const double at = power < 0 ? digit / std::pow(10.0, -power) : digit * std::pow(10.0, power);
      if (at >= low * (1.0 - 1e-9) && at <= high * (1.0 + 1e-9)) ticks.push_back({at, general(at)});
    }
  }
  return ticks;
}

std::vector<AxisTick> log_ticks(double low, double high, int most_ticks) {
  const auto most = static_cast<std::size_t>(std::max(most_ticks, 2));
  if (auto fine = power_ticks(low, high, {1.0, 2.0, 5.0}, 1); fine.size() >= 3 && fine.size() <= most) return fine;
  for (int stride = 1; stride < 700; ++stride) {
    auto ticks = power_ticks(low, high, {1.0}, stride);
    if (ticks.size() < 2) break;
    if (ticks.size() <= most) return ticks;
  }
  return even_ticks(low, high, most_ticks);
}

}  // namespace

void AxisExtent::add(double value) noexcept {
  if (!std::isfinite(value)) return;
  low = any ? std::min(low, value) : value;
  high = any ? std::max(high, value) : value;
  any = true;
}

std::string FigureAxis::tick_list(bool labels) const {
  std::string text = "(";
  for (const AxisTick& tick : ticks)
    text += (text.size() > 1 ? ", " : "") + in_quotes(labels ? tick.label : "") + " " + number(tick.at);
  return text + ")";
}

double FigureAxis::label_width(double size) const {
  double widest = 0.0;
  for (const AxisTick& tick : ticks) widest = std::max(widest, text_width(tick.label, size));
  return widest;
}

FigureAxis axis_over(const AxisExtent& extent, std::optional<double> minimum, std::optional<double> maximum,
                     bool from_zero, double margin, int most_ticks) {
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
  axis.ticks = even_ticks(axis.low, axis.high, most_ticks);
  return axis;
}

FigureAxis log_axis_over(const AxisExtent& extent, std::optional<double> minimum, std::optional<double> maximum,
                         bool zeros, int most_ticks) {
  const double low = extent.any ? extent.low : maximum ? *maximum / 10.0 : 1.0;
  const double high = extent.any ? extent.high : minimum ? *minimum * 10.0 : 1.0;
  FigureAxis axis;
  axis.scale = Scale::log;
  axis.low = minimum.value_or(low / log_margin);
  axis.high = maximum.value_or(high * log_margin);
  // One value only, or all beyond a given end.
  if (!minimum && axis.low * 1.2 > axis.high) axis.low = std::min(axis.low, axis.high) / 1.5;
  if (!maximum && axis.low * 1.2 > axis.high) axis.high = axis.low * 1.5;
  const double least = axis.low;
  if (zeros && !minimum) axis.low = least / zero_distance;
  axis.ticks = log_ticks(least, axis.high, most_ticks);
  if (zeros && !minimum) axis.ticks.insert(axis.ticks.begin(), AxisTick{axis.low, "0"});
  return axis;
}

}  // namespace banyan::study
