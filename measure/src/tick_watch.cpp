// SPDX-License-Identifier: MIT
#include "tick_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tree_view.hpp"

namespace banyan::measure {
namespace {

void count_robots(const world::World& world, Tick& tick) {
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

}  // namespace

TickWatch::TickWatch(const world::World& start)
    : range_m_(start.scenario().radio.range_m),
      tolerance_m_(world::target_tolerance_m(start.scenario())),
      silence_(liveness_period_s(start), start.scenario().tick_s),
      tree_parts_(start.size()),
      graph_(start) {}

void TickWatch::look(const world::World& world, bool exact_fiedler, Tick& tick) {
  tick.tick = world.tick();
  tick.time_s = world.time_s();
  count_robots(world, tick);
  count_edges(world, tick);
  graph_.look(world, exact_fiedler, tick);
  tick.tree_parts = tree_parts_.count(world.alive(), world.reports(), [&](std::size_t i) { return world.links(i); });
  measure_targets(world, tick);
}

void TickWatch::count_edges(const world::World& world, Tick& tick) {
  const auto alive = world.alive();
  const auto reports = world.reports();
  const auto positions = world.positions();
  // The count of the reason why two robots do not hear each other; null if they do.
  const auto broken_by = [&](std::size_t i, RobotId other) -> std::uint32_t* {
    if (alive[other] == 0) return &tick.broken_by_death;
    if (squared_norm(positions[i] - positions[other]) >= range_m_ * range_m_) return &tick.broken_by_distance;
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
    if (silence_.is_long(static_cast<RobotId>(i), other)) ++tick.broken_after_silence;
  };
  tick.edges = tick.broken_by_death = tick.broken_by_distance = tick.broken_by_occlusion = 0;
  tick.broken_after_silence = 0;
  silence_.next_tick();
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Report& m = reports[i];
    if (alive[i] == 0 || m.role == Role::spare) continue;
    count(i, m.parent);
    if (m.old_parent != m.parent) count(i, m.old_parent);
    for_each_kept_link(world, i, [&](RobotId other) { count(i, other); });
  }
}

// One pass over the robots for all targets, where World::holder takes one for each.
void TickWatch::measure_targets(const world::World& world, Tick& tick) {
  const auto targets = world.targets();
  nearest_worker_.assign(targets.size(), std::numeric_limits<double>::infinity());
  holders_.assign(targets.size(), nobody);
  const auto alive = world.alive();
  const auto reports = world.reports();
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Report& m = reports[i];
    if (m.role != Role::worker || alive[i] == 0) continue;
    for (std::size_t t = 0; t < targets.size(); ++t) {
      if (m.serves != targets[t].worker) continue;
      const double away = squared_norm(world.positions()[i] - targets[t].position);
      if (away >= nearest_worker_[t]) continue;
      nearest_worker_[t] = away;
      if (std::sqrt(away) <= tolerance_m_) holders_[t] = static_cast<RobotId>(i);
    }
  }
  if (world.scenario().visits.positions)
    tick.visits = static_cast<std::uint32_t>(world.scenario().visits.positions->size());
  tick.visited = static_cast<std::uint32_t>(world.visited());
  tick.worst_target_distance_m = 0.0;
  tick.targets_reached = tick.active_targets = 0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (!targets[t].active || targets[t].visit) continue;
    ++tick.active_targets;
    const double distance_m = std::sqrt(nearest_worker_[t]);
    if (distance_m <= tolerance_m_) ++tick.targets_reached;
    const double first_m = distance(world.positions()[targets[t].worker], targets[t].position);
    const double counted_m = std::isfinite(distance_m) ? distance_m : first_m;
    tick.worst_target_distance_m = std::max(tick.worst_target_distance_m, counted_m);
  }
}

}  // namespace banyan::measure
