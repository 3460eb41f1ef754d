// SPDX-License-Identifier: MIT
// How soon targets are held again whose workers have died, and how many wait for that.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "banyan/world/world.hpp"

namespace banyan::measure {

// Follows each target that a living worker holds until that worker dies, and from then on until another holds it. A
// worker that is driven off before it dies holds nothing and does not count.
class Takeovers {
 public:
  // `tick_s` > 0.
  explicit Takeovers(double tick_s) : tick_s_{tick_s} {}

  // Once per tick. `holders`: by target, the living worker that holds it, or `nobody`. Targets may be added, never
  // removed.
  void observe(std::span<const RobotId> holders, std::span<const world::Target> targets,
               std::span<const std::uint8_t> alive);

  // Targets that nobody holds at the last tick, since the worker that held them died.
  [[nodiscard]] std::uint32_t waiting() const noexcept { return waiting_; }
  // How often a worker died at its target while the target was active.
  [[nodiscard]] std::uint32_t lost() const noexcept { return lost_; }
  // From such a death until the target was held again, median; a target that still waits counts as longer than all that
  // are held again, one that was deactivated meanwhile does not count. -1: none died, or half of them or more still
  // wait.
  [[nodiscard]] double median_s() const;

 private:
  struct Course {
    RobotId holder = nobody;        // at the last tick, or the one that died
    std::uint32_t waits_ticks = 0;  // 1 and the ticks without a holder since it died; 0: it has not died
  };
  double tick_s_;
  std::vector<Course> courses_;            // by target
  std::vector<std::uint32_t> held_again_;  // ticks without a holder, in the order in which it ended
  std::uint32_t lost_ = 0;
  std::uint32_t waiting_ = 0;
};

}  // namespace banyan::measure
