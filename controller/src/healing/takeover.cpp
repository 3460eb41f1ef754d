// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/core/search.hpp"
#include "healing/healing.hpp"

namespace banyan {

namespace {

constexpr int takeover_beats = 60;          // a successor's count starts so far ahead of the news under way
constexpr int rival_beats = 30;             // a count farther behind mine is that of a dead worker
constexpr std::uint8_t pass_on_ticks = 40;  // how long news has priority
constexpr float second_try_drives = 4.0F;   // so much later whoever gave it up tries again
constexpr float news_hop = 0.7F;            // of C
constexpr int per_tick = 16;                // units of news_gap
constexpr int gap_memory = 64;              // pieces of news
constexpr int gap_patience = 2;             // times as long as other news was missing of late

// What the sender says of a target.
struct TaskNews {
  RobotId serves;
  RobotId holder;
  Serial beat;
  bool reached;  // the holder is at the target
  bool silent;   // in doubt
  RobotId via;   // my child at or above the holder; nobody: the sender is no child, or denies it
};

TaskNews news_in(const HealingRobot& robot, const HealingMessage& m) noexcept {
  const bool below = m.task_below && up_of(m) == robot.self.id;
  return {m.task_serves, m.task_holder, m.task_beat, m.task_reached, m.task_silent, below ? m.id : nobody};
}

Concern concern_of(const TaskNews& news) noexcept {
  if (news.silent || news.holder == nobody) return Concern::urgent;
  if (news.via == nobody) return Concern::none;
  return news.via == news.holder ? Concern::child : Concern::below;
}

void serve(HealingState& self, Task& task, bool reached) noexcept {
  task.holder = self.id;
  task.age_ticks = 0;
  task.reached = reached;
  task.silent = task.gave_up = false;
  task.via = nobody;
  ++task.beat;
}

// First the one at the target, then the worker first sent there, then the one with the smaller id.
struct Claim {
  RobotId id;
  bool reached;
};
bool has_precedence(Claim a, Claim b, RobotId serves) noexcept {
  if (a.reached != b.reached) return a.reached;
  return a.id == serves || (b.id != serves && a.id < b.id);
}

// Another robot is said to serve my target. A count far behind may be a dead worker's and is ignored; a rival
// that lives will hear my count.
void settle_rivalry(HealingRobot& robot, Task& task, const TaskNews& news) noexcept {
  if (news.holder == nobody || ahead_by(news.beat, task.beat) < -rival_beats) return;
  const bool yields =
      !robot.is_station && has_precedence({news.holder, news.reached}, {robot.self.id, task.reached}, task.serves);
  if (yields) {
    resign(robot);
    task.holder = news.holder;
    task.reached = news.reached;
    task.beat = news.beat;
    task.urgent_ticks = pass_on_ticks;
  } else {
    task.beat = advanced(news.beat, takeover_beats);  // so that it hears of me
  }
}

// Towards what a robot says that only remembers the place, or measures with noise.
void approach(Task& task, Vec2 told) noexcept {
  constexpr float trust = 0.2F;  // of the difference, for each time it is told
  task.target += (told - task.target) * trust;
}

// Where bearings are noisy, what a robot says of a far target is wrong by decimetres, and copies of that drift: then
// only those help to remember a place that are near it, or at least nearer than I am.
bool is_too_far_to_tell(const HealingRobot& robot, RobotId sender, Vec2 told, Vec2 remembered) noexcept {
  constexpr float beside_target = 0.5F;  // of C
  const TreeTable& table = robot.table();
  if (!table.filter().has_seen_noise()) return false;
  const int k = table.find(sender);
  const float near = std::max(beside_target, norm(remembered));
  return k < 0 || distance(told, table.position(k)) > near;
}

// Where the target is, as told by a robot about as near to its worker as I am. If the worker is silent, or itself goes
// by memory, copies of copies would only drift, and wheels slip in a crowd: then the mean of what all neighbours
// remember is best. Where targets are handed over all the time, the holder and the worker first sent there know best.
void locate(const HealingRobot& robot, Task& task, RobotId sender, const TaskNews& news, Vec2 told) noexcept {
  constexpr int stale_ticks = 3;  // a count farther behind mine is old news
  const bool silent =
      robot.self.forgets ? task.silent && news.silent : task.age_ticks > 2 * robot.liveness_ticks() + task_capacity;
  const bool by_memory = silent || task.holder != task.serves;
  const bool noisy = robot.table().filter().has_seen_noise();
  const bool knows_best = robot.passes_targets_on && (sender == task.holder || sender == task.serves);
  const auto is_fresh = [&] {
    return ahead_by(news.beat, task.beat) >= -stale_ticks || is_news(news.beat, task.beat, task.age_ticks);
  };
  if (task.unlocated) set_place(task, told);
  else if (knows_best || (!by_memory && is_fresh())) {
    if (!noisy) task.target = told;
    else approach(task, told);
  } else if (by_memory && !is_too_far_to_tell(robot, sender, told, task.target)) {
    approach(task, told);
  }
}

// The longest recent gap in the news of a worker that was alive: in a long thin network news comes in bursts.
void measure_gap(HealingState& self, const Task& task) noexcept {
  const int gap = self.news_gap - self.news_gap / gap_memory;
  self.news_gap = static_cast<std::uint16_t>(std::max(gap, std::min<int>(task.age_ticks * per_tick, UINT16_MAX)));
}

// A count so little later than the one last heard is no proof of life: it was on another way when the worker fell
// silent.
bool proves_life(const HealingRobot& robot, Serial later, Serial missed) noexcept {
  return ahead_by(later, missed) > robot.liveness_ticks() / 2;
}

// A later sign of life, or another holder.
void renew(HealingRobot& robot, Task& task, const TaskNews& news) noexcept {
  if (news.holder == task.holder && !task.silent) measure_gap(robot.self, task);
  if (news.holder == task.holder && task.silent && task.age_ticks < serial_half_range &&
      !proves_life(robot, news.beat, task.beat))
    return;
  // It has been alive since I missed it: another robot is in charge of it.
  if (task.silent && !news.silent) task.via = nobody;
  if (news.silent != task.silent || news.holder != task.holder) task.urgent_ticks = pass_on_ticks;
  task.beat = news.beat;
  task.holder = news.holder;
  task.reached = news.reached;
  task.age_ticks = 0;
  task.silent = false;
}

void hear_of_task(HealingRobot& robot, RobotId sender, const TaskNews& news, const Vec2* target) noexcept {
  HealingState& self = robot.self;
  const bool mine = self.is_worker && self.serves == news.serves;
  if (news.holder == self.id && !mine) return;  // old news, from before I resigned
  Task* task = find_task(self, news.serves);
  if (task == nullptr) {
    if (target == nullptr && !news.silent) return;  // a question is passed on even without the place
    task = add_task(self, news.serves, target, mine ? Concern::own : concern_of(news));
    if (task == nullptr) return;
    task->beat = advanced(news.beat, -1);
    task->holder = news.holder;
    if (news.holder == nobody) task->urgent_ticks = pass_on_ticks;
  }
  if (mine) {
    // If the mission tells me where it is, no other robot knows better.
    const bool knows_better = !robot.passes_targets_on || sender == news.serves;
    if (target != nullptr && robot.target == nullptr && knows_better &&
        !is_too_far_to_tell(robot, sender, *target, task->target))
      approach(*task, *target);
    if (news.silent) task->urgent_ticks = pass_on_ticks;
    if (news.holder != self.id) settle_rivalry(robot, *task, news);
    return;
  }
  if (target != nullptr) locate(robot, *task, sender, news, *target);
  if (news.via != nobody || task->via == sender) task->via = news.via;
  const bool newer = is_news(news.beat, task->beat, task->age_ticks);
  if (newer) renew(robot, *task, news);
  if (news.silent && !task->silent) {
    if (proves_life(robot, task->beat, news.beat))
      task->urgent_ticks = pass_on_ticks;  // I know of a later sign of life
    else begin_doubt(robot, *task);
  }
}

// Finds targets in the list by the last bits of their names: every packet is about one.
class TaskIndex {
 public:
  explicit TaskIndex(const HealingState& self) noexcept : tasks_(self.tasks) {
    for (int k = 0; k < self.task_count; ++k) place_[tasks_[k].serves % places] = static_cast<std::uint8_t>(k);
  }
  // Null if the target is not known, or if another one has its slot.
  [[nodiscard]] const Task* find(RobotId serves) const noexcept {
    const Task& task = tasks_[place_[serves % places]];
    return task.serves == serves ? &task : nullptr;
  }

