// SPDX-License-Identifier: MIT
// "The integrity of the tree over time is ensured by constraining the robots' motion. We enforce the constraints by
// expressing the robot motion as a sum of virtual potential forces" (paper Sec. III-G)
#include "banyan/controller/paper/corrections.hpp"

namespace banyan::paper {
namespace {

// u_tree,old + u_tree,new: each term is clamped, since at a tenth of C the law says -4000.
Vec2 u_tree(const Robot& robot) noexcept {
  Vec2 u;
  for_each_edge(robot, [&](int j) {
    const float magnitude = std::clamp(interaction(robot.range(j), robot.params), -1.0F, 1.0F);
    u += unit(robot.position(j)) * (magnitude * static_cast<float>(robot.reading.edges_to(robot, j)));
  });
  return u;
}

}  // namespace

float interaction(float d, const Params& params) noexcept {
  const float epsilon = params.interaction_gain;
  const float s = params.ideal_distance / d;  // delta / d
  const float s2 = s * s;
  return d > same_spot ? epsilon / d * (s2 - s2 * s2) : -1.0F;
}

int edges_to(const Robot& robot, int k) noexcept {
  const Message& m = robot.said(k);
  const bool in_new = k == robot.parent || m.parent == robot.self.id;
  const bool in_old = k == robot.old_parent || m.old_parent == robot.self.id;
  return static_cast<int>(in_new) + static_cast<int>(in_old);
}

Vec2 f(const Robot& robot, Vec2 u, Vec2 parent) noexcept {
  const float S = robot.params.safe_range;
  return norm(parent) <= S ? u : Vec2{};
}

// "a repulsive force for obstacle avoidance between neighbors not in a parent-child relationship"
Vec2 u_avoid(const Robot& robot) noexcept {
  Vec2 u;
  for (int k = 0; k < robot.neighbors(); ++k)
    if (robot.range(k) < robot.params.avoidance_range && robot.alive(k) && !robot.is_tree_neighbor(k))
      u += repulsion(robot.params, robot.range(k), robot.position(k));
  return robot.reading.u_obstacles(robot, u);
}

Vec2 repulsion(const Params& params, float d, Vec2 from) noexcept {
  const float A = params.avoidance_range;
  return d < A && d > same_spot ? from * (-params.avoidance_gain * (A / d - 1.0F) / d) : Vec2{};
}

Vec2 u(const Robot& robot) noexcept {
  const float S = robot.params.safe_range;
  const float delta = robot.params.ideal_distance;
  const int up = robot.parent >= 0 ? robot.parent : robot.old_parent >= 0 ? robot.old_parent : robot.hold;
  const Vec2 p_parent = up >= 0 ? robot.position(up) : Vec2{};
  const float d_parent = norm(p_parent);
  if (robot.reading.keeps_links && up < 0 && !robot.is_root() && robot.neighbors() == 0) return {};  // row t
  if (up >= 0 && (d_parent > delta || !robot.alive(up))) return unit(p_parent);
  if (is_orphan(robot)) return d_parent > S ? unit(p_parent) : Vec2{};  // row g
  const Vec2 u_target = robot.self.pull;
  return u_tree(robot) + robot.reading.f(robot, clamped(u_target + u_avoid(robot), 1.0F), p_parent);
}

// "In the ADJUST POSITION state, spare robots rotate around their parent if they are within the safe radius or move
// towards their parent in a straight line otherwise."
Vec2 orbit(const Robot& robot) noexcept {
  const int k = reference_of(robot);
  if (k < 0) return u_avoid(robot);
  const Vec2 p = robot.position(k);
  if (norm(p) > robot.params.safe_range) return unit(p);
  return unit(Vec2{p.y, -p.x}) * robot.params.target_gain + u_avoid(robot);
}

int reference_of(const Robot& robot) noexcept {
  return robot.table().find(robot.self.parent != nobody ? robot.self.parent : robot.self.reference);
}

// "In the EXTEND EDGE state, spare robots head for the middle of the edge to be extended."
Vec2 u_spare(const Robot& robot) noexcept {
  Vec2 midpoint;
  if (robot.self.spare_state == SpareState::extend_edge && edge_midpoint(robot, robot.self.request, midpoint))
    return unit(midpoint) + u_avoid(robot);
  return robot.reading.adjust_position(robot);
}

}  // namespace banyan::paper
