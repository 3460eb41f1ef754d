// SPDX-License-Identifier: MIT
// A scenario with all defaults and the algorithms that come with Banyan.
#pragma once

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

inline Scenario plain_scenario() { return plain_scenario(algorithms()); }

}  // namespace banyan::world
