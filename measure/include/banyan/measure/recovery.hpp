// SPDX-License-Identifier: MIT
// Whether, and how fast, a swarm has recovered from the deaths of a run.
#pragma once

#include <cstdint>
#include <vector>

namespace banyan::measure {

// An instant at which the swarm is whole counts as recovery if it comes within this time of the
// last death and the swarm is whole again exactly `recovery_hold_s` after it.
constexpr double recovery_limit_s = 200.0;
constexpr double recovery_hold_s = 20.0;

// What is whole is the caller's to say. Time is counted in ticks, from the first observation after
// the last death: a swarm that is whole then, and 20 s later, needed no time. Every further death
// begins anew. Keeps one byte per tick for at most 220 s.
class Recovery {
 public:
  // `tick_s` > 0.
  explicit Recovery(double tick_s);

  // Call once per tick. `deaths`: since the start of the run, never falling.
  void observe(std::uint64_t deaths, bool whole);

  [[nodiscard]] bool recovered() const noexcept { return recovered_; }
  // From the last death to the recovery, 0 to recovery_limit_s; -1: not recovered.
  [[nodiscard]] double time_s() const noexcept;
  // Nothing more can change unless a robot dies. True before the first death.
  [[nodiscard]] bool settled() const noexcept;

 private:
  double tick_s_;
  std::uint64_t limit_ticks_;
  std::uint64_t hold_ticks_;
  std::uint64_t deaths_ = 0;
  std::vector<char> whole_;       // at each tick since the last death
  bool recovered_ = false;
  std::uint64_t recovery_ticks_ = 0;
};

}  // namespace banyan::measure
