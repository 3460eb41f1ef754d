// SPDX-License-Identifier: MIT
// Everything a designer sets and a step never changes. The defaults here are Table I's outwards
// column in the corrected reading; each policy supplies its own (policy.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace banyan {

// How the paper's misprints and gaps are read (protocol 2, docs/algorithms.md).
enum class Reading : std::uint8_t { literal, corrected };

// What the wheels allow. A holonomic robot moves in any direction without turning.
enum class Drive : std::uint8_t { differential, holonomic };

// What only convoy reads (docs/convoy.md). Every length is in units of C.
struct ConvoyParams {
  float pull_start = 0.675F;        // a child farther than this pulls its parent along
  float pull_width = 0.15F;         // and with full strength so much farther
  float tension_gain = 0.4F;        // edges are taut strings: straight chains, junctions of 120 degrees
  float tension_start = 0.15F;
  float tension_width = 0.15F;
  float slack_gain = 2.0F;          // edges of a chain share their slack
  float first_edge = 0.35F;         // the longest edge that is chosen while there is a choice
  float clearance = 0.08F;          // a robot nearer than this to a segment blocks it, or soon may
  float corridor_width = 0.35F;     // robots within it move out of a tree edge's line of sight
  float corridor_gain = 0.5F;
  float join_margin = 0.05F;        // a spare joins an edge whose ends are nearer than delta minus this
  float shortest_split = 0.4F;      // shorter edges get no spare
  float call_distance = 0.9F;     // a longer edge in need calls spares from afar
  float release_distance = 0.75F;   // a grandparent nearer than this becomes the parent
  float spare_avoidance = 0.14F;    // repulsion from spares begins here
  float merge_distance = 0.93F;     // longest edge made to save a robot, once all below have arrived
  float compact_distance = 0.91F;   // a chain that has arrived stretches its edges to this
  float plan_after_s = 15.0F;       // all have arrived: the root plans chains from target to target; 0: never
};

// Healing after deaths (healing.hpp), in the corrected reading only. Lengths are in units of C.
struct HealingParams {
  float healing = 1.0F;             // 0: nobody takes the place of the dead
  float claim_radius = 0.45F;       // who is nearer to where the root fell silent may become root
  float claim_after_s = 0.5F;       // without heartbeat, beyond 2 I
  float claim_spread_s_m = 1.0F;    // and so much longer per metre from that place: one claims first
  float retreat_after_s = 2.5F;     // without heartbeat: all drive to where the root was
  float succession_after_s = 3.0F;  // without a sign of a target's worker, beyond 2 I
  float succession_spread_s_m = 0.5F;  // and so much longer per metre from the target
  float largest_loss = 0.9F;        // liveness adapts to the share of packets lost, up to this
};

struct Params : ConvoyParams, HealingParams {
  // Motion, Table I
  float safe_range_m = 1.3893F;        // S
  float avoidance_range_m = 0.4316F;   // A
  float ideal_distance_m = 1.90F;      // delta, also the emergency range (protocol 2, row 1)
  float interaction_gain = 10.0F;      // epsilon, with lengths in cm
  float target_gain = 0.49F;           // tau
  // Tree growth, Table I
  float reconfiguration_period_s = 38.8F;  // R
  float liveness_period_s = 1.2F;          // I
  // Uncommitted management, Table I
  float recruitment_distance_m = 1.3209F;  // E
  float insertion_distance_m = 0.0979F;    // J
  // Gaps of the paper
  float avoidance_gain = 0.5F;         // protocol 9
  float parent_margin_m = 0.02F;       // a parent is chosen at d <= delta - margin (corrected)
  float guard_rate_per_s = 1.0F;       // guard (protocol 2, row 4)
  float barrier_timeout_s = 10.0F;     // START and SELECT PARENT never wait longer (protocol 4)
  float handover_timeout_s = 2.0F;     // unacknowledged offer of the root token (protocol 8)
  float insertion_timeout_s = 25.0F;   // EXTEND EDGE gives up (protocol 7)
  float connector_patience_s = 3.0F;   // childless connector turns spare (protocol 3)
  float centroid_margin_m = 0.05F;     // a better root is closer by more than this (protocol 8)
  float arrival_distance_m = 0.2F;     // a worker's pull fades within this (protocol 9)
  // Platform
  float communication_range_m = 2.0F;  // C
  float tick_s = 0.1F;
  float speed_gain_m_s = 0.2F;         // K: speed per unit of u
  float wheel_limit_m_s = 0.2F;
  float wheel_distance_m = 0.1054F;
  bool line_of_sight = true;           // the radio does not go through obstacles and bodies
  Drive drive = Drive::differential;
  Reading reading = Reading::corrected;

  [[nodiscard]] bool corrected() const noexcept { return reading == Reading::corrected; }
  [[nodiscard]] bool heals() const noexcept { return corrected() && healing > 0.5F; }
  // The longest edge a robot may choose (protocol 2, row 4).
  [[nodiscard]] float parent_range_m() const noexcept {
    return corrected() ? ideal_distance_m - parent_margin_m : communication_range_m;
  }
  [[nodiscard]] int ticks(float seconds) const noexcept { return static_cast<int>(seconds / tick_s + 0.5F); }
};

// One number of Params as a user meets it: a key in a scenario's [parameters], a row of
// `banyan algorithms`, an axis of a sweep.
struct ParameterInfo {
  std::string_view key;      // "target_gain"
  std::string_view symbol;   // the paper's, "" if it has none
  std::string_view unit;     // "m", "s", "" ...
  std::string_view meaning;  // one sentence
  std::string_view source;   // "Table I", "protocol 9" ...
  float minimum;
  float maximum;
  float Params::*member;
};

// Every float of Params, in declaration order. Static lifetime.
[[nodiscard]] std::span<const ParameterInfo> parameter_table() noexcept;

// The first fault in words ("recruitment_distance_m must be below safe_range_m"), or nothing.
// Checks each range, 0 < E < S < delta <= C (protocol 2, row 1; delta = C leaves an edge no margin) and
// A < E.
[[nodiscard]] std::string_view fault(const Params& params) noexcept;

}  // namespace banyan
