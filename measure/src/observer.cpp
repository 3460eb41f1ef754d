// SPDX-License-Identifier: MIT
#include "banyan/measure/observer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <utility>
#include <vector>

#include "banyan/measure/bottleneck.hpp"
#include "banyan/measure/effort.hpp"
#include "banyan/measure/fiedler.hpp"
#include "banyan/measure/lasting.hpp"
#include "banyan/measure/overlaps.hpp"
#include "banyan/measure/recovery.hpp"
#include "banyan/measure/redundancy.hpp"
#include "banyan/measure/redundancy_bound.hpp"
#include "banyan/measure/relays.hpp"
#include "banyan/measure/silence.hpp"
#include "banyan/measure/steiner.hpp"
#include "banyan/measure/takeovers.hpp"
#include "banyan/world/tree_parts.hpp"

namespace banyan::measure {
namespace {

constexpr double low_fiedler = 1e-3;           // paper Sec. IV-B
constexpr std::size_t every_tick_limit = 150;  // robots up to which lambda_2 is judged at every tick
constexpr double sample_period_drives = 0.2;   // above that

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

// For each robot a number at least as large as its hops from the first living one. As long as every other robot
// has a link to one with a smaller number, all are connected.
class HopCount {
 public:
  // As they have just been counted.
  void renew(const world::World& world, std::span<const std::uint32_t> hops_of_living) {
    hops_.assign(world.size(), 0);
    nearer_.assign(world.size(), 0);
    first_ = world.size();
    auto hops = hops_of_living.begin();
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (world.alive()[i] == 0) continue;
      first_ = std::min(first_, i);
      hops_[i] = *hops++;
    }
  }
  void forget() noexcept { hops_.clear(); }
  // Whether all robots are still connected; false if that is not certain. A robot that has lost its link to one with a
  // smaller number gets a larger one, and so may those that relied on it; if this spreads, counting again is cheaper.
  [[nodiscard]] bool holds(const world::World& world) {
    constexpr int most_rounds = 5;
    const auto alive = world.alive();
    if (hops_.empty() || alive[first_] == 0) return false;
    for (int round = 0; round < most_rounds; ++round) {
      bool raised = false;
      for (std::size_t i = 0; i < hops_.size(); ++i) {
        if (alive[i] == 0 || i == first_) continue;
        const auto links = world.links(i);
        if (has_nearer(links, i)) continue;
        if (links.empty()) return false;
        hops_[i] = hops_[links[nearer_[i]]] + 1;
        raised = true;
      }
      if (!raised) return true;
    }
    return false;
  }
  [[nodiscard]] std::uint32_t farthest() const { return *std::max_element(hops_.begin(), hops_.end()); }

 private:
  // If not, nearer_[i] is still the place of the nearest one. Usually it is where it was.
  [[nodiscard]] bool has_nearer(std::span<const std::uint32_t> links, std::size_t i) {
    if (nearer_[i] < links.size() && hops_[links[nearer_[i]]] < hops_[i]) return true;
    const auto nearer = std::min_element(links.begin(), links.end(),
                                         [&](std::uint32_t a, std::uint32_t b) { return hops_[a] < hops_[b]; });
    nearer_[i] = static_cast<std::uint32_t>(nearer - links.begin());
    return nearer != links.end() && hops_[*nearer] < hops_[i];
  }
  std::vector<std::uint32_t> hops_;    // by robot; empty: not connected
  std::vector<std::uint32_t> nearer_;  // by robot: place of a nearer robot in its row of links
  std::size_t first_ = 0;
};

// lambda_2 >= 4 / (n diameter) (Mohar 1991), and diameter <= 2 eccentricity.
bool is_high(std::size_t n, std::uint32_t eccentricity) {
  return 4.0 / (static_cast<double>(n) * 2.0 * std::max(1.0, static_cast<double>(eccentricity))) >= low_fiedler;
}

struct LambdaStopped : std::exception {};  // while lambda_2 was computed

// lambda_2 of one graph over a run: components at every tick, the threshold as often as it pays.
struct Spectrum {
  Fiedler fiedler;
  bool low = false;
  std::uint32_t components = 0;

