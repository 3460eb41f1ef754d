// SPDX-License-Identifier: MIT
// lambda_2 against closed forms, dense against sparse, and the quick decision against the value.
#include "banyan/measure/fiedler.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <exception>
#include <functional>

#include "banyan/controller/core/vec2.hpp"
#include "banyan/world/random.hpp"

namespace banyan::measure {
namespace {

using Vec2 = BasicVec2<double>;

Graph graph_of(std::size_t n, const std::function<bool(std::size_t, std::size_t)>& joined) {
  Graph graph;
  graph.offsets.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j)
      if (i != j && joined(std::min(i, j), std::max(i, j))) graph.neighbors.push_back(static_cast<std::uint32_t>(j));
    graph.offsets.push_back(static_cast<std::uint32_t>(graph.neighbors.size()));
  }
  return graph;
}

Graph path(std::size_t n) {
  return graph_of(n, [](auto a, auto b) { return b == a + 1; });
}
Graph cycle(std::size_t n) {
  return graph_of(n, [n](auto a, auto b) { return b == a + 1 || (a == 0 && b == n - 1); });
}
Graph complete(std::size_t n) {
  return graph_of(n, [](auto, auto) { return true; });
}
Graph star(std::size_t n) {
  return graph_of(n, [](auto a, auto) { return a == 0; });
}
Graph grid(std::size_t w, std::size_t h) {
  return graph_of(w * h, [w](auto a, auto b) { return b == a + w || (b == a + 1 && b % w != 0); });
}
Graph geometric(std::uint64_t seed, std::size_t n, double side, double stretch = 1.0) {
  std::vector<Vec2> p;
  for (std::size_t i = 0; i < n; ++i)
    p.push_back({side * stretch * world::to_uniform(world::bits(seed, world::Purpose::placement, i, 0)),
                 side / stretch * world::to_uniform(world::bits(seed, world::Purpose::placement, i, 1))});
  return graph_of(n, [&](auto a, auto b) { return distance(p[a], p[b]) < 1.0; });
}

double path_value(std::size_t n) { return 2 - 2 * std::cos(M_PI / static_cast<double>(n)); }
double cycle_value(std::size_t n) { return 2 - 2 * std::cos(2 * M_PI / static_cast<double>(n)); }

void expect_value(const Graph& graph, double value) {
  EXPECT_NEAR(Fiedler{}.value(graph), value, 1e-6 * value) << graph.size() << " nodes";
}

TEST(Fiedler, ClosedFormsDenseAndSparse) {
  for (const std::size_t n : {2U, 3U, 10U, 94U, 150U, 151U, 400U, 1000U}) {
    expect_value(path(n), path_value(n));
    if (n > 2) expect_value(cycle(n), cycle_value(n));                // lambda_2 = lambda_3
    if (n > 2) expect_value(star(n), 1.0);                            // n - 2 times
    if (n <= 400) expect_value(complete(n), static_cast<double>(n));  // n - 1 times
  }
  expect_value(grid(8, 8), path_value(8));  // twice
  expect_value(grid(20, 20), path_value(20));
  expect_value(grid(40, 25), path_value(40));
}

TEST(Fiedler, NoneAndOneNode) {
  Fiedler fiedler;
  EXPECT_EQ(fiedler.value(Graph{}), 0.0);
  EXPECT_TRUE(fiedler.below(Graph{}, 1e-3));
  EXPECT_EQ(fiedler.components(Graph{}).count, 0U);
  const Graph one{{0, 0}, {}};
  EXPECT_EQ(fiedler.value(one), 1.0);
  EXPECT_FALSE(fiedler.below(one, 1e-3));
  EXPECT_EQ(fiedler.components(one).count, 1U);
}

TEST(Fiedler, DisconnectedGraphsAreZeroAtAnySize) {
  for (const std::size_t n : {2U, 20U, 150U, 300U, 2000U}) {
    const Graph two = graph_of(n, [n](auto a, auto b) { return b == a + 1 && b != n / 2; });
    Fiedler fiedler;
    EXPECT_EQ(fiedler.value(two), 0.0);
    EXPECT_TRUE(fiedler.below(two, 1e-12));
    EXPECT_EQ(fiedler.components(two).count, 2U);
    const Graph none = graph_of(n, [](auto, auto) { return false; });
    EXPECT_EQ(fiedler.components(none).count, n);
  }
}

TEST(Fiedler, EccentricityIsTheNumberOfHopsFromNodeZero) {
  Fiedler fiedler;
  EXPECT_EQ(fiedler.components(path(17)).eccentricity, 16U);
  EXPECT_EQ(fiedler.components(cycle(17)).eccentricity, 8U);
  EXPECT_EQ(fiedler.components(star(17)).eccentricity, 1U);
  EXPECT_EQ(fiedler.components(grid(5, 7)).eccentricity, 10U);
}

