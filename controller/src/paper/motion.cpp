// SPDX-License-Identifier: MIT
// "The integrity of the tree over time is ensured by constraining the robots' motion. We enforce the constraints by
// expressing the robot motion as a sum of virtual potential forces" (paper Sec. III-G)
#include "banyan/controller/paper/rules.hpp"

namespace banyan::paper {
namespace {

// A robot nearer than this is where I am: it has no direction, and powers of 1 / d would overflow.
constexpr float same_spot = 1e-6F;

// An edge of both trees counts in both (row q). Each term is clamped: at a tenth of C the law says -4000.
Vec2 u_tree_old_and_new(const Robot& robot) noexcept {
  Vec2 u;
  for_each_edge(robot, [&](int j) {
    const float u_tree = std::clamp(interaction(robot.range(j), robot.params), -1.0F, 1.0F);
    u += unit(robot.position(j)) * (u_tree * static_cast<float>(robot.reading.edges_to(robot, j)));
  });
  return u;
}

}  // namespace

// "u_i = u_i^tree,old + u_i^tree,new + f_i(d_i^parent) (u_i^target + u_i^avoid) if d_ij <= E, p_i^parent otherwise"
Vec2 u(const Robot& robot) noexcept {
  const float S = robot.params.safe_range;
  const float E = robot.params.ideal_distance;  // the emergency range, delta (row 1)
  const int up = robot.parent >= 0 ? robot.parent : robot.old_parent >= 0 ? robot.old_parent : robot.hold;
  const Vec2 p_parent = up >= 0 ? robot.position(up) : Vec2{};
  const float d_parent = norm(p_parent);
  const Vec2 u_target = robot.self.pull;
  const bool in_reach = up < 0 || (d_parent <= E && robot.alive(up));

  if (robot.reading.keeps_links && up < 0 && robot.size() == 0 && !robot.is_root()) return {};  // row t
  if (in_reach && is_orphan(robot)) return d_parent > S ? unit(p_parent) : Vec2{};              // row g
  return in_reach
             ? u_tree_old_and_new(robot) + robot.reading.f(robot, p_parent, clamped(u_target + u_avoid(robot), 1.0F))
             : unit(p_parent);
}

// "u_i^tree = epsilon / d_ij ((delta / d_ij)^2 - (delta / d_ij)^4)"
float interaction(float d, const Params& params) noexcept {
  const float epsilon = params.interaction_gain;
  const float s = params.ideal_distance / d;  // delta / d
  const float s2 = s * s;
  return d > same_spot ? epsilon / d * (s2 - s2 * s2) : -1.0F;
}

// "the interaction law between robots (i, j) in a parent-child relationship, in either the old or the new tree"
int edges_to(const Robot& robot, int k) noexcept {
  const Message& m = robot.said(k);
  const bool in_new = k == robot.parent || m.parent == robot.self.id;
  const bool in_old = k == robot.old_parent || m.old_parent == robot.self.id;
  return static_cast<int>(in_new) + static_cast<int>(in_old);
}

// "f_i(d_i^parent) = 1 if d_i^parent <= S, 0 otherwise. Through this function, a robot can ignore navigation to target
// and obstacle avoidance to perform emergency maneuvers when the distance to its parent becomes unsafe." (row 3)
Vec2 f(const Robot& robot, Vec2 p_parent, Vec2 u) noexcept {
  return norm(p_parent) <= robot.params.safe_range ? u : Vec2{};
}

// "a repulsive force for obstacle avoidance between neighbors not in a parent-child relationship"
Vec2 u_avoid(const Robot& robot) noexcept {
  const float A = robot.params.avoidance_range;
  const auto repulsion = [&](float d, Vec2 from) {
    return d < A && d > same_spot ? from * (-robot.params.avoidance_gain * (A / d - 1.0F) / d) : Vec2{};
  };
  Vec2 u;
  for (int k = 0; k < robot.size(); ++k)
    if (robot.alive(k) && !robot.is_tree_neighbor(k)) u += repulsion(robot.range(k), robot.position(k));
  if (robot.reading.avoids_obstacles)
    for (const Vec2 point : robot.obstacles) u += repulsion(norm(point), point);
  return u;
}

// "In the EXTEND EDGE state, spare robots head for the middle of the edge to be extended."
Vec2 u_spare(const Robot& robot) noexcept {
  const State& self = robot.self;
  Vec2 midpoint;
  if (self.spare_state == SpareState::extend_edge && edge_midpoint(robot, robot.find(self.request), midpoint))
    return unit(midpoint) + u_avoid(robot);
  const int reference = robot.find(self.parent != nobody ? self.parent : self.reference);
  return reference < 0 ? u_avoid(robot) : robot.reading.adjust_position(robot, reference);
}

// "In the ADJUST POSITION state, spare robots rotate around their parent if they are within the safe radius or move
// towards their parent in a straight line otherwise."
Vec2 orbit(const Robot& robot, int reference) noexcept {
  const Vec2 p = robot.position(reference);
  if (norm(p) > robot.params.safe_range) return unit(p);
  return unit(-left_of(p)) * robot.params.target_gain + u_avoid(robot);
}

}  // namespace banyan::paper
