// SPDX-License-Identifier: MIT
#include "banyan/controller/core/position_filter.hpp"

#include <algorithm>
#include <cmath>

namespace banyan {
namespace {

constexpr float wander = 4.0F;      // the random walk, in longest ways of a tick: a course lasts ten or twenty rounds
constexpr float explained = 1.25F;  // of that way: what motion explains of an innovation, and odometry's own error
constexpr float newest = 1.0F / 256.0F;  // weight of an innovation: what counts are the last few hundred
// Of the walk: a shove in a crowd that odometry does not see is forgotten at once.
constexpr float noticed = 1.0F / 32.0F;
constexpr float bearing_lever = 0.5F;    // C: at this distance a bearing is compared with it
constexpr float surely = 0.99F;          // and what it explains whatever the roundings
constexpr float shortest_lever = 0.25F;  // nearer, a neighbour's own motion turns its bearing by much

float squared_excess(float innovation, float explained_by_motion) noexcept {
  const float excess = std::max(0.0F, std::fabs(innovation) - explained_by_motion);
  return excess * excess;
}

// Steady after every tick; after a silence the neighbour may be anywhere, and at first a mean is better.
float gain(float walk, float rms, int ticks, int measurements) noexcept {
  if (rms <= walk) return 1.0F;
  const float steady = walk / rms;
  const float variance = steady * (1.0F - steady + static_cast<float>(ticks) * steady);  // of the prediction, of rms^2
  return std::max(variance / (variance + 1.0F - steady), 1.0F / static_cast<float>(measurements + 1));
}

}  // namespace

void PositionFilter::begin(float way) noexcept {
  way_ = way;
  const float walk = wander * way;
  const float least = noticed * walk;
  if (range_ms_ < least * least) range_ms_ = 0.0F;
  if (bearing_ms_ * (bearing_lever * bearing_lever) < least * least) bearing_ms_ = 0.0F;
  range_rms_ = std::sqrt(range_ms_);
  bearing_rms_ = std::sqrt(bearing_ms_);
  spread_ = range_rms_ > walk ? std::sqrt(walk * (range_rms_ - walk)) : 0.0F;
}

Vec2 PositionFilter::fuse(Vec2 predicted, Vec2 measured, int ticks, int measurements) const noexcept {
  if (!has_seen_noise()) return measured;
  const float expected = norm(predicted);
  const float range_gain = gain(wander * way_, range_rms_, ticks, measurements);
  const float bearing_gain = gain(wander * way_, bearing_rms_ * expected, ticks, measurements);
  if (range_gain == 1.0F && bearing_gain == 1.0F) return measured;
  const Vec2 before = unit(predicted);
  const Vec2 now = unit(measured);
  return unit(before + (now - before) * bearing_gain) * (expected + (norm(measured) - expected) * range_gain);
}

void PositionFilter::learn(Vec2 predicted, Vec2 measured, int ticks) noexcept {
  const float by_motion = explained * way_ * static_cast<float>(ticks);
  const float least = surely * by_motion;
  if (!has_seen_noise() && squared_norm(measured - predicted) <= least * least) return;  // neither excess is above 0
  const float expected = norm(predicted);
  const float measured_range = norm(measured);
  if (!(expected > 0.0F) || !(measured_range > 0.0F)) return;
  range_ms_ += (squared_excess(measured_range - expected, by_motion) - range_ms_) * newest;
  const float lever = std::max(expected, shortest_lever);
  const float across = cross(predicted, measured) / measured_range;  // at the distance where it was expected
  bearing_ms_ += (squared_excess(across, by_motion) / (lever * lever) - bearing_ms_) * newest;
}

}  // namespace banyan
