// SPDX-License-Identifier: MIT
#include "shrink.hpp"

#include <algorithm>

#include "banyan/world/faults.hpp"

namespace banyan::soak {
namespace {

using namespace world;
using world::Vec2;

class Shrinker {
 public:
  Shrinker(Scenario scenario, const std::function<bool(const Scenario&)>& still_fails, int most_runs)
      : best_(std::move(scenario)), still_fails_(still_fails), left_{most_runs} {}

  Scenario run() {
    list_targets();
    while (left_ > 0 && pass()) {}
    return std::move(best_);
  }
  template <class Change> bool attempt(const Change& change) {
    Scenario next = best_;
    change(next);
    if (left_ <= 0 || !is_possible(next)) return false;
    --left_;
    if (!still_fails_(next)) return false;
    best_ = std::move(next);
    return true;
  }

 private:
  static bool is_possible(const Scenario& scenario) {
    const auto found = faults(scenario);
    return std::none_of(found.begin(), found.end(), [](const Fault& f) { return !f.warning; });
  }
  // So that they can be taken away one by one. The same positions, hence the same run.
  void list_targets() { best_.targets = target_positions(best_); }

  bool pass() {
    bool better = fewer(&Scenario::events);
    better = fewer(&Scenario::obstacles) || better;
    better = fewer_targets() || better;
    better = fewer_robots() || better;
    return plainer() || better;
  }

  // Halves, quarters, ... of a list, down to single entries.
  template <class Entries> bool fewer_of(const Entries& entries) {
    bool better = false;
    for (std::size_t size = std::max<std::size_t>(entries(best_).size() / 2, 1);; size /= 2) {
      for (std::size_t at = 0; at < entries(best_).size();) {
        const bool gone = attempt([&](Scenario& s) {
          auto& list = entries(s);
          const auto from = list.begin() + static_cast<std::ptrdiff_t>(at);
          list.erase(from, list.begin() + static_cast<std::ptrdiff_t>(std::min(at + size, list.size())));
        });
        if (!gone) at += size;
        better = better || gone;
      }
      if (size <= 1) return better;
    }
  }
  template <class Member> bool fewer(Member member) {
    return fewer_of([member](Scenario & s) -> auto& { return s.*member; });
  }
  bool fewer_targets() {
    return fewer_of([](Scenario & s) -> auto& { return std::get<std::vector<Vec2>>(s.targets); });
  }
  bool fewer_robots() {
    bool better = false;
    for (std::size_t step = *best_.swarm.robots / 2; step > 0;) {
      const bool gone = *best_.swarm.robots > step + 1 && attempt([step](Scenario& s) { *s.swarm.robots -= step; });
      if (!gone) step /= 2;
      better = better || gone;
    }
    return better;
  }
  bool plainer() {
    bool better = false;
    const Scenario plain;
    const auto without = [&](auto member) {
      if (!(member(best_) == member(const_cast<Scenario&>(plain))))
        better = attempt([&](Scenario& s) { member(s) = member(const_cast<Scenario&>(plain)); }) || better;
    };
    without([](Scenario & s) -> auto& { return s.clocks.asynchronous; });
    if (!best_.clocks.asynchronous) best_.clocks = {};
    without([](Scenario & s) -> auto& { return s.robot.body; });
    without([](Scenario & s) -> auto& { return s.robot.wheel_noise; });
    without([](Scenario & s) -> auto& { return s.robot.odometry_noise; });
    without([](Scenario & s) -> auto& { return s.robot.dead_bodies; });
    without([](Scenario & s) -> auto& { return s.radio.range_noise_m; });
    without([](Scenario & s) -> auto& { return s.radio.bearing_noise_rad; });
    without([](Scenario & s) -> auto& { return s.radio.latency_ticks; });
    without([](Scenario & s) -> auto& { return s.radio.model; });
    without([](Scenario & s) -> auto& { return s.radio.loss; });
    without([](Scenario & s) -> auto& { return s.radio.line_of_sight; });
    without([](Scenario & s) -> auto& { return s.radio.range_m; });
    return better;
  }

  Scenario best_;
  const std::function<bool(const Scenario&)>& still_fails_;
  int left_;
};

}  // namespace

Scenario shrink(Scenario scenario, double failed_at_s, const std::function<bool(const Scenario&)>& still_fails,
                int most_runs) {
  scenario.swarm.robots = robot_count(scenario);
  Shrinker shrinker(std::move(scenario), still_fails, most_runs);
  shrinker.attempt([failed_at_s](Scenario& s) { s.mission.time_limit_s = failed_at_s + 1.0; });
  return shrinker.run();
}

}  // namespace banyan::soak
