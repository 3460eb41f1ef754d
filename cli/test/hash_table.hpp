// SPDX-License-Identifier: MIT
// A table of hashes that runs must have: golden_hashes.csv, trajectories.csv. Each row says what is run, for how
// many ticks, and its hash; every shared scenario has a row, and all runs have one that a test asks for.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"

namespace banyan::cli {

struct HashRow {
  std::vector<std::string> run;  // the scenario's name, and what else the table says of the run
  std::uint64_t ticks = 0;
  std::string hash;
};

inline std::vector<std::string> split_at(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

// Columns `run`, then ticks and hash.
inline std::vector<HashRow> read_hashes(const char* path, const std::string& run_columns) {
  std::vector<HashRow> rows;
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, run_columns + ",ticks,hash") << path;
  const std::size_t columns = split_at(line, ',').size();
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split_at(line, ',');
    if (cells.size() != columns) {
      ADD_FAILURE() << path << ": " << line;
      continue;
    }
    rows.push_back({{cells.begin(), cells.end() - 2}, std::stoull(cells[columns - 2]), cells[columns - 1]});
  }
  return rows;
}

inline void write_hashes(const char* path, const std::string& run_columns, const std::vector<HashRow>& rows) {
  std::ofstream out(path);
  out << run_columns << ",ticks,hash\n";
  for (const HashRow& row : rows) {
    for (const std::string& cell : row.run) out << cell << ",";
    out << row.ticks << "," << row.hash << "\n";
  }
}

inline config::Loaded load_shared(const std::string& scenario, const std::vector<std::string>& overrides) {
  std::vector<config::Override> list;
  list.reserve(overrides.size());
  for (const std::string& text : overrides) list.push_back({text, "hashes"});
  return config::load_configuration(std::string(BANYAN_SCENARIOS) + "/" + scenario + ".toml", algorithms(), list);
}

// Names of the shared scenarios, sorted.
inline std::vector<std::string> shared_scenarios() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(BANYAN_SCENARIOS))
    names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

using Runs = std::vector<std::vector<std::string>>;

// A row without hash behind the others of its scenario, for as many ticks as they have.
inline void add_row(std::vector<HashRow>& rows, const std::vector<std::string>& run) {
  constexpr std::uint64_t usual_ticks = 1200;
  const auto last =
      std::find_if(rows.rbegin(), rows.rend(), [&](const HashRow& row) { return row.run.front() == run.front(); });
  if (last == rows.rend()) rows.push_back({run, usual_ticks, ""});
  else rows.insert(last.base(), {run, last->ticks, ""});
}

// Runs every row that is `wanted` and compares; each of `asked` must begin a row. With BANYAN_RENEW_GOLDEN in the
// environment, rows that are missing are added, and what came out is written.
template <class HashOf, class Wanted>
void check_hashes(const char* path, const std::string& run_columns, const Runs& asked, const HashOf& hash_of,
                  const Wanted& wanted) {
  const bool renews = std::getenv("BANYAN_RENEW_GOLDEN") != nullptr;
  std::vector<HashRow> rows = read_hashes(path, run_columns);
  for (const std::vector<std::string>& run : asked) {
    const auto is_of_run = [&](const HashRow& row) { return std::equal(run.begin(), run.end(), row.run.begin()); };
    if (std::any_of(rows.begin(), rows.end(), is_of_run)) continue;
    std::string missing;
    for (const std::string& cell : run) missing += " " + cell;
    ADD_FAILURE() << path << " has no row of" << missing;
    if (renews) add_row(rows, run);
  }
  for (HashRow& row : rows) {
    if (!wanted(row)) continue;
    std::string name;
    for (const std::string& cell : row.run) name += cell + " ";
    SCOPED_TRACE(name);
    const std::string hash = hash_of(row);
    EXPECT_EQ(hash, row.hash);
    row.hash = hash;
  }
  if (renews) write_hashes(path, run_columns, rows);
}
template <class HashOf>
void check_hashes(const char* path, const std::string& run_columns, const Runs& asked, const HashOf& hash_of) {
  check_hashes(path, run_columns, asked, hash_of, [](const HashRow&) { return true; });
}

}  // namespace banyan::cli
