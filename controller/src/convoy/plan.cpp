// SPDX-License-Identifier: MIT
#include "banyan/controller/convoy/plan.hpp"

#include <algorithm>
#include <array>

#include "banyan/controller/obstacles/bypass.hpp"
#include "banyan/controller/convoy/towing.hpp"
#include "banyan/controller/healing/healing.hpp"
#include "banyan/controller/redundancy/companions.hpp"

namespace banyan {
namespace {

constexpr float plan_limit_s = 30.0F;     // what has not been built by then is given up
constexpr float plan_period_s = 40.0F;
constexpr float held_back_after_s = 6.0F;
constexpr float unsettled_after_s = 3.0F;

std::span<Task> tasks(ConvoyState& self) noexcept { return {self.tasks.data(), self.task_count}; }

const Task* find_active(const ConvoyRobot& robot, RobotId serves) noexcept {
  const Task* task = find_task(robot.self, serves);
  return task == nullptr || task->holder == nobody || task->unlocated ? nullptr : task;
}

// ---- The root ----

bool all_have_arrived(const ConvoyRobot& robot) noexcept {
  const auto all = tasks(robot.self);
  const auto active = std::count_if(all.begin(), all.end(), [](const Task& t) { return t.holder != nobody; });
  return has_arrived(robot) && robot.self.subtree_workers >= active;
}

void withdraw(ConvoyState& self) noexcept { self.hosts.fill(nobody); }

// Prim (1957): the shortest tree through the targets, from the one nearest to me. Writes the plan and
// returns how many robots it takes, with edges as long as compaction makes them.
int plan_tree(ConvoyRobot& robot, int levels) noexcept {
  ConvoyState& self = robot.self;
  const float edge_m = robot.params.compact_distance_m;
  std::array<float, task_capacity> gap_m{};  // to the tree so far
  std::array<int, task_capacity> nearest{};  // the nearest target in the tree; -1: me
  std::array<bool, task_capacity> done{};
  std::array<int, task_capacity> level{};    // in the tree
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
    const Task& task = self.tasks[next];
    level[next] = first ? 0 : level[nearest[next]] + 1;
    self.hosts[next] = first || level[next] > levels ? nobody : self.tasks[nearest[next]].serves;
    robots += first ? 1 : static_cast<int>(gap_m[next] / edge_m) + 1;
    for (int k = 0; k < self.task_count; ++k) {
      const float d = distance(self.tasks[k].target, task.target);
      if (done[k] || (!first && d >= gap_m[k])) continue;
      gap_m[k] = d;
      nearest[k] = next;
    }
  }
}

// Once all workers have arrived, the plan covers one more level each period.
void command(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  const ConvoyParams& p = robot.params;
  if (self.phase != Phase::grow_tree) return;
  // While a branch changes its parent its workers are not counted.
  robot.add_elapsed(self.unsettled_ticks);
  if (all_have_arrived(robot)) self.unsettled_ticks = 0;
  if (self.unsettled_ticks > p.ticks(unsettled_after_s)) {
    self.settled_ticks = self.unsettled_ticks = 0;
    return withdraw(self);
  }
  robot.add_elapsed(self.settled_ticks);
  if (self.plan_ticks > p.ticks(plan_limit_s)) return withdraw(self);
  const int since = self.settled_ticks - p.ticks(p.plan_after_s);
  const int period = p.ticks(plan_period_s);
  // Not before I know of all targets.
  const auto known = tasks(self);
  const bool knows_all = self.subtree_workers <= std::count_if(known.begin(), known.end(), [](const Task& t) { return t.holder != nobody; });
  const bool due = knows_all && !has_companions(robot.params) && !self.forgets && p.plan_after_s > 0.0F && since >= 0 && since % period < robot.elapsed_ticks && self.settled_ticks < UINT16_MAX;
  if (due && plan_tree(robot, 1 + since / period) >= self.subtree) withdraw(self);
}

// ---- Every robot ----

void hear_parent(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  const ConvoyMessage* m = robot.parent_message();
  if (m == nullptr) return;
  self.above = m->role == Role::worker ? m->serves : m->above;
  for (int k = 0; k < self.task_count; ++k)
    if (self.tasks[k].serves == m->task_serves) self.hosts[k] = m->task_host;
}

void look_down(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  self.below = nobody;
  if (self.role != Role::connector || robot.useful_children != 1) return;
  for (const int k : robot.children) {
    const TreeStanding& m = robot.table().message(k);
    if (m.role != Role::spare) self.below = m.role == Role::worker ? robot.served_by(k) : robot.convoy_of(k).below;
  }
}

// The target where my branch is to begin, if I am its topmost robot.
RobotId lead_of(const ConvoyRobot& robot) noexcept {
  const ConvoyState& self = robot.self;
  if (self.phase != Phase::grow_tree || self.role != Role::connector || self.below == nobody || !robot.parent_alive() || !has_arrived(robot)) return nobody;
  if (robot.convoy_of(robot.parent).below == self.below) return nobody;  // the parent leads
  const Task* served = find_active(robot, self.below);
  const Task* host = served == nullptr ? nullptr : find_active(robot, self.hosts[static_cast<std::size_t>(served - self.tasks.data())]);
  if (host == nullptr || self.above == host->serves) return nobody;
  return host->serves;
}

}  // namespace

bool find_goal(const ConvoyRobot& robot, Vec2& goal) noexcept {
  const Task* host = find_active(robot, robot.self.lead_to);
  if (host != nullptr) goal = host->target;
  return host != nullptr;
}

bool is_held_back(const ConvoyRobot& robot) noexcept {
  return robot.self.lead_to != nobody && robot.self.lead_ticks > robot.params.ticks(held_back_after_s);
}

Vec2 lead(const ConvoyRobot& robot) noexcept {
  Vec2 goal;
  return find_goal(robot, goal) ? bypass(robot, goal) : Vec2{};
}

void take_part_in_plan(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  look_down(robot);
  if (robot.is_root()) {
    self.above = nobody;
    command(robot);
  } else {
    hear_parent(robot);
  }
  // With more targets than robots can remember, targets unknown to the root keep branches that no plan would count.
  if (self.forgets) withdraw(self);
  const auto hosts = std::span(self.hosts).first(self.task_count);
  const bool planned = std::any_of(hosts.begin(), hosts.end(), [](RobotId host) { return host != nobody; });
  robot.add_elapsed(self.plan_ticks);
  if (!planned) self.plan_ticks = 0;
  const RobotId lead_to = lead_of(robot);
  const bool stays = lead_to != nobody && lead_to == self.lead_to && self.led_from == self.parent;
  robot.add_elapsed(self.lead_ticks);
  if (!stays) self.lead_ticks = 0;
  self.lead_to = lead_to;
  self.led_from = self.parent;
}

}  // namespace banyan
