// SPDX-License-Identifier: MIT
#include "banyan/world/key.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/decimal.hpp"
#include "banyan/world/names.hpp"

namespace banyan::world {
namespace {

constexpr double radians_per_degree = pi<double> / 180.0;

template <class Turn> Value turned(Value value, const Turn& turn) {
  if (double* angle = std::get_if<double>(&value)) *angle = turn(*angle);
  if (auto* angles = std::get_if<std::vector<double>>(&value))
    for (double& angle : *angles) angle = turn(angle);
  return value;
}

}  // namespace

bool Range::holds(double x) const noexcept {
  return std::isfinite(x) && (above ? x > minimum : x >= minimum) && x <= maximum;
}

std::string range_text(const Range& range, std::string_view unit) {
  const bool low = range.minimum > -std::numeric_limits<double>::infinity();
  const bool high = range.maximum < std::numeric_limits<double>::infinity();
  std::string text;
  if (low && range.above)
    text = "above " + number_text(range.minimum) + (high ? ", at most " + number_text(range.maximum) : "");
  else if (low && high) text = number_text(range.minimum) + " to " + number_text(range.maximum);
  else if (low) text = "at least " + number_text(range.minimum);
  else if (high) text = "at most " + number_text(range.maximum);
  else return "any finite number";
  return unit.empty() ? text : text + " " + std::string(unit);
}

std::optional<std::string> range_fault(double x, const Range& range, std::string_view unit) {
  if (range.holds(x)) return std::nullopt;
  return "is " + number_text(x) + "; allowed: " + range_text(range, unit);
}

std::optional<std::string> whole_range_fault(std::int64_t n, const Range& range, std::string_view unit) {
  // What is not below 2^63 has no whole number above it.
  const bool above = range.maximum < 0x1p63 && n > static_cast<std::int64_t>(range.maximum);
  const bool below = range.minimum >= -0x1p63 && n < static_cast<std::int64_t>(range.minimum);
  if (!above && !below && range.holds(static_cast<double>(n))) return std::nullopt;
  return "is " + std::to_string(n) + "; allowed: " + range_text(range, unit);
}

std::optional<std::string> name_fault(std::string_view word, Names names) {
  if (std::find(names.begin(), names.end(), word) != names.end()) return std::nullopt;
  const std::string_view near = nearest_name(word, names);
  return "must be " + alternatives(names) + ", not " + the_text(word) +
         (near.empty() ? "" : "; did you mean \"" + std::string(near) + "\"?");
}

double radians(double degrees) noexcept { return degrees * radians_per_degree; }

double exact_degrees(double rad) {
  const double about = rad / radians_per_degree;
  // The shortest decimal near it first: 90, not 90.00000000000001.
  for (int digits = 1; digits <= 17; ++digits) {
    std::array<char, 40> text;
    static_cast<void>(std::snprintf(text.data(), text.size(), "%.*g", digits, about));  // always fits
    const double candidate = std::strtod(text.data(), nullptr);
    if (radians(candidate) == rad) return candidate;
  }
  for (double low = about, high = about, i = 0; i < 4; ++i) {
    low = std::nextafter(low, -1e9);
    high = std::nextafter(high, 1e9);
    if (radians(low) == rad) return low;
    if (radians(high) == rad) return high;
  }
  return about;
}

Value in_degrees(Value value) { return turned(std::move(value), exact_degrees); }
Value in_radians(Value value) { return turned(std::move(value), radians); }

}  // namespace banyan::world
