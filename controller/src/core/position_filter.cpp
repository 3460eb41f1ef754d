// SPDX-License-Identifier: MIT
#include "banyan/controller/core/position_filter.hpp"

#include <algorithm>
#include <cmath>

namespace banyan {
namespace {

constexpr float wander = 4.0F;           // the random walk, in longest ways of a tick: a course lasts a second or two
constexpr float explained = 1.25F;       // of that way: what motion explains of an innovation, and odometry's own error
constexpr float newest = 1.0F / 256.0F;  // weight of an innovation: what counts are the last few hundred
// Of the walk: a shove in a crowd that odometry does not see is forgotten at once.
constexpr float noticed = 1.0F / 32.0F;
constexpr float surely = 0.99F;           // and what it explains whatever the roundings
constexpr float shortest_lever_m = 0.5F;  // nearer, a neighbour's own motion turns its bearing by much

float squared_excess(float innovation, float explained_by_motion) noexcept {
  const float excess = std::max(0.0F, std::fabs(innovation) - explained_by_motion);
  return excess * excess;
}

// Steady after every tick; after a silence the neighbour may be anywhere, and at first a mean is better.
float gain(float walk_m, float rms_m, int ticks, int measurements) noexcept {
  if (rms_m <= walk_m) return 1.0F;
  const float steady = walk_m / rms_m;
  const float variance = steady * (1.0F - steady + static_cast<float>(ticks) * steady);  // of the prediction, of rms^2
  return std::max(variance / (variance + 1.0F - steady), 1.0F / static_cast<float>(measurements + 1));
}

}  // namespace

void PositionFilter::begin(float way_m) noexcept {
  way_m_ = way_m;
  const float walk_m = wander * way_m;
  const float least = noticed * walk_m;
  if (range_ms_ < least * least) range_ms_ = 0.0F;
  if (bearing_ms_ < least * least) bearing_ms_ = 0.0F;
  range_rms_m_ = std::sqrt(range_ms_);
  bearing_rms_ = std::sqrt(bearing_ms_);
  spread_m_ = range_rms_m_ > walk_m ? std::sqrt(walk_m * (range_rms_m_ - walk_m)) : 0.0F;
}

Vec2 PositionFilter::fuse(Vec2 predicted, Vec2 measured, int ticks, int measurements) const noexcept {
  if (!has_seen_noise()) return measured;
  const float expected_m = norm(predicted);
  const float range_gain = gain(wander * way_m_, range_rms_m_, ticks, measurements);
  const float bearing_gain = gain(wander * way_m_, bearing_rms_ * expected_m, ticks, measurements);
  if (range_gain == 1.0F && bearing_gain == 1.0F) return measured;
  const Vec2 before = unit(predicted);
  const Vec2 now = unit(measured);
  return unit(before + (now - before) * bearing_gain) * (expected_m + (norm(measured) - expected_m) * range_gain);
}

void PositionFilter::learn(Vec2 predicted, Vec2 measured, int ticks) noexcept {
  const float by_motion_m = explained * way_m_ * static_cast<float>(ticks);
  const float least_m = surely * by_motion_m;
  if (!has_seen_noise() && squared_norm(measured - predicted) <= least_m * least_m)
    return;  // neither excess is above 0
  const float expected_m = norm(predicted);
  const float range_m = norm(measured);
  if (!(expected_m > 0.0F) || !(range_m > 0.0F)) return;
  range_ms_ += (squared_excess(range_m - expected_m, by_motion_m) - range_ms_) * newest;
  const float lever_m = std::max(expected_m, shortest_lever_m);
  const float across_m = cross(predicted, measured) / range_m;  // at the distance where it was expected
  bearing_ms_ += (squared_excess(across_m, by_motion_m) / (lever_m * lever_m) - bearing_ms_) * newest;
}

}  // namespace banyan