// The dense solver does not take the graphs that the sparse one does. But the Cartesian product of a
// graph with a triangle has three times its nodes and lambda_2 = min(lambda_2, 3).
TEST(Fiedler, SparseAgreesWithDenseOnRandomGeometricGraphs) {
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::size_t n = 80;
    const Graph small = geometric(seed, n, 5.0);
    const double expected = Fiedler{}.value(small);
    if (expected == 0.0) continue;
    std::vector<std::vector<char>> joined(n, std::vector<char>(n, 0));
    for (std::size_t i = 0; i < n; ++i)
      for (const std::uint32_t j : small.of(i)) joined[i][j] = 1;
    const Graph product =
        graph_of(3 * n, [&](auto a, auto b) { return a % n == b % n || (a / n == b / n && joined[a % n][b % n]); });
    expect_value(product, std::min(expected, 3.0));
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

TEST(Fiedler, AWarmStartDoesNotChangeTheValue) {
  Fiedler warm;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Graph graph = geometric(100 + seed, 400, 11.0);
    const double fresh = Fiedler{}.value(graph);
    EXPECT_NEAR(warm.value(graph), fresh, 1e-6 * fresh);
    EXPECT_NEAR(warm.value(graph), fresh, 1e-6 * fresh) << "from its own eigenvector";
  }
  // Started from an eigenvector that has become the wrong one: a rectangle's long axis changes.
  expect_value(grid(16, 25), path_value(25));
  Fiedler turned;
  EXPECT_NEAR(turned.value(grid(25, 16)), path_value(25), 1e-6 * path_value(25));
  EXPECT_NEAR(turned.value(grid(16, 25)), path_value(25), 1e-6 * path_value(25));
  EXPECT_NEAR(turned.value(grid(20, 20)), path_value(20), 1e-6 * path_value(20));
}

TEST(Fiedler, BelowAgreesWithValueOnThousandsOfGraphs) {
  int yes = 0;
  int no = 0;
  int connected_yes = 0;
  Fiedler quick;  // keeps its memory over all of them
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const std::size_t n = 5 + seed % 60;
    const double side = 0.5 * std::sqrt(static_cast<double>(n));
    const Graph graph = geometric(seed, n, side, 1 + 0.001 * static_cast<double>(seed));
    const double value = Fiedler{}.value(graph);
    for (const double threshold : {1e-3, 0.02, 0.3, 2.0}) {
      EXPECT_EQ(quick.below(graph, threshold), value < threshold) << "seed " << seed << ", value " << value;
      (value < threshold ? yes : no)++;
      connected_yes += value > 0.0 && value < threshold;
    }
    if (value > 0.0) {  // on either side of the value itself
      EXPECT_TRUE(quick.below(graph, value * (1 + 1e-6)));
      EXPECT_FALSE(quick.below(graph, value * (1 - 1e-6)));
    }
  }
  EXPECT_GT(yes, 1000);
  EXPECT_GT(no, 1000);
  EXPECT_GT(connected_yes, 1000);
}

TEST(Fiedler, BelowOnLargeGraphs) {
  Fiedler fiedler;
  for (const std::size_t n : {200U, 1000U}) {
    for (const Graph& graph : {path(n), cycle(n), star(n), grid(n / 20, 20)}) {
      const double value = Fiedler{}.value(graph);
      for (const double factor : {0.1, 0.999, 1.001, 10.0}) {
        EXPECT_EQ(fiedler.below(graph, factor * value), factor > 1) << n;
        EXPECT_EQ(fiedler.below(graph, factor * value), factor > 1) << "asked again";
      }
      fiedler.value(graph);
      EXPECT_TRUE(fiedler.below(graph, 1.0001 * value)) << "by the last eigenvector";
    }
  }
  EXPECT_FALSE(fiedler.below(path(10), 0.0));
  EXPECT_FALSE(fiedler.below(path(10), -1.0));
  EXPECT_TRUE(fiedler.below(path(10), path_value(10) * 1.0001));
}

// So near to lambda_2 no cheap bound settles the question.
TEST(Fiedler, ALongComputationCanBeStopped) {
  const Graph graph = geometric(5, 3000, 22.0);
  ASSERT_EQ(Fiedler{}.components(graph).count, 1U);
  const double value = Fiedler{}.value(graph);
  struct Enough : std::exception {};
  for (const int most : {1, 2, 5}) {
    Fiedler fiedler;
    int asked = 0;
    fiedler.on_pause([&] {
      if (++asked >= most) throw Enough{};
    });
    EXPECT_THROW((void)fiedler.value(graph), Enough) << most;
    EXPECT_EQ(asked, most);
    asked = -1'000'000;  // afterwards it is as if nothing had been
    EXPECT_NEAR(fiedler.value(graph), value, 1e-6 * value);
    asked = most;
    EXPECT_THROW((void)fiedler.below(graph, 0.999 * value), Enough);
    asked = -1'000'000;
    EXPECT_FALSE(fiedler.below(graph, 0.999 * value));
    EXPECT_TRUE(fiedler.below(graph, 1.001 * value));
  }
}

TEST(Fiedler, TheSameGraphIsNotFactorisedTwice) {
  const Graph graph = grid(60, 60);
  Fiedler fiedler;
  const double threshold = 0.5 * path_value(60);  // not settled by the bounds
  const auto took = [&] {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_FALSE(fiedler.below(graph, threshold));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const double first = took();
  const double again = std::min({took(), took(), took()});
  EXPECT_LT(again, 0.5 * first);
}

}  // namespace
}  // namespace banyan::measure
