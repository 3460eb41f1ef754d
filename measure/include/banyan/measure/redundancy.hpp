// SPDX-License-Identifier: MIT
// Whether targets and root stay joined whichever k - 1 other robots are lost, tick by tick, in truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "banyan/measure/disjoint_paths.hpp"
#include "banyan/measure/moment.hpp"

namespace banyan::measure {

// Its graph is the radio graph as simulated of the living robots of the network: those of the tree, and spares that say
// that they keep links (Report::kept). No other spare counts, since nothing keeps it where it is. Its terminals are,
// for each active target, the nearest living worker that serves it, and the newest living root; whatever of these is
// dead and not replaced yet is left out. With one path it looks at nothing and costs nothing.
class Redundancy {
 public:
  struct Row {
    std::uint32_t link_redundancy = 1;  // k
    std::uint32_t companions = 0;       // living spares that keep links, at the end
    // From a drive after completion on, share of ticks with k paths; -1: k = 1, or none was counted.
    double redundant_time_ratio = -1.0;
    std::uint64_t severed_ticks = 0;      // of these, in which living workers or the root were cut off from each other
    double restored_s = -1.0;             // from the last death until there were k paths; -1: not, or k = 1
    std::uint32_t redundant_targets = 0;  // at the end, active targets with k disjoint paths to the root; 0 for k = 1
    std::string single_targets;           // the others, by index, "0 3"
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  // What is counted begins a drive (world::drive_s) after the first completion.
  explicit Redundancy(const world::World& start);
  Redundancy(const world::World& start, Row& row);
  // `completion_s`: when the run was first complete; negative: not yet.
  void observe(const world::World& world, double completion_s);
  void observe(const Moment& now, Row& row);
  void sum_up(const Moment& end, Row& row);

  [[nodiscard]] std::uint32_t wanted() const noexcept { return wanted_; }
  // In the last tick: the least number of disjoint paths between two terminals, at most k; 0: cut off from each other.
  [[nodiscard]] std::uint32_t paths() const noexcept { return paths_; }
  // Of the ticks counted, the share with k paths; -1: none was counted.
  [[nodiscard]] double time_ratio() const noexcept;
  // Of the ticks counted, those in which terminals were cut off from each other.
  [[nodiscard]] std::uint64_t severed_ticks() const noexcept { return severed_; }
  // From the last death to the first tick since with k paths; -1: none died, or not yet.
  [[nodiscard]] double restored_s() const noexcept { return restored_s_; }
  // Now: by active target in the order of the world, the disjoint paths from its worker to the root, at most k.
  [[nodiscard]] std::vector<std::uint32_t> paths_of_targets(const world::World& world);

 private:
  void build(const world::World& world);

  std::uint32_t wanted_;
  double drive_s_;
  std::uint32_t paths_ = 0;
  std::uint64_t counted_ = 0, redundant_ = 0, severed_ = 0;
  std::uint64_t deaths_ = 0;
  double restored_s_ = -1.0;
  DisjointPaths search_;
  Graph graph_;
  std::vector<std::uint32_t> number_;     // by robot, in the graph
  std::vector<std::uint32_t> terminals_;  // the root last, if there is one
  std::vector<std::uint32_t> of_target_;  // by active target: its terminal
  std::vector<double> nearest_;
  bool has_root_ = false;
};

// Living spares that keep links: part of the network, though not of the tree.
[[nodiscard]] std::uint32_t count_companions(const world::World& world) noexcept;

}  // namespace banyan::measure
