// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "banyan/baselines/common/params.hpp"

namespace banyan::baselines::fiedler {

struct Params : BaselineParams {
  constexpr Params() noexcept { target_gain = 0.5F; }  // faster workers leave the estimate behind
  float weight_width = 0.3F;                           // sigma: a link of length d weighs exp(-d^2 / 2 sigma^2)
  float least_connectivity = 0.01F;                    // epsilon: lambda_2 is to stay above it
  float connectivity_gain = 0.0005F;                   // of the gradient of coth(lambda_2 - epsilon)
  float settling_rounds = 200.0F;                      // workers wait for the first estimate
  float iteration_rate = 0.2F;  // of the power iteration: its step in units of 1 / largest weighted degree
};

[[nodiscard]] std::span<const Parameter<Params>> parameters() noexcept;
// The first fault among the values that depend on each other; nothing if there is none.
[[nodiscard]] std::string_view fault(const Params& params) noexcept;

}  // namespace banyan::baselines::fiedler
