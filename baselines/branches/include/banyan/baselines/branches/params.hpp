// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "banyan/baselines/branches/message.hpp"
#include "banyan/baselines/common/params.hpp"

namespace banyan::baselines::branches {

// Distances and times are those of the authors' program, in which C is 0.8 m and a tick takes 0.1 s.
struct Params : BaselineParams {
  constexpr Params() noexcept { longest_link = 0.9375F; }
  float separation = 0.625F;
  float joining = 0.5625F;
  float spacing = 0.75F;
  float flock = 0.1875F;
  float change_rounds = 8.0F;
  float pause_rounds = 4.0F;
  float transfer_rounds = 30.0F;
  float join_patience_drives = 1.0F;  // ours
};

[[nodiscard]] std::span<const Parameter<Params>> parameters() noexcept;
// The first fault among the values that depend on each other; nothing if there is none.
[[nodiscard]] std::string_view fault(const Params& params) noexcept;

}  // namespace banyan::baselines::branches
