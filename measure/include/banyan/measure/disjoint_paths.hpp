// SPDX-License-Identifier: MIT
// How many robots have to be lost before some are cut off from each other: paths that share no node in between.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "banyan/measure/fiedler.hpp"

namespace banyan::measure {

// By Menger's theorem two nodes are joined by k paths that share nothing but their ends if and only if the loss of no
// k - 1 others cuts them off from each other (a direct link is a path, too). Found as a flow through nodes that carry
// one unit each, by augmenting paths. Boost.Graph has maximum flows, but of k = 2 or 3 units all that is needed is two
// or three searches, here without the second copy of each node, its reverse edges and their property maps, which would
// have to be built anew at every tick. One object per thread; it allocates nothing once it has seen a graph of that
// size.
class DisjointPaths {
 public:
  // Between these two different nodes, at most `most`. O(most (n + m)).
  std::uint32_t between(const Graph& graph, std::uint32_t a, std::uint32_t b, std::uint32_t most);
  // The least number between any two of the terminals, which differ, at most `most`; `most` for less than two.
  // Not all pairs are looked at (Even 1975): if `most` terminals are joined in pairs, and each further one is by as
  // many paths to different ones before it, then all are. O(most (most^2 + terminals) (n + m)).
  std::uint32_t among(const Graph& graph, std::span<const std::uint32_t> terminals, std::uint32_t most);

 private:
  // From `source` to the ends: to one end as often as there is a way, to several once each.
  std::uint32_t paths(const Graph& graph, std::uint32_t source, std::span<const std::uint32_t> ends,
                      std::uint32_t most);
  bool augment(const Graph& graph);
  void visit(std::uint32_t state, std::uint32_t from);
  void turn_over(std::uint32_t last, std::uint32_t end);
  [[nodiscard]] bool all_joined(const Graph& graph, std::span<const std::uint32_t> terminals, std::uint32_t most);

  // A node is entered (state 2 v) and left (2 v + 1). A node on a path can only be entered to lead that path elsewhere.
  std::vector<std::uint32_t> queue_, came_from_;  // states
  std::vector<std::uint32_t> next_, previous_;    // by node: the paths found so far
  std::vector<std::uint8_t> is_end_;
  std::uint32_t source_ = 0;
  bool single_end_ = false;
  bool direct_ = false;  // the link from the source to the single end is a path already
};

}  // namespace banyan::measure
