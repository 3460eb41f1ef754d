// SPDX-License-Identifier: MIT
// Trees are put together from full components (full_component.hpp), which share terminals. Few targets: the best way
// to do so, by dynamic programming over sets of targets. Many: components are taken greedily while they save relays.
#include "banyan/measure/relays.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "banyan/measure/steiner.hpp"
#include "full_component.hpp"

namespace banyan::measure {
namespace {

using world::Vec2;
using TargetSet = std::uint32_t;

constexpr std::size_t most_programmed = 9;   // targets; above, components are chosen greedily
constexpr std::size_t most_quadruples = 40;  // targets up to which components of four are tried

// A component of these targets; its branches count them in their order here.
struct JoinedTargets {
  std::vector<std::size_t> targets;
  FullComponent component;
};

std::vector<Vec2> points_of(const std::vector<Vec2>& targets, const std::vector<std::size_t>& members) {
  std::vector<Vec2> points;
  points.reserve(members.size());
  for (const std::size_t i : members) points.push_back(targets[i]);
  return points;
}

std::vector<std::size_t> members(TargetSet set) {
  std::vector<std::size_t> list;
  for (; set != 0; set &= set - 1) list.push_back(static_cast<std::size_t>(std::countr_zero(set)));
  return list;
}

// No network of a set of the targets is shorter; by bit set, computed when asked for.
class Lengths {
 public:
  explicit Lengths(const std::vector<Vec2>& targets)
      : targets_{targets}, known_(std::size_t{1} << targets.size(), -1.0) {}
  // Of all subsets of the set, their bits counted within it.
  std::vector<double> within(TargetSet set) {
    const std::vector<std::size_t> list = members(set);
    std::vector<double> lengths(std::size_t{1} << list.size());
    for (std::size_t local = 0; local < lengths.size(); ++local) {
      TargetSet some = 0;
      for (std::size_t k = 0; k < list.size(); ++k)
        if ((local >> k & 1U) != 0) some |= TargetSet{1} << list[k];
      double& length = known_[some];
      if (length < 0.0) length = steiner_length(points_of(targets_, members(some))).lower_m;
      lengths[local] = length;
    }
    return lengths;
  }

 private:
  const std::vector<Vec2>& targets_;
  std::vector<double> known_;
};

// The fewest relays for each set of targets: one full component, or two trees that share a target.
class Program {
 public:
  explicit Program(const std::vector<Vec2>& targets)
      : targets_{targets}, lengths_{targets}, best_(std::size_t{1} << targets.size()) {
    // By size: the tries go to small components first, which need few.
    for (int size = 2; size <= static_cast<int>(targets.size()); ++size) {
      for (TargetSet set = 1; set < best_.size(); ++set) {
        if (std::popcount(set) != size) continue;
        Choice& choice = best_[set];
        split(set, choice);
        if (size <= most_leaves) try_component(set, choice);
      }
    }
  }
  // The largest set that its relays, at least one, and a worker for each join.
  [[nodiscard]] int largest_within(int robots) const {
    int most = 0;
    for (TargetSet set = 1; set < best_.size(); ++set) {
      const int workers = std::popcount(set);
      const int relays = workers < 2 ? 1 : std::max(1, best_[set].relays);
      if (workers + relays <= robots) most = std::max(most, workers);
    }
    return most;
  }
  [[nodiscard]] std::vector<JoinedTargets> parts() const {
    std::vector<JoinedTargets> list;
    collect(static_cast<TargetSet>(best_.size() - 1), list);
    return list;
  }
  [[nodiscard]] bool complete() const noexcept { return !tries_.used_up(); }

 private:
  struct Choice {
    int relays = std::numeric_limits<int>::max();
    TargetSet one = 0, other = 0;          // two trees, or, if there are none, the component
    std::vector<FullComponent> component;  // at most one
  };

  void split(TargetSet set, Choice& choice) const {
    for (TargetSet one = (set - 1) & set; one > 0; one = (one - 1) & set) {
      if (std::popcount(one) < 2) continue;
      for (TargetSet left = one; left != 0; left &= left - 1) {
        const TargetSet other = (set & ~one) | (left & (~left + 1));
        const int relays = best_[one].relays + best_[other].relays;
        if (relays < choice.relays) choice = {relays, one, other, {}};
      }
    }
  }

