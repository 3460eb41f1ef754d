// SPDX-License-Identifier: MIT
// Parameters that every baseline has: how far a link may reach, how strongly a target attracts, when a
// neighbour is gone. Keys and ranges are those of the paper's algorithms where the meaning is the same.
#pragma once

#include <string_view>

#include "banyan/controller/core/parameter.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan::baselines {

struct BaselineParams : Machine {
  float liveness_rounds = 12.0F;   // I
  float avoidance_range = 0.125F;  // A
  float avoidance_gain = 0.5F;
  float target_gain = 1.0F;  // tau
  float guard_rate = 10.0F;
  float arrival_distance = 0.1F;
  float speed_gain = 1.0F;     // K
  float longest_link = 0.95F;  // no kept link outgrows it
};

// The same table for each: Params is BaselineParams or derived from it.
template <class Params>
inline constexpr Parameter<Params> common_parameters[] = {
    {{"liveness_rounds", "I", "rounds", "a neighbour not heard for longer counts as gone",
      "At least five. Longer where packets are lost.", "baselines", 1.0F, 600.0F},
     &Params::liveness_rounds},
    {{"avoidance_range", "A", "C", "robots repel each other within it", "About three body diameters.", "baselines",
      0.0F, 1.0F},
     &Params::avoidance_range},
    {{"avoidance_gain", "", "", "gain of the repulsion within A", "Raise it if bodies touch.", "baselines", 0.0F,
      100.0F},
     &Params::avoidance_gain},
    {{"target_gain", "tau", "", "magnitude of the attraction to a target",
      "Larger pulls a network that is held by springs farther.", "baselines", 0.0F, 1.9F},
     &Params::target_gain},
    {{"guard_rate", "", "1/drive", "each end may lengthen a kept link at (longest - d)/2 times this",
      "Below a quarter of the rounds per drive. Lower is safer with latency and noise, and slower near the limit.",
      "baselines", 0.1F, 100.0F},
     &Params::guard_rate},
    {{"arrival_distance", "", "C",
      "a worker's pull fades in proportion within this; the mission's target tolerance unless set",
      "Leave it to the mission.", "baselines", 0.005F, 5.0F},
     &Params::arrival_distance},
    {{"longest_link", "", "C", "baselines: no link that is kept grows longer than this",
      "As near to 1 as the radio is reliable.", "baselines", 0.05F, 1.0F},
     &Params::longest_link},
};

}  // namespace banyan::baselines
