// SPDX-License-Identifier: MIT
// Watches a world tick by tick and sums up the metrics of a run. Reads only the world's public view.
#pragma once

#include <functional>
#include <memory>

#include "banyan/measure/metrics.hpp"

namespace banyan::measure {

class Observer {
 public:
  explicit Observer(const world::World& world);
  Observer(Observer&&) noexcept;
  Observer& operator=(Observer&&) noexcept;
  ~Observer();

  // Call after each World::step. `exact_fiedler`: also compute lambda_2 itself (for plots), not
  // only whether it is below 1e-3. The reference is valid until the next call.
  const Tick& observe(const world::World& world, bool exact_fiedler = false);
  // lambda_2 of tens of thousands of robots may take a minute: `asked` is called between its steps, and once it returns
  // true the computation is given up. A value that was not found is that of the tick before.
  void stop_when(const std::function<bool()>& asked);
  [[nodiscard]] const Tick& last() const noexcept;
  [[nodiscard]] const Run& run() const noexcept;
  // Nothing dies: complete (Tick::complete; with mission.stop_when_complete, then
  // mission.settle_s later, even beyond the time limit), or the time limit reached. Robots die, and
  // stop_when_complete: a complete run goes on until no more deaths are due and it is decided whether
  // the swarm has recovered (recovery.hpp); a run not complete at its limit ends there, or
  // once that is decided for the last death so far.
  [[nodiscard]] bool finished() const noexcept;
  [[nodiscard]] Run result(const world::World& world) const;  // run() with hash and means filled in

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  bool stop_when_complete_;
  double settle_s_, rounding_s_;
};

// The start of a run, before its first step, as a tick; for pictures and plots. The run's own observer counts
// ticks, and the start is none.
[[nodiscard]] Tick at_start(const world::World& world, bool exact_fiedler = false);

// For plots: whether lambda_2 itself is worth computing at this tick, the first of each tenth
// of a drive (world::drive_s), in swarms of at most 1,000 robots (1 ms with 94, 10 ms with 1,000).
[[nodiscard]] bool is_plotted(const world::World& world) noexcept;

}  // namespace banyan::measure