  void judge(const Graph& graph, bool sample) {
    const Fiedler::Components found = fiedler.components(graph);
    components = found.count;
    if (found.count > 1) low = true;
    else if (is_high(graph.size(), found.eccentricity)) low = false;
    else if (sample) judge_value(graph);
  }
  // If it was stopped, the result stays what it was.
  void judge_value(const Graph& graph) {
    try {
      low = fiedler.below(graph, low_fiedler);
    } catch (const LambdaStopped&) {  // NOLINT(bugprone-empty-catch)
    }
  }
  [[nodiscard]] double value(const Graph& graph) {
    try {
      return fiedler.value(graph);
    } catch (const LambdaStopped&) { return -1.0; }
  }
  void stop_when(const std::function<bool()>& asked) {
    fiedler.on_pause([asked] {
      if (asked()) throw LambdaStopped{};
    });
  }
};

}  // namespace

struct Observer::Impl {
  explicit Impl(const world::World& world);
  void count_robots(const world::World& world);
  void count_edges(const world::World& world);
  void judge_graph(const world::World& world, bool exact_fiedler);
  void judge_links(const world::World& world, bool sample, bool exact_fiedler);
  void measure_targets(const world::World& world);
  void time_phases(const world::World& world);
  void add_up();
  void watch_recovery(const world::World& world);
  [[nodiscard]] bool finished() const noexcept;
  [[nodiscard]] bool survivors_suffice(const world::World& world) const;
  void ask_oracle();
  void sum_up_redundancy(const world::World& world, Run& result);
  void sum_up_targets(const world::World& world, Run& result) const;

  Tick tick;
  Run run;
  double range_m;
  double tolerance_m;
  bool stop_when_complete;
  double settle_s;
  double time_rounding_s;
  std::uint64_t sample_ticks;
  LivingGraph graph;
  world::TreeParts tree_parts;
  Spectrum with_occlusion, by_distance;
  HopCount hop_count;
  std::uint64_t ticks_since_complete = 0;
  std::uint32_t most_deploying = 0;                  // robots in the tree, in a tick up to completion
  double held_sum = 0.0, unheld_by_death_sum = 0.0;  // of the shares of the active targets, since complete
  std::uint64_t committed_sum = 0, low_ticks = 0, low_ticks_by_distance = 0;
  std::uint64_t start_ticks = 0, select_ticks = 0;
  Serial last_epoch = 0;  // of a root
  std::uint64_t two_roots_streak = 0, longest_two_roots = 0;
  std::vector<double> nearest_worker;      // by target: squared distance
  std::vector<RobotId> holders;            // by target: that worker if it holds the target
  std::vector<world::Vec2> first_targets;  // those the bounds are about
  std::vector<world::Vec2> first_others;   // where robots start that are not sent to a target
  double speed_m_s;
  bool oracle_asked = false;
  Effort effort;
  Overlaps overlaps;
  Lasting lasting;
  Recovery recovery;
  Takeovers takeovers;
  Silence silence;
  Redundancy redundancy;
  bool pending_kills;
};

namespace {

std::string metres(double m) {
  std::array<char, 32> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), "%.2f m", m));  // always fits
  return text.data();
}

std::vector<world::Vec2> active_positions(const world::World& world) {
  std::vector<world::Vec2> positions;
  for (const world::Target& target : world.targets())
    if (target.active) positions.push_back(target.position);
  return positions;
}

std::vector<world::Vec2> unsent_positions(const world::World& world) {
  std::vector<char> sent(world.size(), 0);
  for (const world::Target& target : world.targets()) sent[target.worker] = 1;
  std::vector<world::Vec2> positions;
  for (std::size_t i = 0; i < world.size(); ++i)
    if (sent[i] == 0) positions.push_back(world.positions()[i]);
  return positions;
}

bool is_of_tree(const world::World& world, std::size_t i) {
  return world.alive()[i] != 0 && world.reports()[i].role != Role::spare;
}

// The links that robot i keeps besides edges to parents, except those counted at the other end: that has i as its
// parent, or keeps the link, too, and has the smaller id.
template <class Visit> void for_each_kept_link(const world::World& world, std::size_t i, Visit visit) {
  const Report& mine = world.reports()[i];
  const auto me = static_cast<RobotId>(i);
  for (const RobotId other : mine.kept) {
    if (other == nobody) return;
    if (other == mine.parent || other == mine.old_parent) continue;
    if (other < world.size() && is_of_tree(world, other)) {
      const Report& theirs = world.reports()[other];
      if (theirs.parent == me || theirs.old_parent == me || (other < me && keeps(theirs, me))) continue;
    }
    visit(other);
  }
}

