// SPDX-License-Identifier: MIT
// What the robots count of themselves, and what they broadcast.
#pragma once

#include <string>

#include "banyan/measure/moment.hpp"

namespace banyan::measure {

class Tallies {
 public:
  struct Row {
    std::uint64_t insertions = 0, handovers = 0, repairs = 0;
    std::uint64_t elections = 0, replacements = 0;  // of a root, of a worker that had fallen silent
    double bytes_per_robot_s = 0.0;                 // broadcast
    std::uint64_t messages = 0;                     // broadcast, by all robots
    std::uint64_t rejected = 0;                     // readings that did not pass the gates of robots (gate.hpp)
    std::string rejected_by;                        // these robots, "3, 5"
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  Tallies(const world::World& /*start*/, Row& /*row*/) {}
  static void observe(const Moment& /*now*/, Row& /*row*/) {}
  static void sum_up(const Moment& end, Row& row);
};

}  // namespace banyan::measure
