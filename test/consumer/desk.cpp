// SPDX-License-Identifier: MIT
// A study of its own: a scenario as a user writes it, some ticks of the installed world under the
// installed observer, by name and by an algorithm of its own; prints the version as the recordings carry it.
#include <banyan/algorithms/algorithms.hpp>
#include <banyan/algorithms/paper_algorithm.hpp>
#include <banyan/config/config.hpp>
#include <banyan/measure/observer.hpp>
#include <banyan/version.hpp>
#include <banyan/world/world.hpp>
#include <iostream>

namespace {

constexpr banyan::PaperAlgorithmOf<banyan::paper::inwards> slow("slow", "inwards with a weaker pull", []() noexcept {
  banyan::paper::Params params = banyan::paper::inwards_column();
  params.target_gain = 0.1F;
  return params;
});

}  // namespace

int main() {
  const auto loaded = banyan::config::parse_configuration(
      "desk.toml", "[swarm]\nrobots = 12\n[targets]\nlayout = \"ring\"\ncount = 2\nradius_m = 1.0\n",
      banyan::algorithms());
  if (!loaded.ok()) return 2;
  banyan::world::World world(loaded.configuration.scenario);
  banyan::measure::Observer observer(world);
  for (int tick = 0; tick < 20; ++tick) {
    world.step();
    observer.observe(world);
  }
  banyan::world::World own(loaded.configuration.scenario, slow);
  for (int tick = 0; tick < 20; ++tick) own.step();
  if (own.scenario().mission.algorithm != "slow" || own.hash() == world.hash()) return 3;
  // The same from a file, by a list of the program's own.
  const banyan::AlgorithmList mine{&slow};
  const auto named =
      banyan::config::parse_configuration("slow.toml",
                                          "[mission]\nalgorithm = \"slow\"\n[swarm]\nrobots = 12\n[targets]\nlayout = "
                                          "\"ring\"\ncount = 2\nradius_m = 1.0\n",
                                          mine);
  if (!named.ok()) return 4;
  banyan::world::World again(named.configuration.scenario);
  for (int tick = 0; tick < 20; ++tick) again.step();
  if (again.hash() != own.hash()) return 5;
  std::cout << banyan::version << '\n';
  return observer.last().tick == 20 && observer.last().alive == 12 ? 0 : 1;
}
