// SPDX-License-Identifier: MIT
// Whoever needs a robot advertises a post; how far the nearest one is, is one gradient.
#include "caravan/rules.hpp"

namespace banyan::caravan {
namespace {

constexpr std::uint8_t most_hops = 250;
constexpr int echo_rounds = 64;  // by then echoes have ended, and the count has not come half round

// My edge is worth a spare, and none has been in reach for a while.
bool has_post(Robot& robot) noexcept {
  State& self = robot.self;
  const float from = robot.is_station ? station_asks_from : robot.params.post_distance;
  const bool needs = self.role != Role::spare && robot.parent >= 0 && robot.is_wanted() &&
                     robot.stretched(robot.range(robot.parent)) > from;
  if (self.leaving && self.role != Role::spare) return true;
  if (!needs) self.unserved_rounds = 0;
  else robot.add_elapsed(self.unserved_rounds);
  return self.unserved_rounds > whole(robot.params.call_after_rounds);
}

// A robot that runs low can wait, the less the less charge is left: as if it were so many hops farther away.
std::uint8_t urgency(const State& self) noexcept {
  constexpr float hops = 20.0F;  // with a full battery
  return self.leaving ? static_cast<std::uint8_t>(hops * self.level) : std::uint8_t{0};
}

// The neighbour through which the post is nearest, -1: there is none.
int caller(const Robot& robot) noexcept {
  const Table& table = robot.table();
  const State& self = robot.self;
  if (self.call.source == nobody || self.leaving) return -1;
  return least_of(table.size(), not_counted, [&](int k) {
    const Call& c = robot.said(k).call;
    const bool leads = table.age(k) <= 1 && c.source == self.call.source && c.hops < self.call.hops;
    return leads ? static_cast<float>(c.hops) + 0.5F * table.range(k) : not_counted;
  });
}

}  // namespace

void call_spares(Robot& robot) noexcept {
  State& self = robot.self;
  const Table& table = robot.table();
  if (has_post(robot)) {
    self.call = {self.id, ++self.post_count, urgency(self)};
    self.call_silence = 0;
    return;
  }
  if (self.call.source == self.id) self.call = {};
  robot.add_elapsed(self.call_silence);
  robot.add_elapsed(self.ended_rounds);
  if (self.ended_rounds > echo_rounds) self.ended = {};
  // Of what I hear the nearest source; of one source the newest count.
  for (int k = 0; k < table.size(); ++k) {
    const Call& c = robot.said(k).call;
    if (table.age(k) > 0 || c.source == nobody || c.source == self.id || c.hops >= most_hops) continue;
    // What has ended does not begin again by an echo.
    if (c.source == self.ended.source && static_cast<std::int8_t>(c.count - self.ended.count) <= 0) continue;
    const auto newer = static_cast<std::int8_t>(c.count - self.call.count);
    const bool same = c.source == self.call.source;
    const bool nearer = c.hops + 1 < self.call.hops;
    if (self.call.source != nobody && (same ? newer < 0 || (newer == 0 && !nearer) : !nearer)) continue;
    if (!same || newer > 0) self.call_silence = 0;
    self.call = {c.source, c.count, static_cast<std::uint8_t>(c.hops + 1)};
  }
  if (self.call.source != nobody && self.call_silence > 2 * robot.liveness()) {
    self.ended = self.call;
    self.ended_rounds = 0;
    self.call = {};
  }
  if (self.role == Role::spare) robot.caller = caller(robot);
}

}  // namespace banyan::caravan
