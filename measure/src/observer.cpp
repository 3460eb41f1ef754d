// SPDX-License-Identifier: MIT
#include "banyan/measure/observer.hpp"

#include <algorithm>
#include <cmath>

#include "banyan/measure/fiedler.hpp"
#include "banyan/measure/steiner.hpp"

namespace banyan::measure {
namespace {

constexpr double low_fiedler = 1e-3;        // paper Sec. IV-B
constexpr std::size_t every_tick_limit = 150;  // robots up to which lambda_2 is judged at every tick
constexpr double sample_period_s = 2.0;     // above that

// Communication graph of the living robots, which are numbered anew without gaps.
class LivingGraph {
 public:
  void build(const world::World& world, bool with_blocked) {
    const std::size_t n = world.size();
    const auto alive = world.alive();
    const bool all_alive = std::find(alive.begin(), alive.end(), std::uint8_t{0}) == alive.end();
    if (!all_alive) number(alive);
    if (with_blocked) collect_blocked(world);
    graph.offsets.assign(1, 0);
    graph.neighbors.clear();
    for (std::size_t i = 0; i < n; ++i) {
      if (alive[i] == 0) continue;
      const auto links = world.links(i);
      graph.neighbors.insert(graph.neighbors.end(), links.begin(), links.end());
      if (with_blocked) graph.neighbors.insert(graph.neighbors.end(), blocked_[i].begin(), blocked_[i].end());
      graph.offsets.push_back(static_cast<std::uint32_t>(graph.neighbors.size()));
    }
    if (!all_alive)
      for (std::uint32_t& j : graph.neighbors) j = number_[j];
  }
  Graph graph;

 private:
  void number(std::span<const std::uint8_t> alive) {
    number_.resize(alive.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < alive.size(); ++i) number_[i] = alive[i] != 0 ? next++ : 0;
  }

  void collect_blocked(const world::World& world) {
    blocked_.resize(world.size());
    for (auto& row : blocked_) row.clear();
    for (const auto& [i, j] : world.blocked()) {
      blocked_[i].push_back(j);
      blocked_[j].push_back(i);
    }
  }
  std::vector<std::uint32_t> number_;
  std::vector<std::vector<std::uint32_t>> blocked_;
};

// lambda_2 of one graph over a run: components at every tick, the threshold as often as it pays.
struct Spectrum {
  Fiedler fiedler;
  bool low = false;
  std::uint32_t components = 0;

  void judge(const Graph& graph, bool sample) {
    const Fiedler::Components found = fiedler.components(graph);
    components = found.count;
    if (found.count > 1) {
      low = true;
      return;
    }
    // lambda_2 >= 4 / (n diameter) (Mohar 1991), and diameter <= 2 eccentricity.
    const double bound = 4.0 / (static_cast<double>(graph.size()) * 2.0 * std::max(1.0, static_cast<double>(found.eccentricity)));
    if (bound >= low_fiedler) low = false;
    else if (sample) low = fiedler.below(graph, low_fiedler);
  }
};

}  // namespace

// Reads what the robots broadcast, not what they remember: the same, but 64 bytes apart instead of
// 8 KB, which in large swarms is the difference between a pass and a cache miss per robot.
struct Observer::Impl {
  explicit Impl(const world::World& world);
  void count_robots(const world::World& world);
  void count_edges(const world::World& world);
  void judge_graph(const world::World& world, bool exact_fiedler);
  void measure_targets(const world::World& world);
  void time_phases(const world::World& world);
  void add_up();

