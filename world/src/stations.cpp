// SPDX-License-Identifier: MIT
#include "banyan/world/stations.hpp"

#include <algorithm>
#include <cmath>

namespace banyan::world {
namespace {

Vec2 between(Vec2 from, Vec2 to, double share) noexcept { return from + (to - from) * std::clamp(share, 0.0, 1.0); }

// By the clock: it is at each way point when its time has come.
Vec2 timed(const Station& station, double time_s) noexcept {
  Vec2 from = station.position;
  double from_s = station.start_s;
  for (std::size_t k = 0; k < station.course.size(); ++k) {
    const double to_s = station.times[k];
    if (time_s < to_s) return between(from, station.course[k], (time_s - from_s) / (to_s - from_s));
    from = station.course[k];
    from_s = to_s;
  }
  return from;
}

}  // namespace

Vec2 station_at(const Station& station, double time_s) noexcept {
  if (station.course.empty()) return station.position;
  if (!station.times.empty()) return timed(station, time_s);
  if (!(station.speed_m_s > 0.0)) return station.position;
  double left_s = time_s - station.start_s;
  // Legs begin at the place of the start; in a loop the last one leads back there.
  const std::size_t legs = station.course.size() + (station.loop ? 1 : 0);
  const auto point = [&](std::size_t k) {
    return k == 0 || k > station.course.size() ? station.position : station.course[k - 1];
  };
  if (station.loop) {
    double round_s = 0.0;
    for (std::size_t k = 0; k < legs; ++k)
      round_s += distance(point(k), point(k + 1)) / station.speed_m_s + station.pause_s;
    if (round_s > 0.0 && left_s > 0.0) left_s = std::fmod(left_s, round_s);
  }
  for (std::size_t k = 0; k < legs && left_s > 0.0; ++k) {
    const Vec2 from = point(k), to = point(k + 1);
    const double way_s = distance(from, to) / station.speed_m_s;
    if (left_s < way_s) return between(from, to, left_s / way_s);
    left_s -= way_s;
    if (left_s < station.pause_s || k + 1 == legs) return to;
    left_s -= station.pause_s;
  }
  return station.position;
}

}  // namespace banyan::world
