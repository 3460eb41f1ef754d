// SPDX-License-Identifier: MIT
// How far a robot trusts a measured position (protocol 1): a Kalman filter in its steady state, for range and
// bearing separately. A neighbour moves like a random walk of `walk` a tick, for it keeps its course for a while;
// the gain is then the walk over the root mean square of the innovations (measured minus expected
// values), so that the noise need not be known: the robot learns it from the innovations (Mehra 1970). Without
// noise these are no larger than a neighbour moves, the gain is exactly 1, and a measurement is taken as it is.
#pragma once

#include "banyan/controller/core/vec2.hpp"

namespace banyan {

class PositionFilter {
 public:
  // `way`: the longest that a neighbour drives in a tick; 0: measurements are taken as they are.
  void begin(float way) noexcept;
  [[nodiscard]] bool is_on() const noexcept { return way_ > 0.0F; }
  // Both in the present frame. `ticks` since the last measurement of that neighbour; `measurements` of it so far.
  [[nodiscard]] Vec2 fuse(Vec2 predicted, Vec2 measured, int ticks, int measurements) const noexcept;
  // From a neighbour that was heard at the last step, too.
  void learn(Vec2 predicted, Vec2 measured, int ticks) noexcept;
  // One standard deviation of a filtered range, C; 0: not noticeable.
  [[nodiscard]] float spread() const noexcept { return spread_; }
  [[nodiscard]] bool has_seen_noise() const noexcept { return range_ms_ > 0.0F || bearing_ms_ > 0.0F; }

  template <class Visit> void visit(Visit visit) const noexcept { visit(range_ms_), visit(bearing_ms_); }

 private:
  // Mean squares of the innovations, as far as no motion explains them
  float range_ms_ = 0.0F;    // C^2
  float bearing_ms_ = 0.0F;  // rad^2
  // In this step
  float way_ = 0.0F;
  float range_rms_ = 0.0F;
  float bearing_rms_ = 0.0F;
  float spread_ = 0.0F;
};

}  // namespace banyan
