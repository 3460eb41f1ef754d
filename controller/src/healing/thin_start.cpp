// SPDX-License-Identifier: MIT
// Starts in which each robot has few neighbours, all of them far away: a line, a ring, a wide grid (protocol 12). Where
// packets get lost, another part of the network may hear a robot that has not heard it yet.
#include <algorithm>

#include "healing/healing.hpp"

namespace banyan {
namespace {

constexpr int look_ticks = 10;  // by then most neighbours have been heard, whatever is lost

bool has_few_far_away(const HealingRobot& robot) noexcept {
  constexpr int few = 4;         // neighbours
  constexpr float apart = 0.4F;  // of C: so few in a crowd are nearer
  const TreeTable& table = robot.table();
  return table.size() > 0 && table.size() <= few && table.range(0) > apart;
}

}  // namespace

void note_start(HealingRobot& robot) noexcept {
  const int size = robot.table().size();
  const bool looks = robot.self.phase == Phase::init ? robot.self.turn >= look_ticks : robot.self.turn == look_ticks;
  if (looks && (size == 0 || has_few_far_away(robot)))
    robot.self.neighbors_at_start = static_cast<std::uint8_t>(std::max(size, 1));
}

bool may_start_thin(const HealingRobot& robot) noexcept {
  constexpr int kept_ticks = look_ticks + 2;  // what is found then changes what is kept two steps later
  return robot.self.turn <= kept_ticks && has_few_far_away(robot);
}

bool starts_wide(const HealingRobot& robot) noexcept {
  constexpr float wide_link = 0.8F;  // of C: it may break in the first rounds
  if (!starts_thin(robot.self) && !may_start_thin(robot)) return false;
  const TreeTable& table = robot.table();
  return table.size() == 0 || table.range(0) > wide_link;
}

// Not inlined: it is for the first rounds only (and the firmware is smaller).
[[gnu::noinline]] bool awaits_others(const HealingRobot& robot, Vec2& u) noexcept {
  constexpr int end_ticks = 150;      // so long the end of a thin start stays
  constexpr float stretched = 0.72F;  // of C: nearer to a robot that may be beyond this end
  const HealingState& self = robot.self;
  const TreeTable& table = robot.table();
  const int size = table.size();
  const bool thin = self.neighbors_at_start > 0 || may_start_thin(robot);
  const bool begins = self.phase == Phase::init || starts_wide(robot);
  if (self.missed_in_the_clear + self.usual_silence + self.burst_ticks == 0) return begins && thin;
  const bool at_end = self.neighbors_at_start == 1 && size <= 1 && self.turn < end_ticks;
  if (!thin || !(begins || at_end)) return false;
  if (size == 1 && table.range(0) < stretched) u = -table.position(0);
  return true;
}

}  // namespace banyan
