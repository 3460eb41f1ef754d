// SPDX-License-Identifier: MIT
// The radio graph of the living, tick by tick: its components, and whether lambda_2 is low.
#pragma once

#include <functional>
#include <memory>

#include "banyan/measure/tick.hpp"
#include "banyan/world/world.hpp"

namespace banyan::measure {

class GraphWatch {
 public:
  explicit GraphWatch(const world::World& start);
  GraphWatch(GraphWatch&&) noexcept;
  GraphWatch& operator=(GraphWatch&&) noexcept;
  ~GraphWatch();

  // `exact_fiedler`: also lambda_2 itself. `tick.alive` is known.
  void look(const world::World& world, bool exact_fiedler, Tick& tick);
  // Observer::stop_when.
  void stop_when(const std::function<bool()>& asked);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace banyan::measure
