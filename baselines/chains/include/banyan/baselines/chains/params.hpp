// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "banyan/baselines/chains/message.hpp"
#include "banyan/baselines/common/params.hpp"

namespace banyan::baselines::chains {

// Distances and times are those of the authors' program, in which C is 2.5 m and a tick takes 0.1 s.
struct Params : BaselineParams {
  constexpr Params() noexcept {
    liveness_rounds = 40.0F;
    longest_link = 0.72F;  // MAX
  }
  float safe_distance = 0.56F;      // SAFE
  float critical_distance = 0.64F;  // CRITICAL
  float chains_per_target = 1.0F;   // k
  float request_rounds = 20.0F;
  float ignore_rounds = 100.0F;
  float gap_patience_drives = 2.0F;
  float side_offset = 0.3F;  // theirs: half as much
  float free_spacing = 0.16F;

  [[nodiscard]] int chains() const noexcept { return static_cast<int>(chains_per_target + 0.5F); }
};

[[nodiscard]] std::span<const Parameter<Params>> parameters() noexcept;
// The first fault among the values that depend on each other; nothing if there is none.
[[nodiscard]] std::string_view fault(const Params& params) noexcept;

}  // namespace banyan::baselines::chains
