// SPDX-License-Identifier: MIT
// The swarm's boundary (McLurkin & Demaine 2009): a robot is on it where two neighbours that follow one another around
// it are not linked, or are half a turn apart, and both know of such a gap themselves. Along a boundary the mean angle
// of the gaps tells whether it is the outer one or a hole's.
#include <algorithm>
#include <cmath>

#include "rooms.hpp"

namespace banyan::baselines::cohesion {
namespace {

constexpr float half_turn = pi<float>;
constexpr float nearly_straight = pi<float> / 8.0F;
constexpr float same_way = 0.01F;  // rad; a sector that ends in this direction is a whole turn away
constexpr float most_in_mean = 255.0F;

// Counter-clockwise from a to b, (0, 2 pi].
float turn(Vec2 a, Vec2 b) noexcept {
  const float t = angle_of(rotate_back(a, b));
  return t < same_way ? t + 2.0F * half_turn : t;
}

// Facing the sector from neighbour k, too, the boundary goes on with the first open sector from me: clockwise at its
// right end, counter-clockwise at its left.
const SaidSector* continuation(const Robot& robot, int k, bool is_right) noexcept {
  const Vec2 frame = robot.around.frame(k);
  const SaidSector* best = nullptr;
  float least = 0.0F;
  if (frame == Vec2{}) return best;
  for (const SaidSector& sector : robot.message(k).sectors) {
    if (!sector.is_open()) continue;
    const Mention& end = is_right ? sector.right : sector.left;
    const Vec2 way = rotate(frame, unit_vector(static_cast<float>(end.bearing) / per_rad));
    const Vec2 back = -robot.around.place(k);
    const float t = is_right ? turn(way, back) : turn(back, way);
    if (best != nullptr && t >= least) continue;
    best = &sector;
    least = t;
  }
  return best;
}

Mean mean_up_to(const Robot& robot, int k, float angle, bool is_right) noexcept {
  const SaidSector* const before = continuation(robot, k, is_right);
  if (before == nullptr) return {to_fixed<std::uint16_t>(angle, per_rad), 1};
  const Mean& mean = is_right ? before->right_mean : before->left_mean;
  const auto n = static_cast<float>(mean.sectors);
  return {to_fixed<std::uint16_t>((angle + n * mean.rad()) / (n + 1.0F), per_rad),
          to_fixed<std::uint8_t>(std::min(n + 1.0F, most_in_mean), 1.0F)};
}

// Of two angles.
float difference(float a, float b) noexcept {
  const float d = std::fabs(a - b);
  return std::min(d, std::fabs(2.0F * half_turn - d));
}

}  // namespace

float Sector::mean() const noexcept {
  const auto r = static_cast<float>(right_mean.sectors), l = static_cast<float>(left_mean.sectors);
  return (r * right_mean.rad() + l * left_mean.rad()) / (r + l);
}

bool Boundary::is_large() const noexcept {
  return std::any_of(sectors.begin(), sectors.begin() + size,
                     [](const Sector& s) { return std::fabs(s.mean() - half_turn) < nearly_straight; });
}

void Boundary::add(const Sector& sector) noexcept {
  if (size == most_sectors) return;
  auto at = static_cast<std::size_t>(size++);
  for (; at > 0 && sectors[at - 1].angle < sector.angle; --at) sectors[at] = sectors[at - 1];
  sectors[at] = sector;
}

Boundary find_boundary(const Robot& robot) noexcept {
  const Surroundings& around = robot.around;
  Boundary found;
  for (int i = 0; i < around.size; ++i) {
    const int right = around.next(i), left = around.next(i + 1);
    const float angle = around.gap(i);
    if (angle <= half_turn && distance(around.place(right), around.place(left)) < source_range) continue;
    found.candidate = true;
    if (!robot.message(right).candidate || !robot.message(left).candidate) continue;
    found.matching = true;
    if (!robot.message(right).matching || !robot.message(left).matching) continue;
    found.add({right, left, angle, mean_up_to(robot, right, angle, true), mean_up_to(robot, left, angle, false)});
  }
  return found;
}

// (4)
Vec2 boundary_tension(const Robot& robot, const Boundary& boundary) noexcept {
  Vec2 sum;
  for (int i = 0; i < boundary.size; ++i) {
    const Sector& s = boundary.sectors[static_cast<std::size_t>(i)];
    const float mean = s.mean();
    const float bend = mean > half_turn ? std::sqrt(difference(s.angle, mean)) : 1.0F;
    sum += (robot.around.place(s.right) + robot.around.place(s.left)) * (1.0F + bend);
  }
  return sum * robot.params.boundary_gain;
}

}  // namespace banyan::baselines::cohesion
