// SPDX-License-Identifier: MIT
// Results as tidy tables (table.hpp).
#include "banyan/record/table.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "banyan/world/placement.hpp"
#include "cell.hpp"

namespace banyan::record {

namespace {

using measure::column;
using measure::ColumnIn;
using measure::quantity;

constexpr int format_version = 1;

constexpr measure::Column<Identification> identifying_table[] = {
    column<&Identification::name>("name", "the scenario's name"),
    column<&Identification::algorithm>("algorithm", "mission.algorithm"),
    column<&Identification::reading>("reading", "mission.reading: literal or corrected"),
    column<&Identification::body>("body", "robot.body: disks, box2d or linear"),
    column<&Identification::line_of_sight>("line_of_sight", "radio blocked by bodies and obstacles"),
    quantity<&Identification::sight_leak>("sight_leak",
                                          "share of the lines of sight past one body over which packets get through"),
    quantity<&Identification::loss>("loss", "probability that a packet is lost", "packet loss"),
    column<&Identification::targets>("targets", "number of targets at the start"),
    quantity<&Identification::target_radius_m>("target_radius_m", "the farthest target from the centre of the start",
                                               "farthest target (m)"),
    quantity<&Identification::redundancy>("redundancy", "the paper's k: robots in units of sum |p| / 0.77 C"),
    quantity<&Identification::range_m>("range_m", "communication range C", "radio range C (m)"),
    quantity<&Identification::tick_s>("tick_s", "length of a tick", "length of a tick (s)"),
    column<&Identification::seed>("seed", "of all random draws"),
    column<&Identification::version>("version", "of Banyan"),
    column<&Identification::git>("git", "commit Banyan was built from"),
};

constexpr measure::Column<RunRow> further_table[] = {
    column<&RunRow::interrupted>("interrupted", "stopped from outside before completion or limit",
                                 "stopped runs (share)"),
    {"format_version", "of this table", 0, [](const RunRow&) -> Cell { return std::uint64_t{format_version}; }},
};

struct RunTable {
  RunTable() {
    constexpr auto id = [](const RunRow& row) -> const Identification& { return row.id; };
    constexpr auto run = [](const RunRow& row) -> const measure::Run& { return row.run; };
    constexpr auto whole = [](const RunRow& row) -> const RunRow& { return row; };
    for (const auto& of : identifying_table) columns.push_back(measure::column_in<RunRow, id>(of));
    for (const auto& of : measure::run_columns()) columns.push_back(measure::column_in<RunRow, run>(of));
    for (const auto& of : further_table) columns.push_back(measure::column_in<RunRow, whole>(of));
  }
  std::vector<ColumnIn<RunRow>> columns;
};

std::span<const ColumnIn<RunRow>> run_table() {
  static const RunTable table;
  return table.columns;
}

void write_csv_field(Text& out, std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) return out.put(field);
  out.put('"');
  for (const char c : field) {
    if (c == '"') out.put('"');
    out.put(c);
  }
  out.put('"');
}

template <class Columns> std::string header_of(const Columns& columns) {
  std::string line;
  for (const auto& column : columns) {
    if (!line.empty()) line += ',';
    line += column.name;
  }
  return line;
}

template <class Columns, class RowType> void write_row(Text& out, const Columns& columns, const RowType& row) {
  for (const auto& column : columns) {
    write_cell_csv(out, column.cell(row), column.decimals);
    out.put(',');
  }
  out.drop_last();
}

std::string_view body_name(world::BodyModel body) noexcept {
  switch (body) {
    case world::BodyModel::disks: return "disks";
    case world::BodyModel::box2d: return "box2d";
    case world::BodyModel::linear: return "linear";
  }
  return "?";
}

}  // namespace

void write_cell_csv(Text& out, const Cell& cell, int decimals) {
  if (const auto* flag = std::get_if<bool>(&cell)) return out.put(*flag ? "true" : "false");
  if (const auto* whole = std::get_if<std::uint64_t>(&cell)) return out.natural(*whole);
  if (const auto* real = std::get_if<double>(&cell)) return out.fixed(*real, decimals, "");
  if (const auto* text = std::get_if<std::string>(&cell)) return write_csv_field(out, *text);
}

void write_cell_json(Text& out, const Cell& cell, int decimals) {
  if (const auto* flag = std::get_if<bool>(&cell)) return out.put(*flag ? "true" : "false");
  if (const auto* whole = std::get_if<std::uint64_t>(&cell)) return out.natural(*whole);
  if (const auto* real = std::get_if<double>(&cell)) return out.fixed(*real, decimals);
  if (const auto* text = std::get_if<std::string>(&cell)) return out.json_string(*text);
  out.put("null");
}

