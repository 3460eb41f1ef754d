// SPDX-License-Identifier: MIT
// Geometry of discs, boxes and walls: do they block a line of sight, do they touch a robot.
#pragma once

#include <span>
#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::world {

// Whether the open segment a-b meets the obstacle. Symmetric in a and b to the last bit.
[[nodiscard]] bool blocks(const Obstacle& obstacle, Vec2 a, Vec2 b) noexcept;

// No more than the distance between the segment a-b and the obstacle, which does not block it; 0 if they touch.
[[nodiscard]] double gap(const Obstacle& obstacle, Vec2 a, Vec2 b) noexcept;

// Distance of p to the obstacle's surface; negative inside a disc or box.
[[nodiscard]] double clearance(const Obstacle& obstacle, Vec2 p) noexcept;
// To the nearest of several; infinity if there are none.
[[nodiscard]] double clearance(std::span<const Obstacle> obstacles, Vec2 p) noexcept;

// The point of the obstacle's surface nearest to p, also from inside; the first of several in a
// fixed order (the side to the right, the positive x axis).
[[nodiscard]] Vec2 nearest_surface_point(const Obstacle& obstacle, Vec2 p) noexcept;

// The shortest shift that brings a disc of `radius` at p out of the obstacle; zero if it is out.
[[nodiscard]] Vec2 push_out(const Obstacle& obstacle, Vec2 p, double radius) noexcept;

// Of a wall, its middle.
[[nodiscard]] Vec2 center_of(const Obstacle& obstacle) noexcept;

// The same obstacle with its centre, of a wall the middle, at `center`; it is not turned.
[[nodiscard]] Obstacle moved(const Obstacle& obstacle, Vec2 center) noexcept;

// What an event makes of the obstacles there are. False: it is none of theirs, or refers to one that is not there.
bool change(std::vector<Obstacle>& obstacles, const Action& action);

}  // namespace banyan::world
