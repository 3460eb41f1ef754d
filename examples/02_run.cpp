// SPDX-License-Identifier: MIT
// A whole run from C++: build a scenario, step its world, let an observer compute the metrics. It has
// the same hash as `banyan run` prints for the same scenario, on any machine.
#include <cinttypes>
#include <cstdio>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/measure/observer.hpp"

using namespace banyan;

int main() {
  world::Scenario scenario = world::plain_scenario(algorithms());  // every field has a default
  scenario.seed = 1;
  scenario.mission.algorithm = "inwards";
  scenario.swarm.redundancy = 3.0;
  scenario.targets = world::RingTargets{.count = 3, .radius_m = 3.0};
  for (const world::Fault& fault : world::faults(scenario))
    std::printf("%s: %s\n", fault.key.c_str(), fault.text.c_str());

  world::World world(scenario);
  measure::Observer observer(world);
  while (!observer.finished()) {
    world.step();
    const measure::Tick& tick = observer.observe(world);
    if (tick.tick % 100 == 0)
      std::printf("%5.1f s: %u of %u robots in the tree, %u of 3 targets reached\n", tick.time_s, tick.committed,
                  tick.alive, tick.targets_reached);
  }
  const measure::Run run = observer.result(world);
  std::printf("%s after %.1f s of at most %.0f s, %" PRIu64 " ticks with a broken edge, hash %016" PRIx64 "\n",
              run.complete ? "complete" : "not complete", run.time_s, run.time_limit_s, run.broken_ticks, run.hash);
  return run.complete ? 0 : 1;
}
