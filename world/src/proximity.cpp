// SPDX-License-Identifier: MIT
#include "proximity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "banyan/world/obstacles.hpp"

namespace banyan::world {
namespace {

constexpr double rounding = 1e-9;  // of lengths in a world of that size, and far more

// Which eighth of the plane a direction is in, by the signs of its parts and which is larger.
std::size_t eighth(Vec2 d) noexcept {
  return (d.x < 0.0 ? 1U : 0U) | (d.y < 0.0 ? 2U : 0U) | (std::abs(d.x) < std::abs(d.y) ? 4U : 0U);
}

}  // namespace

// The nearest few so far, ascending by (distance, order of arrival).
class Proximity::Nearest {
 public:
  explicit Nearest(double reach_m) noexcept : limit_(reach_m * reach_m) {}
  void offer(Vec2 d, std::uint64_t order) noexcept {
    const Sight sight{squared_norm(d), order, d};
    if (sight.d2 > limit_) return;
    std::size_t k = size_ < capacity ? size_++ : capacity;
    if (k == capacity && !before(sight, sights_[--k])) return;
    for (; k > 0 && before(sight, sights_[k - 1]); --k) sights_[k] = sights_[k - 1];
    sights_[k] = sight;
  }
  std::size_t write(Vec2 heading, Seen& seen) const noexcept {
    for (std::size_t k = 0; k < size_; ++k) {
      const Vec2 d = rotate_back(heading, sights_[k].d);
      seen[k] = {static_cast<float>(d.x), static_cast<float>(d.y)};
    }
    return size_;
  }

 private:
  struct Sight {
    double d2;
    std::uint64_t order;
    Vec2 d;
  };
  static bool before(const Sight& a, const Sight& b) noexcept { return a.d2 != b.d2 ? a.d2 < b.d2 : a.order < b.order; }
  double limit_;
  std::size_t size_ = 0;
  std::array<Sight, capacity> sights_;  // the first `size_` are valid
};

Proximity::Proximity(const Scenario& scenario)
    : reach_m_(proximity_m(scenario)),
      radius_m_(scenario.robot.radius_m),
      sees_dead_(scenario.robot.dead_bodies && reach_m_ > 0.0) {
  set_obstacles(scenario.obstacles);
}

void Proximity::set_obstacles(std::span<const Obstacle> obstacles) {
  if (reach_m_ == 0.0) return;
  obstacles_.assign(obstacles.begin(), obstacles.end());
  around_.clear();
  for (const Obstacle& obstacle : obstacles_) {
    const Disc disc = enclosing(obstacle);
    around_.push_back({disc.center, (disc.radius_m + reach_m_) * (1.0 + rounding) - reach_m_});
  }
}

void Proximity::update(std::span<const Vec2> positions, std::span<const std::uint8_t> alive, std::size_t dead) {
  if (!sees_dead_ || dead == 0) return;
  dead_.clear();
  dead_.reserve(dead);
  for (std::uint32_t i = 0; i < positions.size(); ++i)
    if (alive[i] == 0) dead_.push_back({positions[i], i});
  std::sort(dead_.begin(), dead_.end(), [](const Body& a, const Body& b) {
    return a.position.x != b.position.x ? a.position.x < b.position.x : a.index < b.index;
  });
}

// A map is around a robot on all sides: what counts is its nearest point in each eighth of the plane.
void Proximity::see_map(const FloorMap& map, Vec2 here, std::size_t index, Nearest& nearest) const noexcept {
  if (!may_be_nearer(map, here, reach_m_)) return;
  std::array<Vec2, 8> least{};
  std::array<double, 8> least2;
  least2.fill(std::numeric_limits<double>::infinity());
  each_near(map, here, reach_m_, [&](Vec2 point) {
    const Vec2 d = point - here;
    const std::size_t side = eighth(d);
    if (squared_norm(d) >= least2[side]) return;
    least[side] = d;
    least2[side] = squared_norm(d);
  });
  for (std::size_t side = 0; side < least.size(); ++side)
    if (least2[side] <= reach_m_ * reach_m_) nearest.offer(least[side], index);
}

std::size_t Proximity::sense(const Poses& poses, std::size_t i, Seen& seen) const noexcept {
  if (obstacles_.empty() && dead_.empty()) return 0;
  const Vec2 here = poses.position[i];
  Nearest nearest(reach_m_);
  for (std::size_t k = 0; k < obstacles_.size(); ++k) {
    const double far = around_[k].radius_m + reach_m_;
    if (squared_norm(around_[k].center - here) > far * far) continue;
    if (const auto* map = std::get_if<FloorMap>(&obstacles_[k])) see_map(*map, here, k, nearest);
    else nearest.offer(nearest_surface_point(obstacles_[k], here) - here, k);
  }
  const double far = reach_m_ + radius_m_;
  auto body = std::lower_bound(dead_.begin(), dead_.end(), here.x - far,
                               [](const Body& b, double x) { return b.position.x < x; });
  for (; body != dead_.end() && body->position.x <= here.x + far; ++body)
    nearest.offer(nearest_surface_point(Disc{body->position, radius_m_}, here) - here, obstacles_.size() + body->index);
  return nearest.write(poses.heading[i], seen);
}

}  // namespace banyan::world
