// SPDX-License-Identifier: MIT
// "Optimized Design Parameters" (paper Table I), and the few numbers that the paper leaves out.
#pragma once

#include <span>

#include "banyan/controller/core/parameter.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan::paper {

struct Params : Machine {
  float safe_range = 0.0F;              // S, C
  float avoidance_range = 0.0F;         // A, C
  float ideal_distance = 0.0F;          // delta, C; also the emergency range (row 1)
  float interaction_gain = 0.0F;        // epsilon, C
  float target_gain = 0.0F;             // tau
  float reconfiguration_drives = 0.0F;  // R
  float liveness_rounds = 0.0F;         // I
  float recruitment_distance = 0.0F;    // E, C
  float insertion_distance = 0.0F;      // J, C
  // Not in the paper
  float arrival_distance = 0.1F;  // C: a worker's pull fades within this
  float avoidance_gain = 0.5F;
  float guard_rate = 10.0F;  // per drive (corrected)
  float speed_gain = 1.0F;   // K: speed per unit of u
};

// The columns of Table I.
[[nodiscard]] Params outwards_column() noexcept;
[[nodiscard]] Params inwards_column() noexcept;

[[nodiscard]] std::span<const Parameter<Params>> parameters() noexcept;
// The first fault among values that depend on each other, in words; nothing if there is none.
[[nodiscard]] std::string_view fault(const Params& params) noexcept;

}  // namespace banyan::paper
