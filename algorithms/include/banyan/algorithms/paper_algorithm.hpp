// SPDX-License-Identifier: MIT
// The paper's algorithms as hosts meet them, and rules of one's own over the paper's tree.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "banyan/algorithms/swarms.hpp"
#include "banyan/controller/core/algorithm_of.hpp"
#include "banyan/controller/paper/rules.hpp"

namespace banyan {

[[nodiscard]] inline std::vector<BoundParameter> bind(paper::Params& params) {
  return bind_all(params, paper::parameters());
}

// A tree that grows by a rule (paper::Growth), as corrected and as printed.
template <const paper::Growth& growth>
class PaperAlgorithmOf : public AlgorithmOf<PaperSwarm<growth, paper::corrected>> {
  using Corrected = AlgorithmOf<PaperSwarm<growth, paper::corrected>>;
  using Literal = PaperSwarm<growth, paper::literal>;

 public:
  constexpr PaperAlgorithmOf(std::string_view name, std::string_view summary, paper::Params (*defaults)() noexcept)
      : Corrected({.name = name, .summary = summary, .defaults = defaults, .bind = bind, .fault = paper::fault}) {}
  [[nodiscard]] bool knows_readings() const noexcept override { return true; }
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    if (setup.reading != "literal") return Corrected::make(setup, members);
    return std::make_unique<SwarmOf<Literal>>(this->params(setup), setup.platform, members, setup.history);
  }
};

}  // namespace banyan
