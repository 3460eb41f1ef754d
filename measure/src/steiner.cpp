// SPDX-License-Identifier: MIT
// Euclidean Steiner trees by Smith's (1992) branch and bound: full topologies grow by one terminal
// at a time, and the shortest tree of a partial topology bounds all that grow from it, because
// taking a terminal out of a tree never makes it longer. Which terminal is next is decided for each
// topology (after Fampa & Anstreicher 2008). The shortest tree of a topology is the solution of a
// convex problem, sum of |edge|; it is solved by Newton's method on sqrt(|edge|^2 + e^2) for
// falling e. Every bound is the value of a feasible point of the dual problem (a flow of unit
// vectors), so nothing is cut off by rounding or by stopping early.
#include "banyan/measure/steiner.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace banyan::measure {
namespace {

using world::Vec2;

constexpr std::size_t exact_limit = 12;
constexpr int most_looks = 150'000;       // topologies relaxed before a search gives up: some seconds
constexpr double steiner_ratio = 0.8241;  // Chung & Graham 1985
constexpr double tolerance = 2e-7;        // relative; what is not better by this is skipped

double spanning_tree_length(const std::vector<Vec2>& points) {
  std::vector<double> gap(points.size(), std::numeric_limits<double>::infinity());
  std::vector<char> done(points.size(), 0);
  double length = 0.0;
  std::size_t last = 0;
  for (std::size_t step = 1; step < points.size(); ++step) {
    done[last] = 1;
    std::size_t next = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (done[i]) continue;
      gap[i] = std::min(gap[i], distance(points[last], points[i]));
      if (next == points.size() || gap[i] < gap[next]) next = i;
    }
    length += gap[next];
    last = next;
  }
  return length;
}

// At most `most` points far from each other: the farthest from the centre, then always the one
// farthest from those before. Partial trees are long early that way, and bounds strong.
std::vector<Vec2> far_apart(std::vector<Vec2> points, std::size_t most) {
  Vec2 center{};
  for (const Vec2 p : points) center += p / static_cast<double>(points.size());
  std::vector<double> gap(points.size());
  for (std::size_t i = 0; i < gap.size(); ++i) gap[i] = distance(center, points[i]);
  for (std::size_t k = 0; k < std::min(most, points.size()); ++k) {
    const auto far = static_cast<std::size_t>(
        std::max_element(gap.begin() + static_cast<std::ptrdiff_t>(k), gap.end()) - gap.begin());
    std::swap(points[k], points[far]);
    std::swap(gap[k], gap[far]);
    for (std::size_t i = k + 1; i < gap.size(); ++i) {
      const double d = distance(points[k], points[i]);
      gap[i] = k == 0 ? d : std::min(gap[i], d);
    }
  }
  points.resize(std::min(most, points.size()));
  return points;
}

// A full topology over `terminals` of the points, 0 and 1 among them: node k < exact_limit is
// terminal k, node exact_limit + s is Steiner point s, which has three edges.
struct Tree {
  struct Edge {
    int a, b;
  };
  int terminals = 0;
  int edge_count = 0;
  std::array<Edge, 2 * exact_limit - 3> edges{};
  std::array<Vec2, 2 * exact_limit> at{};  // by node

  [[nodiscard]] int steiner_points() const noexcept { return terminals - 2; }
};
constexpr int first_steiner = static_cast<int>(exact_limit);
constexpr bool is_steiner(int node) noexcept { return node >= first_steiner; }

// The topology with a further terminal tied to edge `k` by a new Steiner point.
Tree grown(const Tree& tree, int terminal, int k) noexcept {
  Tree next = tree;
  ++next.terminals;
  const int middle = first_steiner + tree.steiner_points();
  const Tree::Edge split = tree.edges[k];
  next.edges[k] = {split.a, middle};
  next.edges[next.edge_count++] = {split.b, middle};
  next.edges[next.edge_count++] = {terminal, middle};
  next.at[middle] = (tree.at[split.a] + tree.at[split.b] + tree.at[terminal]) / 3.0;
  return next;
}

