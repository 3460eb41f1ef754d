// SPDX-License-Identifier: MIT
#include "banyan/algorithms/tree_algorithm.hpp"

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/algorithms/swarms.hpp"
#include "banyan/controller/core/speed_parameter.hpp"

namespace banyan {

std::vector<BoundParameter> bind(HealingParams& params) {
  return bind_all(params, tree_parameters(), healing_parameters(), speed_parameter<HealingParams>);
}

std::vector<BoundParameter> bind(ConvoyParams& params) {
  return bind_all(params, tree_parameters(), convoy_parameters(), healing_parameters(), power_parameters(),
                  speed_parameter<ConvoyParams>);
}

namespace {

// One of the paper's: a step as printed and one as corrected.
template <auto literal_step, auto corrected_step>
class OfPaper final : public TreeAlgorithmOf<CorrectedSwarm<corrected_step>> {
  using Corrected = TreeAlgorithmOf<CorrectedSwarm<corrected_step>>;

 public:
  using Corrected::Corrected;
  [[nodiscard]] bool knows_readings() const noexcept override { return true; }
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    if (setup.reading != literal_reading_name) return Corrected::make(setup, members);
    return std::make_unique<SwarmOf<LiteralSwarm<literal_step>>>(this->params(setup), setup.platform, members, setup.history);
  }

 private:
  static constexpr std::string_view literal_reading_name = "literal";
};

// Robots with batteries say more and remember more.
class Convoy final : public TreeAlgorithmOf<ConvoySwarm> {
 public:
  using TreeAlgorithmOf::TreeAlgorithmOf;
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    if (!setup.platform.battery) return TreeAlgorithmOf::make(setup, members);
    return std::make_unique<SwarmOf<PoweredConvoySwarm>>(with_room_for_relief(params(setup)), setup.platform, members, setup.history);
  }
};

}  // namespace

const Algorithm& outwards() noexcept {
  static constexpr OfPaper<outwards_literal_step, outwards_step> algorithm(
      "outwards", "grows a spanning tree from the root over all robots, then prunes branches without worker",
      outwards_defaults);
  return algorithm;
}

const Algorithm& inwards() noexcept {
  static constexpr OfPaper<inwards_literal_step, inwards_step> algorithm(
      "inwards", "grows a sparse tree from the workers towards the root; only robots that are needed join",
      inwards_defaults);
  return algorithm;
}

const Algorithm& convoy() noexcept {
  static constexpr Convoy algorithm("convoy",
                                    "a sparse tree that its workers tow; spares join near the root, without travelling",
                                    convoy_defaults);
  return algorithm;
}

}  // namespace banyan
