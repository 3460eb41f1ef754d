// SPDX-License-Identifier: MIT
// What no swarm can beat, and what one that knows everything does: robots and time for the targets at the start.
#pragma once

#include <vector>

#include "banyan/measure/moment.hpp"

namespace banyan::measure {

class Oracle {
 public:
  struct Row {
    std::uint32_t robots_bound = 0;  // no fewer committed robots complete the mission (relays.hpp)
    // 0: not asked, since there are more than a thousand targets.
    std::uint32_t oracle_robots = 0;   // workers and relays: edges of 0.95 C, targets at the start
    bool oracle_exact = false;         // no tree of such edges has fewer
    std::uint32_t oracle_targets = 0;  // targets at the start that it can hold with the robots there are
    double oracle_time_s = -1.0;    // straight drives, relays at their places as well; -1: too few robots, or too many
    double steiner_length_m = 0.0;  // shortest network of the targets, certified from below
    double star_length_m = 0.0;     // of the shortest star of the targets, for comparison
    bool survivors_suffice = true;  // as many live as the bound for the targets active at the end
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  Oracle(const world::World& start, Row& row);
  static void observe(const Moment& /*now*/, Row& /*row*/) {}
  void sum_up(const Moment& end, Row& row);

 private:
  void ask(const Moment& end);

  double range_m_, tolerance_m_, speed_m_s_;
  std::vector<world::Vec2> targets_;  // at the start
  std::vector<world::Vec2> others_;   // where robots start that are not sent to a target
  bool asked_ = false;
  Row answer_;
};

}  // namespace banyan::measure
