// SPDX-License-Identifier: MIT
// The gnuplot scripts of the figures.
#pragma once

#include <string>

#include "banyan/study/figure.hpp"

namespace banyan::study {

// The whole script, data included; the same bytes for the same figure and name. `name`: of the files
// without their ending, for running the script by hand. std::invalid_argument for a figure that
// cannot be drawn (figure.hpp).
[[nodiscard]] std::string script_of(const BoxFigure& figure, const std::string& name);
[[nodiscard]] std::string script_of(const CurveFigure& figure, const std::string& name);

}  // namespace banyan::study
