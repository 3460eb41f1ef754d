// SPDX-License-Identifier: MIT
// Distances between cells against a dense sample of their points.
#include "discs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "banyan/world/random.hpp"

namespace banyan::measure {
namespace {

using world::Vec2;

double chance(std::uint64_t seed, std::uint64_t which, std::uint64_t axis) {
  return world::to_uniform(world::bits(seed, world::Purpose::targets, which, axis));
}

CommonRegion some_cell(std::uint64_t seed, std::uint64_t first, std::size_t discs, Vec2 about) {
  std::vector<RangeDisc> list;
  for (std::uint64_t k = first; k < first + discs; ++k)
    list.push_back({about + Vec2{chance(seed, k, 0), chance(seed, k, 1)} * 2.0, 0.5 + 1.5 * chance(seed, k, 2)});
  return CommonRegion(list);
}

std::vector<Vec2> sampled(const CommonRegion& cell, double step) {
  std::vector<Vec2> points;
  const RangeDisc& disc = cell.discs().front();
  for (double x = -disc.radius; x <= disc.radius; x += step)
    for (double y = -disc.radius; y <= disc.radius; y += step)
      if (const Vec2 p = disc.center + Vec2{x, y}; cell.has(p)) points.push_back(p);
  return points;
}

TEST(Discs, CirclesCross) {
  EXPECT_EQ(crossing({{0, 0}, 1}, {{3, 0}, 1}).count, 0U);
  EXPECT_EQ(crossing({{0, 0}, 3}, {{1, 0}, 1}).count, 0U) << "one inside the other";
  const Points touching = crossing({{0, 0}, 1}, {{3, 0}, 2});
  ASSERT_EQ(touching.count, 2U);
  EXPECT_NEAR(distance(touching.at[0], {1, 0}), 0.0, 1e-9);
  for (const Vec2 p : crossing({{0, 0}, 5}, {{6, 0}, 5})) {
    EXPECT_NEAR(p.x, 3.0, 1e-12);
    EXPECT_NEAR(std::abs(p.y), 4.0, 1e-12);
  }
}

TEST(Discs, ACellIsEmptyIfNoPointIsInAllDiscs) {
  int empty = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const CommonRegion cell = some_cell(seed, 0, 3, {});
    const bool found = !sampled(cell, 0.02).empty();
    if (found) { EXPECT_FALSE(cell.empty()) << seed; }
    if (cell.empty()) { EXPECT_FALSE(found) << seed; }
    if (!cell.empty()) { EXPECT_TRUE(cell.has(cell.nearest({9, 9}))) << seed; }
    empty += cell.empty() ? 1 : 0;
  }
  EXPECT_GT(empty, 10);
  EXPECT_LT(empty, 190);
}

TEST(Discs, NoSampledPairIsNearer) {
  constexpr double step = 0.05;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const CommonRegion a = some_cell(seed, 0, 1 + seed % 3, {}), b = some_cell(seed, 10, 2, {2.5, 1.0});
    if (a.empty() || b.empty()) continue;
    const Nearest ends = nearest(a, b);
    EXPECT_TRUE(a.has(ends.a) && b.has(ends.b)) << seed;
    double least = 1e9;
    for (const Vec2 p : sampled(a, step)) {
      least = std::min(least, distance(p, b.nearest(p)));
      for (const Vec2 q : sampled(b, 4 * step)) EXPECT_GE(distance(p, q), distance(p, b.nearest(p)) - 1e-9);
    }
    EXPECT_LE(distance(ends.a, ends.b), least + 1e-9) << seed;
    if (least < 1e8) { EXPECT_GE(distance(ends.a, ends.b), least - 2 * step) << seed; }
  }
}

TEST(Discs, APlaceBetweenTwoCellsIsFoundIfASampleFindsOne) {
  int both = 0, neither = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const CommonRegion a = some_cell(seed, 0, 2, {-2, 0}), b = some_cell(seed, 10, 2, {2, 1});
    if (a.empty() || b.empty()) continue;
    const RangeDisc disc{{chance(seed, 30, 0) * 2, chance(seed, 30, 1) * 4 - 2}, 0.5 + chance(seed, 30, 2)};
    const double a_reach = 0.5 + chance(seed, 31, 0), b_reach = 0.5 + chance(seed, 31, 1);
    const auto place = between(disc, a, a_reach, b, b_reach);
    bool sampled_one = false;
    for (const Vec2 p : sampled(CommonRegion({disc}), 0.02))
      sampled_one = sampled_one || (distance(p, a.nearest(p)) <= a_reach && distance(p, b.nearest(p)) <= b_reach);
    if (sampled_one) { EXPECT_TRUE(place.has_value()) << seed; }
    both += sampled_one && place ? 1 : 0;
    neither += !sampled_one && !place ? 1 : 0;
    if (!place) continue;
    EXPECT_LE(distance(*place, disc.center), disc.radius + 1e-8);
    EXPECT_LE(distance(*place, a.nearest(*place)), a_reach + 1e-8);
    EXPECT_LE(distance(*place, b.nearest(*place)), b_reach + 1e-8);
  }
  EXPECT_GT(both, 20);
  EXPECT_GT(neither, 20);
}

}  // namespace
}  // namespace banyan::measure
