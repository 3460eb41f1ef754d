// SPDX-License-Identifier: MIT
#include "study_checks.hpp"

#include <algorithm>

#include "banyan/study/results.hpp"

namespace banyan::study {

std::string label_of(const config::Node& value) {
  if (value.string()) return *value.string();
  if (const auto* yes = std::get_if<bool>(&value.value)) return *yes ? "on" : "off";
  if (const auto* whole = std::get_if<std::int64_t>(&value.value)) return std::to_string(*whole);
  if (const auto* real = std::get_if<double>(&value.value)) return config::number_text(*real);
  return "";
}

void check_name(config::TableReader& table, const std::string& name) {
  if (table.has("name") && !config::good_name(name))
    table.report("name", "is \"" + name + "\"; allowed: " + std::string(config::name_rule));
}

void check_metric(config::TableReader& table, std::string_view name, const std::string& metric) {
  if (metric.empty() || is_metric(metric)) return;
  const auto near = config::nearest(metric, metrics());
  table.report(name, "\"" + metric + "\" is no column of numbers in the table of runs" +
                         (near.empty() ? "" : "; did you mean \"" + std::string(near) + "\"?"));
}

std::vector<std::string_view> axis_names(std::span<const Part> parts) {
  std::vector<std::string_view> names;
  for (const auto& part : parts) {
    for (const auto& axis : part.axes) {
      if (std::find(names.begin(), names.end(), axis.name) == names.end()) names.push_back(axis.name);
    }
  }
  return names;
}

void check_axis(config::TableReader& table, std::string_view name, const std::string& axis,
                const std::vector<std::string_view>& known) {
  if (axis.empty() || std::find(known.begin(), known.end(), axis) != known.end()) return;
  std::string list;
  for (const auto k : known) list += (list.empty() ? "" : ", ") + std::string(k);
  const auto near = config::nearest(axis, known);
  table.report(name, "\"" + axis + "\" is no axis here (axes: " + (list.empty() ? "none" : list) + ")" +
                         (near.empty() ? "" : "; did you mean \"" + std::string(near) + "\"?"));
}

}  // namespace banyan::study
