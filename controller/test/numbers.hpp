// SPDX-License-Identifier: MIT
// Random numbers for property tests.
#pragma once

#include <rapidcheck.h>

namespace banyan {

// Evenly from low to high, both included.
inline float number(float low, float high) {
  constexpr int steps = 1 << 20;
  return low + (high - low) * static_cast<float>(*rc::gen::inRange(0, steps + 1)) / static_cast<float>(steps);
}

}  // namespace banyan
