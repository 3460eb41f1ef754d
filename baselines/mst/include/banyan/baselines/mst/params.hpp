// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "banyan/baselines/common/params.hpp"

namespace banyan::baselines::mst {

struct Params : BaselineParams {
  float trigger_distance = 0.8F;      // a longer edge asks for a new tree
  float least_period_rounds = 60.0F;  // between two trees
  float countdown_rounds = 20.0F;     // from the first word of a new tree to its construction
  float build_rounds = 250.0F;        // a construction that takes longer is begun anew
  float consensus_gain = 4.0F;        // 1/C, of the motion of robots that have not been sent anywhere
};

[[nodiscard]] std::span<const Parameter<Params>> parameters() noexcept;
// The first fault among the values that depend on each other; nothing if there is none.
[[nodiscard]] std::string_view fault(const Params& params) noexcept;

}  // namespace banyan::baselines::mst
