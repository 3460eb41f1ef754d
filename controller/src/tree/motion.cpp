// SPDX-License-Identifier: MIT
#include "banyan/controller/tree/motion.hpp"

#include <algorithm>

#include "banyan/controller/tree/parent_selection.hpp"
#include "banyan/controller/tree/spare_management.hpp"

namespace banyan {
namespace {

// The neighbour whose distance counts as d^parent: the parent, else the old one, else the hold; -1 if none.
int nearest_up(const TreeRobot& robot) noexcept {
  return robot.parent >= 0 ? robot.parent : robot.old_parent >= 0 ? robot.old_parent : robot.hold;
}

// u^tree; an edge of both trees counts once. Each term is clamped: at a tenth of C the law says -4000.
Vec2 tree_force(const TreeRobot& robot) noexcept {
  Vec2 u;
  for_each_tree_neighbor(robot, [&](int k) {
    const float magnitude = std::clamp(interaction(robot.table().range(k), robot.params), -1.0F, 1.0F);
    u += unit(robot.table().position(k)) * magnitude;
  });
  return u;
}

// ADJUST POSITION: straight to the reference when far from it; near it, spares stand still, because orbiting ones block
// lines of sight.
Vec2 adjust_position(const TreeRobot& robot) noexcept {
  const TreeParams& p = robot.params;
  const int k = robot.table().find(robot.self.parent != nobody ? robot.self.parent : robot.self.reference);
  if (k < 0) return avoidance(robot);
  const Vec2 reference = robot.table().position(k);
  const float d = norm(reference);
  // A spare next to the tree stays within reach of its edges; a crowd far from the tree stays spread out.
  const float reach = robot.table().message(k).role != Role::spare ? 0.5F * p.recruitment_distance : p.safe_range;
  const bool called = robot.self.called && d > p.avoidance_range;
  return d > reach || called ? unit(reference) + avoidance(robot) : avoidance(robot);
}

}  // namespace

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

Vec2 spring_motion(const TreeRobot& robot) noexcept {
  const TreeParams& p = robot.params;
  const int up = nearest_up(robot);
  const Vec2 parent = up >= 0 ? robot.table().position(up) : Vec2{};
  const float d = norm(parent);
  const bool silent = up >= 0 && !robot.is_linked(up);
  if (up < 0 && !robot.is_root() && robot.table().size() == 0) return {};  // none heard
  // Emergency: u = p_parent, at full speed; towards a silent parent's estimated position.
  if (up >= 0 && (d > p.ideal_distance || silent)) return unit(parent);
  if (is_orphan(robot)) return d > p.safe_range ? unit(parent) : Vec2{};
  const Vec2 u = clamped(robot.self.pull + avoidance(robot), 1.0F);
  return tree_force(robot) + (up >= 0 ? safe_part(u, parent, p) : u);
}

Vec2 attendance_motion(const TreeRobot& robot) noexcept {
  Vec2 midpoint;
  if (robot.self.spare_state == SpareState::extend_edge && edge_midpoint(robot, robot.self.request, midpoint))
    return unit(midpoint) + avoidance(robot);
  return adjust_position(robot);
}

float interaction(float length, const TreeParams& params) noexcept {
  const float s = params.ideal_distance / length;
  const float s2 = s * s;
  return length > same_spot ? params.interaction_gain / length * (s2 - s2 * s2) : -1.0F;
}

Vec2 safe_part(Vec2 u, Vec2 parent, const TreeParams& params) noexcept {
  const float d = norm(parent);
  if (d <= params.safe_range) return u;
  const Vec2 away = -parent / d;
  return u - away * std::max(0.0F, dot(u, away));
}

Vec2 allowed(Vec2 u, const Guard& guard, const TreeParams& params) noexcept {
  return clamped(guard.apply(clamped(u, 1.0F) * params.speed_gain), 1.0F);
}

}  // namespace banyan
