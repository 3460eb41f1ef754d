// SPDX-License-Identifier: MIT
// Carries out a plan: what is not in the journal yet is handed to the workers and written down as it
// comes back.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "banyan/study/journal.hpp"
#include "banyan/study/plan.hpp"
#include "banyan/study/workers.hpp"

namespace banyan::study {

// How far it is.
struct Standing {
  std::size_t wanted = 0;  // runs to do in this call
  std::size_t done = 0;    // of these, failed ones included
  std::size_t failed = 0;
  double share = 1.0;    // of the expected work that is done, in [0, 1]
  bool stopped = false;  // before all was done
};
// Called on the caller's thread about ten times a second, and once all runs are done; false stops: what runs is
// finished first.
using Watch = std::function<bool(const Standing&)>;

// Does the runs with the indices `todo` of the plan, the longest first, and adds each to the journal.
// `runs_folder`: where recordings go. Throws record::FileError if the journal cannot be written
// (disk full): everything that was written stays.
Standing execute(const Plan& plan, const std::vector<std::size_t>& todo, Workers& workers, Journal& journal,
                 const std::string& runs_folder, const Watch& watch);

// Seconds of one core that the runs `todo` may take, from a few of them that are really run, for at
// most about `patience_s` seconds. 0 without runs.
[[nodiscard]] double estimate_s(const Plan& plan, const std::vector<std::size_t>& todo, double patience_s);

}  // namespace banyan::study
