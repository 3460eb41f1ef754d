// SPDX-License-Identifier: MIT
// The row that every algorithm has whose Params have a speed_gain.
#pragma once

#include "banyan/controller/core/parameter.hpp"

namespace banyan {

template <class Params>
inline constexpr Parameter<Params> speed_parameter[] = {
    {{"speed_gain", "K", "v_max", "speed per unit of the control law",
      "1, unless the robot is to drive more slowly; with more, small forces already drive at v_max.",
      "protocol 2, row 9", 0.001F, 10.0F},
     &Params::speed_gain},
};

}  // namespace banyan
