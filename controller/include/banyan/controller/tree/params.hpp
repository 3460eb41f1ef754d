// SPDX-License-Identifier: MIT
// What a designer sets of convoy's tree, and a step never changes; convoy.cpp has its defaults.
#pragma once

#include <span>
#include <string_view>

#include "banyan/controller/core/parameter.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan {

struct TreeParams : Machine {
  // Motion, Table I
  float safe_range = 0.69465F;      // S
  float avoidance_range = 0.2158F;  // A
  float ideal_distance = 0.95F;     // delta, also the emergency range (protocol 2, row 1)
  float target_gain = 0.49F;        // tau
  // Tree growth, Table I
  float reconfiguration_drives = 3.88F;  // R
  float liveness_rounds = 12.0F;         // I
  // Uncommitted management, Table I
  float recruitment_distance = 0.66045F;  // E
  // Gaps of the paper
  float avoidance_gain = 0.5F;      // protocol 9
  float parent_margin = 0.01F;      // a parent is chosen at d <= delta - margin (corrected)
  float guard_rate = 10.0F;         // guard (protocol 2, row 4)
  float barrier_rounds = 100.0F;    // START and SELECT PARENT never wait longer (protocol 4)
  float handover_rounds = 20.0F;    // unacknowledged offer of the root token (protocol 8)
  float insertion_drives = 2.5F;    // EXTEND EDGE gives up (protocol 7)
  float call_after_rounds = 20.0F;  // a need unanswered for this long calls spares from afar (corrected; protocol 7)
  float connector_rounds = 30.0F;   // childless connector turns spare (protocol 3)
  float centroid_margin = 0.025F;   // a better root is closer by more than this (protocol 8)
  float arrival_distance = 0.1F;    // a worker's pull fades within this (protocol 5)
  float speed_gain = 1.0F;          // K: speed per unit of u
};

[[nodiscard]] std::span<const Parameter<TreeParams>> tree_parameters() noexcept;

// The first fault among the values that depend on each other, in words; nothing if there is none:
// A < E < S < delta <= C (protocol 2, row 1; delta = C leaves an edge no margin).
[[nodiscard]] std::string_view tree_fault(const TreeParams& params) noexcept;

}  // namespace banyan
