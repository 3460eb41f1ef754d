// SPDX-License-Identifier: MIT
// What a designer sets about batteries (docs/lasting.md). Charges are shares of a full battery.
#pragma once

#include "banyan/controller/healing/params.hpp"

namespace banyan {

struct PowerParams : HealingParams {
  float relieve_below =
      0.35F;  // a robot of the tree with less, and some more for each hop to a place, asks to be relieved
  float charge_below = 0.85F;  // a spare with less drives to a charging place when nobody needs it
  float ready_above = 0.8F;    // a spare with less joins no edge
  float relief_edge =
      0.825F;  // edges are compacted and merged up to this, so that a robot beside another reaches as far
};

[[nodiscard]] std::span<const Parameter<PowerParams>> power_parameters() noexcept;

[[nodiscard]] std::string_view power_fault(const PowerParams& params) noexcept;

}  // namespace banyan
