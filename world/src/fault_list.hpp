// SPDX-License-Identifier: MIT
// What the checks of a scenario share: the list they fill, and the checks that parts have in common.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "banyan/world/faults.hpp"

namespace banyan::world {

// A computed number, in six digits.
[[nodiscard]] inline std::string short_text(double x) {
  char text[32];
  static_cast<void>(std::snprintf(text, sizeof text, "%g", x));  // %g always fits
  return text;
}
[[nodiscard]] inline std::string at(Vec2 p) { return "(" + short_text(p.x) + ", " + short_text(p.y) + ")"; }
[[nodiscard]] inline std::string element(const std::string& list, std::size_t i) {
  return list + "[" + std::to_string(i) + "]";
}

class FaultList {
 public:
  void fail(std::string key, std::string text, std::vector<std::string> with = {}) {
    list_.push_back({std::move(key), std::move(text), false, std::move(with)});
  }
  void warn(std::string key, std::string text) { list_.push_back({std::move(key), std::move(text), true, {}}); }
  // A list of `n` entries has at least one and not too many.
  void check_length(const std::string& key, std::size_t n, std::size_t most) {
    if (n < 1 || n > most) fail(key, "must have 1 to " + std::to_string(most) + " entries, not " + std::to_string(n));
  }
  [[nodiscard]] bool failed() const noexcept {
    return std::any_of(list_.begin(), list_.end(), [](const Fault& f) { return !f.warning; });
  }
  // Where else there is room is looked for as often as anybody reads it.
  [[nodiscard]] bool may_search() noexcept { return searches_left_-- > 0; }
  [[nodiscard]] std::vector<Fault> take() { return std::move(list_); }

 private:
  std::vector<Fault> list_;
  int searches_left_ = 10;
};

// Every value of every event, on its own.
void check_event_values(FaultList& list, const std::vector<Event>& events);
// Checks that what events refer to exists when they happen. False if there are more targets than
// robots that can be sent.
bool check_events_fit(FaultList& list, const Scenario& scenario, std::size_t targets, std::size_t robots);
// Checks that the body model can represent this obstacle.
void check_obstacle_body(FaultList& list, const Scenario& scenario, const std::string& key, const Obstacle& obstacle);
// Checks that a robot can get near enough to a target at p, named as in a fault, with key `key`. `room`: its distance
// to the nearest of the obstacles, or a robot's radius if that is less.
void check_target_room(FaultList& list, const Scenario& scenario, std::span<const Obstacle> obstacles, double room,
                       const std::string& key, const std::string& name, Vec2 p);
// "; the nearest free place is (1, 2)": the nearest to p that is so far from the obstacles. Nothing if none is near.
[[nodiscard]] std::string free_place_text(FaultList& list, std::span<const Obstacle> obstacles, Vec2 p, double room_m);
// Checks that a map has cells, some of them free.
void check_map(FaultList& list, const std::string& key, const FloorMap& map);
// Checks that robots can drive to all targets, given and named as there, and to all rooms of the maps.
void check_ways(FaultList& list, const Scenario& scenario, std::span<const Vec2> targets,
                const std::function<std::string(std::size_t)>& key_of);

}  // namespace banyan::world
