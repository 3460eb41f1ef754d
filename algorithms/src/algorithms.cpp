// SPDX-License-Identifier: MIT
// The one list. An algorithm is a line here and a folder of its own.
#include "banyan/algorithms/algorithms.hpp"

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

const AlgorithmList& algorithms() noexcept {
  static const AlgorithmList all{&outwards(), &inwards(), &convoy(), &link_consensus(), &mst(), &fiedler()};
  return all;
}

}  // namespace banyan
