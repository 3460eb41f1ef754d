// SPDX-License-Identifier: MIT
// Reading [[figures]] of a study's file.
#pragma once

#include <vector>

#include "banyan/config/table_reader.hpp"
#include "banyan/study/study.hpp"

namespace banyan::study {

// Fills study.figures, whose parts have been read. Without [[figures]]: time and connectivity of every part. Faults go
// to `problems`.
void read_figures(config::TableReader& top, Study& study, std::vector<config::Problem>& problems);

}  // namespace banyan::study
