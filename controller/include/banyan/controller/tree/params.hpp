// SPDX-License-Identifier: MIT
// Everything a designer of the paper's algorithms sets and a step never changes. The defaults here are
// Table I's outwards column; each algorithm supplies its own.
#pragma once

#include <span>
#include <string_view>

#include "banyan/controller/core/parameter.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan {

struct TreeParams : Platform {
  // Motion, Table I
  float safe_range_m = 1.3893F;       // S
  float avoidance_range_m = 0.4316F;  // A
  float ideal_distance_m = 1.90F;     // delta, also the emergency range (protocol 2, row 1)
  float interaction_gain = 10.0F;     // epsilon, with lengths in cm
  float target_gain = 0.49F;          // tau
  // Tree growth, Table I
  float reconfiguration_period_s = 38.8F;  // R
  float liveness_period_s = 1.2F;          // I
  // Uncommitted management, Table I
  float recruitment_distance_m = 1.3209F;  // E
  float insertion_distance_m = 0.0979F;    // J
  // Gaps of the paper
  float avoidance_gain = 0.5F;        // protocol 9
  float parent_margin_m = 0.02F;      // a parent is chosen at d <= delta - margin (corrected)
  float guard_rate_per_s = 1.0F;      // guard (protocol 2, row 4)
  float barrier_timeout_s = 10.0F;    // START and SELECT PARENT never wait longer (protocol 4)
  float handover_timeout_s = 2.0F;    // unacknowledged offer of the root token (protocol 8)
  float insertion_timeout_s = 25.0F;  // EXTEND EDGE gives up (protocol 7)
  float call_after_s = 2.0F;          // a need unanswered for this long calls spares from afar (corrected; protocol 7)
  float connector_patience_s = 3.0F;  // childless connector turns spare (protocol 3)
  float centroid_margin_m = 0.05F;    // a better root is closer by more than this (protocol 8)
  float arrival_distance_m = 0.2F;    // a worker's pull fades within this (protocol 9)
  float speed_gain_m_s = 0.2F;        // K: speed per unit of u
};

[[nodiscard]] std::span<const Parameter<TreeParams>> tree_parameters() noexcept;

// The first fault among the values that depend on each other, in words; nothing if there is none:
// A < E < S < delta <= C (protocol 2, row 1; delta = C leaves an edge no margin), R below 65,535 ticks.
[[nodiscard]] std::string_view tree_fault(const TreeParams& params) noexcept;

}  // namespace banyan
