// SPDX-License-Identifier: MIT
// From a study's results to the boxes of a figure.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "banyan/study/figure.hpp"
#include "banyan/study/results.hpp"

namespace banyan::study {

// The figure of one combination of labels of plan.each. Panels, groups and series without a run are left out; nothing
// is left, and the figure has no panels, if no run has a value.
[[nodiscard]] BoxFigure figure_of(const Study& study, const Results& results, const FigurePlan& plan,
                                  const std::vector<std::string>& each);

// Every combination of labels of these axes that the plan's `where` picks, the last axis fastest.
[[nodiscard]] std::vector<std::vector<std::string>> combinations(const Part& part, const std::vector<std::string>& axes,
                                                                 const Where& where);

}  // namespace banyan::study
