// SPDX-License-Identifier: MIT
#include "convoy/plan.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "banyan/controller/core/search.hpp"
#include "convoy/companions.hpp"
#include "convoy/towing.hpp"
#include "healing/healing.hpp"
#include "obstacles/bypass.hpp"

namespace banyan {
namespace {

constexpr float plan_limit_drives = 3.0F;       // what has not been built by then is given up
constexpr float plan_period_drives = 4.0F;      // between two levels
constexpr float thrifty_limit_drives = 2.6F;    // the same with thrift
constexpr float thrifty_period_drives = 2.5F;   // the same with thrift
constexpr float held_back_after_drives = 0.6F;  // without progress a leader asks for a spare
constexpr int unsettled_ticks = 30;             // so long somebody may be missing before all counts as undone
constexpr float far = 1e9F;

const Task* find_active(const ConvoyRobot& robot, RobotId serves) noexcept {
  const Task* task = find_task(robot.self, serves);
  return task == nullptr || task->holder == nobody || task->unlocated ? nullptr : task;
}

// ---- The root ----

int count_held(const ConvoyState& self) noexcept {
  return count_of(self.known_tasks(), [](const Task& t) { return t.holder != nobody; });
}

bool all_have_arrived(const ConvoyRobot& robot) noexcept {
  return has_arrived(robot) && static_cast<int>(robot.self.subtree_workers) >= count_held(robot.self);
}

void withdraw(ConvoyState& self) noexcept { self.hosts.fill(nobody); }

// The shortest tree through the targets that are held, seen from one of them.
struct TargetTree {
  std::array<std::int16_t, task_capacity>
      host{};  // the next target on the way to the first; -1: the first, or not held
  std::array<std::uint8_t, task_capacity> level{};  // targets on that way
  int deepest = 0;                                  // of the levels
  int robots = 0;                                   // that it takes, with edges as long as compaction makes them
};

// Prim (1957).
TargetTree shortest_tree(const ConvoyRobot& robot, int first) noexcept {
  const ConvoyState& self = robot.self;
  const float edge = thrifty(robot.params, robot.params.compact_distance);
  TargetTree tree;
  std::array<float, task_capacity> gap{};  // to the tree so far
  std::array<bool, task_capacity> done{};
  for (int k = 0; k < self.task_count; ++k) done[k] = self.tasks[k].holder == nobody;
  tree.host.fill(-1);
  gap.fill(far);
  for (int next = first; next >= 0;) {
    const int host = tree.host[next];
    done[next] = true;
    if (host >= 0) tree.level[next] = tree.level[host] + 1;
    tree.deepest = std::max<int>(tree.deepest, tree.level[next]);
    tree.robots += host < 0 ? 1 : static_cast<int>(gap[next] / edge) + 1;
    const int last = next;
    next = -1;
    for (int k = 0; k < self.task_count; ++k) {
      if (done[k]) continue;
      if (const float d = distance(self.tasks[k].target, self.tasks[last].target); d < gap[k]) {
        gap[k] = d;
        tree.host[k] = static_cast<std::int16_t>(last);
      }
      if (next < 0 || gap[k] < gap[next]) next = k;
    }
  }
  return tree;
}

// From the target nearest to me; with thrift from the tree's centre, where it has the fewest levels.
TargetTree best_tree(const ConvoyRobot& robot) noexcept {
  const ConvoyState& self = robot.self;
  const bool thrifty = robot.params.thrift > 0.0F;
  TargetTree best;
  float nearest = far;
  for (int k = 0; k < self.task_count; ++k) {
    if (self.tasks[k].holder == nobody) continue;
    const float d = norm(self.tasks[k].target);
    if (!thrifty && d >= nearest) continue;
    nearest = d;
    const TargetTree tree = shortest_tree(robot, k);
    if (!thrifty || best.robots == 0 || tree.deepest < best.deepest) best = tree;
  }
  return best;
}

// Where several trees are as short, as on a ring, what robots measure would decide anew each time: with thrift
// the plan stays until a target comes or goes.
void make_plan(ConvoyRobot& robot, int targets) noexcept {
  ConvoyState& self = robot.self;
  const TargetTree tree = best_tree(robot);
  const bool saves = tree.robots < static_cast<int>(self.subtree);
  self.plan_targets = static_cast<std::uint8_t>(targets);
  self.plan_levels = static_cast<std::uint8_t>(saves ? tree.deepest : 0);
  self.plan_level = tree.level;
  for (int k = 0; k < self.task_count; ++k)
    self.planned[k] = saves && tree.host[k] >= 0 ? self.tasks[tree.host[k]].serves : nobody;
}

// Once all workers have arrived, the plan covers one more level each period. With thrift from its leaves inwards: the
// branch of a target is led to its host along the host's own, which must not have been led away before.
void command(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  const ConvoyParams& p = robot.params;
  if (self.phase != Phase::grow_tree) return;
  const bool thrifty = p.thrift > 0.0F;
  // While a branch changes its parent its workers are not counted.
  robot.add_elapsed(self.unsettled_ticks);
  if (all_have_arrived(robot)) self.unsettled_ticks = 0;
  if (self.unsettled_ticks > unsettled_ticks) {
    self.settled_ticks = self.unsettled_ticks = 0;
    self.plan_targets = self.plan_levels = self.plan_steps = 0;
    return withdraw(self);
  }
  robot.add_elapsed(self.settled_ticks);
  if (self.plan_ticks > p.rounds(thrifty ? thrifty_limit_drives : plan_limit_drives)) return withdraw(self);
  const int since = self.settled_ticks - p.rounds(p.plan_after_drives);
  const int period = p.rounds(thrifty ? thrifty_period_drives : plan_period_drives);
  // Not before I know of all targets.
  const int targets = count_held(self);
  const bool may = static_cast<int>(self.subtree_workers) <= targets && !has_companions(p) && !self.forgets &&
                   p.plan_after_drives > 0.0F && since >= 0 && self.settled_ticks < UINT16_MAX;
  if (!may || (thrifty ? since < self.plan_steps * period : since % period >= robot.elapsed_ticks)) return;
  if (!thrifty) {
    const int levels = 1 + since / period;
    const TargetTree tree = best_tree(robot);
    for (int k = 0; k < self.task_count; ++k)
      self.hosts[k] = tree.host[k] < 0 || tree.level[k] > levels ? nobody : self.tasks[tree.host[k]].serves;
    if (tree.robots >= static_cast<int>(self.subtree)) withdraw(self);
    return;
  }
  if (self.plan_levels == 0 || targets != self.plan_targets) make_plan(robot, targets);
  ++self.plan_steps;
  for (int k = 0; k < self.task_count; ++k)
    self.hosts[k] = self.plan_level[k] > self.plan_levels - self.plan_steps ? self.planned[k] : nobody;
}

// ---- The root: too few robots ----

// Of the targets not yet reached, the one without which the shortest tree takes fewest robots; while one is tried
// again, only that one: no other is lost for it.
RobotId least_worth(ConvoyRobot& robot) noexcept {
  RobotId worst = nobody;
  int fewest = INT16_MAX;
  const auto all = robot.self.known_tasks();
  const bool tries = banyan::any_of(all, is_tried_again);
  for (Task& task : all) {
    if (task.holder == nobody || task.reached || task.unlocated || (tries && !is_tried_again(task))) continue;
    const RobotId holder = std::exchange(task.holder, nobody);
    const int robots = best_tree(robot).robots;
    task.holder = holder;
    if (robots >= fewest) continue;
    fewest = robots;
    worst = task.serves;
  }
  return worst;
}

// Spares are called in vain, and no worker has come nearer to its target for a while: one is given up. To all robots
// its host is then that target itself.
void shed(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  if (self.shed != nobody) {
    const Task* task = find_task(self, self.shed);
    const bool over = task == nullptr || task->holder == nobody;
    if (task != nullptr) self.hosts[static_cast<std::size_t>(task - self.tasks.data())] = over ? nobody : self.shed;
    if (over) self.shed = nobody;
    return;
  }
  constexpr int hand = 13;  // of per_range: so much nearer is progress
  const auto all = self.known_tasks();
  const int reached = count_of(all, [](const Task& t) { return t.holder != nobody && t.reached; });
  const int want_steps = static_cast<int>(self.want * per_range);
  const bool is_short = robot.params.shed_after_drives > 0.0F && !self.forgets &&
                        self.want > robot.params.arrival_distance && self.call_hops != nobody_calls;
  if (want_steps == 0 || (self.short_ticks == 0 && !is_short)) return void(self.short_ticks = 0);
  if (self.short_ticks == 0 || want_steps < self.short_want - hand || reached > self.short_reached) {
    self.short_ticks = 0;
    self.short_want = static_cast<std::uint16_t>(want_steps);
    self.short_reached = static_cast<std::uint8_t>(reached);
  }
  robot.add_elapsed(self.short_ticks);
  constexpr float sooner = 0.45F;  // once it is known that robots are too few
  const bool known = banyan::any_of(all, [](const Task& t) { return t.holder == nobody || t.times_put_off > 0; });
  if (self.short_ticks <= robot.params.rounds((known ? sooner : 1.0F) * robot.params.shed_after_drives) || !is_short)
    return;
  self.shed = least_worth(robot);
  self.short_ticks = 0;
}

// The fewest robots that it takes beside what stands: along a straight line from the nearest way to a target that is
// held. If none is, all come along.
int least_robots(const ConvoyRobot& robot, const Task& task) noexcept {
  float gap = far;
  for (const Task& other : robot.self.known_tasks())
    if (other.holder != nobody) gap = std::min(gap, distance_to_segment(task.target, other.target, Vec2{}));
  return gap < far ? static_cast<int>((gap - robot.params.arrival_distance) / robot.params.ideal_distance) + 1 : 1;
}

// Once all others are held and spares may suffice, a target that was put off is tried again: soon if there are more
// spares than ever before, else after a pause that doubles with each time. If nobody sets out for it, it is put off
// again.
void retry(ConvoyRobot& robot) noexcept {
  constexpr float first_pause_drives = 3.0F;  // before it is tried again; then twice as long each time
  constexpr float unclaimed_drives = 6.0F;    // then it is put off again
  ConvoyState& self = robot.self;
  const int spares = static_cast<int>(self.root_size) - static_cast<int>(self.subtree);
  const int tried_with = static_cast<int>(self.tried_with);
  const bool none_held = count_held(self) == 0;
  const bool settled = self.phase == Phase::grow_tree && !self.forgets && (none_held || has_settled(robot));
  Task* next = nullptr;
  int fewest = spares + 1;
  for (Task& task : self.known_tasks()) {
    if ((is_tried_again(task) || task.serves == self.shed) && task.holder != nobody &&
        task.age_ticks > robot.params.rounds(unclaimed_drives))
      return put_off(robot, task);
    const int doubled = robot.params.rounds(first_pause_drives) << (spares > tried_with ? 1 : int{task.times_put_off});
    const int pause_ticks = std::min(doubled, UINT16_MAX - 1);  // age_ticks reaches no farther
    if (!settled || !is_put_off(task) || task.unlocated || task.age_ticks <= pause_ticks) continue;
    if (const int robots = least_robots(robot, task); robots < fewest) next = &task, fewest = robots;
  }
  if (next == nullptr) return;
  try_again(robot, *next);
  self.tried_with = static_cast<RobotCount>(std::max(tried_with, spares));
}

// ---- Every robot ----

// Whether there are so many robots that branches may fold (convoy/folding.hpp): for each path more than the
// shortest tree takes, since edges are not all equally long. What is measured varies, so there is a band between.
void count_for_folding(ConvoyRobot& robot) noexcept {
  constexpr int look_again_ticks = 16;  // between two looks
  constexpr float plenty = 1.25F;       // times the robots of one path: from here on branches may fold,
  constexpr float scarce = 1.1F;        // and below this they may not
  ConvoyState& self = robot.self;
  if (!has_companions(robot.params) || !robot.params.line_of_sight) return;
  if (self.turn % look_again_ticks != 0 || self.root_size == 0) return;
  const auto paths = static_cast<float>(best_tree(robot).robots * robot.params.link_redundancy);
  self.too_few_to_fold = static_cast<float>(self.root_size) < paths * (self.too_few_to_fold ? plenty : scarce);
}

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
  if (self.phase != Phase::grow_tree || self.role != Role::connector || self.below == nobody || !robot.parent_alive() ||
      !has_arrived(robot))
    return nobody;
  if (robot.convoy_of(robot.parent).below == self.below) return nobody;  // the parent leads
  const Task* served = find_active(robot, self.below);
  const Task* host = served == nullptr
                         ? nullptr
                         : find_active(robot, self.hosts[static_cast<std::size_t>(served - self.tasks.data())]);
  if (host == nullptr || host == served || self.above == host->serves) return nobody;
  return host->serves;
}

}  // namespace

