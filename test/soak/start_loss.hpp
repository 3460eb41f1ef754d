// SPDX-License-Identifier: MIT
// How many packets the links of a start lose on average: from the formulas of docs/model.md, with no code of the
// world's radio.
#pragma once

#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::soak {

// The share of its packets that a link of this length loses on average, over both directions and all shadows.
[[nodiscard]] double mean_loss(const world::RadioModel& radio, double length_m);

// Its mean over links of these lengths; 0 if there are none.
[[nodiscard]] double mean_loss(const world::RadioModel& radio, const std::vector<double>& lengths_m);

}  // namespace banyan::soak
