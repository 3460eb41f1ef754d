// SPDX-License-Identifier: MIT
#include "banyan/measure/tick.hpp"

namespace banyan::measure {
namespace {

constexpr Column<Tick> tick_table[] = {
    column<&Tick::tick>("tick", "number of the tick"),
    quantity<&Tick::time_s>("time_s", "tick times tick_s"),
    column<&Tick::alive>("alive", "living robots"),
    column<&Tick::roots>("roots", "living roots"),
    column<&Tick::workers>("workers", "living workers"),
    column<&Tick::connectors>("connectors", "living connectors"),
    column<&Tick::spares>("spares", "living spares"),
    column<&Tick::committed>("committed", "alive and no spare"),
    column<&Tick::edges>("edges", "tree edges: parent and old parent of every robot that is no spare"),
    column<&Tick::broken_by_distance>("broken_by_distance", "of these, of C or longer"),
    column<&Tick::broken_by_occlusion>("broken_by_occlusion", "of these, in range but without line of sight"),
    column<&Tick::broken_after_silence>("broken_after_silence",
                                        "tree edges broken for longer than I without a break, to dead robots too"),
    column<&Tick::components>("components", "of the radio graph of the living robots"),
    column<&Tick::components_by_distance>("components_by_distance", "the same without occlusion"),
    column<&Tick::fiedler_low>("fiedler_low", "lambda_2 < 1e-3"),
    column<&Tick::fiedler_low_by_distance>("fiedler_low_by_distance", "the same without occlusion"),
    {"fiedler", "lambda_2; empty if not computed at this tick", 9, cell_of<&Tick::fiedler>},
    quantity<&Tick::worst_target_distance_m>(
        "worst_target_distance_m", "largest distance of an active target to the nearest worker that serves it"),
    column<&Tick::targets_reached>("targets_reached", "active targets held by a living worker"),
    quantity<&Tick::least_charge>("least_charge",
                                  "of the living, as a share of a full battery; empty without batteries"),
    quantity<&Tick::mean_charge>("mean_charge", "of the living; empty without batteries"),
};

}  // namespace

std::span<const Column<Tick>> tick_columns() noexcept { return tick_table; }

}  // namespace banyan::measure
