// SPDX-License-Identifier: MIT
// Geometry of discs, boxes, walls and maps: do they block a line of sight, do they touch a robot.
#pragma once

#include <span>
#include <vector>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

// Whether the open segment a-b meets the obstacle. Symmetric in a and b to the last bit.
[[nodiscard]] bool blocks(const Obstacle& obstacle, Vec2 a, Vec2 b) noexcept;

// No more than the distance between the segment a-b and the obstacle, which does not block it; 0 if they touch.
[[nodiscard]] double gap(const Obstacle& obstacle, Vec2 a, Vec2 b) noexcept;

// Distance of p to the obstacle's surface; negative inside a disc, a box or the cells of a map.
[[nodiscard]] double clearance(const Obstacle& obstacle, Vec2 p) noexcept;
// To the nearest of several; infinity if there are none.
[[nodiscard]] double clearance(std::span<const Obstacle> obstacles, Vec2 p) noexcept;

// False only if no point of the obstacle is nearer to p than `distance_m`.
[[nodiscard]] bool may_be_nearer(const Obstacle& obstacle, Vec2 p, double distance_m) noexcept;

// A disc that holds the obstacle.
[[nodiscard]] Disc enclosing(const Obstacle& obstacle) noexcept;

// The point of the obstacle's surface nearest to p, also from inside; the first of several in a
// fixed order (the side to the right, the positive x axis).
[[nodiscard]] Vec2 nearest_surface_point(const Obstacle& obstacle, Vec2 p) noexcept;

// The shortest shift that brings a disc of `radius` at p out of the obstacle; zero if it is out.
[[nodiscard]] Vec2 push_out(const Obstacle& obstacle, Vec2 p, double radius) noexcept;

// Calls visit(point) with the nearest point of each cell of the map no farther from p than `farthest_m`.
template <class Visit> void each_near(const FloorMap& map, Vec2 p, double farthest_m, const Visit& visit);

// Of a wall, its middle; of a map, that of all its cells.
[[nodiscard]] Vec2 center_of(const Obstacle& obstacle) noexcept;

// The same obstacle with its centre, of a wall the middle, at `center`; it is not turned.
[[nodiscard]] Obstacle moved(const Obstacle& obstacle, Vec2 center) noexcept;

// A map's cells as the plane they lie in: from metres to cells and back.
class CellFrame {
 public:
  explicit CellFrame(const FloorMap& map) noexcept;
  [[nodiscard]] Vec2 in_cells(Vec2 p) const noexcept { return rotate_back(rotation_, p - origin_) / cell_m_; }
  [[nodiscard]] Vec2 in_metres(Vec2 p) const noexcept { return origin_ + shift_m(p); }
  [[nodiscard]] Vec2 shift_m(Vec2 cells) const noexcept { return rotate(rotation_, cells * cell_m_); }

 private:
  Vec2 rotation_, origin_;
  double cell_m_;
};

template <class Visit> void each_near(const FloorMap& map, Vec2 p, double farthest_m, const Visit& visit) {
  const CellFrame frame(map);
  map.cells->each_near(frame.in_cells(p), farthest_m / map.cell_m, [&](Vec2 q) { visit(frame.in_metres(q)); });
}

// What an event makes of the obstacles there are. False: it is none of theirs, or refers to one that is not there.
bool change(std::vector<Obstacle>& obstacles, const Action& action);

}  // namespace banyan::world
