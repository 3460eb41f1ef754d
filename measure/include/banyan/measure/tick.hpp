// SPDX-License-Identifier: MIT
// One tick, as observed from outside (ground truth): a row of series.csv.
#pragma once

#include <cstdint>
#include <span>

#include "banyan/measure/column.hpp"

namespace banyan::measure {

struct Tick {
  std::uint64_t tick = 0;
  double time_s = 0.0;
  std::uint32_t alive = 0;
  std::uint32_t roots = 0, workers = 0, connectors = 0, spares = 0;  // living robots by role
  std::uint32_t committed = 0;                                       // alive and no spare
  std::uint32_t edges = 0;  // tree edges: parent and old parent of every robot that is not a spare, links that it keeps
  std::uint32_t broken_by_distance = 0;      // of these, d >= C
  std::uint32_t broken_by_occlusion = 0;     // of these, d < C but no line of sight, nor a leak
  std::uint32_t broken_by_death = 0;         // of these, the other end is dead
  std::uint32_t broken_after_silence = 0;    // of all broken ones, for longer than I without a break
  std::uint32_t components = 0;              // communication graph of the living robots
  std::uint32_t components_by_distance = 0;  // the same without occlusion
  std::uint32_t tree_parts = 1;  // components of the graph of the living that are not spares; 0: no root lives
  bool fiedler_low = false;      // lambda_2 < 1e-3, with occlusion as simulated
  bool fiedler_low_by_distance = false;
  double fiedler = -1.0;              // lambda_2; -1: not computed this tick
  std::uint32_t disjoint_paths = 0;   // the least number between two of targets and root (redundancy.hpp); 0 for k = 1
  std::uint32_t active_targets = 0;   // not given up
  std::uint32_t targets_reached = 0;  // of these, held: a living worker that serves it is within tolerance
  std::uint32_t visits = 0, visited = 0;  // places to be visited, and those where a robot has been
  double worst_target_distance_m = 0.0;   // of these, the largest distance to the nearest living worker that
                                          // serves it; if none does, to the body of the one first sent there

  double least_charge = -1.0, mean_charge = -1.0;  // of the living (lasting.hpp); -1: no batteries

  [[nodiscard]] bool all_held() const noexcept {
    return (active_targets > 0 || visits > 0) && targets_reached == active_targets && visited == visits;
  }
  // Held and visited, and connected.
  [[nodiscard]] bool complete() const noexcept { return all_held() && tree_parts == 1; }
  // Of the active targets, the share that is held; 1 without any.
  [[nodiscard]] double held_share() const noexcept {
    return active_targets > 0 ? static_cast<double>(targets_reached) / static_cast<double>(active_targets) : 1.0;
  }
};

[[nodiscard]] std::span<const Column<Tick>> tick_columns() noexcept;

}  // namespace banyan::measure
