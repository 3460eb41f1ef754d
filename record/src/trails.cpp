// SPDX-License-Identifier: MIT
// Where robots have been (draw.hpp).
#include <algorithm>

#include "banyan/record/draw.hpp"

namespace banyan::record {

namespace {
constexpr double trail_step_s = 0.5;
}  // namespace

void TrailLog::add(const Frame& frame) {
  if (!(length_s_ > 0.0)) return;
  if (!samples_.empty() && frame.time_s + 1e-9 < samples_.back().time_s + trail_step_s) return;
  Sample sample{frame.time_s, {}};
  for (const RobotFrame& robot : frame.robots) sample.positions.push_back(robot.position);
  samples_.push_back(std::move(sample));
  // One that is too old stays: the oldest end of a trail lies between it and the next.
  while (samples_.size() > 2 && samples_[1].time_s < frame.time_s - length_s_) samples_.pop_front();
}

Trails TrailLog::trails(const Frame& end) const {
  Trails trails(end.robots.size());
  const auto add = [&](std::size_t i, Vec2 p) {
    if (trails[i].empty() || !(trails[i].back() == p)) trails[i].push_back(p);
  };
  const double begin_s = end.time_s - length_s_;
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    const Sample& sample = samples_[k];
    if (sample.time_s < begin_s && (k + 1 == samples_.size() || samples_[k + 1].time_s <= begin_s)) continue;
    for (std::size_t i = 0; i < std::min(sample.positions.size(), trails.size()); ++i) {
      Vec2 p = sample.positions[i];
      if (sample.time_s < begin_s && i < samples_[k + 1].positions.size()) {
        const double share = (begin_s - sample.time_s) / (samples_[k + 1].time_s - sample.time_s);
        p += share * (samples_[k + 1].positions[i] - p);
      }
      add(i, p);
    }
  }
  for (std::size_t i = 0; i < trails.size(); ++i) {
    if (!trails[i].empty()) add(i, end.robots[i].position);
  }
  return trails;
}

}  // namespace banyan::record
