// SPDX-License-Identifier: MIT
#include "free_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cells.hpp"

namespace banyan::soak {
namespace {

using world::Vec2;

constexpr double touch_m = 1e-9;  // a way may touch an obstacle and pass between two that touch
constexpr int disc_corners = 24;

// Corners, anticlockwise. A wall has two.
using Polygon = std::vector<Vec2>;

// Positive to the left of the line.
double side(Vec2 from, Vec2 to, Vec2 point) {
  const Vec2 along = to - from, off = point - from;
  return along.x * off.y - along.y * off.x;
}

Polygon polygon_of(const world::Disc& disc) {
  Polygon corners;
  for (int k = 0; k < disc_corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / disc_corners;
    corners.push_back(disc.center + Vec2{std::cos(angle), std::sin(angle)} * disc.radius_m);
  }
  return corners;
}
Polygon polygon_of(const world::Box& box) {
  const Vec2 along = Vec2{std::cos(box.angle_rad), std::sin(box.angle_rad)} * (0.5 * box.size.x);
  const Vec2 across = Vec2{-std::sin(box.angle_rad), std::cos(box.angle_rad)} * (0.5 * box.size.y);
  return {box.center - along - across, box.center + along - across, box.center + along + across,
          box.center - along + across};
}
Polygon polygon_of(const world::Wall& wall) { return {wall.from, wall.to}; }

template <class Shape> void add_polygons(const Shape& shape, std::vector<Polygon>& polygons) {
  polygons.push_back(polygon_of(shape));
}
void add_polygons(const world::FloorMap& map, std::vector<Polygon>& polygons) {
  for (const world::Box& cell : cells_of(map)) polygons.push_back(polygon_of(cell));
}

bool crosses_wall(Vec2 a, Vec2 b, Vec2 from, Vec2 to) {
  const double a_side = side(from, to, a), b_side = side(from, to, b), from_side = side(a, b, from),
               to_side = side(a, b, to);
  return std::min(std::abs(a_side), std::abs(b_side)) > touch_m &&
         std::min(std::abs(from_side), std::abs(to_side)) > touch_m && (a_side > 0.0) != (b_side > 0.0) &&
         (from_side > 0.0) != (to_side > 0.0);
}

// Whether a piece of the way lies within (Cyrus and Beck: what is left of it, cut by one edge after the other).
bool passes_through(Vec2 a, Vec2 b, const Polygon& polygon) {
  if (polygon.size() == 2) return crosses_wall(a, b, polygon[0], polygon[1]);
  double begin = 0.0, end = 1.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 from = polygon[k], to = polygon[(k + 1) % polygon.size()];
    const double inside_a = side(from, to, a) - touch_m, inside_b = side(from, to, b) - touch_m;
    if (inside_a <= 0.0 && inside_b <= 0.0) return false;
    if (inside_a <= 0.0) begin = std::max(begin, inside_a / (inside_a - inside_b));
    if (inside_b <= 0.0) end = std::min(end, inside_a / (inside_a - inside_b));
  }
  return (end - begin) * norm(b - a) > 1e-6;
}

}  // namespace

double free_path_m(const std::vector<world::Obstacle>& obstacles, Vec2 from, Vec2 to) {
  std::vector<Polygon> polygons;
  std::vector<Vec2> points{from, to};
  for (const world::Obstacle& obstacle : obstacles) {
    std::visit([&](const auto& o) { add_polygons(o, polygons); }, obstacle);
  }
  for (const Polygon& polygon : polygons) points.insert(points.end(), polygon.begin(), polygon.end());
  const auto is_free = [&](Vec2 a, Vec2 b) {
    return std::none_of(polygons.begin(), polygons.end(), [&](const Polygon& p) { return passes_through(a, b, p); });
  };
  if (is_free(from, to)) return norm(to - from);
  // Dijkstra; edges are looked at when a point is left.
  std::vector<double> way(points.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> left(points.size());
  way[0] = 0.0;
  while (true) {
    std::size_t next = points.size();
    for (std::size_t k = 0; k < points.size(); ++k)
      if (!left[k] && std::isfinite(way[k]) && (next == points.size() || way[k] < way[next])) next = k;
    if (next == points.size() || next == 1) return way[1];
    left[next] = true;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double length = way[next] + norm(points[k] - points[next]);
      if (!left[k] && length < way[k] && is_free(points[next], points[k])) way[k] = length;
    }
  }
}

}  // namespace banyan::soak
