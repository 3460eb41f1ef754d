// SPDX-License-Identifier: MIT
// "The algorithm provides an estimate of the centroid in the root reference frame by adding up each robot contribution
// from the leaves to the root." "A tree-based distributed algorithm to count the number of robots currently committed
// in the tree" (paper Sec. III-C, Alg. 1, Alg. 2)
#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/paper/rules.hpp"

namespace banyan::paper {
namespace {

// Calls visit(j) for the children that are counted: of both trees, but the barrier of SELECT PARENT counts the new one.
template <class Visit> void for_each_child(const Robot& robot, Visit visit) noexcept {
  robot.for_each_below([&](int j, bool old) {
    const bool counts = !old || robot.self.phase != Phase::select_parent;
    if (counts && up_of(robot.said(j)) == robot.self.id) visit(j);
  });
}

}  // namespace

// "Algorithm 1: Distributed centroid estimation algorithm executed by robot i"
void algorithm_1(Robot& robot) noexcept {
  State& self = robot.self;
  const int parent = robot.is_root() ? -1 : robot.up();
  const auto c_d_1 = static_cast<float>(self.subtree);                   // c_i - d_i + 1 (row 6)
  Vec2 a;                                                                //  1: a_i = 0
  for_each_child(robot, [&](int j) {                                     //  2: for all child j
    const Vec2 q = from_edge_frame(robot.said(j).q, robot.position(j));  //  3:   q_j^i = q_j in i's frame
    a = a + q;                                                           //  4:   a_i = a_i + q_j^i
  });                                                                    //  5: end for
  self.q = {};
  if (parent >= 0) {                              //  6: if robot i has a parent
    self.q = a - robot.position(parent) * c_d_1;  //  7:   q_i = a_i - (c_i - d_i + 1) p_i^parent
  }                                               //  8: end if
  if (robot.is_root()) {                          //  9: if robot i is the root
    self.q = a / c_d_1;                           // 10:   q_i = a_i / c_i, since d_i = 1
  }                                               // 11: end if
}

// "Algorithm 2: Tree-based count algorithm for robot i. The depth of robot i in the tree is denoted as d_i." The sum is
// over children: with the parent in it, as a neighbor, it diverges (row 5).
void algorithm_2(Robot& robot) noexcept {
  const std::uint32_t d = robot.self.depth;
  std::uint32_t children = 0, c = 0;
  for_each_child(robot, [&](int j) { ++children, c += robot.said(j).count; });
  switch (children) {                   // 1: switch number of children
    case 0: c = d; break;               // 2: case 0: return d_i
    case 1: break;                      // 4: case 1: return c_child
    default: c = c - children * d + d;  // 6: default: return sum over neighbors j of (c_j - d_i) + d_i
  }
  robot.self.count = saturated(c);
}

// "Workers propagate to their parents the calculated u_target, and connectors apply it in turn": a robot with several
// children the mean (row r). The robots below are counted beside Alg. 2, whose depths are wrong until they have
// settled: barriers and Alg. 1 use this count (row 5).
void take_census(Robot& robot) noexcept {
  State& self = robot.self;
  const bool by_new_tree = self.phase == Phase::select_parent && robot.has_child();
  std::uint32_t robots = 1;
  std::uint32_t workers = self.is_worker ? 1 : 0;
  Vec2 sum;
  int pulling = 0;
  self.want = 0;
  for_each_child(robot, [&](int j) { robots += robot.said(j).subtree, workers += robot.said(j).subtree_workers; });
  robot.for_each_below([&](int j, bool old) {
    const Message& m = robot.said(j);
    if ((old && by_new_tree) || up_of(m) != self.id || m.role == Role::spare) return;
    const Vec2 pull{static_cast<float>(m.pull_x) / pull_unit, static_cast<float>(m.pull_y) / pull_unit};
    sum += from_edge_frame(pull, robot.position(j));
    ++pulling;
    self.want = std::max(self.want, m.want);
  });
  self.subtree = saturated(robots);
  self.subtree_workers = saturated(workers);
  self.pull = pulling > 0 ? sum / static_cast<float>(pulling) : Vec2{};
  if (!self.is_worker) return;
  // u_target = tau (l - p) / |l - p|, fading on arrival so that the worker does not chatter.
  const float reach = robot.params.arrival_distance;
  const float d = self.target_known ? norm(self.target) : 1.0F;
  if (self.target_known) self.pull = unit(self.target) * (robot.params.target_gain * std::min(1.0F, d / reach));
  if (d > reach || !self.target_known) self.want = std::max(self.want, to_fixed<std::uint16_t>(d, per_range));
}

}  // namespace banyan::paper