 private:
  static constexpr int places = 64;
  const std::array<Task, task_capacity>& tasks_;
  std::array<std::uint8_t, places> place_{};
};

void hear_of_tasks(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  const TaskIndex index(self);
  const RobotId me = self.id;
  for (const Heard& h : robot.heard) {
    const HealingMessage& m = said(h);
    if (m.forgets) self.forgets = true;
    if (m.task_serves == nobody) continue;
    // Most news is old: a count no newer than mine, no doubt, a target that others serve, a place told to another
    // robot, and nothing new about where in the tree its holder is.
    const Task* task = m.told == me ? nullptr : index.find(m.task_serves);
    const bool below = m.task_below && up_of(m) == me;
    if (task != nullptr && !m.task_silent && (task->via == m.id) == below &&
        !is_news(m.task_beat, task->beat, task->age_ticks) && (!self.is_worker || self.serves != m.task_serves))
      continue;
    Vec2 target;
    const bool told = m.told == self.id && robot.read_point(h, m.task_x, m.task_y, target);
    hear_of_task(robot, m.id, news_in(robot, m), told ? &target : nullptr);
  }
}

void grow_older(HealingRobot& robot) noexcept {
  for (Task& task : robot.self.known_tasks()) {
    robot.add_elapsed(task.age_ticks);
    task.urgent_ticks = static_cast<std::uint8_t>(std::max(0, task.urgent_ticks - robot.elapsed_ticks));
  }
}

// Whether I am at the target.
bool is_there(const HealingRobot& robot, const Task& task) noexcept {
  return !task.unlocated && norm(task.target) <= robot.params.arrival_distance;
}

// My own target. One that the mission has taken from me is given up, and all robots are to know.
void mind_own(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  const RobotId me = self.id;
  const RobotId own = self.is_worker ? self.serves : nobody;
  for (Task& task : self.known_tasks()) {
    if (task.holder != me || task.serves == own || task.gave_up) continue;
    announce(task, nobody);
  }
  if (!self.is_worker) {  // I may still be told where the target is that I was sent to
    if (Task* task = self.target_known ? find_task(self, me) : nullptr; task != nullptr) set_place(*task, self.target);
    return;
  }
  Task* task = find_task(self, self.serves);
  if (task == nullptr && robot.target != nullptr) task = add_task(self, self.serves, robot.target, Concern::own);
  if (task == nullptr) return;
  if (robot.target != nullptr) set_place(*task, *robot.target);
  serve(self, *task, is_there(robot, *task));
}

void take_over(HealingRobot& robot, Task& task) noexcept {
  HealingState& self = robot.self;
  self.is_worker = true;
  self.serves = task.serves;
  self.role = Role::worker;
  self.request = self.inserted_child = nobody;
  self.spare_state = SpareState::wait;
  announce(task, self.id);
  self.progress = {};
  serve(self, task, is_there(robot, task));
  ++self.tally.replacements;
}

// News of another branch goes in to the root and out to me, and every robot on the way sends news of all targets in
// turn: on average half of them before this one. A robot without a label waits longest, until it has a tree.
int way_of_news_ticks(const HealingRobot& robot, const Task& task) noexcept {
  const HealingState& self = robot.self;
  const float in = self.root_known ? distance(self.root_at, task.target) : 0.0F;
  const float out = from_fixed(self.label);
  return static_cast<int>((in + out) / news_hop * static_cast<float>(self.task_count));
}

// Where robots forget, an answer comes straight from near the target, in turn with all that is urgent, which has every
// second message: how much longer that takes than the spread allows for.
int way_of_answer_ticks(const HealingRobot& robot, const Task& task) noexcept {
  constexpr float hop = 0.5F;  // of C
  const HealingState& self = robot.self;
  const int urgent = count_of(self.known_tasks(), is_urgent);
  const float hops = norm(task.target) / hop;
  const int spread_ticks = whole(robot.params.succession_spread_rounds * norm(task.target));
  return std::max(0, static_cast<int>(hops * 2.0F * static_cast<float>(urgent)) - spread_ticks);
}

// The nearer to the target, the sooner: the first robot tells the others.
void succeed(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  const HealingParams& p = robot.params;
  const bool free = self.role == Role::spare || self.dangling_ticks > 0;
  const int least_ticks = 2 * robot.liveness_ticks();
  if (!free || self.is_worker || robot.is_root() || self.silence_ticks > least_ticks) return;
  for (Task& task : self.known_tasks()) {
    if (task.unlocated || task.holder == nobody || task.age_ticks <= least_ticks || (self.forgets && !task.silent))
      continue;
    const int again_ticks = task.gave_up ? p.rounds(second_try_drives) : 0;  // others first
    const int way_ticks = self.forgets ? way_of_answer_ticks(robot, task) : way_of_news_ticks(robot, task);
    const int patience_ticks = least_ticks + way_ticks + again_ticks +
                               whole(p.succession_after_rounds + p.succession_spread_rounds * norm(task.target));
    const int rare_ticks = self.forgets ? 0 : gap_patience * self.news_gap / per_tick;  // doubt has waited already
    if (task.age_ticks > std::max(patience_ticks, rare_ticks)) return take_over(robot, task);
  }
}

}  // namespace

void resign(HealingRobot& robot) noexcept {
  robot.self.is_worker = false;
  robot.self.serves = nobody;
  robot.target = nullptr;
}

void yield_task(HealingRobot& robot, RobotId heir) noexcept {
  Task* task = find_task(robot.self, robot.self.serves);
  resign(robot);
  if (task != nullptr) announce(*task, heir);
}

void announce(Task& task, RobotId holder) noexcept {
  task.holder = holder;
  task.beat = advanced(task.beat, takeover_beats);
  task.urgent_ticks = pass_on_ticks;
}

void put_off(const HealingRobot& robot, Task& task) noexcept {
  announce(task, nobody);
  begin_doubt(robot, task);
}

// I stand for the dead worker, and do not go myself.
void try_again(const HealingRobot& robot, Task& task) noexcept {
  announce(task, robot.self.id);
  task.gave_up = true;
  task.silent = task.reached = false;
  task.age_ticks = 0;
}

void inherit_task(HealingRobot& robot, RobotId serves) noexcept {
  Task* task = find_task(robot.self, serves);
  if (task == nullptr || task->unlocated || robot.is_root()) return;
  take_over(robot, *task);
  --robot.self.tally.replacements;  // nobody has died
  ++robot.self.tally.insertions;
}

void watch_tasks(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  if (!robot.params.heals()) return;
  grow_older(robot);
  mind_own(robot);
  hear_of_tasks(robot);
  doubt(robot);
  succeed(robot);
  // A successor has its target from the task list, not from the mission.
  if (!self.is_worker || robot.target != nullptr) return;
  if (const Task* task = find_task(self, self.serves); task != nullptr && !task->unlocated)
    robot.target = &task->target;
}

}  // namespace banyan