Identification identify(const world::Scenario& scenario, std::string_view version, std::string_view git) {
  Identification id;
  id.name = scenario.name;
  id.algorithm = scenario.mission.algorithm;
  id.reading = scenario.mission.reading;
  id.body = body_name(scenario.robot.body);
  id.line_of_sight = scenario.radio.line_of_sight;
  id.sight_leak = scenario.radio.sight_leak;
  id.loss = scenario.radio.loss;
  const std::vector<Vec2> targets = world::target_positions(scenario);
  id.targets = targets.size();
  double sum_m = 0.0;
  for (const Vec2& target : targets) {
    const double far_m = distance(scenario.swarm.start.center, target);
    sum_m += far_m;
    id.target_radius_m = std::max(id.target_radius_m, far_m);
  }
  const double given = static_cast<double>(scenario.swarm.robots.value_or(0)) * world::redundancy_edge_m(scenario);
  id.redundancy = !scenario.swarm.robots ? scenario.swarm.redundancy : sum_m > 0.0 ? given / sum_m : 0.0;
  id.range_m = scenario.radio.range_m;
  id.tick_s = scenario.tick_s;
  id.seed = scenario.seed;
  id.version = version;
  id.git = git;
  return id;
}

std::span<const ColumnIn<RunRow>> run_columns() { return run_table(); }
std::span<const ColumnIn<RunRow>> result_columns() { return run_table().subspan(std::size(identifying_table)); }
std::span<const measure::Column<measure::Tick>> series_columns() noexcept { return measure::tick_columns(); }

std::string columns_markdown() {
  std::string page =
      "# The columns of results\n\n"
      "Written by `banyan keys --columns`; a test checks it. What a metric means in detail is on the page of "
      "[the model](model.md#what-is-measured).\n";
  const auto add = [&page](std::string_view heading, const auto& columns) {
    page += "\n## " + std::string(heading) + "\n\n| column | meaning | in figures |\n|---|---|---|\n";
    for (const auto& column : columns)
      page += "| `" + std::string(column.name) + "` | " + std::string(column.meaning) + " | " +
              std::string(column.in_figures) + " |\n";
  };
  add("A row for a run: run.csv, run.json, runs.csv", run_columns());
  add("A row for a tick: series.csv", series_columns());
  return page;
}

std::string run_csv_header() { return header_of(run_columns()); }
std::string series_csv_header() { return header_of(series_columns()); }

std::string run_csv_row(const RunRow& row) {
  Text line;
  write_row(line, run_columns(), row);
  return std::string(line.view());
}

std::string series_csv_row(const measure::Tick& tick) {
  Text line;
  write_row(line, series_columns(), tick);
  return std::string(line.view());
}

std::string run_json(const RunRow& row, std::string_view config_json) {
  Text out;
  out.put("{\n  \"format\": \"banyan.run\",\n  \"format_version\": ");
  out.natural(format_version);
  out.put(",\n  \"result\": {");
  for (const auto& column : run_columns()) {
    out.put("\n    \"");
    out.put(column.name);
    out.put("\": ");
    write_cell_json(out, column.cell(row), column.decimals);
    out.put(',');
  }
  out.drop_last();
  out.put("\n  },\n  \"config\": ");
  // Text that is not JSON must not make the whole file unreadable.
  if (nlohmann::json::accept(config_json)) {
    out.put(config_json.substr(0, config_json.find_last_not_of(" \n\r\t") + 1));
  } else {
    out.json_string(config_json);
  }
  out.put("\n}\n");
  return std::string(out.view());
}

std::vector<std::string> csv_cells(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted) {
      if (c != '"') cells.back() += c;
      else if (i + 1 < line.size() && line[i + 1] == '"') cells.back() += line[++i];
      else quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

std::optional<std::vector<std::string>> run_cells(std::string_view row) {
  std::vector<std::string> cells = csv_cells(row);
  if (cells.size() != run_table().size() || cells.back() != std::to_string(format_version)) return std::nullopt;
  return cells;
}

std::string csv_quoted(std::string_view field) {
  Text out;
  write_csv_field(out, field);
  return std::string(out.view());
}

std::string json_quoted(std::string_view text) {
  Text out;
  out.json_string(text);
  return std::string(out.view());
}

void write_run_csv(const std::string& path, const RunRow& row, Existing existing) {
  write_file(path, run_csv_header() + "\n" + run_csv_row(row) + "\n", existing);
}

void write_run_json(const std::string& path, const RunRow& row, std::string_view config_json, Existing existing) {
  write_file(path, run_json(row, config_json), existing);
}

}  // namespace banyan::record
