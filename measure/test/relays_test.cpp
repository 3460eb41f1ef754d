// SPDX-License-Identifier: MIT
// The bound on robots against networks drawn at random, the fewest relays against closed forms and against an
// exhaustive search over a grid.
#include "banyan/measure/relays.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "banyan/measure/steiner.hpp"
#include "banyan/world/random.hpp"

namespace banyan::measure {
namespace {

using world::Vec2;

std::vector<Vec2> circle_of(int count, double radius) {
  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    points.push_back({radius * std::cos(2 * M_PI * i / count), radius * std::sin(2 * M_PI * i / count)});
  return points;
}

double drawn(std::uint64_t seed, std::uint64_t which, std::uint64_t axis) {
  return world::to_uniform(world::bits(seed, world::Purpose::targets, which, axis));
}

// In a square of this side.
std::vector<Vec2> scattered(std::uint64_t seed, int count, double side) {
  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    points.push_back(
        {side * drawn(seed, static_cast<std::uint64_t>(i), 0), side * drawn(seed, static_cast<std::uint64_t>(i), 1)});
  return points;
}

std::size_t relays_for(const std::vector<Vec2>& targets, double range_m) {
  const RelayTree tree = fewest_relays(targets, range_m);
  const auto at = [&](std::uint32_t k) { return k < targets.size() ? targets[k] : tree.relays[k - targets.size()]; };
  std::vector<std::size_t> part(targets.size() + tree.relays.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  for (const auto& [a, b] : tree.edges) {
    EXPECT_LE(distance(at(a), at(b)), range_m * (1 + 1e-7));
    const std::size_t from = part[a], to = part[b];
    EXPECT_NE(from, to) << "a cycle";
    std::replace(part.begin(), part.end(), from, to);
  }
  if (!part.empty()) { EXPECT_EQ(tree.edges.size(), part.size() - 1) << "a tree"; }
  return tree.relays.size();
}

// Kruskal, with chains on the edges.
std::size_t relays_of_spanning_tree(const std::vector<Vec2>& targets, double range_m) {
  std::vector<std::size_t> part(targets.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  std::size_t relays = 0;
  for (std::size_t need = 0; need < 200; ++need) {
    for (std::size_t a = 0; a < targets.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const std::size_t from = part[a], to = part[b];
        if (from == to || distance(targets[a], targets[b]) > range_m * static_cast<double>(need + 1)) continue;
        std::replace(part.begin(), part.end(), from, to);
        relays += need;
      }
    }
  }
  return relays;
}

// With each node's cost the least over all ways from those that have one; the first `t` nodes are targets and free.
void spread_along_links(std::vector<int>& cost, const std::vector<std::vector<std::size_t>>& near, std::size_t t) {
  const auto own = [t](std::size_t v) { return v < t ? 0 : 1; };
  constexpr int most = 60;
  for (int level = 0; level < most; ++level) {
    for (std::size_t v = 0; v < cost.size(); ++v) {
      if (cost[v] != level) continue;
      for (const std::size_t w : near[v]) cost[w] = std::min(cost[w], level + own(w));
      // A target costs nothing: those behind it are still of this level.
      for (const std::size_t w : near[v])
        if (w < t && cost[w] == level)
          for (const std::size_t x : near[w]) cost[x] = std::min(cost[x], level + own(x));
    }
  }
}

// The targets, then the places of a grid over [0, side]^2.
std::vector<Vec2> with_grid(std::vector<Vec2> nodes, double side, int cells) {
  const double step = side / cells;
  for (int x = 0; x <= cells; ++x)
    for (int y = 0; y <= cells; ++y) nodes.push_back({x * step, y * step});
  return nodes;
}

std::vector<std::vector<std::size_t>> links_within(const std::vector<Vec2>& nodes, double range_m) {
  std::vector<std::vector<std::size_t>> near(nodes.size());
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t b = 0; b < nodes.size(); ++b)
      if (a != b && distance(nodes[a], nodes[b]) <= range_m * (1 + 1e-9)) near[a].push_back(b);
  return near;
}

// The fewest relays on a grid, by dynamic programming over sets of targets and places of the grid (Dreyfus & Wagner
// with costs on nodes). All targets must lie within [0, side]^2.
std::size_t relays_on_grid(const std::vector<Vec2>& targets, double range_m, double side, int cells) {
  const std::vector<Vec2> nodes = with_grid(targets, side, cells);
  const std::vector<std::vector<std::size_t>> near = links_within(nodes, range_m);
  const std::size_t n = nodes.size(), t = targets.size();
  constexpr int far = 1000;
  std::vector<std::vector<int>> best(std::size_t{1} << t, std::vector<int>(n, far));  // with v itself counted
  for (std::size_t set = 1; set < best.size(); ++set) {
    std::vector<int>& now = best[set];
    for (std::size_t v = 0; v < n; ++v) {
      if (v < t && set == std::size_t{1} << v) now[v] = 0;
      for (std::size_t one = (set - 1) & set; one > 0; one = (one - 1) & set)
        now[v] = std::min(now[v], best[one][v] + best[set ^ one][v] - (v < t ? 0 : 1));
    }
    spread_along_links(now, near, t);
  }
  return static_cast<std::size_t>(best.back()[0]);
}

TEST(FewestRelays, NoneForTargetsNearEachOther) {
  EXPECT_EQ(relays_for({}, 1.0), 0U);
  EXPECT_EQ(relays_for({{1, 2}}, 1.0), 0U);
  EXPECT_EQ(relays_for({{1, 2}, {1, 2}, {1, 2}}, 1.0), 0U);
  EXPECT_EQ(relays_for({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}}, 1.0), 0U) << "workers relay";
  EXPECT_EQ(relays_for(circle_of(9, 0.4), 2.0), 0U);
}

TEST(FewestRelays, OnALine) {
  for (int edges = 1; edges <= 12; ++edges) {
    EXPECT_EQ(relays_for({{0, 0}, {edges * 1.9, 0}}, 1.9), static_cast<std::size_t>(edges - 1));
    EXPECT_EQ(relays_for({{0, 0}, {edges * 1.9 + 1e-3, 0}}, 1.9), static_cast<std::size_t>(edges));
  }
  EXPECT_EQ(relays_for({{0, 0}, {1.5, 0}, {3, 0}, {4.5, 0}}, 1.0), 3U) << "one in each gap";
  EXPECT_EQ(relays_for({{0, 0}, {1, 1}, {2, 2}, {4, 4}, {9, 9}}, std::sqrt(2.0)), 0U + 0U + 1U + 4U);
}

// A search through all layouts would hardly end: their number grows with a high power of the hops.
TEST(FewestRelays, FarTargetsTakeSeconds) {
  for (const int n : {5, 8}) {
    const std::vector<Vec2> targets = circle_of(n, 90.0);
    EXPECT_LE(relays_for(targets, 1.0), relays_of_spanning_tree(targets, 1.0)) << n;
  }
  EXPECT_FALSE(fewest_relays(circle_of(5, 90.0), 1.0).exact) << "not all were tried";
}

TEST(FewestRelays, OneHubWhereAllAreWithinReach) {
  for (int n = 3; n <= 5; ++n) {
    EXPECT_EQ(relays_for(circle_of(n, 1.0), 1.0), 1U) << "the centre joins " << n;
    EXPECT_EQ(relays_for(circle_of(n, 2.0), 1.0), static_cast<std::size_t>(n) + 1) << "a hub and one on each way";
  }
  EXPECT_EQ(relays_for(circle_of(3, 1.001), 1.0), 2U);
  EXPECT_EQ(relays_for(circle_of(4, 1.001), 1.0), 2U) << "two hubs, as in Steiner's tree";
}

// A square of side a. One hub: 4 ceil(a / sqrt 2) - 3 relays; two hubs, as in Steiner's tree, need less where the
// diagonal is just too long; three sides: 3 ceil(a) - 3.
TEST(FewestRelays, Squares) {
  const auto square = [](double a) { return std::vector<Vec2>{{0, 0}, {a, 0}, {a, a}, {0, a}}; };
  EXPECT_EQ(relays_for(square(1.0), 1.0), 0U);
  EXPECT_EQ(relays_for(square(1.4), 1.0), 1U);
  EXPECT_EQ(relays_for(square(std::sqrt(2.0)), 1.0), 1U);
  // Two hubs one edge apart serve squares with sqrt(1 - a^2/4) + 1/2 >= a/2, up to a = 1.82.
  EXPECT_EQ(relays_for(square(1.5), 1.0), 2U);
  EXPECT_EQ(relays_for(square((1.0 + std::sqrt(7.0)) / 2.0 - 1e-6), 1.0), 2U);
  EXPECT_EQ(relays_for(square((1.0 + std::sqrt(7.0)) / 2.0 + 1e-6), 1.0), 3U);
}

TEST(FewestRelays, RegularPentagonsHaveThreeHubsOrFour) {
  // Brackets by the length of Steiner's tree, 3.891 r, and by the sides.
  for (double r = 1.0; r < 6.0; r += 0.25) {
    const std::vector<Vec2> targets = circle_of(5, r);
    const double length = steiner_length(targets).lower_m;
    const auto sides = 4 * static_cast<int>(std::ceil(2 * r * std::sin(M_PI / 5) - 1e-9)) - 4;
    const auto found = static_cast<int>(relays_for(targets, 1.0));
    EXPECT_GE(found, static_cast<int>(std::ceil(length - 1e-9)) - 4) << r;
    EXPECT_LE(found, sides) << r;
    EXPECT_LE(found, static_cast<int>(std::ceil(length)) - 4 + 4)
        << r << ": rounding costs at most one per branch over three";
  }
}

// A relay of any network is at most half a diagonal of the grid from a place of it, so with edges that much longer at
// both ends the grid has a network with as few relays.
TEST(FewestRelays, AgreesWithAnExhaustiveSearchOnAGrid) {
  constexpr double side = 4.0;
  constexpr int cells = 40;
  int tight = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const int count = 3 + static_cast<int>(seed % 3);
    const std::vector<Vec2> targets = scattered(seed, count, side);
    const std::size_t found = relays_for(targets, 1.0);
    const std::size_t above = relays_on_grid(targets, 1.0, side, cells);
    const std::size_t below = relays_on_grid(targets, 1.0 + std::sqrt(2.0) * side / cells, side, cells);
    EXPECT_LE(found, above) << seed;
    EXPECT_GE(found, below) << seed;
    tight += above == below ? 1 : 0;
  }
  EXPECT_GE(tight, 3) << "where both agree nothing is left open";
}

