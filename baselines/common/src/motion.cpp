// SPDX-License-Identifier: MIT
#include "banyan/baselines/common/motion.hpp"

#include <algorithm>

namespace banyan::baselines {
namespace {

constexpr float same_spot = 1e-6F;  // nearer than this there is no direction
constexpr float least_u = 0.02F;    // below it a robot rests

Vec2 push_from(Vec2 there, float d, const BaselineParams& params) noexcept {
  const float a = params.avoidance_range;
  return d < a && d > same_spot ? there * (-params.avoidance_gain * (a / d - 1.0F) / d) : Vec2{};
}

}  // namespace

void OwnTarget::follow(const Orders& orders, const Carry& carry) noexcept {
  sent = orders.sent;
  if (!sent) known = false;
  if (known) target = carry.point(target);
  if (orders.target && sent) {
    target = *orders.target;
    known = true;
  }
}

Vec2 target_pull(const OwnTarget& assignment, const BaselineParams& params) noexcept {
  if (!assignment.sent || !assignment.known) return {};
  return unit(assignment.target) *
         (params.target_gain * std::min(1.0F, norm(assignment.target) / params.arrival_distance));
}

Vec2 avoidance(const Neighbors& table, std::span<const Vec2> obstacles, const BaselineParams& params) noexcept {
  Vec2 u;
  for (int k = 0; k < table.size(); ++k) u += push_from(table.position(k), table.range(k), params);
  for (const Vec2 o : obstacles) u += push_from(o, norm(o), params);
  return u;
}

Motion move(Vec2 u, const Guard& guard, const BaselineParams& params) noexcept {
  if (norm(u) < least_u) return {};
  return drive(clamped(guard.apply(clamped(u, 1.0F) * params.speed_gain), 1.0F), guard, params);
}

}  // namespace banyan::baselines
