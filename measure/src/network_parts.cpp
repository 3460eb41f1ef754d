// SPDX-License-Identifier: MIT
#include "banyan/measure/network_parts.hpp"

#include <algorithm>

#include "banyan/measure/fiedler.hpp"
#include "banyan/measure/metrics.hpp"
#include "living_graph.hpp"

namespace banyan::measure {
namespace {

constexpr Column<NetworkParts::Row> network_parts_table[] = {
    column<&NetworkParts::Row::start_parts>(
        "start_parts", "into which the robots fall at the start, over links of which both ends hear each other",
        "parts of the network at the start"),
    column<&NetworkParts::Row::split_ticks>("split_ticks", "ticks with several radio components",
                                            "ticks with a split network"),
    column<&NetworkParts::Row::split_ticks_by_distance>("split_ticks_by_distance", "the same without occlusion",
                                                        "ticks with a split network, occlusion aside"),
    ratio<&NetworkParts::Row::fiedler_time_ratio>("fiedler_time_ratio", "share of ticks with lambda_2 < 1e-3",
                                                  "share of time with λ₂ < 0.001"),
    ratio<&NetworkParts::Row::fiedler_time_ratio_by_distance>("fiedler_time_ratio_by_distance",
                                                              "the same without occlusion",
                                                              "share of time with λ₂ < 0.001, occlusion aside"),
};

}  // namespace

std::span<const Column<NetworkParts::Row>> NetworkParts::columns() noexcept { return network_parts_table; }

NetworkParts::NetworkParts(const world::World& start, Row& row) {
  LivingGraph both_ways;
  both_ways.build_both_ways(start);
  row.start_parts = Fiedler{}.components(both_ways.graph).count;
}

void NetworkParts::observe(const Moment& now, Row& row) {
  const Tick& tick = now.tick;
  row.split_ticks += tick.components > 1 ? 1 : 0;
  row.split_ticks_by_distance += tick.components_by_distance > 1 ? 1 : 0;
  low_ticks_ += tick.fiedler_low ? 1 : 0;
  low_ticks_by_distance_ += tick.fiedler_low_by_distance ? 1 : 0;
}

void NetworkParts::sum_up(const Moment& end, Row& row) const {
  const double ticks = std::max(1.0, static_cast<double>(end.run.ticks));
  row.fiedler_time_ratio = static_cast<double>(low_ticks_) / ticks;
  row.fiedler_time_ratio_by_distance = static_cast<double>(low_ticks_by_distance_) / ticks;
}

}  // namespace banyan::measure
