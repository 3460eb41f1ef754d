// SPDX-License-Identifier: MIT
// Healing (protocol 12): any robot may die at any moment, the root included, and no robot is told. The
// root and the workers count ticks. All robots pass on the largest counts heard, and where the root
// and the targets are. So a robot that falls silent can be replaced by one that knows enough.
#pragma once

#include <algorithm>

#include "healing/robot.hpp"

namespace banyan {

// ---- loss.cpp: how long a neighbour may be silent ----

// Estimates the share of packets that are lost from those heard the tick before, and makes I so long
// that a living neighbour is silent for it once in 10^5 times.
void estimate_loss(HealingRobot& robot) noexcept;

// ---- mutual.cpp: which neighbours hear me ----

// The sender, which is in the table, may have named me as one that it hears, or have passed me over.
void note_hears(HealingRobot& robot, const Heard& h) noexcept;
// It may have done neither, as in most messages: it has named one that comes, by ascending ids round and round, before
// me.
[[nodiscard]] inline bool names_another(const HealingRobot& robot, const Heard& h) noexcept {
  const auto after = [&](RobotId id) { return static_cast<RobotId>(id - h.named_before - 1); };
  return after(robot.self.id) > after(h.message->count) && h.message->count != h.message->id;
}
// The next neighbour to be named as heard; my own id if I call.
[[nodiscard]] RobotId name_next(const HealingRobot& robot) noexcept;
// robot.gap: the neighbour by which a part of the network is near that hears nobody of mine, or that I do not belong to
// because it does not hear me.
void find_gap(HealingRobot& robot) noexcept;
// Whether I come nearer to it, or to a robot that calls, by motion `u`.
[[nodiscard]] bool closes_gap(const HealingRobot& robot, Vec2& u) noexcept;

// The smallest call hops heard in this tick or the last, of those that `counts` accepts. The hops of a call that is
// over count up, and the slower the more neighbours are hidden now and then, with what they said last.
template <class Counts> [[nodiscard]] std::uint8_t live_call_hops(const TreeTable& table, Counts counts) noexcept {
  std::uint8_t least = nobody_calls;
  for (int k = 0; k < table.size(); ++k) {
    const std::uint8_t hops = table.message(k).call_hops;
    if (table.age(k) <= 1 && counts(hops)) least = std::min(least, hops);
  }
  return least;
}

// ---- thin_start.cpp: few neighbours at the start, all of them far away ----

// Of how many, as long as I have heard of no root; 1 if I have heard nobody.
void note_start(HealingRobot& robot) noexcept;
// Until that is noted I keep those that have fallen silent.
[[nodiscard]] bool may_start_thin(const HealingRobot& robot) noexcept;
// The first of their links is near C. For the first rounds nobody moves.
[[nodiscard]] bool starts_wide(const HealingRobot& robot) noexcept;
// Where packets get lost, another part of the network may hear me that I have not heard yet. So I stay as long as I
// have heard of no root, and where links are near C for the first rounds; at the end of such a start longer, or I go
// towards whoever may be there, by motion `u`.
[[nodiscard]] bool awaits_others(const HealingRobot& robot, Vec2& u) noexcept;
// In the first rounds of such a start a silence is rather a burst than a death.
[[nodiscard]] inline bool starts_thin(const HealingState& self) noexcept {
  constexpr int start_ticks = 50;  // the first rounds
  return self.neighbors_at_start > 0 && self.turn < start_ticks;
}
// Packets get lost in such a start.
[[nodiscard]] inline bool is_thin(const HealingState& self) noexcept {
  return self.usual_silence > 0 && self.neighbors_at_start > 0;
}

// ---- heartbeat.cpp: is there a root, and where? ----

void follow_heartbeat(HealingRobot& robot) noexcept;
[[nodiscard]] bool hears_nobody(const HealingRobot& robot) noexcept;
// Close to where the root fell silent: becomes root and opens an epoch.
void claim_root(HealingRobot& robot) noexcept;

// ---- task_memory.cpp: which targets a robot knows of ----

// By its first worker; null if I know of no such target.
[[nodiscard]] Task* find_task(HealingState& self, RobotId serves) noexcept;

inline void set_place(Task& task, Vec2 target) noexcept {
  task.target = target;
  task.unlocated = false;
}

// I serve it, or a robot below me in the tree does.
[[nodiscard]] inline bool is_mine_or_below(const HealingState& self, const Task& task) noexcept {
  return task.via != nobody || (self.is_worker && self.serves == task.serves);
}

// A doubt is a question to all, for a minute: later no answer will come, and no spare was free to take over.
inline constexpr int question_ticks = 600;
[[nodiscard]] inline bool is_asked_about(const Task& task) noexcept {
  return task.silent && task.holder != nobody && task.age_ticks <= question_ticks;
}
// Every robot has to pass it on soon: a question, or news that has priority.
[[nodiscard]] inline bool is_urgent(const Task& task) noexcept { return is_asked_about(task) || task.urgent_ticks > 0; }

// How much a robot needs to know of a target, least first. With more targets than it can remember, those that
// matter more take the place of those that matter less.
enum class Concern : std::uint8_t { outdated, none, below, child, urgent, own };
inline constexpr int outdated_ticks = 100;  // older news says nothing about the moment in which a branch tears
[[nodiscard]] Concern concern_of(const HealingState& self, const Task& task) noexcept;
// Room for one more; null if there is none for so small a concern. `target`: where it is, if I know. A robot without
// room for all says so: from then on no robot takes silence alone for death.
[[nodiscard]] Task* add_task(HealingState& self, RobotId serves, const Vec2* target, Concern concern) noexcept;

// ---- doubt.cpp: which robots may say that a worker is dead ----

// Where robots forget, news of a living worker may not come through; then only those in charge of it doubt that
// it lives: robots that no longer hear it, or the child by which it was below them. The doubt is a question to
// all. Every robot that knows of a later sign of life answers, first of all the worker.
void doubt(HealingRobot& robot) noexcept;
// Its clock starts with it, however old the news of the worker: the rest of the patience is for answers.
void begin_doubt(const HealingRobot& robot, Task& task) noexcept;

// ---- takeover.cpp: does every target have its worker? ----

// Learns of targets and their workers, gives up a target that a robot with precedence serves,
// takes over one whose worker has fallen silent.
void watch_tasks(HealingRobot& robot) noexcept;
// A worker that was not sent: others told it where its target is.
[[nodiscard]] inline bool goes_by_memory(const HealingState& self) noexcept {
  return self.is_worker && self.serves != self.id;
}
// Serves no target any more; does not say which robot does.
void resign(HealingRobot& robot) noexcept;

// The holder of my target is robot `heir` from now on, and I am free.
void yield_task(HealingRobot& robot, RobotId heir) noexcept;

// All robots are to hear of another holder.
void announce(Task& task, RobotId holder) noexcept;

// Robots are too few for it: nobody serves it until the root has it tried again. Then it is as if its worker had died.
void put_off(const HealingRobot& robot, Task& task) noexcept;
void try_again(const HealingRobot& robot, Task& task) noexcept;
[[nodiscard]] inline bool is_put_off(const Task& task) noexcept { return task.holder == nobody && task.silent; }
[[nodiscard]] inline bool is_tried_again(const Task& task) noexcept {
  return task.holder != nobody && task.times_put_off > 0 && !task.reached;
}
// I serve that target from now on, as after its worker's death; it knows. Nothing if I do not know where it is.
void inherit_task(HealingRobot& robot, RobotId serves) noexcept;

// ---- progress.cpp: a worker that gets no nearer ----

// At the end of a step, with the velocity that it is to have, v_max. A worker that has driven in vain for long (its
// motors or wheels do not do what they are told, bodies or walls are in its way) resigns: its target goes to the next,
// as if it had died, and for four drives longer not to itself.
void watch_progress(HealingRobot& robot, bool retreats, Vec2 v) noexcept;

// ---- dangling_branch.cpp: the end of a torn branch ----

// Notes that this connector's only child has fallen silent for good. It stays in the tree and drives to where
// the child was, as a worker would, to meet the robots below it.
void watch_branch(HealingRobot& robot) noexcept;
// Until it is there: robot.carries_on.

// ---- retreat.cpp: back to where the others should be ----

// A worker whose edge has waited in vain for a spare: its branch is too short. Where robots can change their
// parents between reconstructions (convoy) it drives home, joins the robots nearest to the root, and sets out
// anew from there: it regroups.
[[nodiscard]] bool is_left_waiting(const HealingRobot& robot) noexcept;
// The ticks that its edge has waited, or would have while it is on its way.
void count_waiting(HealingRobot& robot, bool unserved, bool regroups) noexcept;
// No root has been heard of for long, or it regroups.
[[nodiscard]] bool is_retreating(const HealingRobot& robot, bool regroups) noexcept;
// Towards where the root was, in units of speed_gain.
[[nodiscard]] Vec2 retreat_motion(const HealingRobot& robot, bool regroups) noexcept;

// How far this robot has to drive for a reason of its own, C: to where the last robot below it was.
[[nodiscard]] inline float own_want(const HealingRobot& robot) noexcept {
  return robot.carries_on ? norm(robot.self.lost_child) : 0.0F;
}

// ---- fragments.cpp: two networks meet ----

// Adopts root and phase, in a swarm that may have been torn apart: when two roots meet, the root of the
// larger fragment stays.
void listen_among_fragments(HealingRobot& robot) noexcept;
// accept_offer() and advance(), with the size of the root's fragment.
void accept_offered_root(HealingRobot& robot) noexcept;
void advance_and_count(HealingRobot& robot, bool tree_complete, bool may_reconstruct = true) noexcept;

// ---- gossip.cpp: what of it is broadcast ----

// The counts, and for one neighbour at a time where root and targets are. Index of the target spoken of;
// -1: none.
int gossip(const HealingRobot& robot, HealingMessage& message) noexcept;

}  // namespace banyan
