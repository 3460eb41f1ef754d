// SPDX-License-Identifier: MIT
#include "healing/healing.hpp"

namespace banyan {

Task* find_task(HealingState& self, RobotId serves) noexcept {
  for (Task& task : self.known_tasks())
    if (task.serves == serves) return &task;
  return nullptr;
}

Concern concern_of(const HealingState& self, const Task& task) noexcept {
  if (self.is_worker && self.serves == task.serves) return Concern::own;
  if (is_urgent(task)) return Concern::urgent;
  if (task.via == nobody) return task.age_ticks > outdated_ticks ? Concern::outdated : Concern::none;
  return task.via == task.holder ? Concern::child : Concern::below;
}

namespace {

constexpr float nowhere = 1e9F;

// Decides between tasks of equal concern. Of doubts the nearer ones, since there I may be the successor. Of workers
// in no robot's charge each robot prefers different ones, so that of many in one place each is known to some robot.
float liking(const HealingState& self, Concern concern, RobotId serves, const Vec2* target) noexcept {
  if (concern != Concern::none) return target != nullptr ? -norm(*target) : -nowhere;
  return static_cast<float>(static_cast<std::uint16_t>((serves ^ (self.id * 0x9E37U)) * 0x6A2DU));
}

float liking(const HealingState& self, Concern concern, const Task& task) noexcept {
  return liking(self, concern, task.serves, task.unlocated ? nullptr : &task.target);
}

Task& least_concern(HealingState& self) noexcept {
  const auto matters_less = [&](const Task& a, const Task& b) {
    const Concern ca = concern_of(self, a);
    const Concern cb = concern_of(self, b);
    return ca != cb ? ca < cb : liking(self, ca, a) < liking(self, cb, b);
  };
  Task* least = self.tasks.data();
  for (Task& task : self.tasks)
    if (matters_less(task, *least)) least = &task;
  return *least;
}

}  // namespace

Task* add_task(HealingState& self, RobotId serves, const Vec2* target, Concern concern) noexcept {
  Task* task = nullptr;
  if (self.task_count < task_capacity) {
    task = &self.tasks[self.task_count++];
  } else {
    self.forgets = true;
    task = &least_concern(self);
    const Concern least = concern_of(self, *task);
    // Tasks in my charge are not replaced by others of the same concern.
    const bool changes = concern == Concern::none || concern == Concern::urgent;
    const bool better = liking(self, concern, serves, target) > liking(self, least, *task);
    if (concern < least || (concern == least && !(changes && better))) return nullptr;
  }
  *task = {};
  task->serves = serves;
  task->unlocated = target == nullptr;
  if (target != nullptr) task->target = *target;
  return task;
}

}  // namespace banyan
