// SPDX-License-Identifier: MIT
// Points of a tuning's search space: the optimiser's in [0, 1]^n, the parameters' in their units.
#pragma once

#include <span>
#include <vector>

#include "banyan/study/tune.hpp"

namespace banyan::study {

// In the order of the bounds. `unit` within [0, 1]; the result never leaves the bounds.
[[nodiscard]] std::vector<double> from_unit(const std::vector<TuneBound>& bounds, std::span<const double> unit);
[[nodiscard]] std::vector<double> to_unit(const std::vector<TuneBound>& bounds, std::span<const double> point);

// The scenario with the point's parameters in place of its own.
[[nodiscard]] world::Scenario with_parameters(world::Scenario scenario, const std::vector<TuneBound>& bounds,
                                              std::span<const double> point);

// What the plan's first world has without tuning, in the order of the bounds.
[[nodiscard]] std::vector<double> untuned_point(const TunePlan& plan);

}  // namespace banyan::study
