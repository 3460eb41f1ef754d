// SPDX-License-Identifier: MIT
// A study whose runs are not carried out: a test says how each has gone.
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/record/table.hpp"
#include "banyan/study/plan.hpp"
#include "banyan/study/results.hpp"
#include "banyan/study/study.hpp"
#include "banyan/version.hpp"
#include "temporary_folder.hpp"

namespace banyan::study {

using TableRow = std::map<std::string, std::string>;

inline std::vector<TableRow> table_of(const std::string& csv) {
  std::vector<TableRow> rows;
  std::vector<std::string> names;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    const auto cells = record::csv_cells(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), names.size()) << line;
    rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) rows.back()[names[i]] = cells.at(i);
  }
  return rows;
}

class PlannedStudy : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    write("w.toml", "[swarm]\nrobots = 6\n[targets]\ncount = 2\nradius_m = 0.9\n");
  }
  // Of the file s.toml, less its scenario.
  void plan(const std::string& text) {
    auto loaded = parse_study(path("s.toml"), "scenario = \"w.toml\"\n" + text);
    ASSERT_TRUE(loaded.ok()) << config::to_string(loaded.problems.front());
    study_ = std::move(loaded.study);
    plan_ = make_plan(study_, algorithms());
    ASSERT_TRUE(plan_.ok()) << config::to_string(plan_.problems.front());
    outcomes_.clear();
  }
  template <class Fill> void finish(const PlannedRun& run, Fill fill) {
    record::RunRow row{record::identify(configuration_of(plan_, run).scenario, version, git_id()), {}, false};
    fill(row.run);
    outcomes_[run.id] = {record::run_csv_row(row), "", 1.0};
  }
  [[nodiscard]] Results results() const { return {study_, plan_, outcomes_}; }

  Study study_;
  Plan plan_;
  Outcomes outcomes_;
};

}  // namespace banyan::study
