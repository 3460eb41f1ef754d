// SPDX-License-Identifier: MIT
#include "groups.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "banyan/record/table.hpp"

namespace banyan::study {

std::vector<std::vector<std::string>> groupings(const Study& study, const Part& part) {
  std::vector<std::string> all;
  for (const auto& axis : part.axes) all.push_back(axis.name);
  std::vector<std::vector<std::string>> list{all};
  for (const auto& by : study.statistics.by) {
    std::vector<std::string> here;
    for (const auto& name : all) {
      if (std::find(by.begin(), by.end(), name) != by.end()) here.push_back(name);
    }
    if (std::find(list.begin(), list.end(), here) == list.end()) list.push_back(here);
  }
  return list;
}

GroupKey key_of(const Part& part, const PlannedRow& row, const std::vector<std::string>& by) {
  GroupKey key(part.axes.size(), any_value);
  for (std::size_t a = 0; a < key.size(); ++a) {
    if (std::find(by.begin(), by.end(), part.axes[a].name) != by.end()) key[a] = row.values[a];
  }
  return key;
}

std::vector<std::size_t> rows_of(const Results& results, std::size_t part) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < results.rows(); ++row) {
    if (results.planned(row).part == part) rows.push_back(row);
  }
  return rows;
}

std::string group_cells(const Study& study, const Results& results, std::size_t p, const GroupKey& key) {
  const Part& part = study.parts[p];
  std::string text = part.name;
  for (const auto& axis : results.axes()) {
    text += ",";
    for (std::size_t a = 0; a < part.axes.size(); ++a) {
      if (part.axes[a].name != axis) continue;
      text += key[a] == any_value ? "*" : record::csv_quoted(part.axes[a].values[key[a]].label);
    }
  }
  return text;
}

std::string group_header(const Results& results) {
  std::string text = "part";
  for (const auto& axis : results.axes()) text += "," + record::csv_quoted(axis);
  return text;
}

std::string shown(double value) {
  if (std::isnan(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace banyan::study
