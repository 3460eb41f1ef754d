// SPDX-License-Identifier: MIT
// What hides an edge: robots beside it, and corners of obstacles that were passed.
#include "caravan/rules.hpp"

namespace banyan::caravan {
namespace {

constexpr float costs_hidden = 5.0F;  // C: the line is blocked
constexpr float corner_room = 0.05F;  // an edge has to pass a corner so far off

// The point of the line from me to `to` that is nearest to corner `c`, as a share of the way; and how far off it is.
struct Passing {
  float share;
  Vec2 off;  // from that point to the corner
};
Passing passing(Vec2 to, Vec2 c) noexcept {
  const float share = std::clamp(dot(c, to) / std::max(squared_norm(to), 1e-6F), 0.0F, 1.0F);
  return {share, c - to * share};
}

// How far it is from the nearest of my edges: the farther, the less it matters.
float to_edges(const Robot& robot, Vec2 c) noexcept {
  float nearest = norm(c);
  const auto note = [&](int k) { nearest = std::min(nearest, distance_to_segment(c, Vec2{}, robot.position(k))); };
  if (robot.parent >= 0) note(robot.parent);
  robot.children.for_each(note);
  return nearest;
}

// Where there is no room, the one that matters least is dropped.
void file(Robot& robot, Vec2 c) noexcept {
  State& self = robot.self;
  std::size_t at = self.corner_count;
  for (std::size_t k = 0; k < self.corner_count; ++k)
    if (distance(self.corners[k], c) < corner_room) return;
  if (at == most_corners) {
    at = 0;
    for (std::size_t k = 1; k < most_corners; ++k)
      if (to_edges(robot, self.corners[k]) > to_edges(robot, self.corners[at])) at = k;
    if (to_edges(robot, c) >= to_edges(robot, self.corners[at])) return;
  } else if (at == self.corner_count) {
    ++self.corner_count;
  }
  self.corners[at] = c;
}

}  // namespace

// Those that I have passed, and those that others say are near their edges.
void remember_corners(Robot& robot) noexcept {
  State& self = robot.self;
  for (std::size_t k = 0; k < self.corner_count; ++k) self.corners[k] = robot.carry.point(self.corners[k]);
  if (!robot.params.line_of_sight) return;
  for (const Heard& h : robot.heard) {
    const Message& m = *h.message;
    if (m.corner_x.bits == 0 && m.corner_y.bits == 0) continue;
    const int up = robot.table().find(m.parent);
    if (m.parent != self.id && up < 0) continue;
    const Vec2 upper = m.parent == self.id ? Vec2{} : robot.position(up);
    file(robot, upper + from_edge_frame({m.corner_x.value(), m.corner_y.value()}, h.position - upper));
  }
  for (const Vec2 o : robot.obstacles) file(robot, o);
  self.pinned = false;
  if (robot.parent < 0 || !robot.is_wanted()) return;
  for (std::size_t k = 0; k < self.corner_count; ++k)
    if (const Passing by = passing(robot.position(robot.parent), self.corners[k]);
        by.share > 0.0F && by.share < 1.0F && norm(by.off) < corner_room)
      self.pinned = true;
}

void tell_corner(Robot& robot) noexcept {
  constexpr float near = 0.15F;  // C
  State& self = robot.self;
  self.corner_x = self.corner_y = {};
  if (robot.parent < 0) return;
  const Vec2 parent = robot.position(robot.parent);
  float best = near;
  for (std::size_t k = 0; k < self.corner_count; ++k) {
    const Passing by = passing(parent, self.corners[k]);
    if (by.share <= 0.0F || by.share >= 1.0F || norm(by.off) >= best) continue;
    best = norm(by.off);
    write_in_edge_frame(self.corners[k] - parent, parent, self.corner_x, self.corner_y);
  }
}

float hazard(const Robot& robot, int k) noexcept {
  const Table& table = robot.table();
  if (!robot.params.line_of_sight) return 0.0F;
  float share = 1.0F;  // of the clearance that is left
  for (int j = 0; j < table.size(); ++j)
    if (j != k && !robot.is_lost(j))
      share =
          std::min(share, distance_to_segment(table.position(j), Vec2{}, table.position(k)) / robot.params.clearance);
  for (std::size_t j = 0; j < robot.self.corner_count; ++j)
    if (const Passing by = passing(table.position(k), robot.self.corners[j]); by.share > 0.0F && by.share < 1.0F)
      share = std::min(share, norm(by.off) / corner_room);
  return costs_hidden * (1.0F - share);
}

void keep_sight(const Robot& robot, Guard& guard) noexcept {
  const Params& p = robot.params;
  if (!p.line_of_sight || robot.self.corner_count == 0 || robot.self.role == Role::spare) return;
  const auto keep = [&](int k) {
    for (std::size_t j = 0; j < robot.self.corner_count; ++j) {
      const Passing by = passing(robot.position(k), robot.self.corners[j]);
      const float d = norm(by.off);
      if (by.share <= 0.0F || by.share >= 1.0F || d > 0.2F || d <= 0.0F) continue;
      guard.add_limit(by.off / d, std::max(0.0F, d - 0.5F * corner_room) * p.guard_rate / (1.0F - by.share));
    }
  };
  if (robot.parent >= 0) keep(robot.parent);
  robot.children.for_each(keep);
}

}  // namespace banyan::caravan
