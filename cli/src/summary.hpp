// SPDX-License-Identifier: MIT
// What `banyan run` prints at the end: at most 25 lines for a person.
#pragma once

#include <string>
#include <vector>

#include "banyan/record/table.hpp"
#include "outputs.hpp"

namespace banyan::cli {

struct SummaryExtras {
  double wall_s = 0.0;
  int threads = 1;
  std::size_t targets = 0;
  std::size_t targets_reached = 0;
  std::size_t tree_parts = 1;
  std::vector<const record::OutputFormat*> written;
  std::string remarks;  // of a run that was not computed: whole lines, instead of speed and hash
};

[[nodiscard]] std::string summary_text(const record::RunRow& row, const config::Configuration& configuration,
                                       const RunOutputs& outputs, const SummaryExtras& extras);

}  // namespace banyan::cli
