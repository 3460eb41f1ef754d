// SPDX-License-Identifier: MIT
// From a study to its list of runs, the same in every process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/study/study.hpp"

namespace banyan::study {

// One simulation. Two rows of the table that ask for the same one share it.
struct PlannedRun {
  std::string id;               // 16 hexadecimal digits: a digest of the configuration without name,
                                // description and output. With an algorithm that has one, "-" and its fingerprint
  std::size_t combination = 0;  // index into Plan::combinations
  std::uint64_t seed = 0;
  std::string directory;  // readable, "worlds/algorithm=inwards,r=9/seed=17"
  // The same for all versions of its algorithm.
  [[nodiscard]] std::string_view configured() const noexcept { return std::string_view(id).substr(0, 16); }
  double cost = 0.0;  // robots times ticks of the time limit: an upper bound of robot-steps
};

// One row of the table.
struct PlannedRow {
  std::size_t part = 0;
  std::vector<std::size_t> values;  // index of the value of each axis of the part
  std::uint64_t seed = 0;
  std::size_t run = 0;  // index into Plan::runs
};

struct Plan {
  std::vector<config::Configuration> combinations;  // of the axes' values; their seed means nothing
  std::vector<PlannedRun> runs;                     // no id twice
  std::vector<PlannedRow> rows;                     // parts in file order; the last axis and then the seed vary fastest
  std::uint64_t digest = 0;                         // of the ids in order, without fingerprints
  std::vector<std::string> algorithms;              // names of those that there are, in the order of their list
  std::vector<config::Problem> problems;            // warnings too
  [[nodiscard]] bool ok() const noexcept;
};

// Whether a run leaves files of its own besides its row.
[[nodiscard]] bool keeps_files(const config::Configuration& configuration) noexcept;

// The digest as text, 16 hexadecimal digits.
[[nodiscard]] std::string plan_text(const Plan& plan);

// The complete configuration of a run, seed included.
[[nodiscard]] config::Configuration configuration_of(const Plan& plan, const PlannedRun& run);

// How many rows the study has, without making them; may be huge.
[[nodiscard]] double count_rows(const Study& study) noexcept;

using PlanProgress = std::function<void(double rows)>;

// Builds and checks every configuration. Problems: scenarios that cannot be read or are at fault,
// each named with the combination that made it; two runs of one part that are the same. With millions of rows that
// takes a minute: `progress` is told now and then how many there are, and in the end that there are all.
[[nodiscard]] Plan make_plan(const Study& study, const AlgorithmList& algorithms, const PlanProgress& progress = {});

// A shard of the work, "3/8": the runs whose index is 2, 10, 18 ... {1, 1} is everything.
struct Shard {
  std::size_t number = 1;  // 1 to count
  std::size_t count = 1;
  [[nodiscard]] bool whole() const noexcept { return count == 1; }
  [[nodiscard]] bool holds(std::size_t run) const noexcept { return run % count == number - 1; }
};

}  // namespace banyan::study