// Whether parents, in a reconstruction old ones, lead from robot i to a living root.
bool is_joined_to_root(const world::World& world, std::size_t i) {
  for (std::size_t steps = 0; i < world.size() && steps <= world.size(); ++steps) {
    if (!is_of_tree(world, i)) return false;
    const Report& m = world.reports()[i];
    if (m.role == Role::root) return true;
    i = up_of(m);
  }
  return false;
}

// Edges from the living robots of the tree to their living parents, in a reconstruction to the old ones, and the
// links that they keep.
double network_length_m(const world::World& world) {
  double length_m = 0.0;
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (!is_of_tree(world, i)) continue;
    const auto add = [&](RobotId other) {
      if (other < world.size() && world.alive()[other] != 0)
        length_m += distance(world.positions()[i], world.positions()[other]);
    };
    add(up_of(world.reports()[i]));
    for_each_kept_link(world, i, add);
  }
  return length_m;
}

}  // namespace

Observer::Impl::Impl(const world::World& world)
    : range_m(world.scenario().radio.range_m),
      tolerance_m(world::target_tolerance_m(world.scenario())),
      stop_when_complete(world.scenario().mission.stop_when_complete),
      settle_s(world.scenario().mission.settle_s),
      time_rounding_s(world::time_rounding_s(world.scenario())),
      sample_ticks(std::max<std::uint64_t>(
          1, static_cast<std::uint64_t>(
                 sample_period_drives * world::drive_s(world.scenario()) / world.scenario().tick_s + 0.5))),
      tree_parts(world.size()),
      first_targets(active_positions(world)),
      first_others(unsent_positions(world)),
      speed_m_s(world.scenario().robot.wheel_limit_m_s),
      effort(world),
      overlaps(world),
      lasting(world),
      recovery(world.scenario().tick_s, world::drive_s(world.scenario()), stop_when_complete ? settle_s : 0.0),
      takeovers(world.scenario().tick_s),
      silence(liveness_period_s(world), world.scenario().tick_s),
      redundancy(world),
      pending_kills(world.pending_kills()) {
  run.liveness_period_s = liveness_period_s(world);
  run.robots = static_cast<std::uint32_t>(world.size());
  run.time_limit_s = world::time_limit_s(world.scenario());
  graph.build_both_ways(world);
  run.start_parts = with_occlusion.fiedler.components(graph.graph).count;
  for (const world::Target& target : world.targets()) {
    const double distance_m = distance(world.positions()[target.worker], target.position);
    run.time_bound_s = std::max(run.time_bound_s, (distance_m - tolerance_m) / speed_m_s);
  }
  run.steiner_length_m = steiner_length(first_targets).lower_m;
  run.star_length_m = star_length(first_targets);
  run.robots_bound = robots_bound(first_targets, tolerance_m, range_m);
  run.link_redundancy = redundancy.wanted();
  const RedundancyBound bound = redundancy.wanted() > 1
                                    ? redundancy_bound(first_targets, tolerance_m, range_m, redundancy.wanted())
                                    : RedundancyBound{run.robots_bound, false};
  run.redundancy_bound = bound.robots;
  run.redundancy_exact = bound.exact;
}

void Observer::Impl::count_robots(const world::World& world) {
  const auto alive = world.alive();
  const auto reports = world.reports();
  std::array<std::uint32_t, 4> by_role{};
  for (std::size_t i = 0; i < reports.size(); ++i)
    if (alive[i] != 0) ++by_role[static_cast<std::size_t>(reports[i].role)];
  tick.spares = by_role[0];
  tick.connectors = by_role[1];
  tick.workers = by_role[2];
  tick.roots = by_role[3];
  tick.alive = by_role[0] + by_role[1] + by_role[2] + by_role[3];
  tick.committed = tick.alive - tick.spares;
}

