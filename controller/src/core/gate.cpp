// SPDX-License-Identifier: MIT
#include "banyan/controller/core/gate.hpp"

#include <algorithm>

namespace banyan {
namespace {

// Counted from ahead to the left, equally many in each quadrant, and no more than half as wide again as they would be
// if all were equal.
std::size_t direction_of(Vec2 point) noexcept {
  constexpr float per_quadrant = static_cast<float>(most_obstacles) / 4.0F;
  const float sum = std::fabs(point.x) + std::fabs(point.y);
  if (sum == 0.0F) return 0;
  const float slope = point.y / sum;
  const float quadrants = point.x < 0.0F ? 2.0F - slope : slope < 0.0F ? 4.0F + slope : slope;
  return std::min(most_obstacles - 1, static_cast<std::size_t>(quadrants * per_quadrant));
}

}  // namespace

Gate::Gate(const Senses& senses, const Platform& platform) noexcept
    : per_metre_(1.0F / platform.communication_range_m),
      moved_(Vec2{senses.odometry.forward_m, senses.odometry.sideways_m} * per_metre_),
      turn_rad_(senses.odometry.turn_rad),
      orders_(senses.orders),
      charge_(senses.charge) {
  if (!is_within(moved_, farthest_ranges) || !(std::fabs(turn_rad_) <= largest_turn_rad)) {
    moved_ = {};
    turn_rad_ = 0.0F;
    ++rejected_;
  }
  if (orders_.target) {
    *orders_.target *= per_metre_;
    if (!is_within(*orders_.target, farthest_place)) {
      orders_.target.reset();
      ++rejected_;
    }
  }
  if (charge_ && !charge_->is_possible()) {
    charge_.reset();
    ++rejected_;
  }
  const float rounds = senses.elapsed_s / platform.tick_s;
  if (!(rounds >= 0.0F && rounds <= longest_step_ticks)) {
    ++rejected_;
  } else if (rounds > 0.0F) {
    elapsed_ = rounds;
    elapsed_ticks_ = std::max(1, static_cast<int>(rounds + 0.5F));
  }
  if (orders_.station && orders_.sent && !orders_.target) orders_.target = way_of_station(platform);
  if (!senses.obstacles.empty()) admit_obstacles(senses.obstacles);
}

// A station that moves goes on like that, as far as anybody can tell: the others are to follow. One that stands is
// where it has to be.
Vec2 Gate::way_of_station(const Platform& platform) const noexcept {
  constexpr float ahead = 0.5F;   // C
  constexpr float least = 0.01F;  // of full speed: less is what a tracker trembles
  const float full = platform.wheel_limit_m_s * platform.tick_s * per_metre_ * elapsed_;
  if (norm(moved_) < least * full) return {};
  return rotate_back(unit_vector(turn_rad_), unit(moved_)) * ahead;
}

// Of more than there is room for, as a lidar has them, the nearest one in each of so many directions is kept: it hides
// the others. They are not rejected.
void Gate::admit_obstacles(std::span<const Vec2> obstacles) noexcept {
  std::array<Vec2, most_obstacles>& passed = room_.emplace();
  std::size_t possible = 0;
  for (const Vec2 o : obstacles) {
    const Vec2 point = o * per_metre_;
    if (!is_within(point, farthest_ranges)) ++rejected_;
    else if (possible++ < most_obstacles) passed[possible - 1] = point;
  }
  obstacles_ = std::span<const Vec2>(passed).first(std::min(possible, most_obstacles));
  if (possible <= most_obstacles) return;
  passed.fill({2.0F * farthest_ranges, 0.0F});
  for (const Vec2 o : obstacles) {
    const Vec2 point = o * per_metre_;
    if (!is_within(point, farthest_ranges)) continue;
    Vec2& nearest = passed[direction_of(point)];
    if (squared_norm(point) < squared_norm(nearest)) nearest = point;
  }
  const auto end = std::remove_if(passed.begin(), passed.end(),
                                  [](Vec2 point) { return squared_norm(point) > farthest_ranges * farthest_ranges; });
  obstacles_ = std::span<const Vec2>(passed).first(static_cast<std::size_t>(end - passed.begin()));
}

// What is left of the odometry, which is in the frame at the last step, is turned into the frame of the packet.
Vec2 Gate::carried_to_now(Vec2 position, float rounds) const noexcept {
  const float share = std::min(rounds / elapsed_, 1.0F);
  const Vec2 shift = rotate_back(unit_vector(turn_rad_ * (1.0F - share)), moved_ * share);
  return Carry(shift, turn_rad_ * share).point(position);
}

}  // namespace banyan
