// SPDX-License-Identifier: MIT
// Algebraic connectivity (paper Sec. II-B): whether lambda_2 of a graph is below a threshold, and its value.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace banyan::measure {

// Undirected graph in compressed rows: the neighbours of node i are
// neighbors[offsets[i] .. offsets[i + 1]), each edge stored at both ends, no loops, none twice.
struct Graph {
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> neighbors;
  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t i) const noexcept {
    return {neighbors.data() + offsets[i], neighbors.data() + offsets[i + 1]};
  }
  friend bool operator==(const Graph&, const Graph&) = default;
};

// Keeps its workspace and the last eigenvector: consecutive graphs of a run differ little. One
// object per series of graphs and thread.
class Fiedler {
 public:
  // Called before a matrix is factorised, which takes seconds for tens of thousands of nodes, and between the steps of
  // an iteration; what it throws ends below() or value() at once, as if it had not been called.
  void on_pause(std::function<void()> pause) { pause_ = std::move(pause); }

  // Connected components; for a connected graph also the eccentricity of node 0. O(n + m), no
  // allocation once it has seen a graph of this size.
  struct Components {
    std::uint32_t count = 0;
    std::uint32_t eccentricity = 0;
  };
  Components components(const Graph& graph);
  // The hops of each node from node 0, as the last call of any of these found them. Of a connected graph.
  [[nodiscard]] std::span<const std::uint32_t> hops() const noexcept { return level_; }
  // lambda_2 < threshold? Settled by the cheapest of: components; lambda_2 >= 4 / (n diameter) with
  // diameter <= 2 eccentricity; how much must flow through the narrowest links if every node is to
  // reach node 0; the Rayleigh quotient of the last eigenvector or of the hops from node 0; the
  // answer for the same graph before; and else the signs of one sparse factorisation.
  // Everything but the last costs O(n + m) and allocates nothing after the first calls.
  bool below(const Graph& graph, double threshold);
  // lambda_2: 0 for a disconnected or empty graph, n for a complete one (1 for a single node), else
  // dense up to 150 nodes, sparse shift-invert above, started from the last eigenvector. Relative
  // accuracy 1e-6. Throws std::runtime_error if the sparse solver does not converge.
  double value(const Graph& graph);

 private:
  std::uint32_t visit(const Graph& graph, std::uint32_t start);
  double dense(const Graph& graph);
  double sparse(const Graph& graph, double lower_bound);
  double flow_bound(const Graph& graph);
  bool below_by_factorisation(const Graph& graph, double threshold);

  std::function<void()> pause_;
  std::vector<std::uint32_t> queue_, level_;  // breadth-first search
  std::vector<double> flow_, widest_;         // through each node; the largest over an edge of each level
  std::vector<double> eigenvector_;           // of the last value()
  Graph settled_;                             // the last graph that needed a factorisation
  double settled_threshold_ = 0.0;
  bool settled_answer_ = false;
};

}  // namespace banyan::measure
