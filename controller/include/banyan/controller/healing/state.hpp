// SPDX-License-Identifier: MIT
// What an algorithm that heals remembers in addition.
#pragma once

#include <array>
#include <cstdint>

#include "banyan/controller/healing/message.hpp"
#include "banyan/controller/obstacles/state.hpp"
#include "banyan/controller/tree/state.hpp"

namespace banyan {

inline constexpr int task_capacity = 12;  // of more targets each robot knows some (task_memory.cpp)

// A target, as all robots know it that may have to take it over (takeover.cpp).
struct Task {
  RobotId serves = nobody;      // the worker first sent there: the target's name
  RobotId holder = nobody;      // the robot that serves it; nobody: it has been given up
  Serial beat = 0;              // the holder's count of ticks, the newest heard of
  std::uint16_t age_ticks = 0;  // since it grew; in doubt: since I know that it is, and before
  Vec2 target;                  // C, own frame
  RobotId via = nobody;         // the child by which its holder is below me in the tree; nobody: it is not
  bool silent : 1 = false;     // in doubt: the robots that heard the holder last no longer hear it. Without holder: put
                               // off, since robots are too few, until the root has it tried again
  bool reached : 1 = false;    // the holder is there
  bool gave_up : 1 = false;    // I went there in vain (progress.cpp)
  bool unlocated : 1 = false;  // I do not know where it is, and only pass on question and answer
  std::uint8_t times_put_off : 3 = 0;  // as far as I have heard, at most most_put_off
  std::uint8_t urgent_ticks = 0;       // for how long all robots have to pass on the news of it
};

// A range of targets. As a std::span it would make firmware 200 bytes longer.
template <class T> struct TaskList {
  T* first;
  T* last;
  [[nodiscard]] T* begin() const noexcept { return first; }
  [[nodiscard]] T* end() const noexcept { return last; }
};

inline constexpr std::uint8_t most_put_off = 7;  // times; more are not counted
inline constexpr std::uint16_t first_gap = 200;  // sixteenths of ticks: taken for granted at first

// The progress of a worker (progress.cpp).
struct Progress {
  std::uint16_t least = UINT16_MAX;  // C / 256, the nearest to its target since something was in the way
  std::uint16_t vain_ticks = 0;      // eighteenths of ticks at full speed towards it since, in vain
};

// Stands before the tree's part: behind the neighbour table, each access would take a chip a further instruction.
struct HealingMemory {
  std::uint8_t task_count = 0;
  std::uint8_t neighbors_at_start = 0;  // so few after the first rounds, all of them far away; 0: it is no thin start
  bool was_sent : 1 = false;            // to a target, at the last step
  bool root_known : 1 = false;
  bool calls : 1 = false;              // asks its neighbours to come nearer
  bool forgets : 1 = false;            // here or elsewhere a robot has had no room for a target
  std::uint16_t news_gap = first_gap;  // sixteenths of ticks: the longest time without news of a living worker, of late
  float expected_packets = 0.0F;       // packets that were to be heard in the last ticks, fading
  float missed_packets = 0.0F;         // and those of them that were not heard
  RobotId serves = nobody;             // worker: whose target this is, the id of the worker first sent there
  std::uint16_t loss_ticks = 0;        // what this loss requires in place of I; 0: I is long enough
  std::uint8_t missed_in_the_clear = 0;  // silences of neighbours in range that nobody hid; from time to time 0 again
  std::uint8_t usual_silence = 0;        // ticks: the longest that has ended lately; 0: the radio loses no packets
  RobotId watched = nobody;              // a neighbour that fell silent in range and in the clear,
  std::uint8_t watched_ticks = 0;        // and for how long it has been
  std::uint8_t burst_ticks = 0;          // gossip: the longest silence of late, if lost packets alone do not explain it
  RobotCount root_size = 0;              // robots that this root counted last; 0: none yet
  RobotCount flood_counted = 0;          // the root, of its last START TREE: the most robots that the flood had found,
  std::uint16_t flood_ticks = 0;         // and when that was
  Serial heartbeat = 0;
  std::uint16_t silence_ticks = 0;   // since the heartbeat grew; the root: since it heard any robot
  RootToken heart;                   // the root whose heartbeat it is
  std::uint16_t turn = 0;            // which neighbour and target come next
  RobotId hold = nobody;             // the robot that I stay with while I have no parent
  RobotId named = nobody;            // the neighbour last named as heard
  RobotId caller = nobody;           // the robot that asks me to come nearer
  std::uint8_t called_ticks = 0;     // for how long I still do so
  std::uint16_t dangling_ticks = 0;  // the last robot below me has died: how long I still drive to where it was
  Progress progress;
  Vec2 root_at;     // C, own frame: where that root is or was; the root: where it last heard one
  Vec2 lost_child;  // C, own frame: where it was
  std::array<Task, task_capacity> tasks{};                             // the first task_count are valid
  Detour detour;                                                       // obstacles: the way round one
  std::array<HealingStanding, neighbor_capacity> healing_standings{};  // beside the neighbour table

