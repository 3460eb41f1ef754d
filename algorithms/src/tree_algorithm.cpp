// SPDX-License-Identifier: MIT
#include "banyan/algorithms/tree_algorithm.hpp"

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/algorithms/swarms.hpp"
#include "banyan/controller/core/speed_parameter.hpp"

namespace banyan {

std::vector<BoundParameter> bind(ConvoyParams& params) {
  return bind_all(params, tree_parameters(), convoy_parameters(), healing_parameters(), power_parameters(),
                  speed_parameter<ConvoyParams>);
}

namespace {

// Robots with batteries say more and remember more.
class Convoy final : public TreeAlgorithmOf<ConvoySwarm> {
 public:
  using TreeAlgorithmOf::TreeAlgorithmOf;
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    if (!setup.platform.battery) return TreeAlgorithmOf::make(setup, members);
    return std::make_unique<SwarmOf<PoweredConvoySwarm>>(with_room_for_relief(params(setup)), setup.platform, members,
                                                         setup.history);
  }
};

}  // namespace

const Algorithm& convoy() noexcept {
  static constexpr Convoy algorithm(
      "convoy", "a sparse tree that its workers tow; spares join near the root, without travelling", convoy_defaults);
  return algorithm;
}

}  // namespace banyan
