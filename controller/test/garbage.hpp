// SPDX-License-Identifier: MIT
// What a broken sensor may say.
#pragma once

#include <rapidcheck.h>

#include <bit>
#include <cstdint>
#include <limits>

#include "numbers.hpp"

namespace banyan {

inline constexpr float nan_m = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinite_m = std::numeric_limits<float>::infinity();

// Any float at all, one of the worst, or one that is sane.
inline float garbage() {
  switch (*rc::gen::inRange(0, 4)) {
    case 0: return std::bit_cast<float>(*rc::gen::arbitrary<std::uint32_t>());
    case 1:
      return *rc::gen::element(nan_m, infinite_m, -infinite_m, std::numeric_limits<float>::max(),
                               std::numeric_limits<float>::denorm_min(), 0.0F, -0.0F);
    default: return number(-2.0F, 2.0F);
  }
}

}  // namespace banyan
