// SPDX-License-Identifier: MIT
#include "banyan/measure/disjoint_paths.hpp"

#include <algorithm>
#include <array>

namespace banyan::measure {
namespace {

constexpr std::uint32_t no_node = UINT32_MAX;

constexpr std::uint32_t entered(std::uint32_t node) noexcept { return 2 * node; }
constexpr std::uint32_t left(std::uint32_t node) noexcept { return 2 * node + 1; }
constexpr std::uint32_t node_of(std::uint32_t state) noexcept { return state / 2; }
constexpr bool is_left(std::uint32_t state) noexcept { return state % 2 == 1; }

}  // namespace

void DisjointPaths::visit(std::uint32_t state, std::uint32_t from) {
  if (came_from_[state] != no_node) return;
  came_from_[state] = from;
  queue_.push_back(state);
}

// The search has reached an end from the state `last`: what it has gone backwards is given up, the rest is added.
void DisjointPaths::turn_over(std::uint32_t last, std::uint32_t end) {
  for (std::uint32_t to = last; to != left(source_); to = came_from_[to]) {
    const std::uint32_t from = came_from_[to];
    if (is_left(from) || !is_left(to) || node_of(from) == node_of(to)) continue;
    next_[node_of(to)] = no_node;
    previous_[node_of(from)] = no_node;
  }
  const auto join = [&](std::uint32_t from, std::uint32_t to) {
    if (from != source_) next_[from] = to;
    if (!(single_end_ && to == end)) previous_[to] = from;
  };
  if (single_end_ && node_of(last) == source_) direct_ = true;
  join(node_of(last), end);
  for (std::uint32_t to = last; to != left(source_); to = came_from_[to]) {
    const std::uint32_t from = came_from_[to];
    if (is_left(from) && !is_left(to) && node_of(from) != node_of(to)) join(node_of(from), node_of(to));
  }
}

bool DisjointPaths::augment(const Graph& graph) {
  std::fill(came_from_.begin(), came_from_.end(), no_node);
  queue_.clear();
  visit(left(source_), left(source_));
  std::size_t head = 0;
  while (head < queue_.size()) {  // which grows
    const std::uint32_t state = queue_[head++];
    const std::uint32_t node = node_of(state);
    const bool used = previous_[node] != no_node;
    if (!is_left(state)) {
      if (!used) visit(left(node), state);
      else if (previous_[node] != source_) visit(left(previous_[node]), state);
      continue;
    }
    if (used) visit(entered(node), state);
    for (const std::uint32_t to : graph.of(node)) {
      if (to == source_ || next_[node] == to) continue;
      const bool taken = single_end_ ? node == source_ && direct_ : previous_[to] != no_node;
      if (is_end_[to] != 0 && !taken) {
        turn_over(state, to);
        return true;
      }
      if (is_end_[to] != 0 && single_end_) continue;
      if (node != source_ || previous_[to] != source_) visit(entered(to), state);
    }
  }
  return false;
}

std::uint32_t DisjointPaths::paths(const Graph& graph, std::uint32_t source, std::span<const std::uint32_t> ends,
                                   std::uint32_t most) {
  const std::size_t n = graph.size();
  came_from_.resize(2 * n);
  next_.assign(n, no_node);
  previous_.assign(n, no_node);
  is_end_.assign(n, 0);
  queue_.reserve(2 * n);
  for (const std::uint32_t end : ends) is_end_[end] = 1;
  source_ = source;
  single_end_ = ends.size() == 1;
  direct_ = false;
  std::uint32_t found = 0;
  while (found < most && augment(graph)) ++found;
  return found;
}

std::uint32_t DisjointPaths::between(const Graph& graph, std::uint32_t a, std::uint32_t b, std::uint32_t most) {
  return paths(graph, a, std::array{b}, most);
}

bool DisjointPaths::all_joined(const Graph& graph, std::span<const std::uint32_t> terminals, std::uint32_t most) {
  for (std::size_t j = 1; j < terminals.size(); ++j) {
    const auto before = terminals.first(j);
    if (j >= most && j > 1) {
      if (paths(graph, terminals[j], before, most) < most) return false;
      continue;
    }
    for (const std::uint32_t i : before)
      if (between(graph, i, terminals[j], most) < most) return false;
  }
  return true;
}

std::uint32_t DisjointPaths::among(const Graph& graph, std::span<const std::uint32_t> terminals, std::uint32_t most) {
  std::uint32_t number = most;
  while (number > 0 && !all_joined(graph, terminals, number)) --number;
  return number;
}

}  // namespace banyan::measure
