// SPDX-License-Identifier: MIT
// Against all assignments tried in turn.
#include "banyan/measure/bottleneck.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "banyan/world/random.hpp"

namespace banyan::measure {
namespace {

using world::Vec2;

TEST(Bottleneck, NothingToDoAndTooFew) {
  EXPECT_EQ(bottleneck_m({}, {}), 0.0);
  EXPECT_EQ(bottleneck_m({{1, 1}}, {}), 0.0);
  EXPECT_EQ(bottleneck_m({{1, 1}}, {{0, 0}, {1, 0}}), -1.0);
  EXPECT_EQ(bottleneck_m({{0, 0}, {3, 4}}, {{3, 0}}), 3.0);
}

TEST(Bottleneck, TooManyPairsAreNotAsked) {
  const std::vector<Vec2> robots(20'000);
  EXPECT_EQ(bottleneck_m(robots, std::vector<Vec2>(1'000)), 0.0);
  EXPECT_EQ(bottleneck_m(robots, std::vector<Vec2>(1'001)), -1.0);
}

TEST(Bottleneck, TheNearestRobotMayBeNeededElsewhere) {
  // Each place is nearest to the robot at 0, which can have only one of them.
  EXPECT_EQ(bottleneck_m({{0, 0}, {-5, 0}}, {{1, 0}, {-1, 0}}), 4.0);
}

TEST(Bottleneck, NoAssignmentIsBetter) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto points = [seed](std::uint64_t first, std::size_t count) {
      std::vector<Vec2> list;
      for (std::size_t k = 0; k < count; ++k)
        list.push_back({world::to_uniform(world::bits(seed, world::Purpose::targets, first + k, 0)),
                        world::to_uniform(world::bits(seed, world::Purpose::targets, first + k, 1))});
      return list;
    };
    const std::vector<Vec2> robots = points(0, 7), places = points(50, 1 + seed % 6);
    std::vector<std::size_t> order(robots.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    double least = 1e9;
    do {
      double longest = 0.0;
      for (std::size_t k = 0; k < places.size(); ++k)
        longest = std::max(longest, distance(robots[order[k]], places[k]));
      least = std::min(least, longest);
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_EQ(bottleneck_m(robots, places), least) << seed;
  }
}

}  // namespace
}  // namespace banyan::measure
