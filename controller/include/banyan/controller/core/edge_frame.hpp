// SPDX-License-Identifier: MIT
// Vectors in messages (protocol 1). Robots share no compass, but the two ends of an edge share the
// edge: a vector sent from j to i is written with the x axis along the direction from j to i. No
// table of mutual bearings and no extra byte is needed.
#pragma once

#include <cstdint>

#include "banyan/controller/core/fixed_point.hpp"
#include "banyan/controller/core/vec2.hpp"

namespace banyan {

// Sender: `v` in its own frame, the addressee at `addressee`.
[[nodiscard]] inline Vec2 to_edge_frame(Vec2 v, Vec2 addressee) noexcept { return rotate_back(unit(addressee), v); }

// The same, as it travels: in whole multiples of 1 / `unit`.
inline void write_in_edge_frame(Vec2 v, Vec2 addressee, float unit, std::int16_t& x, std::int16_t& y) noexcept {
  v = to_edge_frame(v, addressee);
  x = to_fixed<std::int16_t>(v.x, unit);
  y = to_fixed<std::int16_t>(v.y, unit);
}

// A place, in C.
inline void write_in_edge_frame(Vec2 place, Vec2 addressee, Coordinate& x, Coordinate& y) noexcept {
  place = to_edge_frame(place, addressee);
  x = Coordinate::of(place.x);
  y = Coordinate::of(place.y);
}

// Addressee: `v` as received, the sender at `sender` in its own frame. A rotation: a point needs the
// sender's subtraction of the addressee's position first.
[[nodiscard]] inline Vec2 from_edge_frame(Vec2 v, Vec2 sender) noexcept { return rotate(-unit(sender), v); }

}  // namespace banyan
