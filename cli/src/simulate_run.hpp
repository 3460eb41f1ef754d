// SPDX-License-Identifier: MIT
// One run of a study or a tuning with the program's algorithms.
#pragma once

#include <string>
#include <string_view>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/study/simulate.hpp"

namespace banyan::cli {

inline std::string simulate_run(std::string_view task) { return study::simulate(task, algorithms()); }

}  // namespace banyan::cli
