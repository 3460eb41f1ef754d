// SPDX-License-Identifier: MIT
// How a swarm on batteries lasts: its charge, swaps of robots in the tree, and trips to charging places.
#pragma once

#include <cstdint>
#include <vector>

#include "banyan/measure/moment.hpp"

namespace banyan::measure {

// From the truth and from reports, tick by tick. Without batteries it does nothing. O(edges log degree), no allocation.
class Lasting {
 public:
  struct Row {
    double least_charge = -1.0;                  // of all living robots and ticks; -1: no batteries
    double mean_charge = -1.0;                   // of the living at the end
    std::uint64_t swaps = 0, broken_swaps = 0;   // robots of the tree relieved, and those with a broken edge meanwhile
    std::uint64_t trips = 0, trips_arrived = 0;  // of spares to charging places
    std::uint32_t emptied = 0;                   // robots that died for want of charge
    double lasts_s = -1.0;  // the charge is used up so long after the end at most; -1: it is not, or no batteries
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  explicit Lasting(const world::World& start);
  Lasting(const world::World& start, Row& /*row*/) : Lasting(start) {}
  void observe(const world::World& world);
  void observe(const Moment& now, Row& row);
  void sum_up(const Moment& end, Row& row) const;

  // Of the living, now, as shares of a full battery; -1: none, or no batteries.
  [[nodiscard]] double least_charge() const noexcept { return least_; }
  [[nodiscard]] double mean_charge() const noexcept { return mean_; }
  // A swap: a robot of the tree that had to leave became a spare. It is broken if meanwhile an edge to or from it, or
  // to or from the robot that takes its place, was broken: from the moment that robot joined, or the first at which the
  // leaver is a spare, until a tenth of a drive after it.
  [[nodiscard]] std::uint64_t swaps() const noexcept { return swaps_; }
  [[nodiscard]] std::uint64_t broken_swaps() const noexcept { return broken_swaps_; }
  // A trip: a spare sets out to be charged, and is charged or dies. One that is called to the tree meanwhile makes
  // none.
  [[nodiscard]] std::uint64_t trips() const noexcept { return arrived_ + lost_; }
  [[nodiscard]] std::uint64_t trips_arrived() const noexcept { return arrived_; }
  // At the end: for how long the charge lasts, if the living go on drawing what they drew on average; -1: for ever, or
  // no batteries. Charged are as many as there are slots for, and no more than those that are not among the `committed`
  // robots of the tree (of which those at charging places count, too), each for `charging_share` of its time.
  [[nodiscard]] double lasts_s(const world::World& world, double committed) const noexcept;

 private:
  enum class Stage : std::uint8_t { none, leaving, swapping, left };
  struct Course {
    Stage stage = Stage::none;
    bool broken = false;
    bool travels = false;
    std::uint32_t left_ticks = 0;
    double level = 0.0;  // at the last tick
  };
  void mark_broken(const world::World& world);
  void follow_swap(const world::World& world, std::size_t i);
  // Of the time of a robot that relieves others in turn, what it spends in a slot: the rest it drives to the robots of
  // the tree and back, on average as far as they are from the nearest place.
  [[nodiscard]] double charging_share(const world::World& world, double draws_per_s) const noexcept;
  void follow_trip(const world::World& world, std::size_t i);

  double range_m_;
  std::uint32_t after_ticks_;
  std::vector<Course> courses_;         // by robot; empty: no batteries
  std::vector<std::uint8_t> touched_;   // by robot: an end of a broken edge
  std::vector<std::uint8_t> relieved_;  // by robot: another takes its place
  double least_ = -1.0, mean_ = -1.0, level_sum_ = 0.0;
  double drawn_ = 0.0, drawn_s_ = 0.0;  // by robots that were not charged
  std::uint64_t swaps_ = 0, broken_swaps_ = 0, arrived_ = 0, lost_ = 0;
};

}  // namespace banyan::measure
