// SPDX-License-Identifier: MIT
// Results as tidy tables: one row per run, one row per tick. One list of columns serves the CSV
// header, the CSV row and the JSON, so they cannot drift apart.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/measure/metrics.hpp"
#include "banyan/record/file.hpp"
#include "banyan/record/recording.hpp"

namespace banyan::record {

// What was run: the columns that identify a row.
struct Identification {
  std::string name;
  std::string algorithm;
  std::string reading;
  std::string body;
  bool line_of_sight = false;
  double sight_leak = 0.0;
  double loss = 0.0;
  std::uint64_t targets = 0;
  double target_radius_m = 0.0;  // the farthest target from the centre of the start
  double redundancy = 0.0;       // k as given, or the one that `robots` comes to
  double range_m = 0.0;
  double tick_s = 0.0;
  std::uint64_t seed = 0;
  std::string version;
  std::string git;
};
[[nodiscard]] Identification identify(const world::Scenario& scenario, std::string_view version, std::string_view git);

struct RunRow {
  Identification id;
  measure::Run run;
  bool interrupted = false;
};

using measure::Cell;

[[nodiscard]] std::span<const measure::ColumnIn<RunRow>> run_columns();
// The last of these: how the run went. Those before them identify it.
[[nodiscard]] std::span<const measure::ColumnIn<RunRow>> result_columns();
[[nodiscard]] std::span<const measure::Column<measure::Tick>> series_columns() noexcept;

// All of them with their meanings: the page docs/columns.md.
[[nodiscard]] std::string columns_markdown();

// Lines without their end; RFC 4180 quoting.
[[nodiscard]] std::string run_csv_header();
[[nodiscard]] std::string run_csv_row(const RunRow& row);
// The fields of a row, one for each column. Nothing if it is of another format version or has other columns.
[[nodiscard]] std::optional<std::vector<std::string>> run_cells(std::string_view row);
// {"format":"banyan.run","format_version":1,"config":{…},"result":{column: value, …}}, indented.
[[nodiscard]] std::string run_json(const RunRow& row, std::string_view config_json);
[[nodiscard]] std::string series_csv_header();
[[nodiscard]] std::string series_csv_row(const measure::Tick& tick);
[[nodiscard]] std::string csv_quoted(std::string_view field);
// The fields of one line, unquoted; at least one.
[[nodiscard]] std::vector<std::string> csv_cells(std::string_view line);
[[nodiscard]] std::string json_quoted(std::string_view text);

void write_run_csv(const std::string& path, const RunRow& row, Existing existing = Existing::keep);
void write_run_json(const std::string& path, const RunRow& row, std::string_view config_json,
                    Existing existing = Existing::keep);

}  // namespace banyan::record
