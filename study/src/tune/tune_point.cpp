// SPDX-License-Identifier: MIT
#include "tune_point.hpp"

#include <algorithm>

namespace banyan::study {
std::vector<double> from_unit(const std::vector<TuneBound>& bounds, std::span<const double> unit) {
  std::vector<double> point;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const auto& bound = bounds[i];
    point.push_back(std::clamp(bound.low + unit[i] * (bound.high - bound.low), bound.low, bound.high));
  }
  return point;
}

std::vector<double> to_unit(const std::vector<TuneBound>& bounds, std::span<const double> point) {
  std::vector<double> unit;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const auto& bound = bounds[i];
    unit.push_back(std::clamp((point[i] - bound.low) / (bound.high - bound.low), 0.0, 1.0));
  }
  return unit;
}

world::Scenario with_parameters(world::Scenario scenario, const std::vector<TuneBound>& bounds,
                                std::span<const double> point) {
  auto& parameters = scenario.mission.parameters;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const auto& p) { return p.first == bounds[i].parameter; });
    if (found != parameters.end()) found->second = point[i];
    else parameters.emplace_back(bounds[i].parameter, point[i]);
  }
  return scenario;
}

std::vector<double> untuned_point(const TunePlan& plan) {
  const world::Scenario& scenario = plan.worlds.front().scenario;
  const Algorithm& algorithm = world::algorithm_of(scenario);
  const auto rows = algorithm.parameters();
  const auto values = algorithm.values(world::setup_of(scenario));
  std::vector<double> point;
  for (const auto& bound : plan.bounds) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (rows[k]->key == bound.parameter) point.push_back(config::widened(values[k]));
    }
  }
  return point;
}

}  // namespace banyan::study
