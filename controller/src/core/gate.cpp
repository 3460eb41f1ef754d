// SPDX-License-Identifier: MIT
#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/search.hpp"

#include <algorithm>

namespace banyan {

Gate::Gate(const Senses& senses, const Platform& platform) noexcept : senses_(senses) {
  const float limit_m = farthest_ranges * platform.communication_range_m;
  const Odometry& moved = senses.odometry;
  if (!is_within({moved.forward_m, moved.sideways_m}, limit_m) || !(std::fabs(moved.turn_rad) <= largest_turn_rad)) {
    senses_.odometry = {};
    ++rejected_;
  }
  if (senses.orders.target && !is_within(*senses.orders.target, farthest_target_m)) {
    senses_.orders.target.reset();
    ++rejected_;
  }
  senses_.for_each_reading([this](auto& reading) {
    if (!reading || reading->is_possible()) return;
    reading.reset();
    ++rejected_;
  });
  if (senses.elapsed_s >= 0.0F && senses.elapsed_s <= longest_step_s) {
    elapsed_ticks_ = std::max(1, platform.ticks(senses.elapsed_s));
  } else {
    senses_.elapsed_s = 0.0F;
    ++rejected_;
  }
  admit_obstacles(limit_m);
}

// Valid readings stay where they are, unless some of them must be removed. Of more than there is room for the first are
// kept; the others are not rejected, since a good sensor may well see so many.
void Gate::admit_obstacles(float limit_m) noexcept {
  const auto passes = [&](Vec2 o) { return is_within(o, limit_m); };
  const std::span<const Vec2> all = senses_.obstacles;
  if (all.size() <= most_obstacles && banyan::all_of(all, passes)) return;
  std::array<Vec2, most_obstacles>& passed = obstacles_.emplace();
  std::size_t kept = 0;
  for (const Vec2 o : all) {
    if (!passes(o)) ++rejected_;
    else if (kept < most_obstacles) passed[kept++] = o;
  }
  senses_.obstacles = std::span<const Vec2>(passed).first(kept);
}

}  // namespace banyan
