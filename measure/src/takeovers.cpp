// SPDX-License-Identifier: MIT
#include "banyan/measure/takeovers.hpp"

#include <algorithm>

namespace banyan::measure {

void Takeovers::observe(std::span<const RobotId> holders, std::span<const world::Target> targets,
                        std::span<const std::uint8_t> alive) {
  courses_.resize(holders.size());
  waiting_ = 0;
  for (std::size_t t = 0; t < holders.size(); ++t) {
    Course& course = courses_[t];
    if (!targets[t].active) {
      if (course.waits_ticks > 0) --lost_;
      course = {};
      continue;
    }
    if (course.waits_ticks == 0 && course.holder != nobody && alive[course.holder] == 0) {
      ++lost_;
      course.waits_ticks = 1;
    }
    if (holders[t] != nobody) {
      if (course.waits_ticks > 0) held_again_.push_back(course.waits_ticks - 1);
      course = {.holder = holders[t]};
    } else if (course.waits_ticks > 0) {
      ++course.waits_ticks;
      ++waiting_;
    } else {
      course.holder = nobody;
    }
  }
}

double Takeovers::median_s() const {
  // Those that still wait stand behind all others: the middle of all is that of the others, moved on.
  const std::size_t middle = lost_ / 2;
  const bool even = lost_ % 2 == 0;
  if (lost_ == 0 || held_again_.size() <= middle) return -1.0;
  std::vector<std::uint32_t> ticks = held_again_;
  std::sort(ticks.begin(), ticks.end());
  const double upper = ticks[middle], lower = even ? ticks[middle - 1] : upper;
  return 0.5 * (lower + upper) * tick_s_;
}

}  // namespace banyan::measure
