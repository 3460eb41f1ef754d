// SPDX-License-Identifier: MIT
#include "tree/census.hpp"

#include <algorithm>

#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/core/fixed_point.hpp"

namespace banyan {
namespace {

struct Sums {
  Vec2 a;  // accumulator of Alg. 1
  std::uint32_t robots = 1;
  std::uint32_t workers = 0;
  std::uint32_t counts = 0;  // of Alg. 2
  int children = 0;
  Vec2 pull;
  int pulling = 0;
  float want = 0.0F;
};

// `counts`: whether the child belongs to the tree that is being counted; its pull counts always.
void add_child(const TreeRobot& robot, int k, bool counts, Sums& sums) noexcept {
  const TreeStanding& m = robot.table().message(k);
  if (up_of(m) != robot.self.id) return;  // its vectors are addressed to another robot
  const Vec2 sender = robot.table().position(k);
  if (counts) {
    sums.a += from_edge_frame({m.q_x, m.q_y}, sender);
    sums.robots += m.subtree;
    sums.workers += m.subtree_workers;
    sums.counts += m.count;
    ++sums.children;
  }
  if (m.role == Role::spare) return;
  sums.pull +=
      from_edge_frame({static_cast<float>(m.pull_x) / pull_unit, static_cast<float>(m.pull_y) / pull_unit}, sender);
  ++sums.pulling;
  sums.want = std::max(sums.want, from_fixed(m.want));
}

// u_target = tau (l - p) / |l - p|, fading on arrival so that the worker does not chatter (protocol 5).
void add_own_target(const TreeRobot& robot, float rest_distance, Sums& sums) noexcept {
  const TreeParams& p = robot.params;
  const float away = norm(*robot.target);
  sums.pull = unit(*robot.target) * (p.target_gain * std::min(1.0F, away / p.arrival_distance));
  sums.pulling = 1;
  if (away > rest_distance) sums.want = std::max(sums.want, away);  // its own and that of all below
}

// How long the workers below have not come any nearer to their targets.
void watch_progress(const TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  constexpr float hand = 0.05F;  // of C: a larger change is progress
  if (self.want > self.least_want + hand || self.want < self.least_want - hand) {
    self.least_want = self.want;
    self.stalled_ticks = 0;
  } else {
    robot.add_elapsed(self.stalled_ticks);
  }
}

// Turned into the edge frame, a component grows by up to sqrt 2.
Vec2 sendable(Vec2 q) noexcept {
  constexpr float limit = 0.5F * q_limit;
  return {std::clamp(q.x, -limit, limit), std::clamp(q.y, -limit, limit)};
}

}  // namespace

std::uint32_t algorithm2_count(int child_count, std::uint32_t child_counts, std::uint32_t depth) noexcept {
  switch (child_count) {
    case 0: return depth;
    case 1: return child_counts;
    default: return child_counts - static_cast<std::uint32_t>(child_count) * depth + depth;
  }
}

Vec2 algorithm1_contribution(Vec2 a, std::uint32_t descendants, Vec2 parent) noexcept {
  return a - parent * static_cast<float>(descendants + 1);
}

void take_census(TreeRobot& robot, float rest_distance, float own_want) noexcept {
  TreeState& self = robot.self;
  Sums sums;
  if (self.is_worker) sums.workers = 1;
  // SELECT PARENT's barrier counts the new tree alone; in START TREE there is only the old one.
  const bool selecting = self.phase == Phase::select_parent;
  for (const int k : robot.children) add_child(robot, k, true, sums);
  if (!selecting || robot.children.size == 0)
    for (const int k : robot.old_children) add_child(robot, k, !selecting, sums);
  if (self.is_worker && robot.target != nullptr) add_own_target(robot, rest_distance, sums);
  // Sent, but not yet told where to: it has not arrived.
  else if (self.is_worker) sums.want = std::max(sums.want, 1.0F);
  sums.want = std::max(sums.want, own_want);

  self.subtree = saturated(sums.robots);
  self.subtree_workers = saturated(sums.workers);
  self.count = saturated(algorithm2_count(sums.children, sums.counts, self.depth));
  self.want = sums.want;
  watch_progress(robot);
  self.pull = sums.pulling > 0 ? sums.pull / static_cast<float>(sums.pulling) : Vec2{};

  const int up = robot.up();
  if (robot.is_root()) self.q = sums.a / static_cast<float>(sums.robots);
  else if (up < 0) self.q = {};
  else self.q = sendable(algorithm1_contribution(sums.a, sums.robots - 1, robot.table().position(up)));
}

}  // namespace banyan
