// SPDX-License-Identifier: MIT
// The rows of what robot and radio decide, not the designer: C, tick, wheels. The same for every algorithm whose Params
// have them.
#pragma once

#include "banyan/controller/core/parameter.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan {

// Params is derived from Platform and has a speed_gain_m_s.
template <class Params>
inline constexpr Parameter<Params> platform_parameters[] = {
    {{"communication_range_m", "C", "m", "radio range", "That of the radio.", "protocol 2, row 8", 0.05F, 100.0F},
     &Params::communication_range_m},
    {{"tick_s", "", "s", "control period", "That of the robot.", "protocol 9", 0.01F, 1.0F}, &Params::tick_s},
    {{"speed_gain_m_s", "K", "m/s", "speed per unit of the control law",
      "The wheels' limit, unless the robot is to drive more slowly.", "protocol 2, row 9", 0.001F, 10.0F},
     &Params::speed_gain_m_s},
    {{"wheel_limit_m_s", "", "m/s", "largest speed of a wheel", "That of the robot.", "protocol 2, row 9", 0.001F,
      10.0F},
     &Params::wheel_limit_m_s},
    {{"wheel_distance_m", "", "m", "distance between the wheels", "That of the robot.", "Khepera IV", 0.01F, 2.0F},
     &Params::wheel_distance_m},
};

}  // namespace banyan
