// SPDX-License-Identifier: MIT
// What a study makes of its results: statistics, comparisons, figures.
#pragma once

#include <string>
#include <vector>

#include "banyan/study/results.hpp"

namespace banyan::study {

// Tidy CSVs: a row per part, grouping, group of runs and metric; "*" for an axis that is pooled.
[[nodiscard]] std::string statistics_csv(const Study& study, const Results& results);
// A row per group, pair of values of the axis `compare` and metric (compare.hpp).
[[nodiscard]] std::string comparisons_csv(const Study& study, const Results& results);

// Draws the study's figures into `folder`; returns what went wrong, if anything (no gnuplot), and
// the names of the figures drawn, and of those for which no run has a value. Throws record::FileError.
struct Drawn {
  std::vector<std::string> figures, empty;
  std::vector<std::string> complaints;
};
Drawn draw_figures(const Study& study, const Results& results, const std::string& folder);

}  // namespace banyan::study
