// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "banyan/controller/healing.hpp"

namespace banyan {
namespace {

constexpr std::uint8_t post_reach_hops = 40;

bool is_spare(const Robot& robot, int k) noexcept {
  return robot.table().alive(k) && robot.table().message(k).role == Role::spare;
}

// The root knows by its census; the others are told by their parents.
bool is_settled(const Robot& robot) noexcept {
  const State& self = robot.self;
  if (self.phase != Phase::grow_tree) return false;
  if (!robot.is_root()) return robot.parent_alive() && self.want_m == 0.0F && robot.table().message(robot.parent).settled;
  const auto active = std::count_if(self.tasks.begin(), self.tasks.begin() + self.task_count, [](const Task& t) { return t.holder != nobody; });
  return self.want_m == 0.0F && active > 0 && self.subtree_workers >= active;
}

// No spare within reach of me would be there at once if I died.
bool is_alone(const Robot& robot) noexcept {
  const float range_m = robot.params.picket_range * robot.params.communication_range_m;
  for (int k = 0; k < robot.table().size(); ++k)
    if (is_spare(robot, k) && robot.table().range(k) <= range_m) return false;
  return true;
}

// I am the spare that stands by the robot of the tree next to me: none is nearer to it.
bool holds_post(const Robot& robot) noexcept {
  const Neighborhood& table = robot.table();
  int post = -1;
  float post_m = robot.params.picket_range * robot.params.communication_range_m;
  for (int k = 0; k < table.size(); ++k) {
    if (!table.alive(k) || table.message(k).role == Role::spare || table.range(k) > post_m) continue;
    post = k;
    post_m = table.range(k);
  }
  if (post < 0) return false;
  for (int k = 0; k < table.size(); ++k)
    if (is_spare(robot, k) && distance(table.position(k), table.position(post)) < post_m) return false;
  return true;
}

// The neighbour by which an unmanned post is nearest; -1 if there is none.
int way_to_post(const Robot& robot) noexcept {
  const Neighborhood& table = robot.table();
  int best = -1;
  for (int k = 0; k < table.size(); ++k) {
    if (!table.alive(k) || table.message(k).post_hops >= post_reach_hops) continue;
    if (best < 0 || std::pair(table.message(k).post_hops, table.range(k)) < std::pair(table.message(best).post_hops, table.range(best))) best = k;
  }
  return best;
}

}  // namespace

void man_posts(Robot& robot) noexcept {
  State& self = robot.self;
  self.settled = false;
  self.post_hops = nobody_calls;
  if (!robot.params.heals() || robot.params.picket_range <= 0.0F) return;
  const bool in_tree = self.role != Role::spare;
  self.settled = in_tree && is_settled(robot);
  const int k = way_to_post(robot);
  if (self.settled && is_alone(robot)) self.post_hops = 0;
  else if (k >= 0) self.post_hops = static_cast<std::uint8_t>(robot.table().message(k).post_hops + 1);
  // Who is called to a stretched edge, has an edge to join or a branch to leave has other things to do.
  if (in_tree || k < 0 || self.called || self.request != nobody || self.parent != nobody || holds_post(robot)) return;
  self.called = true;
  self.reference = robot.table().id(k);
}

}  // namespace banyan
