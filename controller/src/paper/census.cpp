// SPDX-License-Identifier: MIT
// "The algorithm provides an estimate of the centroid in the root reference frame by adding up each robot contribution
// from the leaves to the root." "A tree-based distributed algorithm to count the number of robots currently committed
// in the tree" (paper Sec. III-C, Alg. 1, Alg. 2)
#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/paper/rooms.hpp"

namespace banyan::paper {
namespace {

// Calls visit(k) for the children of the tree that is being counted. Those of both trees, except that the barrier of
// SELECT PARENT counts the new one alone.
template <class Visit> void for_each_child(const Robot& robot, Visit visit) noexcept {
  const bool both = robot.self.phase != Phase::select_parent;
  for (const Indices* of : {&robot.children, &robot.old_children})
    for (const int k : *of)
      if ((both || of == &robot.children) && up_of(robot.said(k)) == robot.self.id) visit(k);
}

}  // namespace

void algorithm_1(Robot& robot) noexcept {
  State& self = robot.self;
  const int parent = robot.up();
  const auto c_d_1 = static_cast<float>(self.subtree);  // c_i - d_i + 1 (row 6)
  Vec2 a;                                               //  1  a_i = 0
  for_each_child(robot, [&](int j) {                    //  2  for all child j
    const Vec2 q_j{robot.said(j).q_x, robot.said(j).q_y};
    const Vec2 q = from_edge_frame(q_j, robot.position(j));  //  3  q_j^i = express q_j in i's reference frame
    a = a + q;                                               //  4  a_i = a_i + q_j^i
  });                                                        //  5  end for
  self.q = {};
  if (!robot.is_root() && parent >= 0) {          //  6  if robot i has a parent
    self.q = a - robot.position(parent) * c_d_1;  //  7  q_i = a_i - (c_i - d_i + 1) p_i^parent
  }                                               //  8  end if
  if (robot.is_root()) {                          //  9  if robot i is the root
    self.q = a / c_d_1;                           // 10  q_i = a_i / c_i, since d_i = 1
  }                                               // 11  end if
}

// The sum is over children: with the parent in it ("neighbors") it diverges (row 5).
void algorithm_2(Robot& robot) noexcept {
  const auto d = std::uint32_t{robot.self.depth};
  std::uint32_t children = 0;
  std::uint32_t c = 0;  // sum of c_j
  for_each_child(robot, [&](int j) { ++children, c += robot.said(j).count; });
  switch (children) {                   // switch number of children
    case 0: c = d; break;               //   case 0: return d_i
    case 1: break;                      //   case 1: return c_child
    default: c = c - children * d + d;  //   default: return sum over neighbors j of (c_j - d_i) + d_i
  }
  robot.self.count = saturated(c, UINT16_MAX);
}

// What Alg. 2 counts, without the depth, which is wrong until it has settled: barriers and Alg. 1 use this (row 5).
void count_subtree(Robot& robot) noexcept {
  std::uint32_t robots = 1;
  std::uint32_t workers = robot.self.is_worker ? 1 : 0;
  for_each_child(robot, [&](int j) {
    robots += robot.said(j).subtree;
    workers += robot.said(j).subtree_workers;
  });
  robot.self.subtree = saturated(robots);
  robot.self.subtree_workers = saturated(workers);
}

// "Workers propagate to their parents the calculated u_target, and connectors apply it in turn." A robot with several
// children applies the mean (row r).
void pass_on_targets(Robot& robot) noexcept {
  State& self = robot.self;
  const Params& p = robot.params;
  Vec2 pull;
  int pulling = 0;
  self.way_left = 0.0F;
  for (const Indices* of : {&robot.children, &robot.old_children}) {
    if (of == &robot.old_children && self.phase == Phase::select_parent && robot.children.size > 0) continue;
    for (const int k : *of) {
      const Message& m = robot.said(k);
      if (up_of(m) != self.id || m.role == Role::spare) continue;
      const Vec2 sent{static_cast<float>(m.pull_x) / pull_unit, static_cast<float>(m.pull_y) / pull_unit};
      pull += from_edge_frame(sent, robot.position(k));
      ++pulling;
      self.way_left = std::max(self.way_left, from_fixed(m.want));
    }
  }
  self.pull = pulling > 0 ? pull / static_cast<float>(pulling) : Vec2{};
  if (self.is_worker && self.target_known) {
    // u_target = tau (l - p) / |l - p|, fading on arrival so that the worker does not chatter.
    const float d = norm(self.target);
    self.pull = unit(self.target) * (p.target_gain * std::min(1.0F, d / p.arrival_distance));
    if (d > p.arrival_distance) self.way_left = std::max(self.way_left, d);
  } else if (self.is_worker) {
    self.way_left = std::max(self.way_left, 1.0F);  // sent, but not yet told where to: it has not arrived
  }
}

}  // namespace banyan::paper
