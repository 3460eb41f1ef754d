// SPDX-License-Identifier: MIT
// Against brute force: take away every set of k - 1 other nodes and look whether the rest is connected.
#include "banyan/measure/disjoint_paths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace banyan::measure {
namespace {

using Links = std::vector<std::vector<bool>>;

Graph graph_of(const Links& links) {
  Graph graph;
  graph.offsets.push_back(0);
  for (const auto& row : links) {
    for (std::uint32_t j = 0; j < row.size(); ++j)
      if (row[j]) graph.neighbors.push_back(j);
    graph.offsets.push_back(static_cast<std::uint32_t>(graph.neighbors.size()));
  }
  return graph;
}

Links random_links(std::size_t n, double density, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Links links(n, std::vector<bool>(n, false));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) links[i][j] = links[j][i] = share(random) < density;
  return links;
}

bool is_cut_off(const Links& links, std::size_t a, std::size_t b, unsigned gone) {
  std::vector<std::size_t> reached{a};
  std::vector<bool> seen(links.size(), false);
  seen[a] = true;
  for (std::size_t head = 0; head < reached.size(); ++head)
    for (std::size_t j = 0; j < links.size(); ++j) {
      if (seen[j] || !links[reached[head]][j] || (gone >> j & 1U) != 0) continue;
      seen[j] = true;
      reached.push_back(j);
    }
  return !seen[b];
}

// The fewest other nodes whose loss cuts them off; one more for a link that no loss of nodes takes away.
std::uint32_t least_cut(Links links, std::size_t a, std::size_t b, std::uint32_t most) {
  const std::uint32_t direct = links[a][b] ? 1 : 0;
  links[a][b] = links[b][a] = false;
  std::uint32_t least = most;
  for (unsigned gone = 0; gone < 1U << links.size(); ++gone)
    if ((gone >> a & 1U) == 0 && (gone >> b & 1U) == 0 && is_cut_off(links, a, b, gone))
      least = std::min(least, direct + static_cast<std::uint32_t>(__builtin_popcount(gone)));
  return least;
}

TEST(DisjointPaths, OfKnownGraphs) {
  DisjointPaths paths;
  Links ring(7, std::vector<bool>(7, false));
  for (std::size_t i = 0; i < 7; ++i) ring[i][(i + 1) % 7] = ring[(i + 1) % 7][i] = true;
  EXPECT_EQ(paths.among(graph_of(ring), std::vector<std::uint32_t>{0, 2, 5}, 3), 2U);
  ring[0][6] = ring[6][0] = false;  // a chain
  EXPECT_EQ(paths.among(graph_of(ring), std::vector<std::uint32_t>{0, 2, 5}, 3), 1U);
  ring[3][4] = ring[4][3] = false;
  EXPECT_EQ(paths.among(graph_of(ring), std::vector<std::uint32_t>{0, 2, 5}, 3), 0U);
  EXPECT_EQ(paths.among(graph_of(ring), std::vector<std::uint32_t>{5}, 3), 3U);
}

// The shortest path, 0 1 2 3 4, takes a robot from each of the two disjoint ones: two of its links have to be undone.
TEST(DisjointPaths, UndoAPathThatIsInTheWay) {
  Links links(11, std::vector<bool>(11, false));
  const auto join = [&](const std::vector<std::size_t>& path) {
    for (std::size_t k = 1; k < path.size(); ++k) links[path[k - 1]][path[k]] = links[path[k]][path[k - 1]] = true;
  };
  join({0, 1, 2, 3, 4});
  join({0, 5, 6, 7, 3});
  join({1, 8, 9, 10, 4});
  EXPECT_EQ(DisjointPaths().between(graph_of(links), 0, 4, 3), 2U);
}

TEST(DisjointPaths, AreAsManyAsTheSmallestCutOfRandomGraphs) {
  std::mt19937_64 random(7);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  DisjointPaths paths;
  for (int round = 0; round < 150; ++round) {
    const std::size_t n = 3 + static_cast<std::size_t>(round) % 7;
    const Links links = random_links(n, 0.2 + 0.1 * (round % 5), random);
    const Graph graph = graph_of(links);
    for (std::uint32_t b = 1; b < n; ++b)
      ASSERT_EQ(paths.between(graph, 0, b, 4), least_cut(links, 0, b, 4)) << "graph " << round << ", to node " << b;
  }
}

TEST(DisjointPaths, AmongTerminalsAreTheLeastOfAllPairs) {
  std::mt19937_64 random(11);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  DisjointPaths paths;
  int joined_twice = 0;
  for (int round = 0; round < 100; ++round) {
    const Links links = random_links(9, 0.35 + 0.05 * (round % 6), random);
    const Graph graph = graph_of(links);
    const std::vector<std::uint32_t> terminals{0, 3, 4, 7, 8};
    std::uint32_t least = 3;
    for (const std::uint32_t a : terminals)
      for (const std::uint32_t b : terminals)
        if (a < b) least = std::min(least, least_cut(links, a, b, 3));
    ASSERT_EQ(paths.among(graph, terminals, 3), least) << "graph " << round;
    joined_twice += least == 2 ? 1 : 0;
  }
  EXPECT_GT(joined_twice, 8);  // the test has met the case that matters
}

}  // namespace
}  // namespace banyan::measure
