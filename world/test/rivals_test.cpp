// SPDX-License-Identifier: MIT
// Algorithms of other authors in whole worlds: what they promise to keep joins all robots, and their missions end.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "worlds.hpp"

namespace banyan::world {
namespace {

// Parts that the links make which both ends say they keep, counted by plain search.
std::size_t parts_by_kept_links(const World& world) {
  const auto reports = world.reports();
  const auto has = [&](std::size_t i, std::size_t j) { return keeps(reports[i], static_cast<RobotId>(j)); };
  std::vector<std::size_t> part(world.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < world.size(); ++i)
      for (std::size_t j = 0; j < world.size(); ++j)
        if (part[j] > part[i] && has(i, j) && has(j, i)) {
          part[j] = part[i];
          changed = true;
        }
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < world.size(); ++i) count += part[i] == i ? 1 : 0;
  return count;
}

class Rival : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, Rival, testing::Values("link-consensus", "mst", "fiedler"));
// Of those that keep links, which Fiedler control does not.
class KeptLinks : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, KeptLinks, testing::Values("link-consensus", "mst"));

TEST_P(KeptLinks, WhatIsKeptJoinsAllAndNoKeptLinkOutgrowsTheRadio) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scenario s = ring(GetParam(), 14 + 3 * seed, 2 + seed % 3, 3.0, seed);
    s.radio.loss = seed % 2 == 0 ? 0.2 : 0.0;
    World world(s);
    run_until(world, 100);  // the first links and the first tree
    while (world.tick() < 500) {
      world.step();
      ASSERT_EQ(parts_by_kept_links(world), 1U) << GetParam() << ", seed " << seed << ", tick " << world.tick();
      for (std::size_t i = 0; i < world.size(); ++i)
        for (const RobotId other : world.reports()[i].kept)
          if (other != nobody) { ASSERT_LT(distance(world.positions()[i], world.positions()[other]), s.radio.range_m) << seed << ", tick " << world.tick(); }
    }
  }
}

TEST_P(Rival, ReachesTargetsThatAreNear) {
  World world(ring(GetParam(), 24, 3, 3.0, 7));
  const auto all_held = [&] {
    for (std::size_t t = 0; t < 3; ++t)
      if (!world.holder(t)) return false;
    return true;
  };
  while (world.tick() < 1500 && !all_held()) world.step();
  EXPECT_TRUE(all_held());
  EXPECT_GT(world.tick(), 100U) << "faster than wheels";
}

TEST_P(Rival, TheSameWorldTwiceIsTheSame) {
  World a(hostile(GetParam(), 20, 3));
  World b(a);
  run_until(a, 150);
  run_until(b, 150);
  EXPECT_EQ(a.hash(), b.hash());
}

// Parts of the network by who is within range of whom.
std::size_t parts_by_range(const World& world) {
  std::vector<std::size_t> open(world.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  std::size_t parts = 0;
  while (!open.empty()) {
    ++parts;
    std::vector<std::size_t> front{open.back()};
    open.pop_back();
    while (!front.empty()) {
      const Vec2 here = world.positions()[front.back()];
      front.pop_back();
      const auto reached = std::stable_partition(open.begin(), open.end(), [&](std::size_t j) { return distance(here, world.positions()[j]) >= world.scenario().radio.range_m; });
      front.insert(front.end(), reached, open.end());
      open.erase(reached, open.end());
    }
  }
  return parts;
}

bool stays_connected(const Scenario& scenario, std::uint64_t ticks) {
  World world(scenario);
  while (world.tick() < ticks) {
    world.step();
    if (parts_by_range(world) > 1) return false;
  }
  return true;
}

// Near targets it reaches in one piece. Workers that set out at full speed before there is an estimate are out of range
// before anybody has noticed (docs/rivals.md).
TEST(FiedlerControl, CutsNoSmallNetworkUnlessWorkersDoNotWaitForTheEstimate) {
  int cut = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scenario s = ring("fiedler", 18, 3, 3.0, seed);
    EXPECT_TRUE(stays_connected(s, 900)) << seed;
    s.mission.parameters = {{"target_gain", 1.0}, {"settling_s", 0.0}};
    cut += stays_connected(s, 900) ? 0 : 1;
  }
  EXPECT_GT(cut, 3) << "the page says otherwise";
}

}  // namespace
}  // namespace banyan::world
