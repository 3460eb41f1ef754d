// SPDX-License-Identifier: MIT
// What hides an edge: robots beside it, and corners of obstacles that were passed.
#include "banyan/controller/caravan/caravan.hpp"

namespace banyan::caravan {
namespace {

constexpr float costs_hidden = 5.0F;  // C: the line is blocked
constexpr float corner_room = 0.05F;  // an edge has to pass a corner so far off
constexpr float same_corner = 0.1F;

// The point of the line from me to `to` that is nearest to corner `c`, as a share of the way; and how far off it is.
struct Passing {
  float share;
  Vec2 off;  // from that point to the corner
};
Passing passing(Vec2 to, Vec2 c) noexcept {
  const float share = std::clamp(dot(c, to) / std::max(squared_norm(to), 1e-6F), 0.0F, 1.0F);
  return {share, c - to * share};
}

}  // namespace

// The nearest are kept.
void remember_corners(Robot& robot) noexcept {
  State& self = robot.self;
  for (std::size_t k = 0; k < self.corner_count; ++k) self.corners[k] = robot.carry.point(self.corners[k]);
  for (const Vec2 o : robot.obstacles) {
    std::size_t at = self.corner_count;
    for (std::size_t k = 0; k < self.corner_count; ++k)
      if (distance(self.corners[k], o) < same_corner) at = k;
    if (at == most_corners) {
      at = 0;
      for (std::size_t k = 1; k < most_corners; ++k)
        if (norm(self.corners[k]) > norm(self.corners[at])) at = k;
    } else if (at == self.corner_count) {
      ++self.corner_count;
    }
    self.corners[at] = o;
  }
  self.pinned = false;
  if (!robot.params.line_of_sight || robot.parent < 0 || !robot.is_wanted()) return;
  for (std::size_t k = 0; k < self.corner_count; ++k)
    if (const Passing by = passing(robot.position(robot.parent), self.corners[k]);
        by.share > 0.0F && by.share < 1.0F && norm(by.off) < corner_room)
      self.pinned = true;
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
