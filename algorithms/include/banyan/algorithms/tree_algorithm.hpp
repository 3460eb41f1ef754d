// SPDX-License-Identifier: MIT
// Algorithms over the tree's blocks as hosts meet them: how their tables, readings and steps become an
// Algorithm. Whoever adds one that has a State and Message of these kinds needs nothing else.
#pragma once

#include <string>
#include <vector>

#include "banyan/controller/convoy/params.hpp"
#include "banyan/controller/core/algorithm.hpp"
#include "banyan/controller/core/swarm_of.hpp"

namespace banyan {

// A row of the table and its number.
struct BoundParameter {
  const ParameterInfo* info;
  float* value;
};
[[nodiscard]] std::vector<BoundParameter> bind(HealingParams& params);
[[nodiscard]] std::vector<BoundParameter> bind(ConvoyParams& params);

// Defaults, scaled; platform; the setup's own values. `follows_range`: the lengths among the defaults stand for
// C = 2 m and grow with it; Table I's are absolute.
void apply(const Setup& setup, bool follows_range, std::span<const BoundParameter> rows, TreeParams& params);
// The first value out of its range, by its key.
[[nodiscard]] std::string range_fault(std::span<const BoundParameter> rows);
// What does not fit together.
[[nodiscard]] inline std::string_view cross_fault(const HealingParams& params) { return tree_fault(params); }
[[nodiscard]] inline std::string_view cross_fault(const ConvoyParams& params) {
  const std::string_view text = tree_fault(params);
  return text.empty() ? convoy_fault(params) : text;
}

}  // namespace banyan
