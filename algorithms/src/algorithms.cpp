// SPDX-License-Identifier: MIT
// The one list. An algorithm is a line here and a folder of its own.
#include "banyan/algorithms/algorithms.hpp"

#include <algorithm>
#include <array>

#include "banyan/algorithms/swarms.hpp"
#include "banyan/algorithms/tree_algorithm.hpp"

namespace banyan {
namespace {

// ---- The algorithms ----

// One of the paper's: a step as printed and one as corrected.
template <auto literal_step, auto corrected_step>
class OfPaper final : public TreeAlgorithm<HealingParams> {
 public:
  using TreeAlgorithm::TreeAlgorithm;
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    if (setup.reading == literal_reading_name) return std::make_unique<SwarmOf<LiteralSwarm<literal_step>>>(params(setup), members, setup.history);
    return std::make_unique<SwarmOf<CorrectedSwarm<corrected_step>>>(params(setup), members, setup.history);
  }

 private:
  static constexpr std::string_view literal_reading_name = "literal";
};

}  // namespace

const Algorithm& outwards() noexcept {
  static constexpr OfPaper<outwards_literal_step, outwards_step> algorithm(
      "outwards", "grows a spanning tree from the root over all robots, then prunes branches without worker", outwards_defaults, false);
  return algorithm;
}

const Algorithm& inwards() noexcept {
  static constexpr OfPaper<inwards_literal_step, inwards_step> algorithm(
      "inwards", "grows a sparse tree from the workers towards the root; only robots that are needed join", inwards_defaults, false);
  return algorithm;
}

const Algorithm& convoy() noexcept {
  static constexpr TreeAlgorithmOf<ConvoySwarm> algorithm("convoy", "a sparse tree that its workers tow; spares join near the root, without travelling",
                                                          convoy_defaults, true);
  return algorithm;
}

std::span<const Algorithm* const> algorithms() noexcept {
  static const std::array<const Algorithm*, 3> all{&outwards(), &inwards(), &convoy()};
  return all;
}

// In the order of the longest table, so that the texts of configurations keep theirs.
std::span<const ParameterInfo> parameter_table() noexcept {
  static const std::vector<ParameterInfo> table = [] {
    std::vector<ParameterInfo> rows;
    const auto add = [&](const Algorithm& algorithm) {
      for (const ParameterInfo* info : algorithm.parameters())
        if (std::none_of(rows.begin(), rows.end(), [&](const ParameterInfo& row) { return row.key == info->key; })) rows.push_back(*info);
    };
    const auto all = algorithms();
    add(**std::max_element(all.begin(), all.end(), [](const Algorithm* a, const Algorithm* b) { return a->parameters().size() < b->parameters().size(); }));
    for (const Algorithm* algorithm : all) add(*algorithm);
    return rows;
  }();
  return table;
}

const Algorithm* find_algorithm(std::string_view name) noexcept {
  for (const Algorithm* algorithm : algorithms())
    if (algorithm->name() == name) return algorithm;
  return nullptr;
}

}  // namespace banyan