void Observer::Impl::count_edges(const world::World& world) {
  const auto alive = world.alive();
  const auto reports = world.reports();
  const auto positions = world.positions();
  // The count of the reason why two robots do not hear each other; null if they do.
  const auto broken_by = [&](std::size_t i, RobotId other) -> std::uint32_t* {
    if (alive[other] == 0) return &tick.broken_by_death;
    if (squared_norm(positions[i] - positions[other]) >= range_m * range_m) return &tick.broken_by_distance;
    if (!world.line_of_sight()) return nullptr;
    const auto links = world.links(i);
    return std::binary_search(links.begin(), links.end(), std::uint32_t{other}) ? nullptr : &tick.broken_by_occlusion;
  };
  const auto count = [&](std::size_t i, RobotId other) {
    if (other == nobody || other >= reports.size()) return;
    ++tick.edges;
    std::uint32_t* const broken = broken_by(i, other);
    if (broken == nullptr) return;
    ++*broken;
    if (silence.is_long(static_cast<RobotId>(i), other)) ++tick.broken_after_silence;
  };
  tick.edges = tick.broken_by_death = tick.broken_by_distance = tick.broken_by_occlusion = 0;
  tick.broken_after_silence = 0;
  silence.next_tick();
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Report& m = reports[i];
    if (alive[i] == 0 || m.role == Role::spare) continue;
    count(i, m.parent);
    if (m.old_parent != m.parent) count(i, m.old_parent);
    for_each_kept_link(world, i, [&](RobotId other) { count(i, other); });
  }
}

void Observer::Impl::judge_graph(const world::World& world, bool exact_fiedler) {
  const bool sample = tick.alive <= every_tick_limit || world.tick() % sample_ticks == 1;
  judge_links(world, sample, exact_fiedler);
  tick.components = with_occlusion.components;
  tick.tree_parts = tree_parts.count(world.alive(), world.reports(), [&](std::size_t i) { return world.links(i); });
  tick.fiedler_low = with_occlusion.low;
  tick.fiedler = exact_fiedler ? with_occlusion.value(graph.graph) : -1.0;
  // More edges never lower lambda_2, nor do they split a graph.
  tick.components_by_distance = tick.components;
  tick.fiedler_low_by_distance = tick.fiedler_low;
  if (tick.components == 1 && !tick.fiedler_low) return;
  const auto blocked = world.blocked();
  if (blocked.empty()) return;
  graph.build_by_distance(world, blocked);
  by_distance.judge(graph.graph, sample);
  tick.components_by_distance = by_distance.components;
  tick.fiedler_low_by_distance = by_distance.low;
}

// The graph itself is examined only if what is known of it does not decide the question.
void Observer::Impl::judge_links(const world::World& world, bool sample, bool exact_fiedler) {
  if (!exact_fiedler && hop_count.holds(world)) {
    Spectrum& spectrum = with_occlusion;
    spectrum.components = 1;
    const bool high = (sample || spectrum.low) && is_high(tick.alive, hop_count.farthest());
    if (high) spectrum.low = false;
    if (high || !(sample || spectrum.low)) return;
  }
  graph.build(world);
  with_occlusion.judge(graph.graph, sample);
  if (with_occlusion.components == 1) hop_count.renew(world, with_occlusion.fiedler.hops());
  else hop_count.forget();
}

// One pass over the robots for all targets, where World::holder takes one for each.
void Observer::Impl::measure_targets(const world::World& world) {
  const auto targets = world.targets();
  nearest_worker.assign(targets.size(), std::numeric_limits<double>::infinity());
  holders.assign(targets.size(), nobody);
  const auto alive = world.alive();
  const auto reports = world.reports();
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Report& m = reports[i];
    if (m.role != Role::worker || alive[i] == 0) continue;
    for (std::size_t t = 0; t < targets.size(); ++t) {
      if (m.serves != targets[t].worker) continue;
      const double away = squared_norm(world.positions()[i] - targets[t].position);
      if (away >= nearest_worker[t]) continue;
      nearest_worker[t] = away;
      if (std::sqrt(away) <= tolerance_m) holders[t] = static_cast<RobotId>(i);
    }
  }
  tick.worst_target_distance_m = 0.0;
  tick.targets_reached = tick.active_targets = 0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (!targets[t].active) continue;
    ++tick.active_targets;
    const double distance_m = std::sqrt(nearest_worker[t]);
    if (distance_m <= tolerance_m) ++tick.targets_reached;
    const double first_m = distance(world.positions()[targets[t].worker], targets[t].position);
    const double counted_m = std::isfinite(distance_m) ? distance_m : first_m;
    tick.worst_target_distance_m = std::max(tick.worst_target_distance_m, counted_m);
  }
  takeovers.observe(holders, targets, alive);
  // A run that heals on after its limit is no longer in time.
  if (run.complete || !tick.complete() || tick.time_s > run.time_limit_s + time_rounding_s) return;
  run.complete = true;
  run.completion_time_s = tick.time_s;
  run.normalized_time = tick.time_s / run.time_limit_s;
}