  [[nodiscard]] TaskList<Task> known_tasks() noexcept { return {tasks.data(), tasks.data() + task_count}; }
  [[nodiscard]] TaskList<const Task> known_tasks() const noexcept { return {tasks.data(), tasks.data() + task_count}; }
};

struct HealingState : HealingMemory, TreeState {
  void prefetch(std::size_t entries) const noexcept {
    TreeState::prefetch(entries = std::min<std::size_t>(entries, neighbor_capacity));
    prefetch_lines(neighbors.deaf_ticks.data(), entries);
    prefetch_lines(&task_count,
                   static_cast<std::size_t>(reinterpret_cast<const char*>(healing_standings.data() + entries) -
                                            reinterpret_cast<const char*>(&task_count)));
  }
};

template <class Visitor, class State> constexpr void visit_healing_state(Visitor& visit, State& s) noexcept {
  visit(bool{s.was_sent}), visit(s.serves), visit(s.expected_packets), visit(s.missed_packets), visit(s.loss_ticks),
      visit(s.root_size), visit(s.flood_counted), visit(s.flood_ticks);
  visit(s.heartbeat), visit(s.silence_ticks), visit(s.heart.sequence), visit(s.heart.id), visit(s.root_at),
      visit(bool{s.root_known}), visit(s.turn), visit(s.hold);
  visit(s.dangling_ticks), visit(s.lost_child), visit(bool{s.forgets}), visit(s.task_count), visit(s.news_gap);
  visit(s.progress.least), visit(s.progress.vain_ticks);
  for (int k = 0; k < s.task_count; ++k) {
    auto& task = s.tasks[static_cast<std::size_t>(k)];
    visit(task.serves), visit(task.holder), visit(task.beat), visit(task.age_ticks), visit(task.target),
        visit(task.via), visit(bool{task.silent}), visit(bool{task.reached}), visit(bool{task.gave_up}),
        visit(task.urgent_ticks), visit(bool{task.unlocated}), visit(std::uint8_t{task.times_put_off});
  }
  visit(s.detour.side), visit(s.detour.contact), visit(s.detour.origin), visit(s.detour.goal), visit(s.detour.leave),
      visit(s.detour.span), visit(s.detour.last_side), visit(s.detour.again);
  visit(s.neighbors_at_start), visit(s.usual_silence), visit(s.missed_in_the_clear), visit(s.burst_ticks),
      visit(s.watched), visit(s.watched_ticks);
  visit(s.named), visit(bool{s.calls}), visit(s.caller), visit(s.called_ticks);
  for (int k = 0; k < s.neighbors.size(); ++k)
    visit(s.healing_standings[static_cast<std::size_t>(k)].serves),
        visit(s.neighbors.deaf_ticks[static_cast<std::size_t>(k)]);
}

}  // namespace banyan