  void try_component(TargetSet set, Choice& choice) {
    FullComponent found =
        full_component(points_of(targets_, members(set)), lengths_.within(set), choice.relays - 1, tries_);
    if (found.branches.empty()) return;
    choice = {found.relays, 0, 0, {}};
    choice.component.push_back(std::move(found));
  }

  void collect(TargetSet set, std::vector<JoinedTargets>& list) const {
    const Choice& choice = best_[set];
    if (choice.component.empty()) {
      collect(choice.one, list);
      collect(choice.other, list);
    } else {
      list.push_back({members(set), choice.component.front()});
    }
  }

  const std::vector<Vec2>& targets_;
  Lengths lengths_;
  Tries tries_;
  std::vector<Choice> best_;
};

// Components of a few targets near each other, as long as one saves relays. Targets that a component joins are tied.
class Greedy {
 public:
  explicit Greedy(const std::vector<Vec2>& targets) : targets_{targets}, cost_(targets.size() * targets.size()) {
    for (std::size_t i = 0; i < targets.size(); ++i)
      for (std::size_t j = 0; j < targets.size(); ++j) cost(i, j) = relays_between(targets[i], targets[j]);
  }

  std::vector<JoinedTargets> parts() {
    span();
    std::vector<JoinedTargets> open = worthwhile(), chosen;
    for (;;) {
      const auto gain = [this](const JoinedTargets& p) { return saved_by(p.targets) - p.component.relays; };
      std::erase_if(open, [&](const JoinedTargets& p) { return gain(p) <= 0; });
      if (open.empty()) break;
      const auto best = std::max_element(open.begin(), open.end(), [&](auto& a, auto& b) { return gain(a) < gain(b); });
      for (const std::size_t i : best->targets)
        for (const std::size_t j : best->targets) cost(i, j) = tied;
      chosen.push_back(*best);
      span();
    }
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (up_[i] == i || cost(i, up_[i]) == tied) continue;
      chosen.push_back({{i, up_[i]}, full_component({targets_[i], targets_[up_[i]]}, {}, unlimited, tries_)});
    }
    return chosen;
  }

 private:
  static constexpr int tied = -1;
  static constexpr int unlimited = std::numeric_limits<int>::max();
  int& cost(std::size_t i, std::size_t j) { return cost_[i * targets_.size() + j]; }

  // The minimum spanning tree (Prim), as the next target towards the first.
  void span() {
    const std::size_t n = targets_.size();
    up_.assign(n, 0);
    std::vector<char> done(n, 0);
    done[0] = 1;
    for (std::size_t step = 1; step < n; ++step) {
      std::size_t next = n;
      for (std::size_t i = 0; i < n; ++i)
        if (!done[i] && (next == n || cost(i, up_[i]) < cost(next, up_[next]))) next = i;
      done[next] = 1;
      for (std::size_t i = 0; i < n; ++i)
        if (!done[i] && cost(i, next) < cost(i, up_[i])) up_[i] = next;
    }
  }

  // Relays of the spanning tree that are not needed once these targets are joined; 0 if some of them are tied.
  int saved_by(const std::vector<std::size_t>& some) {
    int saved = 0;
    std::vector<char> cut(targets_.size(), 0);
    for (std::size_t k = 1; k < some.size(); ++k) {
      for (std::size_t j = 0; j < k; ++j) {
        const auto edge = dearest_between(some[j], some[k], cut);
        if (!edge) continue;
        if (cost(*edge, up_[*edge]) == tied) return 0;
        saved += cost(*edge, up_[*edge]);
        cut[*edge] = 1;
      }
    }
    return saved;
  }

