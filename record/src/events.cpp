// SPDX-License-Identifier: MIT
// What happened between two frames (events.hpp).
#include "banyan/record/events.hpp"

#include <algorithm>

#include "banyan/world/obstacles.hpp"

namespace banyan::record {

namespace {

std::string robot_name(std::int64_t robot) { return "robot " + std::to_string(robot); }
std::string target_name(std::size_t target) { return "target T" + std::to_string(target); }

}  // namespace

void EventWatcher::add(std::string_view kind, std::int64_t robot, std::int64_t target, std::string text) {
  events_.push_back({tick_, time_s_, std::string(kind), robot, target, std::move(text)});
}

const std::vector<RecordedEvent>& EventWatcher::watch(const Setting& setting, const Frame& frame,
                                                      const measure::Tick& tick) {
  events_.clear();
  tick_ = frame.tick;
  time_s_ = frame.time_s;
  if (started_) {
    watch_robots(frame);
    watch_radio(tick);
  }
  watch_targets(setting, frame);
  watch_setting(setting);
  started_ = true;
  last_ = frame;
  last_tick_ = tick;
  return events_;
}

void EventWatcher::watch_robots(const Frame& frame) {
  const std::size_t n = std::min(frame.robots.size(), last_.robots.size());
  for (std::size_t i = 0; i < n; ++i) {
    const RobotFrame& before = last_.robots[i];
    const RobotFrame& now = frame.robots[i];
    const auto robot = static_cast<std::int64_t>(i);
    if (before.alive && !now.alive) add("death", robot, -1, robot_name(robot) + " died");
    if (!now.alive) continue;
    if (now.role == Role::root && before.role != Role::root) add("root", robot, -1, robot_name(robot) + " is root");
    if (now.role != Role::root) {
      if (before.role == Role::spare && now.role == Role::connector) {
        add("recruited", robot, -1, robot_name(robot) + " is a connector");
      } else if (before.role == Role::connector && now.role == Role::spare) {
        add("released", robot, -1, robot_name(robot) + " is spare");
      }
      continue;
    }
    // Phases are gossip; the root enters them first.
    if (now.epoch != before.epoch) add("epoch", robot, -1, "epoch " + std::to_string(now.epoch) + " begins");
    if (now.phase != before.phase) add("phase", robot, -1, "phase " + std::string(name_of(now.phase)));
  }
}

void EventWatcher::watch_targets(const Setting& setting, const Frame& frame) {
  for (std::size_t k = 0; k < frame.targets.size() && started_; ++k) {
    const auto target = static_cast<std::int64_t>(k);
    if (k >= last_.targets.size()) {
      add("target_added", frame.targets[k].worker, target, target_name(k) + " is new");
    } else if (!(frame.targets[k].position == last_.targets[k].position)) {
      add("target_moved", frame.targets[k].worker, target, target_name(k) + " has moved");
      reached_[k] = 0;
      complete_ = false;
    }
  }
  reached_.resize(frame.targets.size(), 0);
  std::size_t held = 0;
  for (std::size_t k = 0; k < frame.targets.size(); ++k) {
    const TargetFrame& target = frame.targets[k];
    if (target.worker < 0 || static_cast<std::size_t>(target.worker) >= frame.robots.size()) continue;
    const RobotFrame& worker = frame.robots[static_cast<std::size_t>(target.worker)];
    if (!worker.alive || !(distance(worker.position, target.position) <= setting.target_tolerance_m)) continue;
    ++held;
    if (reached_[k] == 0) {
      reached_[k] = 1;
      add("arrival", target.worker, static_cast<std::int64_t>(k),
          robot_name(target.worker) + " has reached " + target_name(k));
    }
  }
  if (!complete_ && !frame.targets.empty() && held == frame.targets.size()) {
    complete_ = true;
    add("complete", -1, -1, "all targets are reached");
  }
}

void EventWatcher::watch_setting(const Setting& setting) {
  obstacles_.resize(setting.obstacles.size());
  for (std::size_t k = 0; k < obstacles_.size(); ++k) {
    const Vec2 center = world::center_of(setting.obstacles[k]);
    if (started_ && center != obstacles_[k])
      add("obstacle_moved", -1, -1, "obstacle " + std::to_string(k) + " has moved");
    obstacles_[k] = center;
  }
  if (started_ && setting.line_of_sight != line_of_sight_)
    add("line_of_sight", -1, -1,
        setting.line_of_sight ? "bodies and obstacles block the radio now" : "nothing blocks the radio any more");
  line_of_sight_ = setting.line_of_sight;
}

void EventWatcher::watch_radio(const measure::Tick& tick) {
  const auto broken = [](const measure::Tick& t) { return t.broken_by_distance + t.broken_by_occlusion; };
  if (tick.components > 1 && last_tick_.components <= 1) {
    add("split", -1, -1, "the radio graph is in " + std::to_string(tick.components) + " parts");
  }
  if (tick.components <= 1 && last_tick_.components > 1) add("joined", -1, -1, "the radio graph is in one piece");
  if (broken(tick) > 0 && broken(last_tick_) == 0) {
    add("edges_broken", -1, -1, std::to_string(broken(tick)) + " tree edges are broken");
  }
  if (broken(tick) == 0 && broken(last_tick_) > 0) add("edges_whole", -1, -1, "no tree edge is broken");
}

}  // namespace banyan::record
