// SPDX-License-Identifier: MIT
// Starting gnuplot.
#pragma once

#include <string>

namespace banyan::study {

// Runs the script, which draws `output`.svg, .pdf and .png, and waits for it. gnuplot is looked up
// in PATH and started without a shell, without the user's settings and with nothing on standard
// input. `output` is absolute. FigureError, with what gnuplot had to say, if it cannot be started
// or fails.
void run_gnuplot(const std::string& script, const std::string& output);

}  // namespace banyan::study
