// SPDX-License-Identifier: MIT
// A scenario with all defaults and the algorithms that come with Banyan.
#pragma once

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

inline Scenario plain_scenario() {
  Scenario scenario;
  scenario.algorithms = &algorithms();
  return scenario;
}

}  // namespace banyan::world
