// SPDX-License-Identifier: MIT
// What figures call things (words.hpp).
#include "words.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "banyan/record/table.hpp"

namespace banyan::study {

namespace {

constexpr std::pair<std::string_view, std::string_view> units[] = {{"_m_s", "m/s"}, {"_rad_s", "rad/s"}, {"_m", "m"},
                                                                   {"_s", "s"},     {"_deg", "°"},       {"_cm", "cm"}};

bool is_number(std::string_view text) {
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && stop == text.data() + text.size();
}

}  // namespace

std::string words_of_name(std::string_view name) {
  std::string unit;
  for (const auto& [suffix, words] : units) {
    if (!unit.empty() || !name.ends_with(suffix) || name.size() == suffix.size()) continue;
    unit = " (" + std::string(words) + ")";
    name.remove_suffix(suffix.size());
  }
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text + unit;
}

std::string words_of_metric(std::string_view metric) {
  const auto columns = record::run_columns();
  const auto at =
      std::find_if(columns.begin(), columns.end(), [&](const auto& column) { return column.name == metric; });
  return at == columns.end() || at->in_figures.empty() ? words_of_name(metric) : std::string(at->in_figures);
}

std::string with_value(std::string_view title, std::string_view label) {
  const std::string name(title), value(label);
  if (label == "on" || label == "off") return name + " " + value;
  if (!is_number(label)) return name + ": " + value;
  const std::size_t bracket = name.rfind(" (");
  if (bracket == std::string::npos || !name.ends_with(')')) return name + " = " + value;
  const std::string unit = name.substr(bracket + 2, name.size() - bracket - 3);
  return name.substr(0, bracket) + " = " + value + " " + unit;
}

}  // namespace banyan::study
