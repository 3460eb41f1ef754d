// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "banyan/rivals/branches/message.hpp"
#include "banyan/rivals/common/params.hpp"

namespace banyan::rivals::branches {

// Distances in C and times are those of the authors' program, in which C is 0.8 m and a tick takes 0.1 s.
struct Params : RivalParams {
  constexpr Params() noexcept { longest_link_m = 1.875F; }
  float separation_m = 1.25F;
  float joining_m = 1.125F;
  float spacing_m = 1.5F;
  float flock_m = 0.375F;
  float change_timeout_s = 0.8F;
  float change_pause_s = 0.4F;
  float transfer_interval_s = 3.0F;
  float join_patience_s = 10.0F;  // ours
};

[[nodiscard]] std::span<const Parameter<Params>> parameters() noexcept;
// The first fault among the values that depend on each other; nothing if there is none.
[[nodiscard]] std::string_view fault(const Params& params) noexcept;

}  // namespace banyan::rivals::branches
