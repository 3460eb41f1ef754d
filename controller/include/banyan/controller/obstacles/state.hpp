// SPDX-License-Identifier: MIT
// What a robot remembers and tells of obstacles.
#pragma once

#include <array>
#include <cstdint>

#include "banyan/controller/core/fixed_point.hpp"
#include "banyan/controller/core/neighbors.hpp"

namespace banyan {

// A way round an obstacle that a robot is driving; vectors in its own frame, C.
struct Detour {
  std::int8_t side = 0;       // +1: the obstacle is to the right, -1: to the left, 0: no detour
  std::int8_t last_side = 0;  // of the one that ended near here; 0: none did
  bool again = false;         // it continues one that ended in vain
  Vec2 contact;               // where the obstacle was touched last
  Vec2 origin;                // where the detour began
  Vec2 goal;                  // as it was then
  float leave = 0.0F;         // the detour is over when the goal is nearer than this
  float span = 0.0F;          // this far from the origin the other side is tried
};

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

}  // namespace banyan
