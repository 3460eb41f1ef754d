// SPDX-License-Identifier: MIT
// Algorithms of other authors in whole worlds: what they promise to keep joins all robots, and their missions end.
#include <gtest/gtest.h>

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
INSTANTIATE_TEST_SUITE_P(All, Rival, testing::Values("link-consensus", "mst"));

TEST_P(Rival, WhatIsKeptJoinsAllAndNoKeptLinkOutgrowsTheRadio) {
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

}  // namespace
}  // namespace banyan::world