  Tick tick;
  Run run;
  double range_m;
  double tolerance_m;
  bool stop_when_complete;
  std::uint64_t sample_ticks;
  LivingGraph graph;
  Spectrum with_occlusion, by_distance;
  std::uint64_t committed_sum = 0, low_ticks = 0, low_ticks_by_distance = 0;
  std::uint64_t start_ticks = 0, select_ticks = 0;
};

Observer::Impl::Impl(const world::World& world)
    : range_m(world.scenario().radio.range_m),
      tolerance_m(world.scenario().mission.target_tolerance_m),
      stop_when_complete(world.scenario().mission.stop_when_complete),
      sample_ticks(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(sample_period_s / world.scenario().tick_s + 0.5))) {
  run.robots = static_cast<std::uint32_t>(world.size());
  run.time_limit_s = world::time_limit_s(world.scenario());
  std::vector<world::Vec2> targets;
  for (const world::Target& target : world.targets()) {
    targets.push_back(target.position);
    const double distance_m = distance(world.positions()[target.worker], target.position);
    run.time_bound_s = std::max(run.time_bound_s, (distance_m - tolerance_m) / world.scenario().robot.wheel_limit_m_s);
  }
  run.steiner_length_m = steiner_length(targets).lower_m;
  run.robots_bound = robots_bound(targets, tolerance_m, range_m);
}

void Observer::Impl::count_robots(const world::World& world) {
  const auto alive = world.alive();
  const auto messages = world.messages();
  std::array<std::uint32_t, 4> by_role{};
  for (std::size_t i = 0; i < messages.size(); ++i)
    if (alive[i] != 0) ++by_role[static_cast<std::size_t>(messages[i].role)];
  tick.spares = by_role[0];
  tick.connectors = by_role[1];
  tick.workers = by_role[2];
  tick.roots = by_role[3];
  tick.alive = by_role[0] + by_role[1] + by_role[2] + by_role[3];
  tick.committed = tick.alive - tick.spares;
}

void Observer::Impl::count_edges(const world::World& world) {
  const auto alive = world.alive();
  const auto messages = world.messages();
  const auto positions = world.positions();
  const auto count = [&](std::size_t i, RobotId other) {
    if (other == nobody || other >= messages.size()) return;
    ++tick.edges;
    if (alive[other] == 0) {
      ++tick.broken_by_death;
    } else if (squared_norm(positions[i] - positions[other]) >= range_m * range_m) {
      ++tick.broken_by_distance;
    } else if (world.scenario().radio.line_of_sight) {
      const auto links = world.links(i);
      if (!std::binary_search(links.begin(), links.end(), std::uint32_t{other})) ++tick.broken_by_occlusion;
    }
  };
  tick.edges = tick.broken_by_death = tick.broken_by_distance = tick.broken_by_occlusion = 0;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const Message& m = messages[i];
    if (alive[i] == 0 || m.role == Role::spare) continue;
    count(i, m.parent);
    if (m.old_parent != m.parent) count(i, m.old_parent);
  }
}

void Observer::Impl::judge_graph(const world::World& world, bool exact_fiedler) {
  const bool sample = tick.alive <= every_tick_limit || world.tick() % sample_ticks == 1;
  graph.build(world, false);
  with_occlusion.judge(graph.graph, sample);
  tick.components = with_occlusion.components;
  tick.fiedler_low = with_occlusion.low;
  tick.fiedler = exact_fiedler ? with_occlusion.fiedler.value(graph.graph) : -1.0;
  // More edges never lower lambda_2, nor do they split a graph.
  if (world.blocked().empty() || (tick.components == 1 && !tick.fiedler_low)) {
    tick.components_by_distance = tick.components;
    tick.fiedler_low_by_distance = tick.fiedler_low;
    return;
  }
  graph.build(world, true);
  by_distance.judge(graph.graph, sample);
  tick.components_by_distance = by_distance.components;
  tick.fiedler_low_by_distance = by_distance.low;
}

