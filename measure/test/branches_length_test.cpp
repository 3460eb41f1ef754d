// SPDX-License-Identifier: MIT
// Branch repositioning on the instances of its authors (Miyauchi et al., IROS 2024), as far as their program tells
// them: tasks at random places around the start, and 13 robots for each. They claim networks that are clearly shorter
// than the best star and not far from the Steiner tree.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "banyan/measure/steiner.hpp"
#include "worlds.hpp"

namespace banyan::measure {
namespace {

using world::Vec2;
using world::World;

// Their lengths are 1 / 2.5 of these, since C is 0.8 m there.
constexpr double nearest_m = 2.741, farthest_m = 5.375, apart_m = 2.0;

std::vector<Vec2> tasks(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 stream(seed);
  const auto draw = [&] { return farthest_m * (static_cast<double>(stream() >> 11) * 0x1p-52 - 1.0); };
  std::vector<Vec2> places;
  while (places.size() < count) {
    const double x = draw();
    const Vec2 p{x, draw()};
    const bool apart = std::all_of(places.begin(), places.end(), [&](Vec2 q) { return distance(p, q) >= apart_m; });
    if (norm(p) > nearest_m && norm(p) < farthest_m && apart) places.push_back(p);
  }
  return places;
}

// Of the links that are promised, each by both its ends when nothing changes.
double length_of_network(const World& seen) {
  double twice_m = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (const RobotId end : world::links_of(seen.reports()[i]))
      twice_m += distance(seen.positions()[i], seen.positions()[end]);
  return 0.5 * twice_m;
}

struct Lengths {
  double network_m = 0.0, steiner_m = 0.0, star_m = 0.0;
};

// Mean over `instances`, half a minute after all targets have been reached.
Lengths mean_lengths(std::size_t teams, std::uint64_t instances) {
  Lengths mean;
  const double share = 1.0 / static_cast<double>(instances);
  for (std::uint64_t seed = 1; seed <= instances; ++seed) {
    const std::vector<Vec2> places = tasks(teams, seed);
    world::Scenario s = world::ring("branches", 13 * teams, teams, 3.0, seed);
    s.targets = places;
    World run(s);
    while (!all_held(run) && run.time_s() < 60.0) run.step();
    EXPECT_TRUE(all_held(run)) << teams << " teams, instance " << seed;
    run_until(run, run.tick() + 300);
    EXPECT_TRUE(all_held(run)) << teams << " teams, instance " << seed;
    mean.network_m += share * length_of_network(run);
    mean.steiner_m += share * steiner_length(places).lower_m;
    mean.star_m += share * star_length(places);
  }
  return mean;
}

// The fewer targets, the less a star is longer than the Steiner tree: for three it is the Steiner tree.
TEST(BranchesLength, NetworksAreShorterThanTheBestStarAndNearTheSteinerTree) {
  constexpr double of_star[] = {1.04, 0.96, 0.94, 0.90};
  constexpr double of_steiner[] = {1.04, 1.08, 1.15, 1.20};
  for (std::size_t teams = 3; teams <= 6; ++teams) {
    const Lengths mean = mean_lengths(teams, world::long_search() ? 100 : 12);
    const double per_team = 1.0 / (2.5 * static_cast<double>(teams));
    RecordProperty("teams " + std::to_string(teams), "Steiner " + std::to_string(mean.steiner_m * per_team) +
                                                         ", network " + std::to_string(mean.network_m * per_team) +
                                                         ", star " + std::to_string(mean.star_m * per_team));
    EXPECT_LT(mean.network_m, of_star[teams - 3] * mean.star_m) << teams;
    EXPECT_LT(mean.network_m, of_steiner[teams - 3] * mean.steiner_m) << teams;
    EXPECT_GT(mean.network_m, 0.95 * mean.steiner_m)
        << teams << ": shorter than any that reaches the targets up to the tolerance";
  }
}

}  // namespace
}  // namespace banyan::measure
