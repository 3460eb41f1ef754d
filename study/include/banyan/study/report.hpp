// SPDX-License-Identifier: MIT
// What a study makes of its results: statistics, comparisons, figures.
#pragma once

#include <string>
#include <vector>

#include "banyan/study/figure.hpp"
#include "banyan/study/results.hpp"

namespace banyan::study {

// Tidy CSVs: a row per part, grouping, group of runs and metric; "*" for an axis that is pooled.
[[nodiscard]] std::string statistics_csv(const Study& study, const Results& results);
// A row per group, pair of values of the axis `compare` and metric (compare.hpp).
[[nodiscard]] std::string comparisons_csv(const Study& study, const Results& results);

// Writes the study's figures into `folder`, NAME.json, and draws them. Throws record::FileError.
struct Drawn {
  std::vector<std::string> figures, empty;  // written; not, since no run has a value
  std::string complaint;                    // of the drawer, "" if all could be drawn
};
Drawn draw_figures(const Study& study, const Results& results, const std::string& folder, const Drawer& drawer = {});

}  // namespace banyan::study