double length(const Tree& tree) noexcept {
  double sum = 0.0;
  for (int k = 0; k < tree.edge_count; ++k) sum += distance(tree.at[tree.edges[k].a], tree.at[tree.edges[k].b]);
  return sum;
}

// d / sqrt(|d|^2 + e^2): the unit vector along d, but smooth and short where d is short.
Vec2 softened_unit(Vec2 d, double e) noexcept { return d / std::sqrt(squared_norm(d) + e * e); }

// A lower bound on the length of every tree of this topology. For vectors y with |y| <= 1 on the
// edges (child to parent, seen from terminal 0) that add up at each Steiner point,
// sum |edge| >= sum y . edge = sum over terminals of y . (terminal 0 - terminal), whatever the
// Steiner points. The y of terminal edges come from the tree at hand, the others add up.
class DualBound {
 public:
  DualBound(const Tree& tree, double e) noexcept : tree_{tree}, e_{e} {
    for (int k = 0; k < tree.edge_count; ++k) {
      add_neighbor(tree.edges[k].a, tree.edges[k].b);
      add_neighbor(tree.edges[k].b, tree.edges[k].a);
    }
  }
  [[nodiscard]] double value() noexcept {
    flow(neighbors_[0][0], 0);
    return sum_ / largest_;
  }

 private:
  void add_neighbor(int a, int b) noexcept { neighbors_[a][degree_[a]++] = b; }
  Vec2 flow(int node, int parent) noexcept {
    Vec2 y{};
    if (is_steiner(node)) {
      for (const int next : neighbors_[node])
        if (next != parent) y += flow(next, node);
    } else {
      y = softened_unit(tree_.at[parent] - tree_.at[node], e_);
      sum_ += dot(y, tree_.at[0] - tree_.at[node]);
    }
    largest_ = std::max(largest_, norm(y));
    return y;
  }

  const Tree& tree_;
  double e_;
  std::array<std::array<int, 3>, 2 * exact_limit> neighbors_{};
  std::array<int, 2 * exact_limit> degree_{};
  double sum_ = 0.0;
  double largest_ = 1.0;
};

// Newton's method on the softened length, one instance per search (keeps its matrices).
class Relaxation {
 public:
  // Up to `most` steps, fewer once the forces on the Steiner points balance within `balance`.
  void run(Tree& tree, double e, double balance, int most) {
    for (int step = 0; step < most; ++step) {
      assemble(tree, e);
      if (gradient_.lpNorm<Eigen::Infinity>() < balance) return;
      step_ = hessian_.ldlt().solve(gradient_);
      if (!step_.allFinite() || !search(tree, e)) return;
    }
  }

 private:
  static constexpr int most_unknowns = 2 * (static_cast<int>(exact_limit) - 2);
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_unknowns, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_unknowns, most_unknowns>;

  static double softened_length(const Tree& tree, double e) noexcept {
    double sum = 0.0;
    for (int k = 0; k < tree.edge_count; ++k)
      sum += std::sqrt(squared_norm(tree.at[tree.edges[k].b] - tree.at[tree.edges[k].a]) + e * e);
    return sum;
  }

  void assemble(const Tree& tree, double e) {
    const Eigen::Index unknowns = Eigen::Index{2} * tree.steiner_points();
    gradient_.setZero(unknowns);
    hessian_.setZero(unknowns, unknowns);
    for (int k = 0; k < tree.edge_count; ++k) {
      const auto [a, b] = tree.edges[k];
      const Vec2 d = tree.at[a] - tree.at[b];
      const double r = std::sqrt(squared_norm(d) + e * e);
      const Vec2 u = d / r;
      Eigen::Matrix2d curvature;  // (1 - u u') / r
      curvature << (1.0 - u.x * u.x) / r, -u.x * u.y / r, -u.x * u.y / r, (1.0 - u.y * u.y) / r;
      if (is_steiner(a)) add(a, u, curvature);
      if (is_steiner(b)) add(b, -u, curvature);
      if (!is_steiner(a) || !is_steiner(b)) continue;
      hessian_.block<2, 2>(row(a), row(b)) -= curvature;
      hessian_.block<2, 2>(row(b), row(a)) -= curvature;
    }
  }
  static Eigen::Index row(int node) noexcept { return Eigen::Index{2} * (node - first_steiner); }
  void add(int node, Vec2 u, const Eigen::Matrix2d& curvature) {
    gradient_(row(node)) += u.x;
    gradient_(row(node) + 1) += u.y;
    hessian_.block<2, 2>(row(node), row(node)) += curvature;
  }