// Barrier lengths as seen by the root; the newest token decides which robot that is.
void Observer::Impl::time_phases(const world::World& world) {
  const auto alive = world.alive();
  const auto reports = world.reports();
  const Report* root = nullptr;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Report& m = reports[i];
    if (alive[i] != 0 && m.role == Role::root && (root == nullptr || has_newer_root(m, *root))) root = &m;
  }
  if (root == nullptr) return;
  if (const int further = ahead_by(root->epoch, last_epoch); further > 0) {
    run.epochs += static_cast<std::uint64_t>(further);
    last_epoch = root->epoch;
  }
  if (root->phase == Phase::start_tree) ++start_ticks;
  if (root->phase == Phase::select_parent) ++select_ticks;
}

void Observer::Impl::add_up() {
  ++run.ticks;
  run.time_s = tick.time_s;
  if (tick.least_charge >= 0.0)
    run.least_charge = run.least_charge < 0.0 ? tick.least_charge : std::min(run.least_charge, tick.least_charge);
  run.mean_charge = tick.mean_charge;
  run.committed = tick.committed;
  committed_sum += tick.committed;
  if (ticks_since_complete == 0) most_deploying = std::max(most_deploying, tick.committed);
  const bool broken = tick.broken_by_distance + tick.broken_by_occlusion + tick.broken_by_death > 0;
  run.broken_ticks += broken ? 1 : 0;
  run.broken_ticks_by_distance += tick.broken_by_distance > 0 ? 1 : 0;
  run.broken_ticks_by_occlusion += tick.broken_by_occlusion > 0 ? 1 : 0;
  run.broken_ticks_by_death += tick.broken_by_death > 0 ? 1 : 0;
  run.broken_ticks_after_silence += tick.broken_after_silence > 0 ? 1 : 0;
  run.split_ticks += tick.components > 1 ? 1 : 0;
  run.split_ticks_by_distance += tick.components_by_distance > 1 ? 1 : 0;
  low_ticks += tick.fiedler_low ? 1 : 0;
  low_ticks_by_distance += tick.fiedler_low_by_distance ? 1 : 0;
  run.held_ratio = tick.active_targets > 0
                       ? static_cast<double>(tick.targets_reached) / static_cast<double>(tick.active_targets)
                       : 1.0;
  if (run.complete) {
    ++ticks_since_complete;
    held_sum += run.held_ratio;
    if (tick.active_targets > 0)
      unheld_by_death_sum += static_cast<double>(takeovers.waiting()) / static_cast<double>(tick.active_targets);
  }
  two_roots_streak = tick.roots > 1 ? two_roots_streak + 1 : 0;
  run.two_roots_ticks += tick.roots > 1 ? 1 : 0;
  longest_two_roots = std::max(longest_two_roots, two_roots_streak);
}

void Observer::Impl::watch_recovery(const world::World& world) {
  recovery.observe(world.deaths(), tick.components == 1 && tick.roots == 1 && tick.all_held());
  pending_kills = world.pending_kills();
  run.deaths = static_cast<std::uint32_t>(world.deaths());
  run.survivors = tick.alive;
  if (const auto last = world.last_death_tick())
    run.last_death_s = static_cast<double>(*last) * world.scenario().tick_s;
  run.recovered = recovery.recovered();
  run.recovery_time_s = recovery.time_s();
}

// Without deaths: complete, or the limit. With deaths, those of a complete run are all waited for,
// since every moment of the mission has come; those of a run that is not complete at its limit may
// wait for a moment that never comes.
bool Observer::Impl::finished() const noexcept {
  const bool limit_reached = run.time_s >= run.time_limit_s - time_rounding_s;
  if (!stop_when_complete) return limit_reached;
  if (!run.complete) return limit_reached && recovery.settled();
  return run.time_s >= run.completion_time_s + settle_s - time_rounding_s && !pending_kills && recovery.settled();
}

bool Observer::Impl::survivors_suffice(const world::World& world) const {
  const std::vector<world::Vec2> targets = active_positions(world);
  return run.survivors >= (targets == first_targets ? run.robots_bound : robots_bound(targets, tolerance_m, range_m));
}

