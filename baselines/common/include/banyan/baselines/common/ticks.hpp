// SPDX-License-Identifier: MIT
// Time in ticks, for a robot whose steps need not be whole ticks.
#pragma once

namespace banyan::baselines {

// Whole ticks since the last step. What is left over counts at the next step, so that the counts of two robots
// never differ by more than a tick, even if one steps every 1.4 ticks, say, and the other every 1.6.
class Ticks {
 public:
  // `rounds` since the last step (gate.hpp).
  int advance(float rounds) noexcept {
    const float passed = rounds + left_;
    const int whole = static_cast<int>(passed + 0.5F);
    left_ = passed - static_cast<float>(whole);
    return whole;
  }
  [[nodiscard]] float left() const noexcept { return left_; }

 private:
  float left_ = 0.0F;  // of a tick, in [-0.5, 0.5)
};

}  // namespace banyan::baselines
