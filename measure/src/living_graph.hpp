// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "banyan/measure/fiedler.hpp"
#include "banyan/world/world.hpp"

namespace banyan::measure {

// Communication graph of the living robots, which are renumbered without gaps.
class LivingGraph {
 public:
  void build(const world::World& world) {
    build(world, [this](std::size_t /*i*/, std::span<const std::uint32_t> links) {
      graph.neighbors.insert(graph.neighbors.end(), links.begin(), links.end());
    });
  }
  // Over the links of which both ends hear each other.
  void build_both_ways(const world::World& world) {
    build(world, [&](std::size_t i, std::span<const std::uint32_t> links) {
      for (const std::uint32_t j : links)
        if (!world.is_deaf(i, j) && !world.is_deaf(j, i)) graph.neighbors.push_back(j);
    });
  }
  // With a link for each pair without a line of sight.
  void build_by_distance(const world::World& world, std::span<const std::pair<std::uint32_t, std::uint32_t>> blocked) {
    number(world.alive());
    const std::size_t n = world.size();
    std::vector<std::uint32_t>& begin = graph.offsets;
    begin.assign(1, 0);
    for (std::size_t i = 0; i < n; ++i)
      if (world.alive()[i] != 0) begin.push_back(static_cast<std::uint32_t>(world.links(i).size()));
    for (const auto& [i, j] : blocked) {
      ++begin[number_[i] + 1];
      ++begin[number_[j] + 1];
    }
    for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
    graph.neighbors.resize(begin.back());
    end_.assign(begin.begin(), begin.end());
    const auto add = [&](std::size_t i, std::uint32_t j) { graph.neighbors[end_[number_[i]]++] = number_[j]; };
    for (std::size_t i = 0; i < n; ++i)
      for (const std::uint32_t j : world.links(i)) add(i, j);
    for (const auto& [i, j] : blocked) {
      add(i, j);
      add(j, i);
    }
  }
  Graph graph;

 private:
  template <class AddLinks> void build(const world::World& world, AddLinks add_links) {
    const auto alive = world.alive();
    const bool all_alive = std::find(alive.begin(), alive.end(), std::uint8_t{0}) == alive.end();
    graph.offsets.assign(1, 0);
    graph.neighbors.clear();
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (alive[i] == 0) continue;
      add_links(i, world.links(i));
      graph.offsets.push_back(static_cast<std::uint32_t>(graph.neighbors.size()));
    }
    if (all_alive) return;
    number(alive);
    for (std::uint32_t& j : graph.neighbors) j = number_[j];
  }
  void number(std::span<const std::uint8_t> alive) {
    number_.resize(alive.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < alive.size(); ++i) number_[i] = alive[i] != 0 ? next++ : 0;
  }
  std::vector<std::uint32_t> number_, end_;
};

}  // namespace banyan::measure
