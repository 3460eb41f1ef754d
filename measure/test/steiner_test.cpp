// SPDX-License-Identifier: MIT
// Steiner lengths against closed forms and against properties that any shortest network has.
#include "banyan/measure/steiner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "banyan/world/random.hpp"

namespace banyan::measure {
namespace {

using world::Vec2;

std::vector<Vec2> ring(int count, double radius = 1.0, double phase = 0.0) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double a = phase + 2 * M_PI * i / count;
    points.push_back({radius * std::cos(a), radius * std::sin(a)});
  }
  return points;
}

std::vector<Vec2> random_points(std::uint64_t seed, int count) {
  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    points.push_back({world::to_uniform(world::bits(seed, world::Purpose::targets, i, 0)),
                      world::to_uniform(world::bits(seed, world::Purpose::targets, i, 1))});
  return points;
}

// Kruskal, to be independent of the library's Prim.
double spanning_tree(const std::vector<Vec2>& p) {
  struct Edge {
    double length;
    std::size_t a, b;
  };
  std::vector<Edge> edges;
  std::vector<std::size_t> part(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    part[i] = i;
    for (std::size_t j = 0; j < i; ++j) edges.push_back({distance(p[i], p[j]), i, j});
  }
  std::sort(edges.begin(), edges.end(), [](auto& a, auto& b) { return a.length < b.length; });
  double sum = 0.0;
  for (const Edge& e : edges) {
    const std::size_t from = part[e.a];
    const std::size_t to = part[e.b];
    if (from == to) continue;
    sum += e.length;
    for (std::size_t& x : part)
      if (x == from) x = to;
  }
  return sum;
}

void expect_exact(const std::vector<Vec2>& points, double length) {
  const SteinerLength s = steiner_length(points);
  EXPECT_TRUE(s.exact);
  EXPECT_NEAR(s.upper_m, length, 1e-6 * length + 1e-12);
  EXPECT_LE(s.lower_m, length * (1 + 1e-12)) << "a lower bound must not exceed the truth";
  EXPECT_GE(s.lower_m, length * (1 - 1e-6));
}

TEST(Steiner, FewOrCoincidentTerminals) {
  expect_exact({}, 0.0);
  expect_exact({{1, 2}}, 0.0);
  expect_exact({{1, 2}, {1, 2}, {1, 2}}, 0.0);
  expect_exact({{0, 0}, {3, 4}}, 5.0);
  expect_exact({{0, 0}, {3, 4}, {0, 0}, {3, 4}}, 5.0);
}

TEST(Steiner, Triangles) {
  expect_exact(ring(3), 3.0);  // Fermat point in the centre
  // Angles below 120 degrees: sqrt((a^2 + b^2 + c^2) / 2 + 2 sqrt(3) area).
  expect_exact({{0, 0}, {4, 0}, {1, 3}}, std::sqrt((16 + 10 + 18) / 2.0 + 2 * std::sqrt(3.0) * 6));
  expect_exact({{0, 0}, {5, 0.2}, {-5, 0.2}}, 2 * std::sqrt(25.04));  // an angle above: two sides
  expect_exact({{0, 0}, {1, 0}, {-0.5, std::sqrt(0.75)}}, 2.0);       // exactly 120 degrees
}

TEST(Steiner, SquareRectangleAndLadder) {
  expect_exact({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1 + std::sqrt(3.0));
  expect_exact({{0, 0}, {3, 0}, {3, 1}, {0, 1}}, 3 + std::sqrt(3.0));  // long side + sqrt(3) short side
  // Ladders of n rungs (Chung & Graham 1978): with k = 1 + sqrt(3)/2, n k - 1 for even n and
  // sqrt((n k - 1)^2 + 1/4) for odd n.
  const double k = 1 + std::sqrt(3.0) / 2;
  expect_exact({{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}}, std::sqrt((3 * k - 1) * (3 * k - 1) + 0.25));
  expect_exact({{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}}, 4 * k - 1);
  expect_exact({{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}, {0, 4}, {1, 4}},
               std::sqrt((5 * k - 1) * (5 * k - 1) + 0.25));
}

TEST(Steiner, RegularPolygons) {
  // From six on all sides but one are optimal (Du, Hwang & Weng 1987).
  for (int n = 6; n <= 12; ++n) expect_exact(ring(n, 2.0, 0.1 * n), (n - 1) * 4.0 * std::sin(M_PI / n));
}

TEST(Steiner, StarRatiosOfThePeerSurvey) {
  const double ratio[] = {0.966, 0.915, 0.833, 0.744, 0.670};
  for (int n = 4; n <= 8; ++n) EXPECT_NEAR(steiner_length(ring(n, 9.0)).upper_m / (9.0 * n), ratio[n - 4], 6e-4) << n;
}

TEST(Steiner, CollinearTerminalsNeedNoSteinerPoint) {
  expect_exact({{0, 0}, {1, 0}, {2, 0}, {5, 0}, {7, 0}}, 7.0);
  expect_exact({{0, 0}, {1, 1}, {2, 2}, {-3, -3}, {0.5, 0.5}, {4, 4}, {3, 3}}, 7 * std::sqrt(2.0));
}

TEST(Steiner, ACenterTerminalOfAStar) {
  std::vector<Vec2> points = ring(3);
  points.push_back({0, 0});
  expect_exact(points, 3.0);  // the Fermat point is a terminal
}

TEST(Steiner, BetweenTheSteinerRatioAndTheSpanningTree) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const int count = 3 + static_cast<int>(seed % 10);
    const std::vector<Vec2> points = random_points(seed, count);
    const double mst = spanning_tree(points);
    const SteinerLength s = steiner_length(points);
    EXPECT_TRUE(s.exact) << seed;
    EXPECT_LE(s.upper_m, mst * (1 + 1e-12)) << seed;
    EXPECT_GE(s.lower_m, mst * std::sqrt(0.75)) << "a disproof of Gilbert and Pollak's conjecture, seed " << seed;
    EXPECT_LE(s.lower_m, s.upper_m);
  }
}

