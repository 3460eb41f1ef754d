// SPDX-License-Identifier: MIT
// Neighbours half the longest link apart (Olfati-Saber 2006), moving alike; and as many robots on an area as desired.
#include <algorithm>
#include <cmath>

#include "rooms.hpp"

namespace banyan::baselines::cohesion {
namespace {

// ---- The lattice: Olfati-Saber's (5) to (15), with his epsilon = 1, a = 5, b = 8 ----

constexpr float attraction = 5.0F;            // his a
constexpr float repulsion = 8.0F;             // his b
constexpr float offset = 0.23717082F;         // his c = |a - b| / sqrt(4 a b)
constexpr float reach = 0.56204994F;          // sigma norm of the longest link, 1.2
constexpr float rest = 0.16619038F;           // and of half of it
constexpr float full = 0.05F / source_range;  // links up to so much of the reach count fully

float sigma_norm(float d) noexcept { return std::sqrt(1.0F + d * d) - 1.0F; }

float bump(float z) noexcept {
  if (z < full) return 1.0F;
  return z < 1.0F ? 0.5F * (1.0F + unit_vector(pi<float> * (z - full) / (1.0F - full)).x) : 0.0F;
}

// Towards the neighbour where it is positive.
float action(float z) noexcept {
  const float shifted = z - rest + offset;
  return 0.5F * ((attraction + repulsion) * shifted / std::sqrt(1.0F + shifted * shifted) + attraction - repulsion);
}

// ---- Density ----

constexpr float body = 0.05F;                              // radius, hiding what is behind it
constexpr float least_area = 1e-3F;                        // to divide by
constexpr float per_square = source_range * source_range;  // densities are told per square of the longest link
constexpr float most_density = 255.0F / per_density;

// Robots that are very near count more.
float weight(float d) noexcept {
  float w = 1.0F;
  if (d < 0.25F * source_range) w += 0.1F;
  if (d < 0.2F * source_range) w += 0.3F;
  if (d < 0.15F * source_range) w += 0.9F;
  if (d * d < 0.015F * per_square) w += 2.7F;
  return w;
}

// What is seen: up to neighbours' bodies, between them up to the longest link. Of the widest sector of a large boundary
// as much as of others on average.
float visible_area(const Robot& robot, const Boundary& boundary) noexcept {
  const Surroundings& around = robot.around;
  const float hiding = robot.params.line_of_sight ? body : 0.0F;
  const Sector* const outside = boundary.is_large() ? boundary.sectors.data() : nullptr;
  float bodies = 0.0F, between = 0.0F;
  int counted = 0;
  bool left_out = false;
  const auto hidden = [&](float d) { return angle_of(Vec2{d, hiding}); };
  float d = norm(around.place(around.next(0)));
  float half = hidden(d);
  for (int i = 0; i < around.size; ++i) {
    const float next_d = norm(around.place(around.next(i + 1)));
    const float next_half = hidden(next_d);
    const float clear = around.gap(i) - half - next_half;
    bodies += d * d * half;
    if (outside != nullptr && outside->right == around.next(i)) {
      left_out = true;
    } else if (clear > 0.0F) {
      between += 0.5F * clear * per_square;
      ++counted;
    } else {
      const float longer = std::max(d, next_d);
      bodies += 0.5F * clear * longer * longer;
    }
    d = next_d;
    half = next_half;
  }
  if (left_out && counted > 0) between += between / static_cast<float>(counted);
  return std::max(bodies + between, least_area);
}

}  // namespace

// (3)
Vec2 lattice_force(const Robot& robot, Vec2 velocity) noexcept {
  Vec2 lattice, others;
  for (int k = 0; k < robot.around.size; ++k) {
    const Vec2 q = robot.around.place(k);
    const float z = sigma_norm(norm(q));
    const float near = bump(z / reach);
    lattice += q * (near * action(z) / std::sqrt(1.0F + squared_norm(q)));
    const Vec2 frame = robot.around.frame(k);
    if (frame == Vec2{}) continue;
    others += (rotate(frame, robot.message(k).velocity.in_frame()) - velocity) * near;
  }
  if (robot.around.size > 0) others = others / static_cast<float>(robot.around.size);
  return lattice * robot.params.lattice_gain + others;
}

// (8)
Density find_density(const Robot& robot, const Boundary& boundary) noexcept {
  Density found;
  if (robot.around.size < 2) return found;
  float robots = 0.0F, least = most_density, most = 0.0F;
  for (int k = 0; k < robot.around.size; ++k) {
    const float d = norm(robot.around.place(k));
    robots += weight(d);
    const float theirs = static_cast<float>(robot.message(k).density) / per_density;
    least = std::min(least, theirs);
    most = std::max(most, theirs);
    const float lack = (robot.params.desired_density - theirs) / per_square;
    const float share = std::min(1.0F, d / source_range);
    const float pull = 2.0F * lack * std::fabs(lack) * (lack < 0.0F ? 1.0F - share : share);
    found.force += unit(robot.around.place(k)) * pull;
  }
  const float mine = std::min(robots / visible_area(robot, boundary) * per_square, most_density);
  found.said = to_fixed<std::uint8_t>((mine + least + most) / 3.0F, per_density);
  found.force *= robot.params.density_gain;
  return found;
}

}  // namespace banyan::baselines::cohesion
