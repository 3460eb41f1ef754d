// SPDX-License-Identifier: MIT
// The robots of the tests: C is a metre and a drive takes ten seconds, so that what a test hands in as a host does, in
// metres, is in C behind the gate, too. To an algorithm they are the same as a Khepera IV with a radio of 2 m.
#pragma once

#include "banyan/controller/core/platform.hpp"

namespace banyan {

inline constexpr Platform test_platform{.communication_range_m = 1.0F,
                                        .tick_s = 0.1F,
                                        .wheel_limit_m_s = 0.1F,
                                        .wheel_distance_m = 0.0527F,
                                        .body_radius_m = 0.0352F};

}  // namespace banyan
