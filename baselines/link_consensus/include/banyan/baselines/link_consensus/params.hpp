// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "banyan/baselines/common/params.hpp"

namespace banyan::baselines::link_consensus {

struct Params : BaselineParams {
  float add_distance = 0.6F;        // r of Zavlanos & Pappas: nearer robots make a link
  float nominate_distance = 0.75F;  // longer links are proposed to be given up
  float link_gain = 0.01F;          // of the potential along a link
  float root_silence_rounds = 50.0F;
};

[[nodiscard]] std::span<const Parameter<Params>> parameters() noexcept;
// The first fault among the values that depend on each other; nothing if there is none.
[[nodiscard]] std::string_view fault(const Params& params) noexcept;

}  // namespace banyan::baselines::link_consensus
