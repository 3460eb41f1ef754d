// SPDX-License-Identifier: MIT
// Links that are good in one direction only (protocol 12). Every robot names the neighbours that it hears, one in each
// message, by ascending ids and then from the smallest again. So a robot whose id lies between two that were named one
// after the other has been passed over: that neighbour does not hear it. A robot whose table is full hears more robots
// than it can name: every second message of it names nobody, so that no two names follow each other.
#include <algorithm>

#include "healing/healing.hpp"
#include "tree/parent_selection.hpp"

namespace banyan {
namespace {

constexpr float fetched_to = 0.2F;  // of C: so near to a robot that does not hear me I go
constexpr float called_to = 0.45F;  // of C: so near to a robot that calls
constexpr int call_ticks = 10;      // a call that is not repeated ends

int caller_of(const HealingRobot& robot) noexcept {
  return robot.self.called_ticks == 0 ? -1 : robot.table().find(robot.self.caller);
}

}  // namespace

void note_hears(HealingRobot& robot, const Heard& h) noexcept {
  HealingState& self = robot.self;
  const TreeMessage& m = *h.message;
  const int deaf_ticks = self.neighbors.deaf_ticks[static_cast<std::size_t>(h.place)];
  const bool calls = m.count == m.id;
  // By ascending ids round and round, I come after the one and before the other. Nobody: it hears no robot.
  const auto after = [&](RobotId id) { return static_cast<RobotId>(id - h.named_before - 1); };
  const auto is_named = [&](RobotId id) { return id != m.id && id != nobody; };
  const bool in_turn = is_named(m.count) && is_named(h.named_before) && after(self.id) < after(m.count);
  const bool hears_nobody = m.count == nobody && h.named_before == nobody;
  const bool passed_over = h.before != Vec2{} && (hears_nobody || in_turn);
  // Once may be chance: a packet lost, a table that has just filled. From the second time on each round counts with the
  // ticks that it takes, about one for each of my neighbours, or one if nobody was named.
  const bool first_time = deaf_ticks == 0 || deaf_ticks == never_heard_ticks;
  const int round_ticks = first_time || hears_nobody ? 1 : robot.table().size();
  if (m.count == self.id) self.neighbors.set_deaf(h.place, 0);
  else if (passed_over) self.neighbors.set_deaf(h.place, deaf_ticks + round_ticks);
  if (calls && (self.called_ticks == 0 || self.caller == m.id)) {
    self.caller = m.id;
    self.called_ticks = call_ticks;
  }
}

RobotId name_next(const HealingRobot& robot) noexcept {
  constexpr int call_turns = 4;  // every fourth message calls
  HealingState& self = robot.self;
  const TreeTable& table = robot.table();
  if (self.calls && self.turn % call_turns == 0) return self.id;
  if (table.size() == neighbor_capacity && self.turn % 2 == 0) return nobody;  // else whom it forgets is passed over
  return self.named = table.next_heard(self.named, robot.forget_ticks);
}

void find_gap(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  const TreeTable& table = robot.table();
  const int up = robot.up();
  const bool untied = !robot.is_root() && robot.hold < 0 && (up < 0 || !robot.is_linked(up));
  robot.gap = -1;
  table.deaf.for_each([&](int k) {
    const TreeStanding& m = table.message(k);
    // Two parts that have heard of no root wait until they are fetched: each would leave those that hear it.
    if (!table.alive(k) || untied == is_newer(self.epoch, m.epoch) || (untied && m.phase == Phase::init)) return;
    if (robot.gap < 0 || table.range(k) < table.range(robot.gap)) robot.gap = k;
  });
  if (robot.gap >= 0 && !untied) self.call_hops = 0;  // the chain to it may be taut: spares come along it
  self.called_ticks = static_cast<std::uint8_t>(std::max(self.called_ticks - robot.elapsed_ticks, 0));
  // A call is passed on away from the root only: it would never end if two robots called each other.
  const int caller = caller_of(robot);
  self.calls = robot.gap >= 0 || (caller >= 0 && is_ahead(robot, caller) && table.range(caller) > called_to);
}

bool closes_gap(const HealingRobot& robot, Vec2& u) noexcept {
  const int k = robot.gap >= 0 ? robot.gap : caller_of(robot);
  if (k < 0) return false;
  const float rest = robot.gap >= 0 ? fetched_to : called_to;
  const bool rests = starts_wide(robot) || robot.table().range(k) <= rest;
  u = rests ? Vec2{} : unit(robot.table().position(k));
  return true;
}

}  // namespace banyan