bool has_settled(const ConvoyRobot& robot) noexcept {
  constexpr int settled_ticks = 50;  // so long all have been at their targets
  static_assert(settled_ticks > unsettled_ticks, "until then settled_ticks grows, whoever is missing");
  return robot.self.settled_ticks > settled_ticks;
}

bool find_goal(const ConvoyRobot& robot, Vec2& goal) noexcept {
  const Task* host = find_active(robot, robot.self.lead_to);
  if (host != nullptr) goal = host->target;
  return host != nullptr;
}

bool is_held_back(const ConvoyRobot& robot) noexcept {
  return robot.self.lead_to != nobody && robot.self.lead_ticks > robot.params.rounds(held_back_after_drives);
}

Vec2 lead(const ConvoyRobot& robot) noexcept {
  Vec2 goal;
  return find_goal(robot, goal) ? bypass(robot, goal) : Vec2{};
}

void take_part_in_plan(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  look_down(robot);
  count_for_folding(robot);
  if (robot.is_root()) {
    self.above = nobody;
    command(robot);
    shed(robot);
    retry(robot);
  } else {
    hear_parent(robot);
  }
  // With more targets than robots can remember, targets unknown to the root keep branches that no plan would count.
  if (self.forgets) withdraw(self);
  bool planned = false;
  for (int k = 0; k < self.task_count; ++k) {
    Task& task = self.tasks[k];
    if (is_put_off(task)) self.hosts[k] = nobody;  // before it is tried again all have heard
    if (self.hosts[k] != task.serves) planned = planned || self.hosts[k] != nobody;
    else if (self.is_worker && self.serves == task.serves && !robot.is_station) resign(robot), put_off(robot, task);
  }
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
