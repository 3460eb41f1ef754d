// SPDX-License-Identifier: MIT
// Runs a mission and looks, at every tick, for what must not happen (docs/soak.md lists it). Independent
// of measure/: own bookkeeping over positions, and what robots report of themselves.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::soak {

struct Finding {
  std::string kind;     // "split", ...: the names of docs/soak.md
  double time_s = 0.0;  // when first
  std::string text;     // for people
};

struct SoakOutcome {
  std::vector<Finding> findings;  // the first of each kind
  bool complete = false;
  double complete_s = 0.0;  // when first
  double bound_s = 0.0;     // the drive of the worker that has the longest way to its target, past obstacles
  double time_s = 0.0;      // the end
  std::uint64_t hash = 0;
};

// From the start to the limit, or ten seconds beyond completion and a minute beyond the last event. `twice`: a second
// run, on two threads and unobserved, must end in the same state.
[[nodiscard]] SoakOutcome watch(const world::Scenario& scenario, bool twice);

// Whether a finding of this kind in such a mission is a broken promise (docs/soak.md) or, so far, a
// known weakness that is only reported.
[[nodiscard]] bool is_promised(const std::string& kind, const world::Scenario& scenario);

}  // namespace banyan::soak