// Two trees that share a terminal are a tree of all terminals, so the shortest one is no longer.
TEST(Steiner, NeverExceedsTheSumOfTwoPartsThatShareATerminal) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<Vec2> points = random_points(1000 + seed, 7);
    const double whole = steiner_length(points).lower_m;
    for (unsigned mask = 1; mask < 64; ++mask) {
      std::vector<Vec2> left{points[6]};
      std::vector<Vec2> right{points[6]};
      for (unsigned i = 0; i < 6; ++i) (mask >> i & 1 ? left : right).push_back(points[i]);
      EXPECT_LE(whole, (steiner_length(left).upper_m + steiner_length(right).upper_m) * (1 + 1e-9));
    }
  }
}

TEST(Steiner, DoesNotDependOnOrderPlaceAngleOrUnit) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<Vec2> points = random_points(2000 + seed, 7);
    const double length = steiner_length(points).upper_m;
    std::reverse(points.begin(), points.end());
    std::rotate(points.begin(), points.begin() + 3, points.end());
    for (Vec2& p : points) p = rotate(Vec2{0.6, 0.8}, p) * 1000.0 + Vec2{-300, 70};
    EXPECT_NEAR(steiner_length(points).upper_m, 1000 * length, 1e-6 * 1000 * length) << seed;
  }
}

// A tree of all terminals is one of all but the last, and with an edge from the last to the nearest
// other one it is the other way round.
TEST(Steiner, AFurtherTerminalCostsNoMoreThanItsDistanceAndNeverLessThanNothing) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    std::vector<Vec2> points = random_points(5000 + seed, 12);
    while (points.size() > 2) {
      const SteinerLength with = steiner_length(points);
      const Vec2 last = points.back();
      points.pop_back();
      double nearest = 1e9;
      for (const Vec2 p : points) nearest = std::min(nearest, distance(p, last));
      const SteinerLength without = steiner_length(points);
      EXPECT_TRUE(with.exact && without.exact);
      EXPECT_GE(with.upper_m, without.lower_m) << points.size();
      EXPECT_LE(with.lower_m, without.upper_m + nearest) << points.size();
    }
  }
}

// Trees of all full topologies of six terminals, each drawn tight by moving every Steiner point to
// the weighted mean of its neighbours again and again (Weiszfeld's step). Node 0..5: terminals.
class EveryTopology {
 public:
  explicit EveryTopology(std::vector<Vec2> terminals) : at_(std::move(terminals)) { grow({{0, 1}}, 2); }
  double shortest = 1e9;
  int topologies = 0;

 private:
  using Edges = std::vector<std::pair<std::size_t, std::size_t>>;
  void grow(const Edges& edges, std::size_t terminal) {
    if (terminal == 6) return tighten(edges);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      Edges next = edges;
      const std::size_t middle = 6 + terminal - 2;
      next[k].second = middle;
      next.emplace_back(edges[k].second, middle);
      next.emplace_back(terminal, middle);
      grow(next, terminal + 1);
    }
  }
  void tighten(const Edges& edges) {
    std::vector<Vec2> p = at_;
    p.resize(10, Vec2{0.5, 0.5});
    for (int i = 6; i < 10; ++i) p[static_cast<std::size_t>(i)] += Vec2{0.01 * i, 0.003 * i * i};
    double soft = 0.1;  // falling: a Steiner point must not get stuck at the first terminal it meets
    for (int step = 0; step < 2000; ++step, soft *= 0.995) {
      for (std::size_t s = 6; s < 10; ++s) {
        Vec2 sum{};
        double weight = 0.0;
        for (const auto& [a, b] : edges) {
          if (a != s && b != s) continue;
          const Vec2 other = p[a == s ? b : a];
          const double w = 1.0 / std::hypot(distance(other, p[s]), soft);
          sum += other * w;
          weight += w;
        }
        p[s] = sum / weight;
      }
    }
    double length = 0.0;
    for (const auto& [a, b] : edges) length += distance(p[a], p[b]);
    shortest = std::min(shortest, length);
    ++topologies;
  }
  std::vector<Vec2> at_;
};

