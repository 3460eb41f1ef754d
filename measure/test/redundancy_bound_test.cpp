// SPDX-License-Identifier: MIT
// Against brute force: of all sets of relays on a lattice the smallest that joins the targets often enough.
#include "banyan/measure/redundancy_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "banyan/measure/disjoint_paths.hpp"
#include "banyan/measure/relays.hpp"

namespace banyan::measure {
namespace {

using world::Vec2;

Graph within_range(const std::vector<Vec2>& nodes, double range_m) {
  Graph graph;
  graph.offsets.push_back(0);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    for (std::uint32_t j = 0; j < nodes.size(); ++j)
      if (i != j && distance(nodes[i], nodes[j]) < range_m) graph.neighbors.push_back(j);
    graph.offsets.push_back(static_cast<std::uint32_t>(graph.neighbors.size()));
  }
  return graph;
}

// Whether some set of `relays` further places joins the targets by that many paths; tries all.
bool can_be_joined(std::vector<Vec2>& nodes, std::size_t targets, const std::vector<Vec2>& places, std::size_t from,
                   int relays, std::uint32_t paths) {
  if (relays == 0) {
    std::vector<std::uint32_t> terminals;
    for (std::uint32_t t = 0; t < targets; ++t) terminals.push_back(t);
    return DisjointPaths().among(within_range(nodes, 1.0), terminals, paths) >= paths;
  }
  for (std::size_t p = from; p < places.size(); ++p) {
    nodes.push_back(places[p]);
    const bool found = can_be_joined(nodes, targets, places, p + 1, relays - 1, paths);
    nodes.pop_back();
    if (found) return true;
  }
  return false;
}

TEST(RedundancyBound, OfTwoTargets) {
  for (const std::uint32_t k : {2U, 3U}) {
    const RedundancyBound apart = redundancy_bound({{0, 0}, {7, 0}}, 0.0, 2.0, k);
    EXPECT_EQ(apart.robots, 2 + k * 3);
    EXPECT_TRUE(apart.exact);
    EXPECT_EQ(redundancy_bound({{0, 0}, {1, 0}}, 0.0, 2.0, k).robots, 2 + k - 1);
    EXPECT_EQ(redundancy_bound({{5, 0}}, 0.2, 2.0, k).robots, 1 + k);
  }
}

TEST(RedundancyBound, OfATriangleIsARing) {
  const double side = 5.0;  // two relays on each side, with edges of 5/3
  const RedundancyBound bound =
      redundancy_bound({{0, 0}, {side, 0}, {side / 2, side * std::numbers::sqrt3 / 2}}, 0.0, 2.0, 2);
  EXPECT_EQ(bound.robots, 3U + 6U);
  EXPECT_TRUE(bound.exact);
}

TEST(RedundancyBound, OfOnePathIsTheBoundOfTrees) {
  const std::vector<Vec2> targets{{0, 6}, {5, -3}, {-5, -3}};
  EXPECT_EQ(redundancy_bound(targets, 0.2, 2.0, 1).robots, robots_bound(targets, 0.2, 2.0));
}

TEST(RedundancyBound, NoSetOfPlacesOnALatticeNeedsFewer) {
  std::vector<Vec2> places;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y) places.push_back({0.55 * x, 0.55 * y});
  std::mt19937_64 random(5);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  std::uniform_real_distribution<double> side(0.0, 1.8);
  int met = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<Vec2> nodes;
    nodes.reserve(3);
    for (int t = 0; t < 3; ++t) nodes.push_back({side(random), side(random)});
    const std::vector<Vec2> targets = nodes;
    const RedundancyBound bound = redundancy_bound(targets, 0.0, 1.0, 2);
    const int least = static_cast<int>(bound.robots) - 3;
    for (int fewer = 1; fewer < least; ++fewer)  // one for the root in any case
      ASSERT_FALSE(can_be_joined(nodes, 3, places, 0, fewer, 2))
          << "round " << round << ": " << fewer << " relays, bound " << least;
    met += can_be_joined(nodes, 3, places, 0, least, 2) ? 1 : 0;
  }
  EXPECT_GT(met, 20);  // and as a rule so many suffice, even on a lattice
}

// More paths never need fewer robots, and k trees of relays are always enough.
TEST(RedundancyBound, LiesBetweenOneTreeAndSeveral) {
  std::mt19937_64 random(9);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  std::uniform_real_distribution<double> side(0.0, 12.0);
  for (int round = 0; round < 60; ++round) {
    const int count = 2 + round % 7;
    std::vector<Vec2> targets;
    targets.reserve(static_cast<std::size_t>(count));
    for (int t = 0; t < count; ++t) targets.push_back({side(random), side(random)});
    std::uint32_t before = robots_bound(targets, 0.2, 2.0);
    const RelayTree tree = fewest_relays(targets, 1.999);
    for (const std::uint32_t k : {2U, 3U}) {
      const std::uint32_t robots = redundancy_bound(targets, 0.2, 2.0, k).robots;
      ASSERT_GE(robots, before);
      // Each relay k times, and k - 1 more beside each worker, which may be a relay, too.
      const std::size_t enough = k * (std::max<std::size_t>(1, tree.relays.size()) + targets.size());
      ASSERT_LE(robots, enough);
      before = robots;
    }
  }
}

}  // namespace
}  // namespace banyan::measure
