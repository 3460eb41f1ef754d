// SPDX-License-Identifier: MIT
// One run of a study: from its configuration to its row of the table.
#pragma once

#include <string>
#include <string_view>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/measure/metrics.hpp"

namespace banyan::study {

struct RunTask {
  std::string config_json;  // the complete configuration, seed included (config::config_json)
  std::string directory;    // for what the configuration's [output] asks for; "": nothing is kept
};

struct Outcome {
  std::string row;      // record::run_csv_row; "" if there is an error
  std::string error;    // why there is no row, one line
  double wall_s = 0.0;  // time it took
};

// As they travel. decode_outcome() of anything else than an encoded outcome is an outcome with an
// error.
[[nodiscard]] std::string encode(const RunTask& task);
[[nodiscard]] std::string encode(const Outcome& outcome);
[[nodiscard]] Outcome decode_outcome(std::string_view bytes);

// The Work of studies and tuning, once a program has given it its algorithms: an encoded RunTask to an encoded
// Outcome. Never throws: what goes wrong is the outcome's error.
[[nodiscard]] std::string simulate(std::string_view task, const AlgorithmList& algorithms);

}  // namespace banyan::study