  // Halves the step until it gains enough; false if no step does.
  bool search(Tree& tree, double e) {
    const Tree start = tree;
    const double before = softened_length(start, e);
    const double slope = gradient_.dot(step_);
    double share = 1.0;
    for (int halvings = 0; halvings < 20; ++halvings, share *= 0.5) {
      for (int node = first_steiner; node < first_steiner + tree.steiner_points(); ++node)
        tree.at[node] = start.at[node] - share * Vec2{step_(row(node)), step_(row(node) + 1)};
      if (softened_length(tree, e) <= before - 1e-4 * share * slope) return true;
    }
    tree = start;
    return false;
  }

  Vector gradient_, step_;
  Matrix hessian_;
};

// A partial topology and what is known of the terminals still missing: `open[t]` has a bit for
// every edge to which terminal t may yet be tied. What is hopeless for a topology is hopeless for
// all that grow from it: an edge that is split hands its bit to its three parts, since with the
// terminal that split it taken out again they are the edge they were.
struct SearchNode {
  Tree tree;
  std::array<std::uint32_t, exact_limit> open{};
};
static_assert(2 * exact_limit - 3 <= 32, "a bit for every edge");

class SteinerSearch {
 public:
  // 3 to exact_limit distinct terminals.
  explicit SteinerSearch(std::vector<Vec2> terminals)
      : terminals_{std::move(terminals)}, best_{spanning_tree_length(terminals_)}, certain_{best_} {
    for (const Vec2 a : terminals_)
      for (const Vec2 b : terminals_) scale_ = std::max(scale_, distance(a, b));
  }

  SteinerLength run() {
    SearchNode start;
    std::copy(terminals_.begin(), terminals_.end(), start.tree.at.begin());
    start.tree.terminals = 2;
    start.tree.edge_count = 1;
    start.tree.edges[0] = {0, 1};
    for (std::size_t t = 2; t < terminals_.size(); ++t) start.open[t] = 1;
    grow(start);
    const double lower = std::min(certain_, best_ * (1.0 - tolerance));
    return {lower, best_, lower >= best_ * (1.0 - 1e-6)};
  }

 private:
  struct Branch {
    double bound;
    int edge;
    Tree tree;
  };

  [[nodiscard]] bool hopeless(double bound) const noexcept { return bound >= best_ * (1.0 - tolerance); }

  // Of the missing terminals the one that promises the least work is tied first. One without a
  // place rules the whole topology out.
  void grow(SearchNode node) {
    double least = std::numeric_limits<double>::infinity();
    int chosen = 0;
    std::vector<Branch> branches;
    for (int t = 2; t < static_cast<int>(terminals_.size()); ++t) {
      if (node.open[t] == 0) continue;
      std::vector<Branch> found = places(node, t);
      if (found.empty()) return;
      const double work = work_in(found, length(node.tree));
      if (work >= least) continue;
      least = work;
      chosen = t;
      branches = std::move(found);
    }
    std::sort(branches.begin(), branches.end(), [](const Branch& a, const Branch& b) { return a.bound < b.bound; });
    for (const Branch& branch : branches) {
      if (hopeless(branch.bound)) return;  // so are those after it
      if (looks_ < most_looks) grow(with(node, chosen, branch));
      else certain_ = std::min(certain_, branch.bound);
    }
  }

  // Every way to tie the terminal to the topology that may still lead to a shorter tree.
  std::vector<Branch> places(SearchNode& node, int terminal) {
    std::vector<Branch> found;
    for (int k = 0; k < node.tree.edge_count; ++k) {
      if ((node.open[terminal] >> k & 1U) == 0) continue;
      Branch branch{0.0, k, grown(node.tree, terminal, k)};
      branch.bound = relax(branch.tree);
      if (hopeless(branch.bound)) node.open[terminal] &= ~(1U << k);
      else found.push_back(branch);
    }
    return found;
  }

