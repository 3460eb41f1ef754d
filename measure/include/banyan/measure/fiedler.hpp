// SPDX-License-Identifier: MIT
// Algebraic connectivity (paper Sec. II-B): is lambda_2 of a graph below a threshold, and what is it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace banyan::measure {

// Undirected graph in compressed rows: the neighbours of node i are
// neighbors[offsets[i] .. offsets[i + 1]), each edge stored at both ends.
struct Graph {
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> neighbors;
  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
};

// Keeps its workspace and the last eigenvector: consecutive graphs of a run differ little.
class Fiedler {
 public:
  // Connected components; for a connected graph also the eccentricity of node 0. O(n + m).
  struct Components { std::uint32_t count = 0; std::uint32_t eccentricity = 0; };
  Components components(const Graph& graph);
  // lambda_2 < threshold? By components, then lambda_2 >= 4 / (n diameter) with diameter <= 2
  // eccentricity, then the Rayleigh quotient of the last eigenvector, and only then by value().
  bool below(const Graph& graph, double threshold);
  // lambda_2: 0 for a disconnected graph, else dense up to 150 nodes, sparse shift-invert above,
  // started from the last eigenvector. Relative accuracy 1e-6.
  double value(const Graph& graph);

 private:
  std::vector<std::uint32_t> queue_, level_;
  std::vector<double> eigenvector_;
};

}  // namespace banyan::measure
