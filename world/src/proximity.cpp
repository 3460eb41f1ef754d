// SPDX-License-Identifier: MIT
#include "proximity.hpp"

#include <algorithm>

#include "banyan/world/obstacles.hpp"

namespace banyan::world {
namespace {

constexpr double rounding = 1e-9;  // of lengths in a world of that size, and far more

struct Enclose {
  std::pair<Vec2, double> operator()(const Disc& disc) const { return {disc.center, disc.radius_m}; }
  std::pair<Vec2, double> operator()(const Box& box) const { return {box.center, 0.5 * norm(box.size)}; }
  std::pair<Vec2, double> operator()(const Wall& wall) const {
    return {(wall.from + wall.to) * 0.5, 0.5 * distance(wall.from, wall.to)};
  }
};

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
    const auto [center, radius] = std::visit(Enclose{}, obstacle);
    around_.push_back({center, (radius + reach_m_) * (1.0 + rounding) - reach_m_});
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

std::size_t Proximity::sense(const Poses& poses, std::size_t i, Seen& seen) const noexcept {
  if (obstacles_.empty() && dead_.empty()) return 0;
  const Vec2 here = poses.position[i];
  Nearest nearest(reach_m_);
  for (std::size_t k = 0; k < obstacles_.size(); ++k) {
    const double far = around_[k].radius_m + reach_m_;
    if (squared_norm(around_[k].center - here) <= far * far)
      nearest.offer(nearest_surface_point(obstacles_[k], here) - here, k);
  }
  const double far = reach_m_ + radius_m_;
  auto body = std::lower_bound(dead_.begin(), dead_.end(), here.x - far,
                               [](const Body& b, double x) { return b.position.x < x; });
  for (; body != dead_.end() && body->position.x <= here.x + far; ++body)
    nearest.offer(nearest_surface_point(Disc{body->position, radius_m_}, here) - here, obstacles_.size() + body->index);
  return nearest.write(poses.heading[i], seen);
}

}  // namespace banyan::world
