// SPDX-License-Identifier: MIT
// Whether, and how fast, a swarm has recovered from the deaths of a run.
#pragma once

#include <cstdint>

namespace banyan::measure {

// A time in which the swarm stays whole counts as recovery if it begins within so many drives (world::drive_s) of the
// last death and lasts for `recovery_hold_drives`, or as long as the mission is to settle if that is longer.
constexpr double recovery_limit_drives = 20.0;
constexpr double recovery_hold_drives = 2.0;

// The caller decides what is whole. Time is counted in ticks, from the first observation after
// the last death: a swarm that is whole then, and stays so, recovered in no time. Every further death
// begins anew.
class Recovery {
 public:
  // `tick_s`, `drive_s` > 0; `settle_s`: how long the mission is to settle.
  Recovery(double tick_s, double drive_s, double settle_s = 0.0);

  // Call once per tick. `deaths`: since the start of the run, never falling.
  void observe(std::uint64_t deaths, bool whole);

  [[nodiscard]] bool recovered() const noexcept { return recovered_; }
  // From the last death to the recovery, 0 to recovery_limit_drives; -1: not recovered.
  [[nodiscard]] double time_s() const noexcept;
  // Nothing more can change unless a robot dies. True before the first death.
  [[nodiscard]] bool settled() const noexcept;

 private:
  double tick_s_;
  std::uint64_t limit_ticks_;
  std::uint64_t hold_ticks_;
  std::uint64_t deaths_ = 0;
  std::uint64_t ticks_ = 0;        // since the last death, that of the first observation included
  std::uint64_t whole_since_ = 0;  // of these, the first from which on it has been whole: ticks_ if it is not
  bool recovered_ = false;
};

}  // namespace banyan::measure
