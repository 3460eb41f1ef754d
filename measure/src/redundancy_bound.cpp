// SPDX-License-Identifier: MIT
// The bound counts layers. Let a worker's layer j be the robots that are j hops away from it. If another worker is more
// than j hops away, the layer separates the two, so `paths` disjoint paths need as many robots in it. Layers of two
// workers have no robot in common if their numbers add up to less than the hops between the two. So the bound is a
// packing: as many layers as possible, around single workers and then around groups of them.
#include "banyan/measure/redundancy_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "banyan/measure/relays.hpp"
#include "banyan/measure/steiner.hpp"
#include "full_component.hpp"

namespace banyan::measure {
namespace {

using world::Vec2;
using SymmetricTable = std::vector<std::vector<int>>;  // symmetric; the diagonal is not looked at

constexpr int far = std::numeric_limits<int>::max() / 4;
constexpr int most_packings = 100'000;  // while packing: the best so far is certain, too
constexpr std::size_t most_toured = 9;  // targets

// Relays that any path between two workers has at least; exactly, for workers at rest on targets that far apart.
int relays_along(double distance_m, double range_m) noexcept {
  return distance_m <= 0.0 ? 0 : static_cast<int>(std::floor(distance_m / range_m));
}

// The most layers around nodes so that any two of these have no more than their room together: branch and bound.
class Packing {
 public:
  explicit Packing(const SymmetricTable& room)
      : room_(room), layers_(room.size(), 0), best_(room.size(), 0), order_(room.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    // Nodes far from all others first: there most is at stake.
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return alone(a) > alone(b); });
  }
  const std::vector<int>& run() {
    search(0, 0);
    return best_;
  }

 private:
  [[nodiscard]] int alone(std::size_t i) const {
    int least = far;
    for (std::size_t j = 0; j < room_.size(); ++j)
      if (j != i) least = std::min(least, room_[i][j]);
    return least;
  }
  // What node order_[at] may have, given those before it.
  [[nodiscard]] int left(std::size_t node, std::size_t at) const {
    int least = alone(node);
    for (std::size_t k = 0; k < at; ++k) least = std::min(least, room_[node][order_[k]] - layers_[order_[k]]);
    return least;
  }
  void search(std::size_t at, int sum) {
    if (++looks_ > most_packings) return;
    if (at == order_.size()) {
      if (sum > best_sum_) {
        best_sum_ = sum;
        best_ = layers_;
      }
      return;
    }
    int most = sum;
    for (std::size_t k = at; k < order_.size(); ++k) most += left(order_[k], at);
    if (most <= best_sum_) return;
    const std::size_t node = order_[at];
    const int highest = left(node, at);
    // From the middle outwards: half of the room is right for most.
    const auto try_value = [&](int value) {
      if (value < 0 || value > highest) return;
      layers_[node] = value;
      search(at + 1, sum + value);
    };
    try_value(highest / 2);
    for (int d = 1; d <= highest; ++d) {
      try_value(highest / 2 + d);
      try_value(highest / 2 - d);
    }
    layers_[node] = 0;
  }

  const SymmetricTable& room_;
  std::vector<int> layers_, best_;
  std::vector<std::size_t> order_;
  int best_sum_ = -1;
  int looks_ = 0;
};

