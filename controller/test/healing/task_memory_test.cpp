// SPDX-License-Identifier: MIT
// Of more targets than it can remember a robot remembers those that it has to.
#include "healing/healing.hpp"
#include "healing/tick.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace banyan {
namespace {

Task& known(HealingState& self, RobotId serves) { return *find_task(self, serves); }

Task* add(HealingState& self, RobotId serves, Vec2 target, Concern concern) {
  return add_task(self, serves, &target, concern);
}

HealingState full(float away_m = 1.0F) {
  HealingState self = initial_healing_state(1, false, false);
  for (int k = 0; k < task_capacity; ++k) {
    Task* task = add(self, static_cast<RobotId>(100 + k), {away_m + static_cast<float>(k), 0.0F}, Concern::none);
    task->holder = task->serves;
  }
  return self;
}

TEST(TaskMemory, WhoeverHasRoomForAllForgetsNothing) {
  HealingState self = full();
  EXPECT_EQ(self.task_count, task_capacity);
  EXPECT_FALSE(self.forgets);
  std::ignore = add(self, 500, {0.1F, 0.0F}, Concern::none);
  EXPECT_TRUE(self.forgets) << "who has refused one says so";
}

TEST(TaskMemory, WhatMattersMoreTakesThePlaceOfWhatMattersLeast) {
  HealingState self = full();
  for (Task& task : self.tasks) task.via = task.serves == 104 ? nobody : 900;
  ASSERT_NE(add(self, 500, {50.0F, 0.0F}, Concern::below), nullptr);
  EXPECT_EQ(find_task(self, 104), nullptr);
}

// Robots in one place hear the same, in the same order, and yet do not all forget the same.
TEST(TaskMemory, OfManyWorkersInOnePlaceAllAreKnownToSomebody) {
  constexpr RobotId workers = 3 * task_capacity;
  std::set<RobotId> known_to_somebody;
  for (RobotId id = 0; id < 20; ++id) {
    HealingState self = initial_healing_state(static_cast<RobotId>(1000 + id), false, false);
    for (RobotId serves = 0; serves < workers; ++serves)
      if (Task* task = add(self, serves, {1.0F, 0.0F}, Concern::none)) task->holder = serves;
    for (const Task& task : self.tasks) known_to_somebody.insert(task.serves);
  }
  EXPECT_EQ(known_to_somebody.size(), workers);
}

TEST(TaskMemory, OldNewsGivesWayToFresh) {
  HealingState self = full();
  known(self, 103).age_ticks = outdated_ticks + 1;
  ASSERT_NE(add(self, 500, {50.0F, 0.0F}, Concern::none), nullptr);
  EXPECT_EQ(find_task(self, 103), nullptr);
}

TEST(TaskMemory, OfManyDoubtsTheNearestAreRemembered) {
  HealingState self = full();
  for (Task& task : self.tasks) task.silent = true;
  EXPECT_EQ(add(self, 500, {50.0F, 0.0F}, Concern::urgent), nullptr);
  ASSERT_NE(add(self, 501, {0.5F, 0.0F}, Concern::urgent), nullptr);
  EXPECT_EQ(find_task(self, 100 + task_capacity - 1), nullptr);
}

// Who only passes a question on has the least to do with it.
TEST(TaskMemory, OfDoubtsThoseGoFirstOfWhichItIsNotKnownWhereTheyAre) {
  HealingState self = full();
  for (Task& task : self.tasks) task.silent = true;
  EXPECT_EQ(add_task(self, 500, nullptr, Concern::urgent), nullptr);
  known(self, 104).unlocated = true;
  ASSERT_NE(add(self, 501, {50.0F, 0.0F}, Concern::urgent), nullptr);
  EXPECT_EQ(find_task(self, 104), nullptr);
}

// Against a model that knows everything: whatever order it hears of targets in, a robot never loses its own nor one
// that matters more than all that it keeps, and it says that it forgets exactly when it does not know them all.
RC_GTEST_PROP(TaskMemory, KeepsWhatMattersInAnyOrder, ()) {
  HealingState self = initial_healing_state(1, true, false);
  add(self, 1, {90.0F, 0.0F}, Concern::own)->holder = 1;
  std::set<RobotId> told{1};
  const int count = *rc::gen::inRange(0, 40);
  for (int n = 0; n < count; ++n) {
    const auto serves = static_cast<RobotId>(2 + *rc::gen::inRange(0, 30));
    const auto concern = *rc::gen::element(Concern::none, Concern::below, Concern::child, Concern::urgent);
    if (find_task(self, serves) != nullptr) continue;
    told.insert(serves);
    Concern least = Concern::own;
    for (int k = 0; k < self.task_count; ++k)
      least = std::min(least, concern_of(self, self.tasks[static_cast<std::size_t>(k)]));
    const bool was_full = self.task_count == task_capacity;
    Task* task = add(self, serves, {static_cast<float>(*rc::gen::inRange(1, 60)), 0.0F}, concern);
    if (!was_full || concern > least) RC_ASSERT(task != nullptr);
    if (was_full && concern < least) RC_ASSERT(task == nullptr);
    if (task != nullptr) {
      task->holder = serves;
      task->silent = concern == Concern::urgent;
      if (concern == Concern::child) task->via = serves;
      if (concern == Concern::below) task->via = 900;
      RC_ASSERT(concern_of(self, *task) == concern);
    }
    RC_ASSERT(find_task(self, 1) != nullptr);
    RC_ASSERT(self.forgets == (told.size() > static_cast<std::size_t>(task_capacity)));
  }
}

}  // namespace
}  // namespace banyan
