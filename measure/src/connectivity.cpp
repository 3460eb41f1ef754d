// SPDX-License-Identifier: MIT
#include "banyan/measure/connectivity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "banyan/measure/metrics.hpp"

namespace banyan::measure {
namespace {

constexpr std::uint32_t unreached = std::numeric_limits<std::uint32_t>::max();

template <auto field> Cell if_measured(const Connectivity::Row& row) {
  if (row.connected_time_ratio < 0.0) return {};
  if constexpr (std::same_as<std::remove_cvref_t<decltype(row.*field)>, std::int64_t>)
    return static_cast<std::uint64_t>(row.*field);
  else return cell_of<field>(row);
}

constexpr Column<Connectivity::Row> connectivity_table[] = {
    ratio<&Connectivity::Row::connected_time_ratio>(
        "connected_time_ratio",
        "share of the time in which data could flow between the nodes of every asked pair (mission.connect); empty, as "
        "the columns below, without stations or such pairs",
        "time connected (share)"),
    ratio<&Connectivity::Row::least_connected_time_ratio>("least_connected_time_ratio",
                                                          "the same of the pair that was connected for the least time",
                                                          "time connected, worst pair (share)"),
    {"least_connected", "that pair", 0, if_measured<&Connectivity::Row::least_connected>},
    {"disconnections", "how often an asked pair was cut off when all had been connected, or at the start", 0,
     if_measured<&Connectivity::Row::disconnections>, "disconnections"},
    quantity<&Connectivity::Row::longest_disconnection_s>(
        "longest_disconnection_s", "the longest time in which some pair was cut off", "longest disconnection (s)"),
    quantity<&Connectivity::Row::first_disconnection_s>(
        "first_disconnection_s", "when a pair was cut off first; empty if never", "first disconnection (s)"),
    quantity<&Connectivity::Row::last_disconnection_s>("last_disconnection_s",
                                                       "when a pair was cut off last; empty if never"),
    quantity<&Connectivity::Row::hops>("hops", "of the path of fewest hops between a pair that is connected, mean",
                                       "hops"),
    quantity<&Connectivity::Row::longest_hop_m>("longest_hop_m",
                                                "the longest link of that path, where several have as few hops the "
                                                "shortest such, mean",
                                                "longest hop (m)"),
};

}  // namespace

std::span<const Column<Connectivity::Row>> Connectivity::columns() noexcept { return connectivity_table; }

Connectivity::Connectivity(const world::World& start, Row& /*row*/) : tick_s_(start.scenario().tick_s) {
  const world::Scenario& scenario = start.scenario();
  const std::size_t targets = world::mission_targets(scenario).size();
  const auto& asked = scenario.mission.connect;
  if (asked.empty() && scenario.stations.empty()) return;
  for (std::size_t i = 0; i < start.size(); ++i)
    if (const world::Station* station = start.station(i)) nodes_.push_back({station->name, false, i});
  for (std::size_t t = 0; t < targets; ++t) nodes_.push_back({std::to_string(t), true, t});
  const auto find = [&](const std::string& name) {
    return static_cast<std::size_t>(
        std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& node) { return node.name == name; }) -
        nodes_.begin());
  };
  for (const auto& [a, b] : asked) pairs_.push_back({std::min(find(a), find(b)), std::max(find(a), find(b))});
  for (std::size_t a = 0; asked.empty() && a < nodes_.size(); ++a)
    for (std::size_t b = a + 1; b < nodes_.size(); ++b) pairs_.push_back({a, b});
  std::sort(pairs_.begin(), pairs_.end(),
            [](const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
}

// The robot that is this node now; none where nobody holds the target, or the station is dead.
std::size_t Connectivity::robot_at(const Node& node, const Moment& now) noexcept {
  const std::size_t robot = node.target ? now.holders[node.index] : node.index;
  return robot < now.world.size() && now.world.alive()[robot] != 0 ? robot : now.world.size();
}

// Breadth first, over links of which both ends hear each other.
void Connectivity::search(const world::World& world, std::size_t from) {
  hops_to_.assign(world.size(), unreached);
  longest2_to_.assign(world.size(), 0.0);
  queue_.assign(1, static_cast<std::uint32_t>(from));
  hops_to_[from] = 0;
  for (std::size_t next = 0; next < queue_.size(); ++next) {
    const std::uint32_t i = queue_[next];
    for (const std::uint32_t j : world.links(i)) {
      if (hops_to_[j] <= hops_to_[i] || world.is_deaf(i, j) || world.is_deaf(j, i)) continue;
      const double longest2 = std::max(longest2_to_[i], squared_norm(world.positions()[i] - world.positions()[j]));
      if (hops_to_[j] == unreached) {
        hops_to_[j] = hops_to_[i] + 1;
        longest2_to_[j] = longest2;
        queue_.push_back(j);
      } else {
        longest2_to_[j] = std::min(longest2_to_[j], longest2);
      }
    }
  }
}

void Connectivity::observe(const Moment& now, Row& row) {
  if (pairs_.empty()) return;
  ++ticks_;
  bool all = true;
  std::size_t from = now.world.size();
  for (Pair& pair : pairs_) {
    const std::size_t a = robot_at(nodes_[pair.a], now), b = robot_at(nodes_[pair.b], now);
    if (a < now.world.size() && a != from) search(now.world, from = a);
    if (a == now.world.size() || b == now.world.size() || hops_to_[b] == unreached) {
      all = false;
      continue;
    }
    ++pair.ticks;
    ++paths_;
    hops_ += hops_to_[b];
    longest_hops_m_ += std::sqrt(longest2_to_[b]);
  }
  row.disconnections = std::max<std::int64_t>(row.disconnections, 0);
  if (all) {
    ++connected_;
    apart_now_ = 0;
    return;
  }
  if (apart_now_++ == 0) {
    ++row.disconnections;
    if (row.first_disconnection_s < 0.0) row.first_disconnection_s = now.tick.time_s;
  }
  row.last_disconnection_s = now.tick.time_s;
  apart_longest_ = std::max(apart_longest_, apart_now_);
}

void Connectivity::sum_up(const Moment& /*end*/, Row& row) const {
  if (ticks_ == 0) return;
  const auto ticks = static_cast<double>(ticks_);
  const auto least =
      std::min_element(pairs_.begin(), pairs_.end(), [](const Pair& p, const Pair& q) { return p.ticks < q.ticks; });
  row.connected_time_ratio = static_cast<double>(connected_) / ticks;
  row.least_connected_time_ratio = static_cast<double>(least->ticks) / ticks;
  row.least_connected = nodes_[least->a].name + " " + nodes_[least->b].name;
  row.longest_disconnection_s = static_cast<double>(apart_longest_) * tick_s_;
  if (paths_ == 0) return;
  row.hops = hops_ / static_cast<double>(paths_);
  row.longest_hop_m = longest_hops_m_ / static_cast<double>(paths_);
}

}  // namespace banyan::measure