// Nodes between which no room is left are one from then on.
std::vector<std::size_t> groups_of(const SymmetricTable& room) {
  std::vector<std::size_t> group(room.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t i = 0; i < room.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (room[i][j] == 0 && group[i] != group[j])
        std::replace(group.begin(), group.end(), std::max(group[i], group[j]), std::min(group[i], group[j]));
  std::vector<std::size_t> names = group;
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  for (std::size_t& g : group)
    g = static_cast<std::size_t>(std::lower_bound(names.begin(), names.end(), g) - names.begin());
  return group;
}

// How many layers there are room for, none of which has a robot in common with another.
int layers_around(SymmetricTable room) {
  int sum = 0;
  while (room.size() > 1) {
    const std::vector<int> layers = Packing(room).run();
    sum += std::accumulate(layers.begin(), layers.end(), 0);
    for (std::size_t i = 0; i < room.size(); ++i)
      for (std::size_t j = 0; j < room.size(); ++j)
        if (i != j) room[i][j] -= layers[i] + layers[j];
    const std::vector<std::size_t> group = groups_of(room);
    const std::size_t size = *std::max_element(group.begin(), group.end()) + 1;
    SymmetricTable joined(size, std::vector<int>(size, far));
    for (std::size_t i = 0; i < room.size(); ++i)
      for (std::size_t j = 0; j < room.size(); ++j)
        if (group[i] != group[j]) joined[group[i]][group[j]] = std::min(joined[group[i]][group[j]], room[i][j]);
    room = std::move(joined);
  }
  return sum;
}

SymmetricTable relays_between_all(const std::vector<Vec2>& targets, double less_m, double range_m) {
  SymmetricTable relays(targets.size(), std::vector<int>(targets.size(), far));
  for (std::size_t i = 0; i < targets.size(); ++i)
    for (std::size_t j = 0; j < targets.size(); ++j)
      if (i != j) relays[i][j] = relays_along(distance(targets[i], targets[j]) - less_m, range_m);
  return relays;
}

// The relays of the ring through all targets that has the fewest (Held & Karp 1962). At least three targets.
int relays_of_ring(const SymmetricTable& relays) {
  const std::size_t n = relays.size() - 1;  // the last one is where the ring begins
  std::vector<std::vector<int>> least(std::size_t{1} << n, std::vector<int>(n, far));
  for (std::size_t i = 0; i < n; ++i) least[std::size_t{1} << i][i] = relays[n][i];
  for (std::size_t set = 1; set < least.size(); ++set)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; least[set][i] < far && j < n; ++j)
        if ((set >> j & 1U) == 0) {
          int& next = least[set | std::size_t{1} << j][j];
          next = std::min(next, least[set][i] + relays[i][j]);
        }
  int best = far;
  for (std::size_t i = 0; i < n; ++i) best = std::min(best, least.back()[i] + relays[i][n]);
  return best;
}

// The relays of the tree in which all targets are leaves that has the fewest; `far` if none was found in two seconds.
int relays_of_tree(const std::vector<Vec2>& targets, double range_m) {
  constexpr double just_below = 1.0 - 1e-6;  // no edge is as long as the range
  std::vector<Vec2> scaled;
  scaled.reserve(targets.size());
  for (const Vec2 t : targets) scaled.push_back(t / (just_below * range_m));
  std::vector<double> lengths(std::size_t{1} << targets.size());
  for (std::size_t set = 0; set < lengths.size(); ++set) {
    std::vector<Vec2> some;
    for (std::size_t k = 0; k < scaled.size(); ++k)
      if ((set >> k & 1U) != 0) some.push_back(scaled[k]);
    lengths[set] = steiner_length(some).lower_m;
  }
  Tries tries;
  const FullComponent tree = full_component(scaled, lengths, far, tries);
  return tree.branches.empty() ? far : tree.relays;
}

// Of networks that exist; `far` if none was looked for. Workers stand upon their targets.
int relays_found(const std::vector<Vec2>& targets, double range_m, int paths) {
  if (targets.size() < 2) return paths;
  const SymmetricTable relays = relays_between_all(targets, 0.0, range_m);
  if (targets.size() == 2) return relays[0][1] > 0 ? paths * relays[0][1] : paths - 1;
  if (targets.size() > most_toured) return far;
  int found = paths == 2 ? std::max(1, relays_of_ring(relays)) : far;
  if (targets.size() > static_cast<std::size_t>(most_leaves)) return found;
  const int tree = relays_of_tree(targets, range_m);
  return tree < far ? std::min(found, paths * tree) : found;
}

}  // namespace

RedundancyBound redundancy_bound(const std::vector<Vec2>& targets, double tolerance_m, double range_m,
                                 std::uint32_t paths) {
  const auto workers = static_cast<std::uint32_t>(targets.size());
  std::uint32_t robots = robots_bound(targets, tolerance_m, range_m);
  if (paths <= 1 || targets.empty()) return {robots, false};
  // A direct link is one path; each further one has a robot of its own. The same holds for the root.
  robots = std::max({robots, workers + 1, paths + 1});
  const auto layers =
      static_cast<std::uint32_t>(layers_around(relays_between_all(targets, 2.0 * tolerance_m, range_m)));
  robots = std::max(robots, workers + paths * layers);
  return {robots,
          robots == workers + static_cast<std::uint32_t>(relays_found(targets, range_m, static_cast<int>(paths)))};
}

}  // namespace banyan::measure
