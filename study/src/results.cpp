// SPDX-License-Identifier: MIT
#include "banyan/study/results.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "banyan/record/table.hpp"
#include "banyan/version.hpp"

namespace banyan::study {
namespace {

struct RunColumn {
  std::string name;
  bool metric = false;  // numbers or booleans
  bool boolean = false;
  bool identifying = false;
};

// The columns of a run and what they hold, from a row like any other.
const std::vector<RunColumn>& described_columns() {
  static const std::vector<RunColumn> columns = [] {
    const auto sample = record::RunRow{record::identify(world::Scenario{}, version, git_id()), {}, false};
    std::vector<RunColumn> list;
    const std::size_t identifying = record::run_columns().size() - record::result_columns().size();
    for (const auto& column : record::run_columns()) {
      const auto cell = column.cell(sample);
      list.push_back({std::string(column.name), !std::holds_alternative<std::string>(cell),
                      std::holds_alternative<bool>(cell), list.size() < identifying});
    }
    return list;
  }();
  return columns;
}

const RunColumn* find_column(std::string_view name) {
  const auto& columns = described_columns();
  const auto at = std::find_if(columns.begin(), columns.end(), [&](const RunColumn& c) { return c.name == name; });
  return at == columns.end() ? nullptr : &*at;
}

double number_in(const std::string& cell) {
  if (cell == "true") return 1.0;
  if (cell == "false") return 0.0;
  double value = 0.0;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (cell.empty() || error != std::errc{} || stop != cell.data() + cell.size())
    return std::numeric_limits<double>::quiet_NaN();
  return value;
}

// What identifies a run that left no row.
std::vector<std::string> identity_of(const Plan& plan, const PlannedRun& run) {
  const auto scenario = configuration_of(plan, run).scenario;
  auto cells = record::csv_cells(record::run_csv_row({record::identify(scenario, version, git_id()), {}, false}));
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (!described_columns()[c].identifying) cells[c].clear();
  }
  return cells;
}

}  // namespace

bool is_metric(std::string_view name) {
  const auto* column = find_column(name);
  return column && column->metric;
}

bool is_boolean(std::string_view name) {
  const auto* column = find_column(name);
  return column && column->boolean;
}

bool is_identifying(std::string_view name) {
  const auto* column = find_column(name);
  return column && column->identifying;
}

std::vector<std::string_view> metrics() {
  std::vector<std::string_view> names;
  for (const auto& column : described_columns()) {
    if (column.metric && !column.identifying) names.push_back(column.name);
  }
  return names;
}

Results::Results(const Study& study, const Plan& plan, const Outcomes& outcomes) : study_(study), plan_(plan) {
  for (const auto& part : study.parts) {
    for (const auto& axis : part.axes) {
      if (std::find(axes_.begin(), axes_.end(), axis.name) == axes_.end()) axes_.push_back(axis.name);
    }
  }
  for (std::size_t row = 0; row < plan.rows.size(); ++row) {
    const auto& run = plan.runs[plan.rows[row].run];
    const auto found = outcomes.find(run.id);
    if (found == outcomes.end()) continue;
    present_.push_back(row);
    errors_.push_back(found->second.error);
    if (!errors_.back().empty()) ++failed_;
    cells_.push_back(errors_.back().empty() ? record::csv_cells(found->second.row) : identity_of(plan, run));
  }
}

const std::string& Results::label(std::size_t row, std::string_view axis) const {
  static const std::string none;
  const auto& planned_row = planned(row);
  const auto& axes = study_.parts[planned_row.part].axes;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    if (axes[a].name == axis) return axes[a].values[planned_row.values[a]].label;
  }
  return none;
}

Values Results::values(std::string_view column) const {
  const auto& columns = described_columns();
  const auto at = static_cast<std::size_t>(find_column(column) - columns.data());
  Values values;
  values.reserve(rows());
  for (const auto& cells : cells_) values.push_back(number_in(cells[at]));
  return values;
}

std::string Results::csv() const {
  std::vector<std::string> shown;
  for (const auto& axis : axes_) {
    if (!is_identifying(axis)) shown.push_back(axis);
  }
  std::string text = "study,part,run";
  for (const auto& axis : shown) text += "," + record::csv_quoted(axis);
  text += ",error";
  for (const auto& column : described_columns()) text += "," + column.name;
  text += "\n";
  for (std::size_t row = 0; row < rows(); ++row) {
    const auto& p = planned(row);
    text += study_.name + "," + study_.parts[p.part].name + "," + plan_.runs[p.run].id;
    for (const auto& axis : shown) text += "," + record::csv_quoted(label(row, axis));
    text += "," + record::csv_quoted(errors_[row]);
    for (const auto& cell : cells_[row]) text += "," + record::csv_quoted(cell);
    text += "\n";
  }
  return text;
}

}  // namespace banyan::study