  // The edge with most relays on the way in the tree, by its lower end; nothing if the way is cut.
  std::optional<std::size_t> dearest_between(std::size_t a, std::size_t b, const std::vector<char>& cut) {
    std::vector<char> above(targets_.size(), 0);
    for (std::size_t i = a;; i = up_[i]) {
      above[i] = 1;
      if (up_[i] == i) break;
    }
    std::size_t meeting = b;
    while (!above[meeting]) meeting = up_[meeting];
    std::optional<std::size_t> dearest;
    for (const std::size_t start : {a, b}) {
      for (std::size_t i = start; i != meeting; i = up_[i]) {
        if (cut[i]) return std::nullopt;
        if (!dearest || cost(i, up_[i]) > cost(*dearest, up_[*dearest])) dearest = i;
      }
    }
    return dearest;
  }

  // Each target with others near it.
  std::vector<JoinedTargets> worthwhile() {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const std::vector<std::size_t> near = nearest_to(i);
      for (std::size_t b = 0; b < near.size(); ++b) {
        for (std::size_t a = 0; a < b; ++a) {
          groups.push_back({i, near[a], near[b]});
          for (std::size_t c = 0; c < a && targets_.size() <= most_quadruples; ++c)
            groups.push_back({i, near[a], near[b], near[c]});
        }
      }
    }
    for (auto& group : groups) std::sort(group.begin(), group.end());
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    std::vector<JoinedTargets> parts;
    for (const auto& group : groups) {
      const std::vector<Vec2> points = points_of(targets_, group);
      const TargetSet all = (TargetSet{1} << group.size()) - 1;
      FullComponent found = full_component(points, Lengths(points).within(all), saved_by(group) - 1, tries_);
      if (!found.branches.empty()) parts.push_back({group, std::move(found)});
    }
    return parts;
  }
  [[nodiscard]] std::vector<std::size_t> nearest_to(std::size_t i) const {
    constexpr std::size_t neighbors = 6;
    std::vector<std::size_t> order(targets_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    order.erase(order.begin() + static_cast<std::ptrdiff_t>(i));
    const std::size_t some = std::min(neighbors, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(some), order.end(),
                      [&](std::size_t a, std::size_t b) {
                        const double da = distance(targets_[a], targets_[i]), db = distance(targets_[b], targets_[i]);
                        return da != db ? da < db : a < b;
                      });
    order.resize(some);
    return order;
  }

  const std::vector<Vec2>& targets_;
  Tries tries_;
  std::vector<int> cost_;  // relays between two targets
  std::vector<std::size_t> up_;
};

// The components laid out: a relay at each hub, others evenly along each branch.
class Laid {
 public:
  Laid(const std::vector<Vec2>& targets, double range_m) : targets_{targets}, range_m_{range_m} {}

  void add(const JoinedTargets& part) {
    std::vector<std::uint32_t> nodes(part.targets.begin(), part.targets.end());
    for (const Vec2 hub : part.component.hubs) nodes.push_back(add_relay(hub * range_m_));
    for (const Branch& branch : part.component.branches) {
      const std::uint32_t from = nodes[static_cast<std::size_t>(branch.from)];
      const std::uint32_t to = nodes[static_cast<std::size_t>(branch.to)];
      const Vec2 start = place(from), way = place(to) - start;
      std::uint32_t last = from;
      for (int k = 1; k < branch.hops; ++k) {
        const std::uint32_t next = add_relay(start + way * (static_cast<double>(k) / branch.hops));
        tree.edges.emplace_back(last, next);
        last = next;
      }
      tree.edges.emplace_back(last, to);
    }
  }
  RelayTree tree;

