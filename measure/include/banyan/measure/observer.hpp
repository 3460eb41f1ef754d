// SPDX-License-Identifier: MIT
// Watches a world tick by tick and keeps the account of a run. Reads only the world's public view.
#pragma once

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
  [[nodiscard]] const Tick& last() const noexcept;
  [[nodiscard]] const Run& run() const noexcept;
  // Every worker within tolerance of its target at once, or the time limit reached.
  [[nodiscard]] bool finished() const noexcept;
  [[nodiscard]] Run result(const world::World& world) const;   // run() with hash and means filled in

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace banyan::measure
