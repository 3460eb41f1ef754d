// SPDX-License-Identifier: MIT
#include "banyan/measure/silence.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace banyan::measure {

double liveness_period_s(const world::World& world) {
  const auto rows = world.algorithm().parameters();
  const auto row =
      std::find_if(rows.begin(), rows.end(), [](const ParameterInfo* info) { return info->key == "liveness_rounds"; });
  if (row == rows.end())
    return usual_liveness_ticks / (1.0 / world.scenario().tick_s);  // 1.2 s, not 1.2000000000000002, at 0.1 s a tick
  const float rounds =
      world.algorithm().values(world::setup_of(world.scenario()))[static_cast<std::size_t>(row - rows.begin())];
  return static_cast<double>(rounds) * world.scenario().tick_s;
}

// Parameters are in single precision: 0.7 s at 0.1 s are seven ticks although 0.7F is a little less.
Silence::Silence(double limit_s, double tick_s)
    : limit_ticks_{static_cast<std::uint32_t>(std::min(limit_s / tick_s + 1e-4, 4e9))} {}

void Silence::next_tick() {
  std::swap(last_, now_);
  now_.clear();
  std::sort(last_.begin(), last_.end(),
            [](const Pair& a, const Pair& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
}

bool Silence::is_long(RobotId a, RobotId b) {
  const auto [low, high] = std::minmax(a, b);
  const auto is_before = [](const Pair& pair, const std::pair<RobotId, RobotId>& ends) {
    return std::tie(pair.low, pair.high) < std::tie(ends.first, ends.second);
  };
  const auto before = std::lower_bound(last_.begin(), last_.end(), std::pair{low, high}, is_before);
  const bool goes_on = before != last_.end() && before->low == low && before->high == high;
  now_.push_back({low, high, goes_on ? before->ticks + 1 : 1});
  return now_.back().ticks > limit_ticks_;
}

}  // namespace banyan::measure