TEST(Steiner, AgreesWithEveryTopologyTriedInTurn) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const std::vector<Vec2> points = random_points(6000 + seed, 6);
    const EveryTopology all(points);
    EXPECT_EQ(all.topologies, 105);
    EXPECT_NEAR(steiner_length(points).upper_m, all.shortest, 1e-4) << seed;
    EXPECT_LE(steiner_length(points).lower_m, all.shortest + 1e-12) << seed;
  }
}

// An independent algorithm: Dreyfus & Wagner's dynamic programming finds the shortest network whose
// Steiner points lie on a grid.
TEST(Steiner, NoNetworkOnAGridIsShorter) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const std::vector<Vec2> terminals = random_points(3000 + seed, 5);
    std::vector<Vec2> nodes = terminals;
    constexpr int side = 31;
    for (int i = 0; i < side * side; ++i)
      nodes.push_back({(i % side) / (side - 1.0), std::floor(i / static_cast<double>(side)) / (side - 1.0)});
    const std::size_t n = nodes.size();
    std::vector<std::vector<double>> cost(32, std::vector<double>(n, 1e9));
    for (unsigned t = 0; t < 5; ++t)
      for (std::size_t v = 0; v < n; ++v) cost[1U << t][v] = distance(nodes[t], nodes[v]);
    for (unsigned set = 1; set < 32; ++set) {
      if ((set & (set - 1)) == 0) continue;
      std::vector<double> joined(n, 1e9);
      for (std::size_t v = 0; v < n; ++v)
        for (unsigned sub = (set - 1) & set; sub > 0; sub = (sub - 1) & set)
          joined[v] = std::min(joined[v], cost[sub][v] + cost[set ^ sub][v]);
      for (std::size_t v = 0; v < n; ++v)  // all pairs are joined by straight lines
        for (std::size_t w = 0; w < n; ++w)
          cost[set][v] = std::min(cost[set][v], joined[w] + distance(nodes[v], nodes[w]));
    }
    const double on_grid = cost[31][0];
    const SteinerLength s = steiner_length(terminals);
    EXPECT_LE(s.lower_m, on_grid + 1e-9);
    EXPECT_NEAR(s.upper_m, on_grid, 0.01 * on_grid) << "the grid is fine enough for one per cent";
  }
}

TEST(Steiner, ManyTerminalsAreBounded) {
  const std::vector<Vec2> points = random_points(5, 200);
  const SteinerLength s = steiner_length(points);
  EXPECT_FALSE(s.exact);
  EXPECT_NEAR(s.upper_m, spanning_tree(points), 1e-9);
  EXPECT_NEAR(s.lower_m, 0.8241 * s.upper_m, 1e-9);
  const SteinerLength twenty = steiner_length(ring(20));
  const double truth = 38 * std::sin(M_PI / 20);  // all sides but one
  EXPECT_FALSE(twenty.exact);
  EXPECT_NEAR(twenty.upper_m, truth, 1e-9);
  EXPECT_LE(twenty.lower_m, truth);
  EXPECT_GT(twenty.lower_m, 0.87 * truth) << "twelve of them tell more than the ratio";
}

// Closed forms, and a grid search as the judge.
TEST(Star, RunsFromTheGeometricMedian) {
  EXPECT_EQ(star_length({}), 0.0);
  EXPECT_EQ(star_length({{1, 2}}), 0.0);
  EXPECT_NEAR(star_length({{0, 0}, {3, 4}}), 5.0, 1e-6);
  EXPECT_NEAR(star_length(ring(6, 2.0)), 12.0, 1e-6);
  EXPECT_NEAR(star_length({{0, 0}, {10, 0}, {1, 0.1}}), 10.0 + 0.1, 0.1)
      << "an angle beyond 120 degrees: the hub is that terminal";
  EXPECT_NEAR(star_length({{-1, 0}, {1, 0}, {0, -1}, {0, 1}}), 4.0, 1e-6);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<Vec2> points = random_points(seed, 7);
    const double length = star_length(points);
    double least = 1e9;
    for (double x = -1.0; x <= 2.0; x += 0.01)
      for (double y = -1.0; y <= 2.0; y += 0.01) {
        double sum = 0.0;
        for (const Vec2 p : points) sum += distance(p, Vec2{x, y});
        least = std::min(least, sum);
      }
    EXPECT_LE(length, least + 1e-9) << seed;
    EXPECT_GE(length, steiner_length(points).upper_m - 1e-9) << seed;
  }
}

}  // namespace
}  // namespace banyan::measure
