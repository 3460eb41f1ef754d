// SPDX-License-Identifier: MIT
#include "banyan/measure/tallies.hpp"

#include "banyan/measure/metrics.hpp"

namespace banyan::measure {
namespace {

constexpr Column<Tallies::Row> tallies_table[] = {
    column<&Tallies::Row::insertions>("insertions", "spares inserted into edges"),
    column<&Tallies::Row::handovers>("handovers", "times the root role was handed over"),
    column<&Tallies::Row::repairs>("repairs", "lost parents replaced and orphans re-attached"),
    column<&Tallies::Row::elections>("elections", "times a robot made itself root because the root had fallen silent"),
    column<&Tallies::Row::replacements>("replacements", "times a robot took over the target of a silent worker"),
    quantity<&Tallies::Row::bytes_per_robot_s>("bytes_per_robot_s", "broadcast", "bytes per robot and second"),
    column<&Tallies::Row::messages>("messages", "broadcast by all robots"),
};

}  // namespace

std::span<const Column<Tallies::Row>> Tallies::columns() noexcept { return tallies_table; }

void Tallies::sum_up(const Moment& end, Row& row) {
  row = {};
  const auto reports = end.world.reports();
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const auto& tally = reports[i].tally;
    row.insertions += tally.insertions;
    row.handovers += tally.handovers;
    row.repairs += tally.repairs;
    row.elections += tally.elections;
    row.replacements += tally.replacements;
    if (tally.rejected == 0) continue;
    row.rejected += tally.rejected;
    row.rejected_by += (row.rejected_by.empty() ? "" : ", ") + std::to_string(i);
  }
  row.messages = end.world.packets_sent();
  const double robot_s = static_cast<double>(end.world.arrived()) * end.run.time_s;
  if (robot_s > 0.0)
    row.bytes_per_robot_s = static_cast<double>(row.messages * end.world.swarm().message_bytes()) / robot_s;
}

}  // namespace banyan::measure
