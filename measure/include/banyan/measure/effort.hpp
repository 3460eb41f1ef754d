// SPDX-License-Identifier: MIT
// What a run has asked of its robots: the way they drive, and how often they change their minds.
#pragma once

#include <cstdint>
#include <vector>

#include "banyan/measure/moment.hpp"

namespace banyan::measure {

// From the truth and from reports, tick by tick. A tick costs O(robots) and allocates nothing.
class Effort {
 public:
  struct Row {
    std::uint64_t decisions = 0;
    double driven_m = 0.0;  // mean over the robots at the start
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  // The state of this world is what the first tick is compared with.
  explicit Effort(const world::World& start);
  Effort(const world::World& start, Row& /*row*/) : Effort(start) {}
  void observe(const world::World& world);
  void observe(const Moment& now, Row& /*row*/) { observe(now.world); }
  void sum_up(const Moment& end, Row& row) const;

  // By all robots, while they live: from its true position at each tick straight to that at the next. Being pushed is
  // driving, turning on the spot is not.
  [[nodiscard]] double driven_m() const noexcept { return driven_m_; }
  // A decision: in a tick, a living robot changes its role, its parent or the target that it serves. Several of them
  // at once are one decision; neither the old parent nor a kept link is looked at.
  [[nodiscard]] std::uint64_t decisions() const noexcept { return decisions_; }

 private:
  struct Choice {
    RobotId parent, serves;
    Role role;
    bool operator==(const Choice&) const = default;
  };
  static Choice of(const Report& report) noexcept { return {report.parent, report.serves, report.role}; }

  std::vector<world::Vec2> position_;  // by robot, at the last tick
  std::vector<Choice> choice_;         // likewise, and so is
  std::vector<std::uint8_t> alive_;
  std::size_t at_start_;  // robots
  double driven_m_ = 0.0;
  std::uint64_t decisions_ = 0;
};

}  // namespace banyan::measure
