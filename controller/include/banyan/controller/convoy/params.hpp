// SPDX-License-Identifier: MIT
// What only convoy reads (docs/convoy.md).
#pragma once

#include "banyan/controller/power/params.hpp"

namespace banyan {

struct ConvoyParams : PowerParams {
  float pull_start = 0.675F;  // a child farther than this pulls its parent along
  float pull_width = 0.15F;   // and with full strength this much farther away
  float tension_gain = 0.4F;  // edges are taut strings: straight chains, junctions of 120 degrees
  float tension_start = 0.15F;
  float tension_width = 0.15F;
  float slack_gain = 2.0F;       // edges of a chain share their slack
  float first_edge = 0.35F;      // the longest edge that is chosen while there is a choice
  float clearance = 0.08F;       // a robot nearer than this to a segment blocks it, or soon may
  float corridor_width = 0.35F;  // robots within it move out of a tree edge's line of sight
  float corridor_gain = 0.5F;
  float join_margin = 0.05F;         // a spare joins an edge whose ends are nearer than delta minus this
  float shortest_split = 0.4F;       // shorter edges get no spare
  float call_distance = 0.9F;        // a longer edge in need calls spares from afar
  float release_distance = 0.75F;    // a grandparent nearer than this becomes the parent
  float spare_avoidance = 0.14F;     // repulsion from spares begins here
  float merge_distance = 0.93F;      // longest edge made to save a robot, once all below have arrived
  float compact_distance = 0.91F;    // a chain that has arrived stretches its edges to this
  float plan_after_drives = 1.5F;    // all have arrived: the root plans chains from target to target; 0: never
  float shed_after_drives = 9.0F;    // spares missed for so long without progress: the root gives a target up; 0: never
  float thrift = 0.0F;               // 0 to 1: how much robots count against time, once workers have arrived
  float companion_distance = 0.15F;  // how far beside its robot a companion stands
  int link_redundancy = 1;           // the mission's k: each robot that the tree depends on has k - 1 companions
};

// A length between robots that have arrived: with thrift nearer to G, which no edge outgrows.
[[nodiscard]] inline float thrifty(const ConvoyParams& params, float length) noexcept {
  constexpr float most = 0.7F;  // of the rest of the way to G
  return length + most * params.thrift * (params.ideal_distance - length);
}

[[nodiscard]] std::span<const Parameter<ConvoyParams>> convoy_parameters() noexcept;

// Besides tree_fault() and healing_fault(): an edge pulls before it is as long as it may be, a spare can join one, no
// length that edges are brought to is beyond delta and 0.95 C, and C has room for bodies.
[[nodiscard]] std::string_view convoy_fault(const ConvoyParams& params) noexcept;

}  // namespace banyan
