// SPDX-License-Identifier: MIT
#include "banyan/measure/redundancy.hpp"

#include <algorithm>
#include <limits>

#include "banyan/measure/metrics.hpp"

namespace banyan::measure {
namespace {

constexpr Column<Redundancy::Row> redundancy_table[] = {
    column<&Redundancy::Row::link_redundancy>("link_redundancy", "mission.link_redundancy, k"),
    column<&Redundancy::Row::companions>("companions", "spares that stand beside a robot of the tree at the end"),
    ratio<&Redundancy::Row::redundant_time_ratio>(
        "redundant_time_ratio",
        "from a drive (C / v_max) after completion on, share of ticks with k disjoint paths; empty if k is 1",
        "time with k disjoint paths (share)"),
    column<&Redundancy::Row::severed_ticks>("severed_ticks",
                                            "of these, with living workers or the root cut off from each other"),
    quantity<&Redundancy::Row::restored_s>(
        "restored_s", "from the last death until there were k disjoint paths; empty if there never were"),
    column<&Redundancy::Row::redundant_targets>(
        "redundant_targets", "active targets with k disjoint paths to the root at the end; 0 if k is 1"),
};

constexpr std::uint32_t not_there = UINT32_MAX;
constexpr double settling_drives = 1.0;  // after completion

bool is_companion(const Report& report) noexcept { return report.role == Role::spare && report.kept[0] != nobody; }
bool is_of_network(const world::World& world, std::size_t i) noexcept {
  return world.alive()[i] != 0 && (world.reports()[i].role != Role::spare || is_companion(world.reports()[i]));
}

}  // namespace

std::uint32_t count_companions(const world::World& world) noexcept {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < world.size(); ++i)
    if (world.alive()[i] != 0 && is_companion(world.reports()[i])) ++count;
  return count;
}

std::span<const Column<Redundancy::Row>> Redundancy::columns() noexcept { return redundancy_table; }

Redundancy::Redundancy(const world::World& start, Row& row) : Redundancy(start) { row.link_redundancy = wanted_; }

void Redundancy::observe(const Moment& now, Row& /*row*/) {
  observe(now.world, now.run.completion_time_s);
  now.tick.disjoint_paths = paths_;
}

void Redundancy::sum_up(const Moment& end, Row& row) {
  row.companions = count_companions(end.world);
  if (wanted_ <= 1) return;
  row.redundant_time_ratio = time_ratio();
  row.severed_ticks = severed_;
  row.restored_s = restored_s_;
  const auto targets = end.world.targets();
  const std::vector<std::uint32_t> paths = paths_of_targets(end.world);
  auto of_target = paths.begin();
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (!targets[t].active) continue;
    if (*of_target++ >= wanted_) ++row.redundant_targets;
    else row.single_targets += (row.single_targets.empty() ? "" : " ") + std::to_string(t);
  }
}

Redundancy::Redundancy(const world::World& start)
    : wanted_(static_cast<std::uint32_t>(start.scenario().mission.link_redundancy)),
      drive_s_(world::drive_s(start.scenario())) {}

void Redundancy::build(const world::World& world) {
  const auto targets = world.targets();
  number_.assign(world.size(), not_there);
  nearest_.assign(targets.size(), std::numeric_limits<double>::infinity());
  of_target_.assign(targets.size(), not_there);
  std::uint32_t size = 0;
  std::size_t root = world.size();
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (!is_of_network(world, i)) continue;
    number_[i] = size++;
    const Report& report = world.reports()[i];
    if (report.role == Role::root && (root == world.size() || has_newer_root(report, world.reports()[root]))) root = i;
    for (std::size_t t = 0; report.role == Role::worker && t < targets.size(); ++t) {
      const double d = squared_norm(world.positions()[i] - targets[t].position);
      if (!targets[t].active || report.serves != targets[t].worker || d >= nearest_[t]) continue;
      nearest_[t] = d;
      of_target_[t] = number_[i];
    }
  }
  graph_.offsets.assign(1, 0);
  graph_.neighbors.clear();
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (number_[i] == not_there) continue;
    for (const std::uint32_t j : world.links(i))
      if (number_[j] != not_there) graph_.neighbors.push_back(number_[j]);
    graph_.offsets.push_back(static_cast<std::uint32_t>(graph_.neighbors.size()));
  }
  terminals_.clear();
  for (const std::uint32_t worker : of_target_)
    if (worker != not_there) terminals_.push_back(worker);
  has_root_ = root != world.size();
  if (has_root_) terminals_.push_back(number_[root]);
}

void Redundancy::observe(const world::World& world, double completion_s) {
  if (wanted_ <= 1) return;
  build(world);
  paths_ = search_.among(graph_, terminals_, wanted_);
  const double tick_s = world.scenario().tick_s;
  if (completion_s >= 0.0 && world.time_s() > completion_s + settling_drives * drive_s_ - 0.5 * tick_s) {
    ++counted_;
    redundant_ += paths_ >= wanted_ ? 1 : 0;
    severed_ += paths_ == 0 ? 1 : 0;
  }
  if (world.deaths() != deaths_) restored_s_ = -1.0;
  deaths_ = world.deaths();
  if (const auto last = world.last_death_tick(); last && restored_s_ < 0.0 && paths_ >= wanted_)
    restored_s_ = world.time_s() - tick_s * static_cast<double>(*last + 1);
}

double Redundancy::time_ratio() const noexcept {
  return counted_ == 0 ? -1.0 : static_cast<double>(redundant_) / static_cast<double>(counted_);
}

std::vector<std::uint32_t> Redundancy::paths_of_targets(const world::World& world) {
  build(world);
  std::vector<std::uint32_t> paths;
  for (std::size_t t = 0; t < of_target_.size(); ++t) {
    if (!world.targets()[t].active) continue;
    const bool joined = has_root_ && of_target_[t] != not_there;
    paths.push_back(joined ? search_.between(graph_, of_target_[t], terminals_.back(), wanted_) : 0);
  }
  return paths;
}

}  // namespace banyan::measure
