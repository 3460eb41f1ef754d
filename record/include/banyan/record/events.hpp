// SPDX-License-Identifier: MIT
// What happened between two frames, in words: the difference of two snapshots, so that nothing
// in the simulation has to report anything.
#pragma once

#include <vector>

#include "banyan/measure/metrics.hpp"
#include "banyan/record/frame.hpp"
#include "banyan/record/recording.hpp"

namespace banyan::record {

class EventWatcher {
 public:
  // Events since the last call; the first call only learns what is there. Valid until the next.
  const std::vector<RecordedEvent>& watch(const Setting& setting, const Frame& frame, const measure::Tick& tick);

 private:
  void watch_robots(const Frame& frame);
  void watch_targets(const Setting& setting, const Frame& frame);
  void watch_radio(const measure::Tick& tick);
  void watch_setting(const Setting& setting);
  void add(std::string_view kind, std::int64_t robot, std::int64_t target, std::string text);

  bool started_ = false;
  Frame last_;
  measure::Tick last_tick_;
  std::vector<world::Vec2> obstacles_;  // where each was
  bool line_of_sight_ = false;
  std::vector<std::uint8_t> reached_;   // per target
  bool complete_ = false;
  std::vector<RecordedEvent> events_;
  double time_s_ = 0.0;
  std::uint64_t tick_ = 0;
};

}  // namespace banyan::record