// The fewest robots, and the least time in which all workers and, from the nearest starts, relays can be at their
// places. Asked once, at the end, since no tick needs it. It takes milliseconds with few targets and some seconds with
// a thousand; with more it is not asked. Without any relay a root is needed beside the workers, which has no place of
// its own.
void Observer::Impl::ask_oracle() {
  constexpr double edge_share = 0.95;
  constexpr std::size_t most = 1'000;
  if (std::exchange(oracle_asked, true) || first_targets.size() > most) return;
  const RelayTree tree = fewest_relays(first_targets, edge_share * range_m);
  const std::size_t relays = std::max<std::size_t>(1, tree.relays.size());
  run.oracle_robots = static_cast<std::uint32_t>(first_targets.size() + relays);
  run.oracle_exact = tree.exact;
  run.oracle_targets = run.robots >= run.oracle_robots ? static_cast<std::uint32_t>(first_targets.size())
                                                       : most_targets(first_targets, edge_share * range_m, run.robots);
  if (first_others.size() < relays) return;
  const double longest_m = bottleneck_m(first_others, tree.relays);
  if (longest_m >= 0.0) run.oracle_time_s = std::max(run.time_bound_s, longest_m / speed_m_s);
}

void Observer::Impl::sum_up_redundancy(const world::World& world, Run& result) {
  result.companions = count_companions(world);
  result.redundancy_ratio =
      static_cast<double>(result.committed + result.companions) / static_cast<double>(result.redundancy_bound);
  if (redundancy.wanted() <= 1) return;
  result.redundant_time_ratio = redundancy.time_ratio();
  result.severed_ticks = redundancy.severed_ticks();
  result.restored_s = redundancy.restored_s();
  const auto targets = world.targets();
  const std::vector<std::uint32_t> paths = redundancy.paths_of_targets(world);
  auto of_target = paths.begin();
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (!targets[t].active) continue;
    if (*of_target++ >= redundancy.wanted()) ++result.redundant_targets;
    else result.single_targets += (result.single_targets.empty() ? "" : " ") + std::to_string(t);
  }
}

// Which active targets are held, and why the others are not.
void Observer::Impl::sum_up_targets(const world::World& world, Run& result) const {
  const auto targets = world.targets();
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (!targets[t].active) continue;
    double nearest_m = std::numeric_limits<double>::infinity();
    bool held = false;
    for (std::size_t i = 0; i < world.size(); ++i) {
      const Report& m = world.reports()[i];
      if (m.role != Role::worker || world.alive()[i] == 0 || m.serves != targets[t].worker) continue;
      const double distance_m = distance(world.positions()[i], targets[t].position);
      nearest_m = std::min(nearest_m, distance_m);
      held = held || (distance_m <= tolerance_m && is_joined_to_root(world, i));
    }
    if (held) {
      ++result.held_targets;
      continue;
    }
    const std::string why = std::isinf(nearest_m)      ? "given up"
                            : nearest_m <= tolerance_m ? "cut off"
                                                       : metres(nearest_m) + " short";
    result.missed_targets += (result.missed_targets.empty() ? "" : ", ") + std::to_string(t) + " " + why;
  }
}

Observer::Observer(const world::World& world) : impl_(std::make_unique<Impl>(world)) {}
Observer::Observer(Observer&&) noexcept = default;
Observer& Observer::operator=(Observer&&) noexcept = default;
Observer::~Observer() = default;

const Tick& Observer::observe(const world::World& world, bool exact_fiedler) {
  impl_->tick.tick = world.tick();
  impl_->tick.time_s = world.time_s();
  impl_->count_robots(world);
  impl_->count_edges(world);
  impl_->judge_graph(world, exact_fiedler);
  impl_->measure_targets(world);
  impl_->time_phases(world);
  impl_->effort.observe(world);
  impl_->overlaps.observe(world);
  impl_->lasting.observe(world);
  impl_->tick.least_charge = impl_->lasting.least_charge();
  impl_->tick.mean_charge = impl_->lasting.mean_charge();
  impl_->add_up();
  impl_->watch_recovery(world);
  impl_->redundancy.observe(world, impl_->run.completion_time_s);
  impl_->tick.disjoint_paths = impl_->redundancy.paths();
  return impl_->tick;
}

void Observer::stop_when(const std::function<bool()>& asked) {
  impl_->with_occlusion.stop_when(asked);
  impl_->by_distance.stop_when(asked);
}

const Tick& Observer::last() const noexcept { return impl_->tick; }
const Run& Observer::run() const noexcept { return impl_->run; }

bool Observer::finished() const noexcept { return impl_->finished(); }

