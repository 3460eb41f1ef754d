// SPDX-License-Identifier: MIT
// A swarm that deaths have cut in two finds together again: each half misses the targets of the other and goes where
// these, or the last root, were. BANYAN_LONG=1 watches more.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "worlds.hpp"

namespace banyan::world {
namespace {

// Two clusters of 20 robots with a bridge of six.
Scenario two_clusters(std::uint64_t seed, bool sight) {
  Scenario s = ring("convoy", 46, 4, 8.0, seed);
  s.targets = RandomTargets{4, 8.0};
  s.swarm.start.layout = Layout::bridge;
  s.swarm.start.pitch_share = 0.16;
  s.swarm.start.bridge_robots = 6;
  s.radio.line_of_sight = sight;
  s.radio.loss = sight ? 0.2 : 0.0;
  return s;
}

// The six robots in the middle of the longer side die.
void cut_in_two(World& world) {
  std::vector<std::size_t> robots(world.size());
  for (std::size_t i = 0; i < robots.size(); ++i) robots[i] = i;
  const auto off = [&](std::size_t i) { return std::fabs(world.positions()[i].x); };
  std::sort(robots.begin(), robots.end(), [&](std::size_t a, std::size_t b) { return off(a) < off(b); });
  for (int k = 0; k < 6; ++k) world.intervene({0.0, Event::When::time, Die{robots[static_cast<std::size_t>(k)]}});
}

class HalvedSwarm : public testing::TestWithParam<bool> {};

TEST_P(HalvedSwarm, FindsTogetherAgain) {
  const std::uint64_t seeds = long_search() ? 40 : 2;
  std::vector<std::uint64_t> ticks;
  for (std::uint64_t seed = 9001; seed < 9001 + seeds; ++seed) {
    World world(two_clusters(seed, GetParam()));
    run_until(world, 60);
    cut_in_two(world);
    world.step();
    ASSERT_EQ(part_sizes_by_range(world), (std::vector<std::size_t>{20, 20})) << "seed " << seed << ": cut in two";
    const auto is_one = [&] { return parts_by_range(world) == 1 && living_roots(world) == 1; };
    while (!is_one() && world.tick() < 3000) world.step();
    EXPECT_TRUE(is_one()) << "seed " << seed << ": " << parts_by_range(world) << " parts, " << living_roots(world)
                          << " roots after five minutes";
    ticks.push_back(world.tick() - 60);
  }
  std::sort(ticks.begin(), ticks.end());
  RecordProperty("median_ticks", static_cast<int>(ticks[ticks.size() / 2]));
  RecordProperty("most_ticks", static_cast<int>(ticks.back()));
}

INSTANTIATE_TEST_SUITE_P(Sight, HalvedSwarm, testing::Bool());

}  // namespace
}  // namespace banyan::world
