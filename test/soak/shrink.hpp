// SPDX-License-Identifier: MIT
// The smallest scenario found in which the same still goes wrong.
#pragma once

#include <functional>

#include "banyan/world/scenario.hpp"

namespace banyan::soak {

// Tries one simplification after the other (fewer robots, targets, events, obstacles; a plainer world; a shorter
// run) and keeps those with which `still_fails`, until none helps or `most_runs` were asked for. Scenarios with
// faults are not asked for.
[[nodiscard]] world::Scenario shrink(world::Scenario scenario, double failed_at_s,
                                     const std::function<bool(const world::Scenario&)>& still_fails, int most_runs);

}  // namespace banyan::soak