Run Observer::result(const world::World& world) const {
  impl_->ask_oracle();
  Run run = impl_->run;
  const double ticks = std::max(1.0, static_cast<double>(run.ticks));
  run.mean_committed = static_cast<double>(impl_->committed_sum) / ticks;
  run.disconnected_time_ratio = static_cast<double>(run.broken_ticks) / ticks;
  run.disconnected_time_ratio_by_distance = static_cast<double>(run.broken_ticks_by_distance) / ticks;
  run.disconnected_time_ratio_by_occlusion = static_cast<double>(run.broken_ticks_by_occlusion) / ticks;
  run.disconnected_time_ratio_after_silence = static_cast<double>(run.broken_ticks_after_silence) / ticks;
  run.fiedler_time_ratio = static_cast<double>(impl_->low_ticks) / ticks;
  run.fiedler_time_ratio_by_distance = static_cast<double>(impl_->low_ticks_by_distance) / ticks;
  const double epochs = std::max(1.0, static_cast<double>(run.epochs));
  run.start_phase_ticks = static_cast<double>(impl_->start_ticks) / epochs;
  run.select_phase_ticks = static_cast<double>(impl_->select_ticks) / epochs;
  run.insertions = run.handovers = run.repairs = run.elections = run.replacements = 0;
  const auto reports = world.reports();
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Report& s = reports[i];
    run.insertions += s.tally.insertions;
    run.handovers += s.tally.handovers;
    run.repairs += s.tally.repairs;
    run.elections += s.tally.elections;
    run.replacements += s.tally.replacements;
    if (s.tally.rejected == 0) continue;
    run.rejected += s.tally.rejected;
    run.rejected_by += (run.rejected_by.empty() ? "" : ", ") + std::to_string(i);
  }
  run.messages = world.packets_sent();
  if (run.time_s > 0.0)
    run.bytes_per_robot_s = static_cast<double>(run.messages * world.swarm().message_bytes()) /
                            (static_cast<double>(world.size()) * run.time_s);
  run.decisions = impl_->effort.decisions();
  run.overlap_ticks = impl_->overlaps.ticks();
  run.swaps = impl_->lasting.swaps();
  run.broken_swaps = impl_->lasting.broken_swaps();
  run.trips = impl_->lasting.trips();
  run.trips_arrived = impl_->lasting.trips_arrived();
  run.emptied = static_cast<std::uint32_t>(world.emptied());
  run.lasts_s = impl_->lasting.lasts_s(world, run.mean_committed);
  run.driven_m = impl_->effort.driven_m() / static_cast<double>(world.size());
  if (impl_->ticks_since_complete > 0) {
    const double since_complete = static_cast<double>(impl_->ticks_since_complete);
    run.held_time_ratio = impl_->held_sum / since_complete;
    run.unheld_time_ratio_by_death = impl_->unheld_by_death_sum / since_complete;
  }
  if (run.complete && run.time_bound_s > 0.0) run.time_ratio = run.completion_time_s / run.time_bound_s;
  run.committed_ratio = static_cast<double>(run.committed) / static_cast<double>(run.robots_bound);
  run.deployment_ratio = static_cast<double>(impl_->most_deploying) / static_cast<double>(run.robots_bound);
  if (run.oracle_robots > 0)
    run.oracle_ratio = static_cast<double>(run.committed) / static_cast<double>(run.oracle_robots);
  run.lost_holders = impl_->takeovers.lost();
  run.held_again_s = impl_->takeovers.median_s();
  impl_->sum_up_redundancy(world, run);
  impl_->sum_up_targets(world, run);
  run.network_length_m = network_length_m(world);
  run.longest_two_roots_s = static_cast<double>(impl_->longest_two_roots) * world.scenario().tick_s;
  run.survivors_suffice = impl_->survivors_suffice(world);
  run.hash = world.hash();
  return run;
}

Tick at_start(const world::World& world, bool exact_fiedler) { return Observer(world).observe(world, exact_fiedler); }

bool is_plotted(const world::World& world) noexcept {
  constexpr std::size_t most_robots = 1000;
  const world::Scenario& scenario = world.scenario();
  const double period_s = 0.1 * world::drive_s(scenario);
  const auto period = [&](std::uint64_t tick) {
    return std::floor((static_cast<double>(tick) * scenario.tick_s + world::time_rounding_s(scenario)) / period_s);
  };
  return world.size() <= most_robots && (world.tick() == 0 || period(world.tick()) > period(world.tick() - 1));
}

}  // namespace banyan::measure
