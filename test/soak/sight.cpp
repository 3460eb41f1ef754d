// SPDX-License-Identifier: MIT
#include "sight.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cells.hpp"

namespace banyan::soak {
namespace {

using namespace world;
using world::Vec2;

constexpr double slack_m = 1e-3;
constexpr double rounding_m = 1e-9;

double cross(Vec2 a, Vec2 b) noexcept { return a.x * b.y - a.y * b.x; }

double to_segment(Vec2 p, Vec2 a, Vec2 b) noexcept {
  const Vec2 along = b - a;
  const double length2 = squared_norm(along);
  const double t = length2 > 0.0 ? std::clamp(((p - a).x * along.x + (p - a).y * along.y) / length2, 0.0, 1.0) : 0.0;
  return distance(p, a + t * along);
}

bool cross_each_other(Vec2 a, Vec2 b, Vec2 c, Vec2 d) noexcept {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

struct Cuts {
  Vec2 a, b;
  bool operator()(const Disc& disc) const { return to_segment(disc.center, a, b) < disc.radius_m - slack_m; }
  bool operator()(const Wall& wall) const { return cross_each_other(a, b, wall.from, wall.to); }
  // A line through a box has corners on both sides, so it crosses a diagonal; of a box a little smaller.
  bool operator()(const Box& box) const {
    const Vec2 x{std::cos(box.angle_rad), std::sin(box.angle_rad)};
    const Vec2 y{-x.y, x.x};
    const Vec2 right = x * (0.5 * box.size.x - slack_m);
    const Vec2 up = y * (0.5 * box.size.y - slack_m);
    return cross_each_other(a, b, box.center - right - up, box.center + right + up) ||
           cross_each_other(a, b, box.center - right + up, box.center + right - up);
  }
  bool operator()(const FloorMap& map) const {  // cell by cell
    const std::vector<Box> cells = cells_of(map);
    return std::any_of(cells.begin(), cells.end(), *this);
  }
};

class Union {
 public:
  explicit Union(std::size_t n) : up_(n) { std::iota(up_.begin(), up_.end(), std::size_t{0}); }
  std::size_t top(std::size_t i) {
    while (up_[i] != i) i = up_[i] = up_[up_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) { up_[top(i)] = top(j); }

 private:
  std::vector<std::size_t> up_;
};

}  // namespace

bool SightCheck::in_range(std::size_t i, std::size_t j) const noexcept {
  return distance(world_.positions()[i], world_.positions()[j]) < range_m() + rounding_m;
}

bool SightCheck::hidden(std::size_t i, std::size_t j) const noexcept {
  const Vec2 a = world_.positions()[i];
  const Vec2 b = world_.positions()[j];
  const RobotModel& robot = world_.scenario().robot;
  for (std::size_t k = 0; k < world_.size(); ++k) {
    if (k == i || k == j || (world_.alive()[k] == 0 && !robot.dead_bodies)) continue;
    if (to_segment(world_.positions()[k], a, b) < robot.radius_m - slack_m) return true;
  }
  const Cuts cuts{a, b};
  return std::any_of(world_.obstacles().begin(), world_.obstacles().end(),
                     [&](const Obstacle& o) { return std::visit(cuts, o); });
}

bool SightCheck::radio_reaches(std::size_t i, std::size_t j) const noexcept {
  return !world_.line_of_sight() || !hidden(i, j);
}

std::vector<double> SightCheck::link_lengths_m() const {
  std::vector<double> lengths_m;
  for (std::size_t i = 0; i < world_.size(); ++i)
    for (std::size_t j = i + 1; j < world_.size(); ++j)
      if (in_range(i, j) && radio_reaches(i, j))
        lengths_m.push_back(distance(world_.positions()[i], world_.positions()[j]));
  return lengths_m;
}

std::size_t SightCheck::components(const std::vector<bool>& counts, bool with_sight) const {
  return components_over(counts, [&](std::size_t i, std::size_t j) { return !with_sight || !hidden(i, j); });
}

std::size_t SightCheck::components_within(const std::vector<bool>& counts, double longest_m) const {
  return components_over(counts, [&](std::size_t i, std::size_t j) {
    return distance(world_.positions()[i], world_.positions()[j]) <= longest_m && radio_reaches(i, j);
  });
}

std::size_t SightCheck::components_both_ways(const std::vector<bool>& counts) const {
  return components_over(counts, [&](std::size_t i, std::size_t j) {
    return !world_.is_deaf(i, j) && !world_.is_deaf(j, i) && radio_reaches(i, j);
  });
}

// Robots in order of x, so that only those within range in x are looked at; the pair is asked for only where it could
// join two components.
template <class Linked> std::size_t SightCheck::components_over(const std::vector<bool>& counts, Linked linked) const {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i]) order.push_back(i);
  const auto x = [this](std::size_t i) { return world_.positions()[i].x; };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return x(i) < x(j); });
  Union parts(counts.size());
  std::size_t left = order.size();
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a + 1; b < order.size() && x(order[b]) - x(order[a]) < range_m() + rounding_m; ++b) {
      const std::size_t i = order[a];
      const std::size_t j = order[b];
      if (parts.top(i) == parts.top(j) || !in_range(i, j) || !linked(i, j)) continue;
      parts.join(i, j);
      --left;
    }
  return left;
}

}  // namespace banyan::soak
