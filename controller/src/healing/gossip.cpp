// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/core/search.hpp"
#include "healing/healing.hpp"

namespace banyan {
namespace {

// Only a robot heard in this tick can be told a point, since that is written relative to the robot's position.
int next_heard(const TreeTable& table, int turn) noexcept {
  const int size = table.size();
  const int first = size > 0 ? turn % size : 0;
  for (int k = first; k < size; ++k)
    if (table.age(k) == 0) return k;
  for (int k = 0; k < first; ++k)
    if (table.age(k) == 0) return k;
  return -1;
}

// The target that my message is about, and who is told where it is: the robot above me, or all in turn.
struct Topic {
  int task = -1;  // -1: none
  int turn = 0;   // whose turn it is
  bool upwards = false;
};

// Each pair of a neighbour and a target for which `counts` holds has its turn; robots begin at different targets.
template <class Counts> Topic next_topic(const HealingState& self, int turn, Counts counts) noexcept {
  const auto tasks = self.known_tasks();
  const int among = count_of(tasks, counts);
  if (among == 0) return {-1, turn};
  int left = turn % among;
  const auto chosen = first_of(tasks, [&](const Task& task) { return counts(task) && left-- == 0; });
  return {static_cast<int>(chosen - tasks.begin()), turn / among};
}

// Every second turn is for what all robots have to know soon. Where robots forget, the rest is for those above me:
// my own target and those of the workers below.
Topic choose_topic(const HealingState& self) noexcept {
  int turn = self.turn + self.id;
  if (banyan::any_of(self.known_tasks(), is_urgent)) {
    if (turn % 2 != 0) return next_topic(self, turn / 2, is_urgent);
    turn /= 2;
  }
  if (!self.forgets) return next_topic(self, turn, [](const Task&) { return true; });
  Topic topic = next_topic(self, turn, [&](const Task& task) { return is_mine_or_below(self, task); });
  topic.upwards = topic.task >= 0 && topic.turn % 2 != 0;
  topic.turn /= 2;
  return topic;
}

int addressee_of(const HealingRobot& robot, const Topic& topic) noexcept {
  if (topic.upwards) {
    const int up = robot.up();
    if (up >= 0 && robot.table().age(up) == 0) return up;
  }
  return next_heard(robot.table(), topic.turn);
}

}  // namespace

int gossip(const HealingRobot& robot, HealingMessage& m) noexcept {
  const HealingState& self = robot.self;
  if (!robot.params.heals()) return -1;
  m.heartbeat = self.heart == self.root ? self.heartbeat : std::uint16_t{0};
  m.forgets = self.forgets;
  const Topic topic = choose_topic(self);
  const Task* task = topic.task >= 0 ? &self.tasks[static_cast<std::size_t>(topic.task)] : nullptr;
  if (task != nullptr) {
    m.task_serves = task->serves;
    m.task_holder = task->holder;
    m.task_beat = task->beat;
    m.task_reached = task->reached;
    m.task_silent = task->silent;
    m.task_below = is_mine_or_below(self, *task);
  }
  const int k = task != nullptr && task->unlocated ? -1 : addressee_of(robot, topic);
  if (k < 0) return topic.task;
  const Vec2 addressee = robot.table().position(k);
  m.told = robot.table().id(k);
  m.root_told = self.root_known && self.heart == self.root;
  if (m.root_told) write_in_edge_frame(self.root_at - addressee, addressee, m.root_x, m.root_y);
  if (task != nullptr) write_in_edge_frame(task->target - addressee, addressee, m.task_x, m.task_y);
  return topic.task;
}

}  // namespace banyan
