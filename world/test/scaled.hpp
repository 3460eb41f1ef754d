// SPDX-License-Identifier: MIT
// Scenarios at another scale: all lengths and speeds, or all times, multiplied. The units of the keys tell which are.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string_view>
#include <utility>

#include "banyan/world/schema.hpp"

namespace banyan::world {

struct Factors {
  double length = 1.0;
  double time = 1.0;

  [[nodiscard]] double of(std::string_view unit) const {
    const std::pair<std::string_view, double> all[] = {{"", 1.0},
                                                       {"m", length},
                                                       {"s", time},
                                                       {"m/s", length / time},
                                                       {"m/s^2", length / time / time},
                                                       {"deg", 1.0},
                                                       {"ticks", 1.0},
                                                       {"dB", 1.0},
                                                       {"1/s", 1.0 / time},
                                                       {"1/m", 1.0 / length},
                                                       {"J", 1.0},
                                                       {"W", 1.0 / time},
                                                       {"W s/m", 1.0 / length},
                                                       {"1/rad", 1.0},
                                                       {"kg", 1.0},
                                                       {"N", 1.0},
                                                       {"N m", 1.0}};
    for (const auto& [name, factor] : all)
      if (name == unit) return factor;
    ADD_FAILURE() << "no factor for the unit " << unit;
    return 1.0;
  }
};

template <class Owner> void multiply(std::span<const Key<Owner>> keys, Owner& owner, const Factors& factors) {
  for (const Key<Owner>& key : keys) {
    const double factor = factors.of(key.unit);
    Value value = key.access.applies(owner) ? key.access.get(owner) : Value();
    if (factor == 1.0 || value.index() == 0) continue;
    if (double* number = std::get_if<double>(&value)) *number *= factor;
    else if (Vec2* point = std::get_if<Vec2>(&value)) *point *= factor;
    else
      for (Vec2& p : std::get<std::vector<Vec2>>(value)) p *= factor;
    key.access.set(owner, value);
  }
}

inline Scenario multiplied(Scenario scenario, const Factors& factors) {
  multiply(scenario_keys(), scenario, factors);
  each_list(scenario, [&](std::string_view, auto keys, auto& list) {
    for (auto& owner : list) multiply(keys, owner, factors);
  });
  return scenario;
}

}  // namespace banyan::world
