// SPDX-License-Identifier: MIT
#include "tree/motion.hpp"

namespace banyan {

Vec2 avoidance(const TreeRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const float a = robot.params.avoidance_range;
  Vec2 u;
  for (int k = 0; k < table.size(); ++k) {
    const float d = table.range(k);
    if (d >= a || d <= same_spot || !table.alive(k) || robot.is_tree_neighbor(k)) continue;
    u += table.position(k) * (-robot.params.avoidance_gain * (a / d - 1.0F) / d);
  }
  for (const Vec2 o : robot.obstacles) {
    const float d = norm(o);
    if (d < a && d > same_spot) u += o * (-robot.params.avoidance_gain * (a / d - 1.0F) / d);
  }
  return u;
}

Vec2 allowed(Vec2 u, const Guard& guard, const TreeParams& params) noexcept {
  return clamped(guard.apply(clamped(u, 1.0F) * params.speed_gain), 1.0F);
}

}  // namespace banyan
