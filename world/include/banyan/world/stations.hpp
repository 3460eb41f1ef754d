// SPDX-License-Identifier: MIT
// Where stations are: the motion of Scenario::stations.
#pragma once

#include "banyan/world/scenario.hpp"

namespace banyan::world {

// Where the station is `time_s` after the start, m. A function of the time alone; between two way points it drives
// straight and at one speed.
[[nodiscard]] Vec2 station_at(const Station& station, double time_s) noexcept;

}  // namespace banyan::world