void Observer::Impl::measure_targets(const world::World& world) {
  tick.worst_target_distance_m = 0.0;
  tick.targets_reached = 0;
  for (const world::Target& target : world.targets()) {
    const double distance_m = distance(world.positions()[target.worker], target.position);
    tick.worst_target_distance_m = std::max(tick.worst_target_distance_m, distance_m);
    if (world.alive()[target.worker] != 0 && distance_m <= tolerance_m) ++tick.targets_reached;
  }
  if (!run.complete && tick.targets_reached == world.targets().size()) {
    run.complete = true;
    run.completion_time_s = tick.time_s;
    run.normalized_time = tick.time_s / run.time_limit_s;
  }
}

// Barrier lengths as the root lives them; the newest token decides who that is.
void Observer::Impl::time_phases(const world::World& world) {
  const auto alive = world.alive();
  const Message* root = nullptr;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Message& m = world.messages()[i];
    if (alive[i] != 0 && m.role == Role::root && (root == nullptr || newer(m.root, root->root))) root = &m;
  }
  if (root == nullptr) return;
  run.epochs = std::max<std::uint64_t>(run.epochs, root->epoch);
  if (root->phase == Phase::start_tree) ++start_ticks;
  if (root->phase == Phase::select_parent) ++select_ticks;
}

void Observer::Impl::add_up() {
  ++run.ticks;
  run.time_s = tick.time_s;
  run.committed = tick.committed;
  committed_sum += tick.committed;
  const bool broken = tick.broken_by_distance + tick.broken_by_occlusion + tick.broken_by_death > 0;
  run.broken_ticks += broken ? 1 : 0;
  run.broken_ticks_by_distance += tick.broken_by_distance > 0 ? 1 : 0;
  run.broken_ticks_by_occlusion += tick.broken_by_occlusion > 0 ? 1 : 0;
  run.broken_ticks_by_death += tick.broken_by_death > 0 ? 1 : 0;
  run.split_ticks += tick.components > 1 ? 1 : 0;
  run.split_ticks_by_distance += tick.components_by_distance > 1 ? 1 : 0;
  low_ticks += tick.fiedler_low ? 1 : 0;
  low_ticks_by_distance += tick.fiedler_low_by_distance ? 1 : 0;
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
  impl_->add_up();
  return impl_->tick;
}

const Tick& Observer::last() const noexcept { return impl_->tick; }
const Run& Observer::run() const noexcept { return impl_->run; }

bool Observer::finished() const noexcept {
  const Run& run = impl_->run;
  return (run.complete && impl_->stop_when_complete) || run.time_s >= run.time_limit_s - 1e-9;
}

Run Observer::result(const world::World& world) const {
  Run run = impl_->run;
  const double ticks = std::max(1.0, static_cast<double>(run.ticks));
  run.mean_committed = static_cast<double>(impl_->committed_sum) / ticks;
  run.disconnected_time_ratio = static_cast<double>(run.broken_ticks) / ticks;
  run.disconnected_time_ratio_by_distance = static_cast<double>(run.broken_ticks_by_distance) / ticks;
  run.disconnected_time_ratio_by_occlusion = static_cast<double>(run.broken_ticks_by_occlusion) / ticks;
  run.fiedler_time_ratio = static_cast<double>(impl_->low_ticks) / ticks;
  run.fiedler_time_ratio_by_distance = static_cast<double>(impl_->low_ticks_by_distance) / ticks;
  const double epochs = std::max(1.0, static_cast<double>(run.epochs));
  run.start_phase_ticks = static_cast<double>(impl_->start_ticks) / epochs;
  run.select_phase_ticks = static_cast<double>(impl_->select_ticks) / epochs;
  run.insertions = run.handovers = run.repairs = 0;
  for (const State& s : world.states()) {
    run.insertions += s.tally.insertions;
    run.handovers += s.tally.handovers;
    run.repairs += s.tally.repairs;
  }
  if (run.time_s > 0.0)
    run.bytes_per_robot_s = static_cast<double>(world.packets_sent() * wire_size) / (static_cast<double>(world.size()) * run.time_s);
  run.hash = world.hash();
  return run;
}

}  // namespace banyan::measure
