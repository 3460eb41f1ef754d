// SPDX-License-Identifier: MIT
// Each follower belongs to a team, at first that of the nearest leader. A leader that has more followers than its way
// needs sends one at a time to the team that lacks most.
#include <cmath>

#include "rooms.hpp"

namespace banyan::baselines::branches {
namespace {

constexpr float most_needed = 255.0F;

int count_followers(const Robot& robot) noexcept {
  int count = 0;
  for (int k = 0; k < robot.table().size(); ++k) {
    const Message& m = robot.table().message(k);
    count += is_follower(m) && m.team == robot.self.id ? 1 : 0;
  }
  return count;
}

// Followers that the rest of the way takes and are not there; negative: it has more.
int missing(const Robot& robot) noexcept {
  const State& self = robot.self;
  const int tail = robot.table().find(self.parent);
  if (tail < 0 || !self.assignment.known) return 0;
  const float way = self.assignment.away() + robot.table().range(tail);
  const float links = std::min(std::ceil(way / robot.params.spacing), most_needed);
  return static_cast<int>(links) - 1 - count_followers(robot);
}

// Takes on what neighbour k says of the need of a team.
void take_over(Robot& robot, int k, std::uint8_t age) noexcept {
  const Message& m = robot.table().message(k);
  robot.self.needy = m.needy;
  robot.self.needed = m.needed;
  robot.self.needy_age = age;
}

// Of the teams that are heard of the one that lacks most, and of what is said of it the newest. A leader that lacks
// none says so, too, because what it said before is still passed round.
void spread_need(Robot& robot) noexcept {
  State& self = robot.self;
  const Table<Message>& table = robot.table();
  self.needy = self.is_leader() ? self.id : nobody;
  self.needed = static_cast<std::uint8_t>(self.is_leader() ? std::max(missing(robot), 0) : 0);
  self.needy_age = self.is_leader() ? std::uint8_t{0} : unknown_age;
  for (int k = 0; k < table.size(); ++k) {
    const Message& m = table.message(k);
    const std::uint8_t age = news_age(m.needy_age, table, k);
    if (m.needy == nobody || m.needy == self.id || age == unknown_age) continue;
    const bool more = m.needed != self.needed ? m.needed > self.needed : m.needy < self.needy;
    if (m.needy != self.needy && more) take_over(robot, k, age);
  }
  for (int k = 0; k < table.size(); ++k) {
    const std::uint8_t age = news_age(table.message(k).needy_age, table, k);
    if (table.message(k).needy == self.needy && age < self.needy_age) take_over(robot, k, age);
  }
}

// The follower that has heard of the need first is nearest to it.
void send(Robot& robot) noexcept {
  State& self = robot.self;
  const Table<Message>& table = robot.table();
  self.sends_ticks = robot.counted(self.sends_ticks);
  const bool may = self.needed > 0 && self.needy != self.id && missing(robot) < 0;
  if (self.sends_ticks > whole(robot.params.change_rounds) || !may) self.sends = nobody;
  if (!may || self.sends_ticks <= whole(robot.params.transfer_rounds)) return;
  int best = -1;
  for (int k = 0; k < table.size(); ++k) {
    const Message& m = table.message(k);
    if (!is_follower(m) || m.team != self.id || m.needy != self.needy) continue;
    if (best < 0 || m.needy_age < table.message(best).needy_age) best = k;
  }
  if (best < 0) return;
  self.sends = table.id(best);
  self.sends_ticks = 0;
}

// How old the news of a leader are that neighbour k has.
std::uint8_t team_age(const Robot& robot, int k, RobotId leader) noexcept {
  const Message& m = robot.table().message(k);
  if (m.id == leader && m.leader) return news_age(0, robot.table(), k);
  return is_follower(m) && m.team == leader ? news_age(m.team_age, robot.table(), k) : unknown_age;
}

// The leader of which the news are newest, the nearest where it is heard of directly.
void choose_team(Robot& robot) noexcept {
  State& self = robot.self;
  const Table<Message>& table = robot.table();
  int best = -1;
  std::uint8_t best_age = unknown_age;
  for (int k = 0; k < table.size(); ++k) {
    const Message& m = table.message(k);
    const std::uint8_t age = m.leader         ? news_age(0, table, k)
                             : is_follower(m) ? news_age(m.team_age, table, k)
                                              : unknown_age;
    const bool nearer = best >= 0 && age == best_age && table.range(k) < table.range(best);
    if (age == unknown_age || (!m.leader && m.team == nobody) || (age >= best_age && !nearer)) continue;
    best = k;
    best_age = age;
  }
  self.travels = false;
  self.team_age = best_age;
  if (best < 0) self.team = nobody;
  else self.team = table.message(best).leader ? table.id(best) : table.message(best).team;
}

}  // namespace

void follow_team(Robot& robot) noexcept {
  State& self = robot.self;
  spread_need(robot);
  if (self.is_leader()) {
    self.team = self.id;
    self.team_age = 0;
    return send(robot);
  }
  if (!self.is_follower()) {
    self.team = nobody;
    self.team_age = unknown_age;
    return;
  }
  const Message* leader = robot.said_by(self.team);
  if (leader != nullptr && leader->leader && leader->sends == self.id && leader->needed > 0) {
    self.team = leader->needy;
    self.travels = true;
  }
  std::uint8_t age = unknown_age;
  for (int k = 0; k < robot.table().size(); ++k) age = std::min(age, team_age(robot, k, self.team));
  self.team_age = self.team == nobody ? unknown_age : age;
  if (self.team_age != unknown_age) self.travels = false;
  else if (!self.travels || self.needy != self.team) choose_team(robot);
}

}  // namespace banyan::baselines::branches