// All that can be shown from outside for any number of targets.
TEST(FewestRelays, LiesBetweenTheBoundAndTheSpanningTree) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const int count = 2 + static_cast<int>(seed % 13);
    const std::vector<Vec2> targets = scattered(100 + seed, count, 12.0);
    const std::size_t found = relays_for(targets, 1.9);
    EXPECT_GE(targets.size() + std::max<std::size_t>(1, found), robots_bound(targets, 0.0, 2.0)) << seed;
    EXPECT_GE(targets.size() + std::max<std::size_t>(1, found), robots_bound(targets, 0.0, 1.9)) << seed;
    EXPECT_LE(found, relays_of_spanning_tree(targets, 1.9)) << seed;
  }
}

// Where the fewest are exact: with one target more there are no fewer robots, since a relay can stand in for its
// worker, and no more than a chain to the nearest target needs.
TEST(FewestRelays, AFurtherTargetNeverSavesARobot) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::vector<Vec2> targets = scattered(200 + seed, 5, 6.0);
    while (targets.size() > 2) {
      const std::size_t with = relays_for(targets, 1.0);
      const Vec2 last = targets.back();
      targets.pop_back();
      double nearest_m = 1e9;
      for (const Vec2 t : targets) nearest_m = std::min(nearest_m, distance(t, last));
      const std::size_t without = relays_for(targets, 1.0);
      EXPECT_GE(with + 1, without) << seed;
      EXPECT_LE(with, without + static_cast<std::size_t>(std::ceil(nearest_m))) << seed;
    }
  }
}

