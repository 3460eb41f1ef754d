// SPDX-License-Identifier: MIT
#include "banyan/measure/deaths.hpp"

namespace banyan::measure {
namespace {

constexpr Column<Deaths::Row> deaths_table[] = {
    column<&Deaths::Row::deaths>("deaths", "robots that died"),
    column<&Deaths::Row::survivors>("survivors", "robots alive at the end"),
    quantity<&Deaths::Row::last_death_s>("last_death_s", "when the last of them died; empty if none did",
                                         "last death (s)"),
    column<&Deaths::Row::recovered>(
        "recovered",
        "whole again within 20 drives (C / v_max) of the last death, and without a break for 2 or settle_s",
        "recovered networks (share)"),
    quantity<&Deaths::Row::recovery_time_s>("recovery_time_s", "from the last death until then; empty if not recovered",
                                            "recovery time (s)"),
};

}  // namespace

std::span<const Column<Deaths::Row>> Deaths::columns() noexcept { return deaths_table; }

Deaths::Deaths(const world::World& start, Row& /*row*/)
    : recovery_(start.scenario().tick_s, world::drive_s(start.scenario()),
                start.scenario().mission.stop_when_complete ? start.scenario().mission.settle_s : 0.0) {}

void Deaths::observe(const Moment& now, Row& row) {
  const world::World& world = now.world;
  recovery_.observe(world.deaths(), now.tick.components == 1 && now.tick.roots == 1 && now.tick.all_held());
  row.deaths = static_cast<std::uint32_t>(world.deaths());
  row.survivors = now.tick.alive;
  if (const auto last = world.last_death_tick())
    row.last_death_s = static_cast<double>(*last) * world.scenario().tick_s;
  row.recovered = recovery_.recovered();
  row.recovery_time_s = recovery_.time_s();
}

}  // namespace banyan::measure
