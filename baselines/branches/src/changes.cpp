// SPDX-License-Identifier: MIT
// A change replaces the link from the robot in the middle to one of its neighbours by a link from that to another of
// them. The middle hears both, decides, and lets the old link go when both have the new one. Each robot takes part in
// one change at a time, so a tree stays a tree, and what is reported stays in one piece.
#include "rooms.hpp"

namespace banyan::baselines::branches {
namespace {

constexpr int uneven_ticks = 8;

// The links of a robot as it sees them before it decides; all are answered, and their ends free.
struct View {
  int leaders = 0;
  int connectors = 0;
  std::array<int, most_links> at{};  // indices in the table: leaders from the front
  [[nodiscard]] int size() const noexcept { return leaders + connectors; }
};

// False if there is one that is not settled.
bool look(const Robot& robot, View& view) noexcept {
  const State& self = robot.self;
  const Table<Message>& table = robot.table();
  for (const bool leader : {true, false})
    for (std::size_t i = 0; i < self.links.size(); ++i) {
      const int k = table.find(self.links[i].to);
      if (k < 0 || !lists(table.message(k).links, self.id)) return false;
      if (table.message(k).leader != leader) continue;
      view.at[static_cast<std::size_t>(view.size())] = k;
      ++(leader ? view.leaders : view.connectors);
    }
  return true;
}

// It can take part in a change now. A leader with two links is about to lose one of them.
bool is_free(const Message& m) noexcept {
  return m.stage == no_change && m.held_by == nobody && (!m.leader || m.links[1] == nobody);
}

// A connector that joins nothing else: it is about to be none. Not the root.
bool is_leaf(const Message& m) noexcept { return m.links[1] == nobody && m.root != m.id; }

struct Choice {
  int leaves = -1;
  int joins = -1;
  float saves = 0.0F;
  void consider(int a, int b, float saved) noexcept {
    if (saved > saves) *this = {a, b, saved};
  }
};

// (1): the follower of this leader that is nearest, and not too near, comes between.
Choice grow(const Robot& robot, const View& view) noexcept {
  const Table<Message>& table = robot.table();
  for (int l = 0; l < view.leaders; ++l) {
    const int leader = view.at[static_cast<std::size_t>(l)];
    if (!(table.range(leader) > robot.params.separation) || !is_free(table.message(leader))) continue;
    int nearest = -1;
    for (int k = 0; k < table.size(); ++k) {
      const Message& m = table.message(k);
      const bool serves = is_follower(m) && m.team == table.id(leader) && table.age(k) == 0 && is_free(m);
      if (!serves || table.range(k) < robot.params.separation || table.range(k) > robot.reach()) continue;
      if (robot.between(k, leader) > table.range(leader)) continue;
      if (nearest < 0 || table.range(k) < table.range(nearest)) nearest = k;
    }
    if (nearest >= 0) return {leader, nearest, 1.0F};
  }
  return {};
}

// (2) and (3)
Choice shorten(const Robot& robot, const View& view) noexcept {
  const Table<Message>& table = robot.table();
  Choice best;
  if (view.size() <= 2) return best;
  for (int i = 0; i < view.size(); ++i)
    for (int j = view.leaders; j < view.size(); ++j) {
      const int a = view.at[static_cast<std::size_t>(i)], b = view.at[static_cast<std::size_t>(j)];
      const Message& joined = table.message(b);
      if (a == b || !is_free(table.message(a)) || !is_free(joined) || is_leaf(joined) || !has_room(joined)) continue;
      if (!table.message(a).leader && table.id(a) < table.id(b)) continue;
      best.consider(a, b, norm(table.position(a)) - robot.between(a, b));
    }
  return best;
}

// (4)
Choice withdraw(const Robot& robot, const View& view) noexcept {
  const bool is_tail = view.leaders == 1 && view.connectors == 1 && !robot.self.is_root();
  if (!is_tail || !has_room(robot.table().message(view.at[1]))) return {};
  return robot.between(view.at[0], view.at[1]) < robot.params.joining ? Choice{view.at[0], view.at[1], 1.0F} : Choice{};
}

// A leader is at the end of a branch: if it had links when it was sent, they go over to one of its neighbours.
Choice hand_over(const Robot& robot, const View& view) noexcept {
  Choice best;
  for (int i = 0; i < view.size(); ++i)
    for (int j = view.leaders; j < view.size(); ++j) {
      const int a = view.at[static_cast<std::size_t>(i)], b = view.at[static_cast<std::size_t>(j)];
      if (a == b || !has_room(robot.table().message(b)) || robot.between(a, b) > robot.reach()) continue;
      best.consider(a, b, 2.0F * robot.reach() - robot.between(a, b));
    }
  return best;
}

Choice choose(const Robot& robot) noexcept {
  View view;
  if (!look(robot, view)) return {};
  if (robot.self.is_leader()) return hand_over(robot, view);
  Choice choice = grow(robot, view);
  if (choice.leaves < 0) choice = shorten(robot, view);
  if (choice.leaves < 0) choice = withdraw(robot, view);
  return choice;
}

void enter(Change& change, Stage stage) noexcept {
  change.stage = stage;
  change.ticks = 0;
}

void offer(Robot& robot) noexcept {
  State& self = robot.self;
  const Choice choice = choose(robot);
  if (choice.leaves < 0) return;
  const Message& joins = robot.table().message(choice.joins);
  if (is_follower(joins) && self.links.full()) return;
  self.change = {offered, robot.table().id(choice.leaves), joins.id, is_follower(joins), 0};
  self.links.add(joins.id);
}

void give_up(State& self) noexcept {
  if (self.change.recruits) self.links.remove(self.change.joins);
  enter(self.change, undone);
}

// After a failure not all the same: two that are in each other's changes wait for each other.
int pause_ticks(const Robot& robot) noexcept {
  const int pause = whole(robot.params.pause_rounds);
  return robot.self.change.stage == undone ? pause + robot.self.id % uneven_ticks : pause;
}

// Whether `id` has taken part so far as to name `other`.
bool has_linked(const Robot& robot, RobotId id, RobotId other) noexcept {
  const Message* m = robot.said_by(id);
  return m != nullptr && m->held_by == robot.self.id && lists(m->links, robot.self.id) && lists(m->links, other);
}

void follow_offer(Robot& robot) noexcept {
  State& self = robot.self;
  Change& change = self.change;
  if (has_linked(robot, change.leaves, change.joins) && has_linked(robot, change.joins, change.leaves)) {
    self.links.remove(change.leaves);
    if (self.parent == change.leaves) self.parent = nobody;
    return enter(change, made);
  }
  if (change.ticks > whole(robot.params.change_rounds)) give_up(self);
}

bool is_held(const Robot& robot, RobotId id) noexcept {
  const Message* m = robot.said_by(id);
  return m != nullptr && m->held_by == robot.self.id;
}

// The robots named in an offer take the new link.
void accept(Robot& robot, const Message& m) noexcept {
  State& self = robot.self;
  const bool leaves = m.leaves == self.id;
  const RobotId other = leaves ? m.joins : m.leaves;
  const int k = robot.table().find(other);
  if (k < 0 || robot.table().range(k) > robot.reach()) return;
  const bool recruited = !leaves && self.is_follower();
  const bool linked = self.links.has(m.id) && lists(m.links, self.id);
  if (!recruited && (!linked || self.links.full() || (!leaves && self.is_leader()))) return;
  if (recruited) {
    self.connector = true;
    self.links.add(m.id);
    ++self.tally.insertions;
  }
  self.links.add(other);
  self.held_by = m.id;
  self.held_other = other;
  self.leaves = leaves;
}

void release(State& self, RobotId without) noexcept {
  self.links.remove(without);
  if (self.parent == without) self.parent = nobody;
  self.held_by = self.held_other = nobody;
}

// What has become of the change that it takes part in. The robot that leaves has its old link until the middle has let
// it go; the one that it joins cannot tell, and leaves it to the answers whether the new link is one.
void follow_middle(Robot& robot) noexcept {
  State& self = robot.self;
  const Message* m = robot.said_by(self.held_by);
  if (m == nullptr) return release(self, nobody);  // the new link replaces the dead robot
  const bool is_of_me = m->leaves == self.id || m->joins == self.id;
  if (is_of_me && m->stage == offered) return;
  if (self.leaves) return release(self, lists(m->links, self.id) ? self.held_other : m->id);
  release(self, is_of_me && m->stage == undone ? self.held_other : nobody);
}

}  // namespace

void take_part(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.held_by != nobody) follow_middle(robot);
  if (self.is_busy()) return;
  const Table<Message>& table = robot.table();
  for (int k = 0; k < table.size() && self.held_by == nobody; ++k) {
    const Message& m = table.message(k);
    if (m.stage == offered && table.age(k) == 0 && (m.leaves == self.id || m.joins == self.id) && m.leaves != m.joins)
      accept(robot, m);
  }
}

void change_links(Robot& robot) noexcept {
  State& self = robot.self;
  Change& change = self.change;
  if (change.stage != no_change) change.ticks = robot.counted(change.ticks);
  switch (change.stage) {
    case no_change:
      if (!self.is_follower() && self.is_joined() && self.held_by == nobody) offer(robot);
      break;
    case offered: follow_offer(robot); break;
    case made:
    case undone:
      if (change.ticks < pause_ticks(robot)) break;
      if (!is_held(robot, change.leaves) && !is_held(robot, change.joins)) change = {};
      break;
  }
}

}  // namespace banyan::baselines::branches
