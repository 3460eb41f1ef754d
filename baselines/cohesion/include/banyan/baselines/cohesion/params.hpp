// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "banyan/baselines/common/params.hpp"

namespace banyan::baselines::cohesion {

// Gains have the values of the authors' program, where a force of 1 is the full speed.
struct Params : BaselineParams {
  constexpr Params() noexcept { target_gain = 0.8F; }  // faster leaders tear off where the swarm is thin
  float lattice_gain = 1.0F;
  float boundary_gain = 5.0F;
  float leader_gain = 1.0F;
  float help_gain = 1.0F;
  float density_gain = 1.0F;
  float desired_density = 4.32F;  // robots in a square as wide as the longest link
  float thickness_gain = 1.0F;
};

[[nodiscard]] Params defaults() noexcept;
[[nodiscard]] std::span<const Parameter<Params>> parameters() noexcept;
// The first fault among the values that depend on each other; nothing if there is none.
[[nodiscard]] std::string_view fault(const Params& params) noexcept;

}  // namespace banyan::baselines::cohesion
