// SPDX-License-Identifier: MIT
// Algorithms over the tree's blocks as hosts meet them: what they have in common are tables and faults.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "banyan/controller/convoy/params.hpp"
#include "banyan/controller/core/algorithm_of.hpp"

namespace banyan {

[[nodiscard]] std::vector<BoundParameter> bind(ConvoyParams& params);
// The first fault among values that depend on each other.
[[nodiscard]] inline std::string_view cross_fault(const ConvoyParams& params) noexcept {
  for (const std::string_view text : {tree_fault(params), healing_fault(params)})
    if (!text.empty()) return text;
  return convoy_fault(params);
}

// An algorithm of an A (core/swarm_of.hpp) with these parameters.
template <class A> class TreeAlgorithmOf : public AlgorithmOf<A> {
 public:
  using typename AlgorithmOf<A>::Params;
  constexpr TreeAlgorithmOf(std::string_view name, std::string_view summary, Params (*defaults)() noexcept)
      : AlgorithmOf<A>({.name = name, .summary = summary, .defaults = defaults, .bind = bind, .fault = cross_fault}) {}
};

}  // namespace banyan
