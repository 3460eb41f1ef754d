// SPDX-License-Identifier: MIT
#include "banyan/controller/power/params.hpp"

namespace banyan {
namespace {

constexpr Parameter<PowerParams> of_power[] = {
    {{"relieve_below", "", "", "batteries: a robot of the tree with less charge than this asks to be relieved",
      "Enough for the wait; 0.02 more for each hop to a charging place.", "lasting", 0.0F, 1.0F},
     &PowerParams::relieve_below},
    {{"charge_below", "", "",
      "batteries: a spare with less charge than this drives to a charging place when nobody needs it",
      "Larger keeps spares full and makes more trips.", "lasting", 0.0F, 1.0F},
     &PowerParams::charge_below},
    {{"ready_above", "", "", "batteries: a spare with less charge than this joins no edge",
      "Above relieve_below, or it would have to leave at once.", "lasting", 0.0F, 1.0F},
     &PowerParams::ready_above},
    {{"relief_edge", "", "C",
      "batteries: robots are saved by edges up to this, so that one beside another reaches as far",
      "Larger saves more robots, and more reliefs have to wait.", "lasting", 0.0F, 1.0F},
     &PowerParams::relief_edge},
};

}  // namespace

std::span<const Parameter<PowerParams>> power_parameters() noexcept { return of_power; }

std::string_view power_fault(const PowerParams& params) noexcept {
  if (!(params.relieve_below < params.ready_above))
    return "relieve_below must be below ready_above, else a spare would have to leave as soon as it has joined";
  if (!(params.ready_above <= params.charge_below))
    return "ready_above must not exceed charge_below, else spares would wait without being charged";
  return {};
}

}  // namespace banyan
