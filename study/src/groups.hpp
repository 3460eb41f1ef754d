// SPDX-License-Identifier: MIT
// Groups of runs, as the tables of a study have them: by the values of some axes, the others pooled.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "banyan/study/results.hpp"

namespace banyan::study {

// A value index per axis of the part, or any_value for an axis that is pooled. Keys are in the order of the study's
// file, not of the labels' text.
using GroupKey = std::vector<std::size_t>;
constexpr std::size_t any_value = static_cast<std::size_t>(-1);

// Axes that group runs in one part: all of them, and then what the study asks for, each once.
[[nodiscard]] std::vector<std::vector<std::string>> groupings(const Study& study, const Part& part);
[[nodiscard]] GroupKey key_of(const Part& part, const PlannedRow& row, const std::vector<std::string>& by);
[[nodiscard]] std::vector<std::size_t> rows_of(const Results& results, std::size_t part);

// "worlds,outwards,*,9": the cells that name a group, "*" for a pooled axis, and the names of their columns.
[[nodiscard]] std::string group_cells(const Study& study, const Results& results, std::size_t part,
                                      const GroupKey& key);
[[nodiscard]] std::string group_header(const Results& results);

// A number as the tables show it: six significant digits, nothing for NaN, "inf" and "-inf" for no bound.
[[nodiscard]] std::string shown(double value);

}  // namespace banyan::study
