// SPDX-License-Identifier: MIT
// Random numbers for property tests, and places.
#pragma once

#include <rapidcheck.h>

#include "banyan/controller/core/trig.hpp"

namespace banyan {

// Evenly from low to high, both included.
inline float number(float low, float high) {
  constexpr int steps = 1 << 20;
  return low + (high - low) * static_cast<float>(*rc::gen::inRange(0, steps + 1)) / static_cast<float>(steps);
}

inline Vec2 polar(float range, float angle) { return unit_vector(angle) * range; }

}  // namespace banyan
