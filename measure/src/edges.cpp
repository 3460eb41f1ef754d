// SPDX-License-Identifier: MIT
#include "banyan/measure/edges.hpp"

#include <algorithm>

#include "banyan/measure/metrics.hpp"
#include "banyan/measure/silence.hpp"

namespace banyan::measure {
namespace {

constexpr Column<Edges::Row> edges_table[] = {
    column<&Edges::Row::broken_ticks>("broken_ticks", "ticks with a broken tree edge", "ticks with a broken edge"),
    column<&Edges::Row::broken_ticks_by_distance>("broken_ticks_by_distance", "with an edge of C or longer",
                                                  "ticks with an edge too long"),
    column<&Edges::Row::broken_ticks_by_occlusion>(
        "broken_ticks_by_occlusion", "with an edge in range but without line of sight", "ticks with an occluded edge"),
    column<&Edges::Row::broken_ticks_by_death>("broken_ticks_by_death", "with an edge to a dead robot",
                                               "ticks with an edge to a dead robot"),
    ratio<&Edges::Row::disconnected_time_ratio>("disconnected_time_ratio", "broken_ticks / ticks",
                                                "share of time with a broken edge"),
    ratio<&Edges::Row::disconnected_time_ratio_by_distance>(
        "disconnected_time_ratio_by_distance", "the same by distance", "share of time with an edge too long"),
    ratio<&Edges::Row::disconnected_time_ratio_by_occlusion>(
        "disconnected_time_ratio_by_occlusion", "the same by occlusion", "share of time with an occluded edge"),
    quantity<&Edges::Row::liveness_period_s>("liveness_period_s", "I: a neighbour not heard for longer counts as gone"),
    column<&Edges::Row::broken_ticks_after_silence>(
        "broken_ticks_after_silence", "with an edge broken for longer than liveness_period_s without a break"),
    ratio<&Edges::Row::disconnected_time_ratio_after_silence>("disconnected_time_ratio_after_silence",
                                                              "broken_ticks_after_silence / ticks"),
};

}  // namespace

std::span<const Column<Edges::Row>> Edges::columns() noexcept { return edges_table; }

Edges::Edges(const world::World& start, Row& row) { row.liveness_period_s = liveness_period_s(start); }

void Edges::observe(const Moment& now, Row& row) {
  const Tick& tick = now.tick;
  const bool broken = tick.broken_by_distance + tick.broken_by_occlusion + tick.broken_by_death > 0;
  row.broken_ticks += broken ? 1 : 0;
  row.broken_ticks_by_distance += tick.broken_by_distance > 0 ? 1 : 0;
  row.broken_ticks_by_occlusion += tick.broken_by_occlusion > 0 ? 1 : 0;
  row.broken_ticks_by_death += tick.broken_by_death > 0 ? 1 : 0;
  row.broken_ticks_after_silence += tick.broken_after_silence > 0 ? 1 : 0;
}

void Edges::sum_up(const Moment& end, Row& row) {
  const double ticks = std::max(1.0, static_cast<double>(end.run.ticks));
  row.disconnected_time_ratio = static_cast<double>(row.broken_ticks) / ticks;
  row.disconnected_time_ratio_by_distance = static_cast<double>(row.broken_ticks_by_distance) / ticks;
  row.disconnected_time_ratio_by_occlusion = static_cast<double>(row.broken_ticks_by_occlusion) / ticks;
  row.disconnected_time_ratio_after_silence = static_cast<double>(row.broken_ticks_after_silence) / ticks;
}

}  // namespace banyan::measure
