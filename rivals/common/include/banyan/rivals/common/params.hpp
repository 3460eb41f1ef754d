// SPDX-License-Identifier: MIT
// Parameters that every rival has: how far a link may reach, how strongly a target attracts, when a
// neighbour is gone. Keys and ranges are those of the paper's algorithms where the meaning is the same.
#pragma once

#include <string_view>

#include "banyan/controller/core/parameter.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan::rivals {

struct RivalParams : Platform {
  float liveness_period_s = 1.2F;   // I
  float avoidance_range_m = 0.25F;  // A
  float avoidance_gain = 0.5F;
  float target_gain = 1.0F;  // tau
  float guard_rate_per_s = 1.0F;
  float arrival_distance_m = 0.2F;
  float speed_gain_m_s = 0.2F;  // K
  float longest_link_m = 1.9F;  // no kept link outgrows it
};

// The same table for each: Params is RivalParams or derived from it.
template <class Params>
inline constexpr Parameter<Params> common_parameters[] = {
    {{"liveness_period_s", "I", "s", "a neighbour not heard for longer counts as gone",
      "At least five ticks. Longer where packets are lost.", "rivals", 0.1F, 60.0F},
     &Params::liveness_period_s},
    {{"avoidance_range_m", "A", "m", "robots repel each other within it", "About three body diameters.", "rivals", 0.0F,
      100.0F, Scaling::mission},
     &Params::avoidance_range_m},
    {{"avoidance_gain", "", "", "gain of the repulsion within A", "Raise it if bodies touch.", "rivals", 0.0F, 100.0F},
     &Params::avoidance_gain},
    {{"target_gain", "tau", "", "magnitude of the attraction to a target",
      "Larger pulls a network that is held by springs farther.", "rivals", 0.0F, 1.9F},
     &Params::target_gain},
    {{"guard_rate_per_s", "", "1/s", "each end may lengthen a kept link at (longest - d)/2 times this",
      "Below 1 / tick. Lower is safer with latency and noise, and slower near the limit.", "rivals", 0.01F, 10.0F},
     &Params::guard_rate_per_s},
    {{"arrival_distance_m", "", "m",
      "a worker's pull fades in proportion within this; the mission's target tolerance unless set",
      "Leave it to the mission.", "rivals", 0.01F, 10.0F},
     &Params::arrival_distance_m},
    {{"longest_link", "", "C", "rivals: no link that is kept grows longer than this",
      "As near to 1 as the radio is reliable.", "rivals", 0.05F, 1.0F, Scaling::range},
     &Params::longest_link_m},
};

}  // namespace banyan::rivals
