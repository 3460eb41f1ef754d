// SPDX-License-Identifier: MIT
#include "banyan/measure/held_targets.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "banyan/measure/metrics.hpp"
#include "tree_view.hpp"

namespace banyan::measure {
namespace {

constexpr Column<HeldTargets::Row> held_targets_table[] = {
    ratio<&HeldTargets::Row::held_time_ratio>(
        "held_time_ratio", "from completion on, mean share of the targets that are held; empty if never complete",
        "share of targets held once complete"),
    ratio<&HeldTargets::Row::unheld_time_ratio_by_death>(
        "unheld_time_ratio_by_death",
        "of the rest, the part from a worker's death at its target until it is held again; empty if never complete",
        "share of targets not held by workers' deaths"),
    ratio<&HeldTargets::Row::held_ratio>("held_ratio", "share of the active targets that are held at the end"),
    column<&HeldTargets::Row::held_targets>("held_targets",
                                            "active targets held at the end by a worker that the tree joins to a root"),
    column<&HeldTargets::Row::missed_targets>("missed_targets",
                                              "the other active targets, by index, each with the reason"),
    {"visited_places", "places of visits.positions_m at which a robot has been; empty without such places", 0,
     [](const HeldTargets::Row& row) {
       return row.visited_places < 0 ? Cell{} : Cell{static_cast<std::uint64_t>(row.visited_places)};
     },
     "visited places"},
    quantity<&HeldTargets::Row::visited_s>("visited_s", "when robots had been at all of them; empty if never",
                                           "all places visited after (s)"),
    column<&HeldTargets::Row::lost_holders>("lost_holders", "workers that died at their targets",
                                            "workers that died at their targets"),
    quantity<&HeldTargets::Row::held_again_s>(
        "held_again_s",
        "from then until such a target was held again, median; empty if none was lost or half never were",
        "target held again after (s, median)"),
};

std::string metres(double m) {
  std::array<char, 32> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), "%.2f m", m));  // always fits
  return text.data();
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

// "": held by a worker that the tree joins to a root.
std::string why_not_held(const world::World& world, const world::Target& target, double tolerance_m) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Report& m = world.reports()[i];
    if (m.role != Role::worker || world.alive()[i] == 0 || m.serves != target.worker) continue;
    const double distance_m = distance(world.positions()[i], target.position);
    nearest_m = std::min(nearest_m, distance_m);
    if (distance_m <= tolerance_m && is_joined_to_root(world, i)) return "";
  }
  return std::isinf(nearest_m) ? "given up" : nearest_m <= tolerance_m ? "cut off" : metres(nearest_m) + " short";
}

}  // namespace

std::span<const Column<HeldTargets::Row>> HeldTargets::columns() noexcept { return held_targets_table; }

HeldTargets::HeldTargets(const world::World& start, Row& /*row*/)
    : tolerance_m_(world::target_tolerance_m(start.scenario())), takeovers_(start.scenario().tick_s) {}

void HeldTargets::observe(const Moment& now, Row& row) {
  takeovers_.observe(now.holders, now.world.targets(), now.world.alive());
  row.held_ratio = now.tick.held_share();
  if (now.tick.visits > 0) {
    row.visited_places = now.tick.visited;
    if (row.visited_s < 0.0 && now.tick.visited == now.tick.visits) row.visited_s = now.tick.time_s;
  }
  if (!now.run.complete) return;
  ++ticks_;
  held_sum_ += row.held_ratio;
  if (now.tick.active_targets > 0)
    waiting_by_death_ += static_cast<double>(takeovers_.waiting()) / static_cast<double>(now.tick.active_targets);
}

void HeldTargets::sum_up(const Moment& end, Row& row) const {
  if (ticks_ > 0) {
    row.held_time_ratio = held_sum_ / static_cast<double>(ticks_);
    row.unheld_time_ratio_by_death = waiting_by_death_ / static_cast<double>(ticks_);
  }
  row.lost_holders = takeovers_.lost();
  row.held_again_s = takeovers_.median_s();
  const auto targets = end.world.targets();
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (!targets[t].active || targets[t].visit) continue;
    const std::string why = why_not_held(end.world, targets[t], tolerance_m_);
    if (why.empty()) ++row.held_targets;
    else row.missed_targets += (row.missed_targets.empty() ? "" : ", ") + std::to_string(t) + " " + why;
  }
}

}  // namespace banyan::measure
