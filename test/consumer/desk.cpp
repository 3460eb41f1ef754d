// SPDX-License-Identifier: MIT
// A study of its own: a scenario as a user writes it, some ticks of the installed world under the
// installed observer; prints the version as the recordings carry it.
#include <banyan/config/config.hpp>
#include <banyan/measure/observer.hpp>
#include <banyan/version.hpp>
#include <banyan/world/world.hpp>
#include <iostream>

int main() {
  const auto loaded = banyan::config::parse_configuration(
      "desk.toml", "[swarm]\nrobots = 12\n[targets]\nlayout = \"ring\"\ncount = 2\nradius_m = 1.0\n");
  if (!loaded.ok()) return 2;
  banyan::world::World world(loaded.configuration.scenario);
  banyan::measure::Observer observer(world);
  for (int tick = 0; tick < 20; ++tick) {
    world.step();
    observer.observe(world);
  }
  std::cout << banyan::version << '\n';
  return observer.last().tick == 20 && observer.last().alive == 12 ? 0 : 1;
}
