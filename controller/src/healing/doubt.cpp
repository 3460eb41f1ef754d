// SPDX-License-Identifier: MIT
#include <algorithm>

#include "healing/healing.hpp"

namespace banyan {
namespace {

constexpr int hesitate_ticks = 25;      // beyond I
constexpr float well_in_range = 0.85F;  // of C: a worker farther away may only have gone out of range

// I heard the worker, and its parent is gone, too, or has more workers below than it can remember.
bool takes_charge(const HealingRobot& robot, const Task& task) noexcept {
  const TreeTable& table = robot.table();
  const int holder = table.find(task.holder);
  if (holder < 0 || !fades(robot, holder) || table.range(holder) > well_in_range) return false;
  const int parent = table.find(up_of(table.message(holder)));
  return parent < 0 || fades(robot, parent) || table.message(parent).subtree_workers > task_capacity;
}

// The child has taken another parent, and its workers along, or serves none any more.
bool has_left(const HealingRobot& robot, int child) noexcept {
  if (child < 0 || !robot.table().alive(child)) return false;
  const TreeStanding& m = robot.table().message(child);
  const RobotId up = up_of(m);
  return up != robot.self.id && (up != nobody || m.role == Role::spare);
}

// While I waited the worker, if it lives, has gone on counting: what others heard of it before that is no answer. Half
// of these ticks, since clocks and steps differ.
void raise_doubt(const HealingRobot& robot, Task& task) noexcept {
  task.beat = advanced(task.beat, std::max(0, task.age_ticks - robot.liveness_ticks()) / 2);
  begin_doubt(robot, task);
}

}  // namespace

void begin_doubt(const HealingRobot& robot, Task& task) noexcept {
  if (task.holder == nobody && task.times_put_off < most_put_off) ++task.times_put_off;
  task.silent = true;
  task.age_ticks = static_cast<std::uint16_t>(robot.liveness_ticks());
}

void doubt(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  if (!self.forgets) return;
  // A robot may stand in between for a moment.
  const int doubt_ticks = robot.liveness_ticks() + hesitate_ticks;
  for (Task& task : self.known_tasks()) {
    int child = robot.table().find(task.via);
    if (has_left(robot, child)) task.via = nobody;
    if (task.silent || task.holder == nobody || task.age_ticks <= fading_ticks(robot)) continue;
    if (task.via == nobody && takes_charge(robot, task)) task.via = task.holder;
    if (task.via == nobody) continue;
    // While that child lives, news of the worker comes through it, in turn with news of many others. Old news is no
    // reason for doubt until a branch torn off would have had time to be heard of.
    child = robot.table().find(task.via);
    const bool fading = child >= 0 && fades(robot, child);
    if (fading) task.age_ticks = static_cast<std::uint16_t>(std::min<int>(task.age_ticks, robot.table().age(child)));
    if (task.age_ticks > std::max(outdated_ticks, 2 * doubt_ticks)) task.via = nobody;
    else if (task.age_ticks > doubt_ticks && (child < 0 || fading)) raise_doubt(robot, task);
  }
}

}  // namespace banyan
