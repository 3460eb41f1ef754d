// SPDX-License-Identifier: MIT
// How many robots died, and whether the swarm has recovered.
#pragma once

#include "banyan/measure/moment.hpp"
#include "banyan/measure/recovery.hpp"

namespace banyan::measure {

class Deaths {
 public:
  struct Row {
    std::uint32_t deaths = 0;
    std::uint32_t survivors = 0;    // alive at the end
    double last_death_s = -1.0;     // -1: none died
    bool recovered = false;         // from the last death (recovery.hpp); false if none died
    double recovery_time_s = -1.0;  // from the last death; -1: not recovered
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  Deaths(const world::World& start, Row& row);
  void observe(const Moment& now, Row& row);
  static void sum_up(const Moment& /*end*/, Row& /*row*/) {}

  // It is decided whether the swarm has recovered from the deaths so far.
  [[nodiscard]] bool settled() const noexcept { return recovery_.settled(); }

 private:
  Recovery recovery_;
};

}  // namespace banyan::measure