 private:
  std::uint32_t add_relay(Vec2 at) {
    tree.relays.push_back(at);
    return static_cast<std::uint32_t>(targets_.size() + tree.relays.size() - 1);
  }
  [[nodiscard]] Vec2 place(std::uint32_t node) const {
    return node < targets_.size() ? targets_[node] : tree.relays[node - targets_.size()];
  }
  const std::vector<Vec2>& targets_;
  double range_m_;
};

// Workers that are certain to hear each other may be joined first, by a shortest forest of k trees. The k - 1 + r
// other edges of a network with r relays are shorter than the range, and with the forest and a way of at most the
// tolerance from each worker to its target they join the targets: L <= forest + (k - 1 + r) C + T tolerance.
int fewest_relays_certain(const std::vector<Vec2>& targets, double tolerance_m, double range_m) {
  struct Pair {
    double length;
    std::size_t a, b;
  };
  std::vector<Pair> near;
  for (std::size_t a = 0; a < targets.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (const double d = distance(targets[a], targets[b]); d + 2.0 * tolerance_m < range_m) near.push_back({d, a, b});
  std::sort(near.begin(), near.end(), [](const Pair& p, const Pair& q) { return p.length < q.length; });
  std::vector<std::size_t> tree(targets.size());
  std::iota(tree.begin(), tree.end(), std::size_t{0});
  std::size_t trees = targets.size();
  double forest = 0.0;
  for (const Pair& pair : near) {
    const std::size_t from = tree[pair.a], to = tree[pair.b];
    if (from == to) continue;
    std::replace(tree.begin(), tree.end(), from, to);
    forest += pair.length;
    --trees;
  }
  const double slack = static_cast<double>(targets.size()) * tolerance_m;
  const double length = steiner_length(targets).lower_m - slack - forest;
  return static_cast<int>(std::ceil(length / range_m - 1e-9)) - (static_cast<int>(trees) - 1);
}

// From each target the next one that takes fewest relays, until the robots are used up.
int grown_within(const std::vector<Vec2>& targets, int robots) {
  const std::size_t n = targets.size();
  int most = 0;
  for (std::size_t first = 0; first < n; ++first) {
    std::vector<int> gap(n, std::numeric_limits<int>::max());
    std::vector<char> done(n, 0);
    int workers = 0, relays = 0;
    for (std::size_t next = first; next < n;) {
      done[next] = 1;
      ++workers;
      relays += next == first ? 0 : gap[next];
      if (workers + std::max(1, relays) <= robots) most = std::max(most, workers);
      std::size_t best = n;
      for (std::size_t i = 0; i < n; ++i) {
        if (done[i]) continue;
        gap[i] = std::min(gap[i], relays_between(targets[i], targets[next]));
        if (best == n || gap[i] < gap[best]) best = i;
      }
      next = best;
    }
  }
  return most;
}

}  // namespace

std::uint32_t robots_bound(const std::vector<Vec2>& targets, double tolerance_m, double range_m) {
  if (targets.empty()) return 1;
  const int relays = std::max(1, fewest_relays_certain(targets, tolerance_m, range_m));
  return static_cast<std::uint32_t>(targets.size()) + static_cast<std::uint32_t>(relays);
}

RelayTree fewest_relays(const std::vector<Vec2>& targets, double range_m) {
  if (targets.size() < 2) return {{}, {}, true};
  std::vector<Vec2> scaled;
  scaled.reserve(targets.size());
  for (const Vec2 t : targets) scaled.push_back(t / range_m);
  const bool few = targets.size() <= most_programmed;
  Laid laid(targets, range_m);
  bool all_tried = false;
  if (few) {
    const Program program(scaled);
    for (const JoinedTargets& part : program.parts()) laid.add(part);
    all_tried = targets.size() <= static_cast<std::size_t>(most_leaves) && program.complete();
  } else {
    for (const JoinedTargets& part : Greedy(scaled).parts()) laid.add(part);
  }
  const int relays = static_cast<int>(laid.tree.relays.size());
  laid.tree.exact = all_tried || relays == 0 || (few && relays <= fewest_relays_certain(scaled, 0.0, 1.0));
  return std::move(laid.tree);
}

std::uint32_t most_targets(const std::vector<Vec2>& targets, double range_m, std::uint32_t robots) {
  if (targets.empty()) return 0;
  std::vector<Vec2> scaled;
  scaled.reserve(targets.size());
  for (const Vec2 t : targets) scaled.push_back(t / range_m);
  const int have = static_cast<int>(std::min<std::uint32_t>(robots, std::numeric_limits<int>::max()));
  const bool few = targets.size() <= most_programmed;
  return static_cast<std::uint32_t>(few ? Program(scaled).largest_within(have) : grown_within(scaled, have));
}

}  // namespace banyan::measure