TEST(FewestRelays, DoesNotDependOnOrderPlaceAngleOrUnit) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    std::vector<Vec2> targets = scattered(300 + seed, 2 + static_cast<int>(seed % 6), 8.0);
    const std::size_t found = relays_for(targets, 1.3);
    std::rotate(targets.begin(), targets.begin() + 1, targets.end());
    for (Vec2& t : targets) t = rotate(Vec2{0.6, 0.8}, t) * 1000.0 + Vec2{-300, 70};
    EXPECT_EQ(relays_for(targets, 1300.0), found) << seed;
  }
}

TEST(FewestRelays, LongerEdgesNeverNeedMore) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<Vec2> targets = scattered(400 + seed, 5, 6.0);
    std::size_t before = std::numeric_limits<std::size_t>::max();
    for (double range_m = 0.8; range_m < 5.0; range_m += 0.2) {
      const std::size_t found = relays_for(targets, range_m);
      EXPECT_LE(found, before) << seed;
      before = found;
    }
  }
}

// A random network of robots, some of them workers, each somewhere near its target. The bound is for all networks, so
// for this one as well.
TEST(RobotsBound, NoNetworkBeatsIt) {
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const double range_m = 2.0, tolerance_m = 0.2 * static_cast<double>(seed % 3);
    const std::size_t size = 2 + seed % 11;
    const bool straight = seed % 2 == 0;
    std::vector<Vec2> robots{{0, 0}};
    while (robots.size() < size) {
      const std::uint64_t k = robots.size();
      const double reach = range_m * (straight ? 0.999 : std::sqrt(drawn(seed, k, 0)));
      const double angle = straight ? 0.3 * drawn(seed, k, 1) : 2 * M_PI * drawn(seed, k, 1);
      const std::size_t from = straight ? k - 1 : static_cast<std::size_t>(drawn(seed, k, 2) * static_cast<double>(k));
      robots.push_back(robots[from] + Vec2{std::cos(angle), std::sin(angle)} * reach);
    }
    std::vector<Vec2> targets;
    for (std::size_t k = 1; k < size; ++k) {  // the first is the root
      if (drawn(seed, k, 3) < 0.5 && k + 1 < size) continue;
      const double angle = 2 * M_PI * drawn(seed, k, 4);
      targets.push_back(robots[k] + Vec2{std::cos(angle), std::sin(angle)} * (tolerance_m * drawn(seed, k, 5)));
    }
    const std::uint32_t bound = robots_bound(targets, tolerance_m, range_m);
    EXPECT_LE(bound, size) << seed;
    met += bound == size ? 1 : 0;
  }
  EXPECT_GT(met, 300) << "and often it is met";
}

