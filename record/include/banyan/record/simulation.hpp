// SPDX-License-Identifier: MIT
// A run: a world, the observer that keeps its account, and a sink that is told of it. The same for the
// program, for studies and for the page.
#pragma once

#include <functional>

#include "banyan/measure/observer.hpp"
#include "banyan/record/sink.hpp"
#include "banyan/world/threads.hpp"

namespace banyan::record {

// Tick by tick. Most want run_scenario() below; the page steps, goes back and interferes.
class Simulation {
 public:
  // Starts `sink`, which must outlive it.
  Simulation(world::World world, Sink& sink);

  void step(world::Executor& executor);  // one tick, also beyond the end of the mission
  void intervene(const world::Event& event) { world_.intervene(event); }
  void call(std::size_t robot, const std::string& name) { world_.call(robot, name); }
  void stop_when(const std::function<bool()>& asked) { observer_.stop_when(asked); }  // within a step, too
  RunEnd finish(bool interrupted);  // finishes the sink; no step may follow

  [[nodiscard]] bool finished() const noexcept { return observer_.finished(); }  // the mission (Observer::finished)
  [[nodiscard]] const world::World& world() const noexcept { return world_; }
  [[nodiscard]] const measure::Tick& last() const noexcept { return observer_.last(); }  // all zero before a step
  [[nodiscard]] const measure::Run& run() const noexcept { return observer_.run(); }
  [[nodiscard]] measure::Run result() const { return observer_.result(world_); }

 private:
  world::World world_;
  measure::Observer observer_;
  Sink& sink_;
};

// Asked before every step, and now and then within one that takes long, with what there is so far: for progress, and
// to stop. False: no further step, and the run is an interrupted one.
using GoOn = std::function<bool(const Simulation&)>;

// From the start to the end of the mission. Whatever `sink` throws ends the run (Sinks does not throw).
RunEnd run_scenario(world::World world, Sink& sink, world::Executor& executor, const GoOn& go_on = {});

}  // namespace banyan::record
