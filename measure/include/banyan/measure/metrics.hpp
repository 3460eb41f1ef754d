// SPDX-License-Identifier: MIT
// The metrics of protocol 11: what one tick looked like, and what a whole run came to.
#pragma once

#include <cstdint>
#include <string>

#include "banyan/world/world.hpp"

namespace banyan::measure {

// One tick, as observed from outside (ground truth).
struct Tick {
  std::uint64_t tick = 0;
  double time_s = 0.0;
  std::uint32_t alive = 0;
  std::uint32_t roots = 0, workers = 0, connectors = 0, spares = 0;   // living robots by role
  std::uint32_t committed = 0;             // alive and no spare
  std::uint32_t edges = 0;                 // tree edges: parent and old parent of every robot that is no spare
  std::uint32_t broken_by_distance = 0;    // of these, d >= C
  std::uint32_t broken_by_occlusion = 0;   // of these, d < C but no line of sight
  std::uint32_t broken_by_death = 0;       // of these, the other end is dead
  std::uint32_t components = 0;            // communication graph of the living robots
  std::uint32_t components_by_distance = 0;  // the same without occlusion
  bool fiedler_low = false;                // lambda_2 < 1e-3, with occlusion as simulated
  bool fiedler_low_by_distance = false;
  double fiedler = -1.0;                   // lambda_2; -1: not computed this tick
  double worst_target_distance_m = 0.0;    // largest distance of a target to its worker
  std::uint32_t targets_reached = 0;
};

// A run so far; final once `finished`. The fields are the columns of the results table.
struct Run {
  std::uint64_t ticks = 0;
  double time_s = 0.0;
  bool complete = false;
  double completion_time_s = -1.0;
  double time_limit_s = 0.0;
  double normalized_time = 1.0;            // completion time / limit, 1 when not complete
  double time_bound_s = 0.0;               // lower bound of the completion time
  std::uint32_t robots = 0;
  std::uint32_t robots_bound = 0;          // lower bound of the committed robots
  double steiner_length_m = 0.0;           // length the bound is computed from
  std::uint32_t committed = 0;             // at the end
  double mean_committed = 0.0;
  std::uint64_t broken_ticks = 0;          // at least one broken tree edge
  std::uint64_t broken_ticks_by_distance = 0;
  std::uint64_t broken_ticks_by_occlusion = 0;
  std::uint64_t broken_ticks_by_death = 0;
  double disconnected_time_ratio = 0.0;    // broken_ticks / ticks
  double disconnected_time_ratio_by_distance = 0.0;
  double disconnected_time_ratio_by_occlusion = 0.0;
  std::uint64_t split_ticks = 0;           // communication graph in several components
  std::uint64_t split_ticks_by_distance = 0;
  double fiedler_time_ratio = 0.0;
  double fiedler_time_ratio_by_distance = 0.0;
  std::uint64_t insertions = 0, handovers = 0, repairs = 0;
  std::uint64_t epochs = 0;                // the highest epoch reached
  double start_phase_ticks = 0.0;          // mean length of a barrier phase, as lived by the root
  double select_phase_ticks = 0.0;
  double bytes_per_robot_s = 0.0;          // broadcast
  std::uint64_t hash = 0;                  // state hash of the world at the end
};

}  // namespace banyan::measure
