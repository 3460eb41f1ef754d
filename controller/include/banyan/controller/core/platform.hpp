// SPDX-License-Identifier: MIT
// What an algorithm is told about the robot it runs on. The same for all algorithms.
#pragma once

namespace banyan {

// What the wheels allow. A holonomic robot moves in any direction without turning.
enum class Drive : unsigned char { differential, holonomic };

struct Platform {
  float communication_range_m = 2.0F;  // C
  float tick_s = 0.1F;                 // control period
  float wheel_limit_m_s = 0.2F;        // largest speed of a wheel
  float wheel_distance_m = 0.1054F;    // between the wheels
  bool line_of_sight = true;           // the radio does not go through obstacles and bodies
  Drive drive = Drive::differential;
  bool battery = false;  // it may run down; Senses::charge says how far

  // The nearest number of whole ticks. In fifty places the division would take more of a robot's memory than a call.
  [[nodiscard, gnu::noinline]] int ticks(float seconds) const noexcept {
    return static_cast<int>(seconds / tick_s + 0.5F);
  }
};

}  // namespace banyan