// Every set of the targets by itself.
TEST(MostTargets, IsTheLargestSetThatSoManyRobotsHold) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<Vec2> targets = scattered(700 + seed, 5, 8.0);
    for (std::uint32_t robots = 0; robots <= 20; robots += 2) {
      std::uint32_t most = 0;
      for (unsigned set = 1; set < 32U; ++set) {
        std::vector<Vec2> some;
        for (std::size_t k = 0; k < targets.size(); ++k)
          if ((set >> k & 1U) != 0) some.push_back(targets[k]);
        const std::size_t relays = std::max<std::size_t>(1, fewest_relays(some, 1.9).relays.size());
        if (some.size() + relays <= robots) most = std::max(most, static_cast<std::uint32_t>(some.size()));
      }
      EXPECT_EQ(most_targets(targets, 1.9, robots), most) << seed << ", " << robots << " robots";
    }
  }
}

TEST(MostTargets, ManyTargetsGrowFromEachOfThem) {
  std::vector<Vec2> line;
  line.reserve(13);
  for (int k = 0; k < 12; ++k) line.push_back({3.0 * k, 0.0});  // a relay between any two
  line.push_back({100, 0});
  EXPECT_EQ(most_targets(line, 1.9, 0), 0U);
  EXPECT_EQ(most_targets(line, 1.9, 2), 1U);
  EXPECT_EQ(most_targets(line, 1.9, 11), 6U);
  EXPECT_EQ(most_targets(line, 1.9, 50), 12U);
  EXPECT_EQ(most_targets(line, 1.9, 500), 13U);
  EXPECT_EQ(most_targets({}, 1.9, 5), 0U);
}

TEST(RobotsBound, CountsAWorkerForEachTargetAndTheRelaysBetween) {
  EXPECT_EQ(robots_bound({}, 0.2, 2.0), 1U) << "a root";
  EXPECT_EQ(robots_bound({{0, 0}}, 0.2, 2.0), 2U) << "a worker and the root";
  EXPECT_EQ(robots_bound(circle_of(9, 1.6), 0.2, 2.0), 10U) << "nine near targets: no relay but the root";
  EXPECT_EQ(robots_bound({{-9, 0}, {9, 0}}, 0.2, 2.0), 10U);  // ceil(17.6 / 2) edges
  EXPECT_EQ(robots_bound({{-9, 0}, {9, 0}}, 0.0, 2.0), 10U);  // 18 / 2 exactly
  EXPECT_EQ(robots_bound(circle_of(3, 9.0), 0.2, 2.0), 15U);  // ceil(26.4 / 2) + 1
  EXPECT_EQ(robots_bound(circle_of(4, 9.0), 0.2, 2.0), 18U);  // (34.77 - 0.8) / 2 = 16.99
  // Four near each other, a fifth 20 m away: (20 - 5 * 0.2) / 2 edges beyond the four.
  EXPECT_EQ(robots_bound({{0, 0}, {-1, 0}, {-2, 0}, {-3, 0}, {20, 0}}, 0.2, 2.0), 5U + 9U);
  EXPECT_EQ(robots_bound({{0, 0}, {0, 0}, {0, 0}}, 0.2, 2.0), 4U) << "at the same place, still a worker each";
}

}  // namespace
}  // namespace banyan::measure
