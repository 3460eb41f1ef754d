// SPDX-License-Identifier: MIT
#include "banyan/controller/plan.hpp"

#include <algorithm>
#include <array>

#include "banyan/controller/bypass.hpp"
#include "banyan/controller/convoy.hpp"
#include "banyan/controller/healing.hpp"

namespace banyan {
namespace {

constexpr float plan_limit_s = 30.0F;     // what has not been built by then is given up
constexpr float plan_period_s = 40.0F;
constexpr float held_back_after_s = 6.0F;
constexpr float unsettled_after_s = 3.0F;

std::span<Task> tasks(State& self) noexcept { return {self.tasks.data(), self.task_count}; }

const Task* find_active(const Robot& robot, RobotId serves) noexcept {
  const Task* task = find_task(robot.self, serves);
  return task == nullptr || task->holder == nobody ? nullptr : task;
}

// ---- The root ----

bool all_have_arrived(const Robot& robot) noexcept {
  const auto all = tasks(robot.self);
  const auto active = std::count_if(all.begin(), all.end(), [](const Task& t) { return t.holder != nobody; });
  return has_arrived(robot) && robot.self.subtree_workers >= active;
}

void withdraw(State& self) noexcept {
  for (Task& task : tasks(self)) task.host = nobody;
}

// Prim (1957): the shortest tree through the targets, from the one nearest to me. Writes the plan and
// returns how many robots it takes, with edges as long as compaction makes them.
int plan_tree(Robot& robot, int levels) noexcept {
  State& self = robot.self;
  const float edge_m = robot.params.compact_distance * robot.params.communication_range_m;
  std::array<float, task_capacity> gap_m{};  // to the tree so far
  std::array<int, task_capacity> nearest{};  // in it; -1: me
  std::array<bool, task_capacity> done{};
  std::array<int, task_capacity> level{};    // of the tree
  for (int k = 0; k < self.task_count; ++k) {
    done[k] = self.tasks[k].holder == nobody;
    gap_m[k] = norm(self.tasks[k].target);
    nearest[k] = -1;
  }
  int robots = 0;
  for (;;) {
    int next = -1;
    for (int k = 0; k < self.task_count; ++k)
      if (!done[k] && (next < 0 || gap_m[k] < gap_m[next])) next = k;
    if (next < 0) return robots;
    done[next] = true;
    const bool first = robots == 0;
    Task& task = self.tasks[next];
    level[next] = first ? 0 : level[nearest[next]] + 1;
    task.host = first || level[next] > levels ? nobody : self.tasks[nearest[next]].serves;
    robots += first ? 1 : static_cast<int>(gap_m[next] / edge_m) + 1;
    for (int k = 0; k < self.task_count; ++k) {
      const float d = distance(self.tasks[k].target, task.target);
      if (done[k] || (!first && d >= gap_m[k])) continue;
      gap_m[k] = d;
      nearest[k] = next;
    }
  }
}

// Once all have arrived, a level more each period.
void command(Robot& robot) noexcept {
  State& self = robot.self;
  const Params& p = robot.params;
  if (self.phase != Phase::grow_tree) return;
  // While a branch changes its parent its workers are not counted.
  self.unsettled_ticks = all_have_arrived(robot) ? std::uint16_t{0} : static_cast<std::uint16_t>(self.unsettled_ticks + 1);
  if (self.unsettled_ticks > p.ticks(unsettled_after_s)) {
    self.settled_ticks = self.unsettled_ticks = 0;
    return withdraw(self);
  }
  if (self.settled_ticks < UINT16_MAX) ++self.settled_ticks;
  if (self.plan_ticks > p.ticks(plan_limit_s)) return withdraw(self);
  const int since = self.settled_ticks - p.ticks(p.plan_after_s);
  const int period = p.ticks(plan_period_s);
  const bool due = p.plan_after_s > 0.0F && since >= 0 && since % period == 0 && self.settled_ticks < UINT16_MAX;
  if (due && plan_tree(robot, 1 + since / period) >= self.subtree) withdraw(self);
}

// ---- Everybody ----

void hear_parent(Robot& robot) noexcept {
  State& self = robot.self;
  const Message* m = robot.parent_message();
  if (m == nullptr) return;
  self.above = m->role == Role::worker ? m->serves : m->above;
  for (Task& task : tasks(self))
    if (task.serves == m->task_serves) task.host = m->task_host;
}

void look_down(Robot& robot) noexcept {
  State& self = robot.self;
  self.below = nobody;
  if (self.role != Role::connector || robot.useful_children != 1) return;
  for (const int k : robot.children) {
    const Standing& m = robot.table().message(k);
    if (m.role != Role::spare) self.below = m.role == Role::worker ? m.serves : m.below;
  }
}

// The target where my branch is to begin, if I am its topmost robot.
RobotId errand_of(const Robot& robot) noexcept {
  const State& self = robot.self;
  if (self.phase != Phase::grow_tree || self.role != Role::connector || self.below == nobody || !robot.parent_alive() || !has_arrived(robot)) return nobody;
  if (robot.table().message(robot.parent).below == self.below) return nobody;  // it leads
  const Task* served = find_active(robot, self.below);
  const Task* host = served == nullptr ? nullptr : find_active(robot, served->host);
  if (host == nullptr || self.above == host->serves) return nobody;
  return host->serves;
}

}  // namespace

bool find_goal(const Robot& robot, Vec2& goal) noexcept {
  const Task* host = find_active(robot, robot.self.errand);
  if (host != nullptr) goal = host->target;
  return host != nullptr;
}

bool is_held_back(const Robot& robot) noexcept {
  return robot.self.errand != nobody && robot.self.errand_ticks > robot.params.ticks(held_back_after_s);
}

Vec2 lead(const Robot& robot) noexcept {
  Vec2 goal;
  return find_goal(robot, goal) ? bypass(robot, goal) : Vec2{};
}

void take_part_in_plan(Robot& robot) noexcept {
  State& self = robot.self;
  look_down(robot);
  if (robot.is_root()) {
    self.above = nobody;
    command(robot);
  } else {
    hear_parent(robot);
  }
  const auto all = tasks(self);
  const bool planned = std::any_of(all.begin(), all.end(), [](const Task& t) { return t.host != nobody; });
  self.plan_ticks = planned ? static_cast<std::uint16_t>(std::min(self.plan_ticks + 1, UINT16_MAX)) : std::uint16_t{0};
  const RobotId errand = errand_of(robot);
  const bool stays = errand != nobody && errand == self.errand && self.led_from == self.parent;
  self.errand_ticks = stays && self.errand_ticks < UINT16_MAX ? static_cast<std::uint16_t>(self.errand_ticks + 1) : std::uint16_t{0};
  self.errand = errand;
  self.led_from = self.parent;
}

}  // namespace banyan
