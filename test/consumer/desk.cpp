// SPDX-License-Identifier: MIT
// A study of its own: some ticks of the installed world under the installed observer; prints the
// version as the recordings carry it.
#include <banyan/measure/observer.hpp>
#include <banyan/version.hpp>
#include <banyan/world/world.hpp>
#include <iostream>

int main() {
  banyan::world::Scenario scenario;
  scenario.swarm.robots = 12;
  scenario.targets = banyan::world::RingTargets{.count = 2, .radius_m = 1.0};
  banyan::world::World world(scenario);
  banyan::measure::Observer observer(world);
  for (int tick = 0; tick < 20; ++tick) {
    world.step();
    observer.observe(world);
  }
  std::cout << banyan::version << '\n';
  return observer.last().tick == 20 && observer.last().alive == 12 ? 0 : 1;
}
