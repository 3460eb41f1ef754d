// SPDX-License-Identifier: MIT
// Running a world to its end (simulation.hpp).
#include "banyan/record/simulation.hpp"

#include <utility>

namespace banyan::record {

namespace {

// The first frame is kept before the bounds of the mission are computed, which takes a second where targets are many.
const world::World& started(const world::World& world, Sink& sink) {
  sink.start(world);
  return world;
}

}  // namespace

Simulation::Simulation(world::World world, Sink& sink)
    : world_(std::move(world)), observer_(started(world_, sink)), sink_(sink) {}

void Simulation::step(world::Executor& executor) {
  world_.step(executor);
  sink_.tick(world_, observer_.observe(world_, sink_.wants_fiedler(world_)));
}

RunEnd Simulation::finish(bool interrupted) {
  RunEnd end{result(), last(), interrupted};
  sink_.finish(world_, end);
  return end;
}

RunEnd run_scenario(world::World world, Sink& sink, world::Executor& executor, const GoOn& go_on) {
  Simulation simulation(std::move(world), sink);
  if (go_on) simulation.stop_when([&] { return !go_on(simulation); });
  while (!simulation.finished()) {
    if (go_on && !go_on(simulation)) return simulation.finish(true);
    simulation.step(executor);
  }
  return simulation.finish(false);
}

}  // namespace banyan::record
