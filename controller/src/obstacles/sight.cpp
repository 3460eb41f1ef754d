// SPDX-License-Identifier: MIT
#include "obstacles/sight.hpp"

namespace banyan {
namespace {

// `p` is nearer than `clearance` to the inside of the segment from `a` along `d`. The ends are the robots
// that communicate; a point beyond them blocks nothing.
bool blocks(Vec2 p, Vec2 a, Vec2 d, float d2, float clearance) noexcept {
  const Vec2 k = p - a;
  const float along = dot(k, d);
  if (along <= 0.0F || along >= d2) return false;
  const float across = cross(k, d);
  return across * across < clearance * clearance * d2;
}

}  // namespace

bool is_clear(const TreeRobot& robot, const Corners& corners, Vec2 a, Vec2 b, int i, int j, float clearance,
              FunctionRef<bool(int k)> is_passed) noexcept {
  const TreeTable& table = robot.table();
  const Vec2 d = b - a;
  const float d2 = squared_norm(d);
  if (blocks(Vec2{}, a, d, d2, clearance)) return false;
  if (!is_free(robot, corners, a, b, obstacle_clearance)) return false;
  for (int k = 0; k < table.size(); ++k)
    if (k != i && k != j && blocks(table.position(k), a, d, d2, clearance) && !is_passed(k)) return false;
  return true;
}

bool sees_clearly(const TreeRobot& robot, const Corners& corners, int k, float clearance,
                  FunctionRef<bool(int k)> is_passed) noexcept {
  return is_clear(robot, corners, Vec2{}, robot.table().position(k), k, -1, clearance, is_passed);
}

}  // namespace banyan