  // The work below a branch shrinks fast as its bound rises from that of the topology it grows
  // from to the length of the best tree.
  [[nodiscard]] double work_in(const std::vector<Branch>& branches, double before) const noexcept {
    const double room = std::max(best_ - before, tolerance * best_);
    double work = 0.0;
    for (const Branch& branch : branches) {
      const double left = std::clamp((best_ - branch.bound) / room, 0.0, 1.0);
      work += left * left * left * left;
    }
    return work;
  }

  static SearchNode with(const SearchNode& node, int terminal, const Branch& branch) noexcept {
    SearchNode next{branch.tree, node.open};
    for (std::uint32_t& edges : next.open)
      if ((edges >> branch.edge & 1U) != 0) edges |= 3U << node.tree.edge_count;  // the two new edges
    next.open[terminal] = 0;
    return next;
  }

  // A lower bound for the topology, only as tight as needed to decide whether it is above the best tree
  // or, for unfinished topologies, cannot be. A finished one that is better becomes the best tree.
  double relax(Tree& tree) {
    ++looks_;
    const bool finished = tree.terminals == static_cast<int>(terminals_.size());
    double bound = 0.0;
    double e = 0.1;
    for (int digits = 1; digits <= 8; ++digits, e *= 0.1) {
      relaxation_.run(tree, e * scale_, 0.1 * e, 20);
      bound = std::max(bound, DualBound(tree, e * scale_).value());
      if (hopeless(bound)) return bound;
      const double reached = length(tree);
      if (!finished && digits > 1 && !hopeless(reached)) return bound;
      if (finished) best_ = std::min(best_, reached);
    }
    if (finished) certain_ = std::min(certain_, bound);
    return bound;
  }

  std::vector<Vec2> terminals_;
  Relaxation relaxation_;
  double scale_ = 0.0;
  double best_;     // length of the shortest tree found
  double certain_;  // smallest bound of a topology that was looked at to the end, or given up
  int looks_ = 0;
};

}  // namespace

SteinerLength steiner_length(const std::vector<Vec2>& terminals) {
  std::vector<Vec2> distinct = terminals;
  const auto order = [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(distinct.begin(), distinct.end(), order);
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  const double spanning = spanning_tree_length(distinct);
  if (distinct.size() <= 2) return {spanning, spanning, true};
  SteinerLength best{steiner_ratio * spanning, spanning, false};
  // Where a search gives up, a search among fewer terminals may still bound better than the ratio.
  const std::size_t first = std::min(distinct.size(), exact_limit);
  for (std::size_t most = first; most > 2 && most + 4 >= first; most -= 2) {
    const SteinerLength found = SteinerSearch(far_apart(distinct, most)).run();
    best.lower_m = std::max(best.lower_m, found.lower_m);
    if (most == distinct.size()) best.upper_m = found.upper_m;
    if (found.exact) break;
  }
  best.exact = best.lower_m >= best.upper_m * (1.0 - 1e-6);
  return best;
}

double star_length(const std::vector<Vec2>& terminals) {
  if (terminals.size() < 2) return 0.0;
  const auto length_from = [&](Vec2 hub) {
    return std::accumulate(terminals.begin(), terminals.end(), 0.0,
                           [&](double sum, Vec2 t) { return sum + distance(t, hub); });
  };
  Vec2 hub;
  for (const Vec2 t : terminals) hub += t / static_cast<double>(terminals.size());
  // It creeps where the median is a terminal: those are tried themselves.
  double best = length_from(hub);
  for (const Vec2 t : terminals) best = std::min(best, length_from(t));
  constexpr int rounds = 2000;
  const double still_m = 1e-9 * best;
  for (int round = 0; round < rounds; ++round) {
    Vec2 sum;
    double weight = 0.0;
    for (const Vec2 t : terminals) {
      const double d = std::max(distance(t, hub), 1e-12 * best);
      sum += t / d;
      weight += 1.0 / d;
    }
    const Vec2 next = sum / weight;
    const double moved_m = distance(next, hub);
    hub = next;
    if (!(moved_m > still_m)) break;
  }
  return std::min(best, length_from(hub));
}

}  // namespace banyan::measure
