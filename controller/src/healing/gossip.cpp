// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/healing/healing.hpp"

namespace banyan {
namespace {

// A point as the neighbour at `addressee` is told it.
void write(Vec2 point, Vec2 addressee, std::int16_t& x_cm, std::int16_t& y_cm) noexcept {
  const Vec2 v = to_edge_frame(point - addressee, addressee);
  x_cm = to_fixed<std::int16_t>(v.x, per_cm);
  y_cm = to_fixed<std::int16_t>(v.y, per_cm);
}

// Only who was heard this tick can be told a point: it is written relative to where that robot is.
int next_heard(const TreeTable& table, int turn) noexcept {
  const int size = table.size();
  const int first = size > 0 ? turn % size : 0;
  for (int k = first; k < size; ++k)
    if (table.age(k) == 0) return k;
  for (int k = 0; k < first; ++k)
    if (table.age(k) == 0) return k;
  return -1;
}

}  // namespace

int gossip(const HealingRobot& robot, HealingMessage& m) noexcept {
  const HealingState& self = robot.self;
  if (!robot.params.heals()) return -1;
  m.heartbeat = self.heart == self.root ? self.heartbeat : std::uint16_t{0};
  // Every pair of a neighbour and a target has its turn; not all robots speak of the same at once.
  const int turn = self.turn + self.id;
  const int tasks = std::max<int>(self.task_count, 1);
  const int spoken_of = self.task_count > 0 ? turn % tasks : -1;
  const Task* task = spoken_of >= 0 ? &self.tasks[spoken_of] : nullptr;
  if (task != nullptr) {
    m.task_serves = task->serves;
    m.task_holder = task->holder;
    m.task_beat = task->beat;
  }
  const int k = next_heard(robot.table(), turn / tasks);
  if (k < 0) return spoken_of;
  const Vec2 addressee = robot.table().position(k);
  m.told = robot.table().id(k);
  m.root_told = self.root_known && self.heart == self.root;
  if (m.root_told) write(self.root_at, addressee, m.root_x_cm, m.root_y_cm);
  if (task != nullptr) write(task->target, addressee, m.task_x_cm, m.task_y_cm);
  return spoken_of;
}

}  // namespace banyan
