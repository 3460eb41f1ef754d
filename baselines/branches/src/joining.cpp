// SPDX-License-Identifier: MIT
// The network begins at the root, and what is not joined to it joins: at the start the leaders, later what a dead robot
// has cut off. The source has no such rules, since there all teams begin within range of one connector.
#include "rooms.hpp"

namespace banyan::baselines::branches {
namespace {

void become_follower(State& self) noexcept {
  self.connector = false;
  self.links.clear();
  self.parent = nobody;
  self.joined_age = unknown_age;
  self.leaf_ticks = 0;
  self.calls = nobody;
}

// The nearest connector that is joined.
int find_way_in(const Robot& robot) noexcept {
  const Table<Message>& table = robot.table();
  int nearest = -1;
  for (int k = 0; k < table.size(); ++k) {
    const Message& m = table.message(k);
    const bool joined = m.connector && news_age(m.joined_age, table, k) != unknown_age;
    if (!joined || !has_room(m) || m.id == robot.self.ignored || robot.self.links.has(m.id)) continue;
    if (table.range(k) > robot.reach()) continue;
    if (nearest < 0 || table.range(k) < table.range(nearest)) nearest = k;
  }
  return nearest;
}

// The follower from which the root is fewest hops away; of several the farthest within the spacing of connectors.
int find_helper(const Robot& robot) noexcept {
  const Table<Message>& table = robot.table();
  int best = -1;
  int best_age = 0;
  for (int k = 0; k < table.size(); ++k) {
    const Message& m = table.message(k);
    if (!is_follower(m) || m.root == nobody || m.id == robot.self.ignored || table.age(k) > 0) continue;
    if (table.range(k) > robot.params.spacing) continue;
    const int age = age_now(m.root_age, table, k);
    if (best >= 0 && (age > best_age || (age == best_age && table.range(k) < table.range(best)))) continue;
    best = k;
    best_age = age;
  }
  return best;
}

// A robot to which it is linked is nearer to the root, and has to find the way.
bool is_led(const Robot& robot) noexcept {
  for (std::size_t i = 0; i < robot.self.links.size(); ++i) {
    const int k = robot.table().find(robot.self.links[i].to);
    if (k < 0 || robot.table().message(k).root != robot.self.root) continue;
    if (age_now(robot.table().message(k).root_age, robot.table(), k) <= robot.self.root_age) return true;
  }
  return false;
}

bool is_waiting(const Robot& robot) noexcept {
  for (std::size_t i = 0; i < robot.self.links.size(); ++i) {
    const Message* m = robot.said_by(robot.self.links[i].to);
    if (m != nullptr && !lists(m->links, robot.self.id)) return true;
  }
  return false;
}

void call(Robot& robot) noexcept {
  State& self = robot.self;
  if (const Message* m = robot.said_by(self.calls); m != nullptr && m->connector && lists(m->links, self.id)) {
    self.links.add(self.calls);
    self.calls = nobody;
  }
  if (self.calls != nobody) {
    self.calls_ticks = robot.counted(self.calls_ticks);
    if (self.calls_ticks <= whole(robot.params.change_rounds)) return;
    self.ignored = self.calls;
    self.ignored_ticks = static_cast<std::uint16_t>(whole(robot.params.transfer_rounds));
    self.calls = nobody;
  }
  if (self.links.full() || is_led(robot)) return;
  const int k = find_helper(robot);
  if (k < 0) return;
  self.calls = robot.table().id(k);
  self.calls_ticks = 0;
}

void find_root(Robot& robot) noexcept {
  State& self = robot.self;
  self.ignored_ticks = static_cast<std::uint16_t>(std::max(self.ignored_ticks - robot.elapsed_ticks, 0));
  if (self.ignored_ticks == 0) self.ignored = nobody;
  if (!self.is_cut(robot.params) || self.held_by != nobody) {
    self.calls = nobody;
    return;
  }
  if (is_waiting(robot)) return;
  const int k = find_way_in(robot);
  if (k < 0 || self.links.full()) return call(robot);
  self.calls = nobody;
  self.forget();
  self.links.add(robot.table().id(k));
}

// Takes up those who ask: who is not joined lists a robot that is.
void let_in(Robot& robot) noexcept {
  State& self = robot.self;
  const Table<Message>& table = robot.table();
  for (int k = 0; k < table.size(); ++k) {
    const Message& m = table.message(k);
    const bool asks = table.age(k) == 0 && lists(m.links, self.id) && !self.links.has(m.id);
    if (!asks || m.joined_age <= news_ticks || table.range(k) > robot.reach()) continue;
    self.forget();
    self.links.add(m.id);
  }
}

// A follower that is called becomes a connector.
void answer(Robot& robot) noexcept {
  State& self = robot.self;
  const Table<Message>& table = robot.table();
  for (int k = 0; k < table.size(); ++k) {
    if (table.message(k).calls != self.id || table.age(k) > 0) continue;
    self.connector = true;
    self.links.add(table.message(k).id);
    ++self.tally.insertions;
    return;
  }
}

// A connector that joins nothing to the network is a follower again.
void leave(Robot& robot) noexcept {
  State& self = robot.self;
  const bool is_leaf = self.links.size() <= 1 && !self.is_busy() && !self.is_root() && !self.has_lost_child();
  self.leaf_ticks = is_leaf ? robot.counted(self.leaf_ticks) : std::uint16_t{0};
  const bool is_idle = self.is_joined() || self.links.size() == 0;
  const int patience_ticks =
      is_idle ? whole(robot.params.change_rounds) : robot.params.rounds(robot.params.join_patience_drives);
  if (self.leaf_ticks > patience_ticks) become_follower(self);
}

}  // namespace

void join(Robot& robot) noexcept {
  State& self = robot.self;
  self.root_ticks = self.is_root() ? robot.counted(self.root_ticks) : std::uint16_t{0};
  // Where a root is missing many call themselves so, and soon only one of them.
  const bool is_lasting_root = self.root_ticks > whole(robot.params.change_rounds);
  if (self.is_leader()) self.connector = false;
  else if (is_lasting_root || self.links.size() > 0) self.connector = true;
  if (self.is_follower()) return answer(robot);
  if (self.connector && self.is_joined() && !self.is_busy()) let_in(robot);
  if (!self.is_root()) find_root(robot);
  if (self.connector) leave(robot);
}

}  // namespace banyan::baselines::branches
