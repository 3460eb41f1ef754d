// SPDX-License-Identifier: MIT
// What happened between two frames, in words: the difference of two snapshots, so that nothing
// in the simulation has to report anything.
#pragma once

#include <span>
#include <vector>

#include "banyan/measure/metrics.hpp"
#include "banyan/record/frame.hpp"
#include "banyan/record/recording.hpp"

namespace banyan::record {

class EventWatcher {
 public:
  // Events since the last call; the first call learns what is there and tells only of targets that
  // are held already. Valid until the next.
  const std::vector<RecordedEvent>& watch(const Setting& setting, const Frame& frame, const measure::Tick& tick);

 private:
  void watch_setting(const Setting& setting);
  void watch_obstacles(std::span<const world::Obstacle> before, std::span<const world::Obstacle> now);
  void watch_robots(const Frame& frame);
  void watch_death(const Frame& frame, std::size_t i);
  void watch_root(const Frame& frame, std::size_t i);
  void watch_recruit(const Frame& frame, std::size_t i);
  void watch_targets(const Setting& setting, const Frame& frame, const measure::Tick& tick);
  void watch_target(const Setting& setting, const Frame& frame, std::size_t k);
  void watch_arrivals(const Setting& setting, const Frame& frame, const measure::Tick& tick);
  void watch_radio(const measure::Tick& tick);
  void watch_edges(const Setting& setting, const Frame& frame, const measure::Tick& tick);
  [[nodiscard]] std::string robot_name(std::int64_t robot) const;
  void add(std::string_view kind, std::int64_t robot, std::int64_t target, std::string text);

  bool started_ = false;
  Setting setting_;
  const std::vector<std::string>* names_ = nullptr;  // of the setting that is being watched
  Frame last_;
  measure::Tick last_tick_;
  std::vector<std::int32_t> reached_;   // per target: the worker that has reached it, -1: none that still serves it
  std::vector<std::uint8_t> moving_;    // per target: it has moved since the last frame
  std::vector<std::uint8_t> drifting_;  // the same per obstacle
  bool complete_ = false;
  std::vector<RecordedEvent> events_;
  double time_s_ = 0.0;
  std::uint64_t tick_ = 0;
};

}  // namespace banyan::record
