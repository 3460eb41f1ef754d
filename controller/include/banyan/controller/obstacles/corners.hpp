// SPDX-License-Identifier: MIT
// Lines of sight past obstacles: a robot remembers a few of the points that it has passed, so that no
// tree edge is cut by a corner. Children tell their parent of the corner nearest to their edge.
#pragma once

#include "banyan/controller/tree/robot.hpp"

namespace banyan {

struct Guard;  // motion.hpp

// What a robot broadcasts of this, and keeps of each neighbour.
struct CornerStanding {
  Coordinate hinge_x;  // the corner nearest to the edge to my parent - parent, edge frame; 0, 0: none known
  Coordinate hinge_y;
  bool pinned = false;  // a corner is about to cut the edge to my parent, and I still have to travel

  friend bool operator==(const CornerStanding&, const CornerStanding&) = default;
};

// The obstacles block, field by field (wire.hpp).
template <class Visitor, class M> constexpr void visit_corner_block(Visitor& visit, M& m) noexcept {
  visit.flag("pinned", "1: a corner is about to cut the edge to the parent", m.pinned);
  visit.coordinate(
      "hinge_x",
      "known obstacle point nearest to the edge to the parent, relative to the parent, along that edge; 0, 0: none",
      m.hinge_x);
  visit.coordinate("hinge_y", "the same, to the left of that edge", m.hinge_y);
}

// Points of obstacles that were sensed a while ago, in the own frame, C.
inline constexpr int landmark_capacity = 8;
struct Landmarks {
  std::array<Vec2, landmark_capacity> points{};  // the first `size` are valid
  std::uint8_t size = 0;
};

// Where tree neighbours fell silent in plain sight: their bodies have stayed there, between the robots that they
// joined. Centres, own frame, C.
inline constexpr int body_capacity = 4;
struct KnownBodies {
  std::array<Vec2, body_capacity> centers{};  // the first `size` are valid
  std::array<RobotId, body_capacity> ids{};
  std::uint8_t size = 0;
};

struct Corners {
  Landmarks landmarks;
  KnownBodies bodies;
  Vec2 seen_from;                                             // C, own frame: where I was when I last heard my parent
  bool pinned = false;                                        // a corner is about to cut the edge to my parent
  std::array<CornerStanding, neighbor_capacity> standings{};  // beside the neighbour table

  [[nodiscard]] const CornerStanding& of(int k) const noexcept { return standings[static_cast<std::size_t>(k)]; }
};

void carry_corners(Corners& corners, const Carry& carry) noexcept;

// Adds what is sensed this tick to the remembered points, and forgets those that have proved wrong.
// Once a tick, after the memory has been carried along.
void remember_corners(const TreeRobot& robot, Corners& corners) noexcept;

// The obstacle point nearest to the inside of the edge to my parent, own frame, C; false if none is near.
[[nodiscard]] bool find_hinge(const TreeRobot& robot, const Corners& corners, Vec2& hinge) noexcept;

// Half-planes that keep obstacles out of the lines of sight along the robot's tree edges.
void keep_sight(const TreeRobot& robot, const Corners& corners, Guard& guard) noexcept;

// Away from obstacles that are about to cut one of the robot's tree edges. In units of speed_gain.
[[nodiscard]] Vec2 clear_sight(const TreeRobot& robot, const Corners& corners) noexcept;

// An obstacle is about to cut the edge to the parent, and this robot has to travel, or is towed by a child farther
// away than `towing_start`: the parent has to come up to the corner.
[[nodiscard]] bool is_pinned(const TreeRobot& robot, const Corners& corners, float towing_start) noexcept;

// No obstacle known to me is nearer than `clearance` to the inside of segment a-b (own frame, C).
[[nodiscard]] bool is_free(const TreeRobot& robot, const Corners& corners, Vec2 a, Vec2 b, float clearance) noexcept;

}  // namespace banyan
