// SPDX-License-Identifier: MIT
// The metrics of protocol 11: the values of one tick, and the results of a whole run.
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
  double worst_target_distance_m = 0.0;  // of these, the largest distance to the nearest living worker that
                                         // serves it; if none does, to the body of the one first sent there

  double least_charge = -1.0, mean_charge = -1.0;  // of the living (lasting.hpp); -1: no batteries

  [[nodiscard]] bool all_held() const noexcept { return active_targets > 0 && targets_reached == active_targets; }
  // Held and connected.
  [[nodiscard]] bool complete() const noexcept { return all_held() && tree_parts == 1; }
};

// A run so far. The fields are the columns of the results table. Means, sums over robots and ratios
// are filled in by Observer::result.
struct Run {
  std::uint64_t ticks = 0;
  double time_s = 0.0;
  bool complete = false;  // in time, at some tick
  double completion_time_s = -1.0;
  double time_limit_s = 0.0;
  double normalized_time = 1.0;   // completion time / limit, 1 when not complete
  double time_bound_s = 0.0;      // lower bound of the completion time
  double held_time_ratio = -1.0;  // from completion on, mean share of the targets that are held; -1: not complete
  double unheld_time_ratio_by_death = -1.0;  // of the rest, from a worker's death at its target until it is held again
  double held_ratio = 0.0;                   // at the end, share of the active targets that are held; 1 without any
  double time_ratio = -1.0;                  // completion time / bound; -1: not complete, or the bound is 0
  std::uint32_t robots = 0;
  std::uint32_t robots_bound = 0;  // no fewer committed robots complete the mission (relays.hpp)
  // Of the oracle; 0: not asked, since there are more than a thousand targets.
  std::uint32_t oracle_robots = 0;   // workers and relays: edges of 0.95 C, targets at the start
  std::uint32_t oracle_targets = 0;  // targets at the start that it can hold with the robots there are
  std::uint32_t held_targets = 0;    // at the end, held by a worker that the tree joins to a root
  std::string missed_targets;        // the other active ones, by index and why, "2 given up, 5 3.10 m short"
  bool oracle_exact = false;         // no tree of such edges has fewer
  double oracle_time_s = -1.0;       // straight drives, relays at their places as well; -1: too few robots, or too many
  double steiner_length_m = 0.0;     // shortest network of the targets, certified from below
  double star_length_m = 0.0;        // of the shortest star of the targets, for comparison
  std::uint32_t committed = 0;       // at the end
  double mean_committed = 0.0;
  double committed_ratio = 0.0;        // committed / robots_bound
  double oracle_ratio = 0.0;           // committed / oracle_robots
  double deployment_ratio = 0.0;       // most robots in the tree in a tick up to completion / robots_bound
  std::uint32_t link_redundancy = 1;   // k
  std::uint32_t redundancy_bound = 0;  // no fewer robots give k disjoint paths between targets (redundancy_bound.hpp)
  bool redundancy_exact = false;       // so many are enough
  std::uint32_t companions = 0;        // living spares that keep links, at the end
  double redundancy_ratio = 0.0;       // (committed + companions) / redundancy_bound
  double redundant_time_ratio =
      -1.0;                         // from a drive after completion on, share of ticks with k paths; -1: k = 1, or none
  std::uint64_t severed_ticks = 0;  // of these, in which living workers or the root were cut off from each other
  double restored_s = -1.0;         // from the last death until there were k paths; -1: not, or k = 1
  std::uint32_t redundant_targets = 0;  // at the end, active targets with k disjoint paths to the root; 0 for k = 1
  std::string single_targets;           // the others, by index, "0 3"
  double network_length_m =
      0.0;  // edges to the parents and kept links, at the end; both ends alive, the child no spare
  std::uint64_t broken_ticks = 0;  // at least one broken tree edge
  std::uint64_t broken_ticks_by_distance = 0;
  std::uint64_t broken_ticks_by_occlusion = 0;
  std::uint64_t broken_ticks_by_death = 0;
  double disconnected_time_ratio = 0.0;  // broken_ticks / ticks
  double disconnected_time_ratio_by_distance = 0.0;
  double disconnected_time_ratio_by_occlusion = 0.0;
  double liveness_period_s = 0.0;                // I
  std::uint64_t broken_ticks_after_silence = 0;  // at least one tree edge broken for longer than I
  double disconnected_time_ratio_after_silence = 0.0;
  std::uint32_t start_parts = 1;  // components at the start, over links of which both ends hear each other
  std::uint64_t split_ticks = 0;  // communication graph in several components
  std::uint64_t split_ticks_by_distance = 0;
  double fiedler_time_ratio = 0.0;
  double fiedler_time_ratio_by_distance = 0.0;
  std::uint64_t two_roots_ticks = 0;  // more than one living root
  double longest_two_roots_s = 0.0;   // the longest such time without a break
  std::uint64_t insertions = 0, handovers = 0, repairs = 0;
  std::uint64_t elections = 0, replacements = 0;  // of a root, of a worker that had fallen silent
  std::uint64_t epochs = 0;                       // the last epoch reached; counters that wrap are counted on
  std::uint64_t rejected = 0;                     // readings that did not pass the gates of robots (gate.hpp)
  std::string rejected_by;                        // these robots, "3, 5"
  double start_phase_ticks = 0.0;                 // mean length of a barrier phase at the root
  double select_phase_ticks = 0.0;
  double bytes_per_robot_s = 0.0;              // broadcast
  std::uint64_t messages = 0;                  // broadcast, by all robots
  std::uint64_t decisions = 0;                 // changes of role, parent or served target, of all robots (effort.hpp)
  double driven_m = 0.0;                       // mean over the robots at the start (effort.hpp)
  std::int64_t overlap_ticks = -1;             // two living bodies in one place (overlaps.hpp); -1: they cannot be
  double least_charge = -1.0;                  // of all living robots and ticks (lasting.hpp); -1: no batteries
  double mean_charge = -1.0;                   // of the living at the end
  std::uint64_t swaps = 0, broken_swaps = 0;   // robots of the tree relieved, and those with a broken edge meanwhile
  std::uint64_t trips = 0, trips_arrived = 0;  // of spares to charging places
  std::uint32_t emptied = 0;                   // robots that died for want of charge
  double lasts_s = -1.0;  // the charge is used up so long after the end at most; -1: it is not, or no batteries
  std::uint32_t deaths = 0;
  std::uint32_t survivors = 0;     // alive at the end
  double last_death_s = -1.0;      // -1: none died
  bool recovered = false;          // from the last death (recovery.hpp); false if none died
  double recovery_time_s = -1.0;   // from the last death; -1: not recovered
  std::uint32_t lost_holders = 0;  // workers that died at their targets (takeovers.hpp)
  double held_again_s = -1.0;      // from then until such a target was held again, median; -1: none, or most never were
  bool survivors_suffice = true;   // as many as the bound for the targets active at the end
  std::uint64_t hash = 0;          // state hash of the world at the end
};

}  // namespace banyan::measure
