// SPDX-License-Identifier: MIT
// Boruvka's algorithm (1926) among robots, as in Gallager, Humblet & Spira 1983, but by what each says of itself at
// every tick instead of by messages that must not be lost. A fragment is a subtree of the minimum spanning tree; at
// first each robot is one. In a round each fragment finds the shortest edge that leads out of it: robots report it
// towards their leader, and the leader's choice comes back. Fragments grow together along the edges chosen. Exactly one
// of these has been chosen from both sides; of its ends the one with the larger id leads the new fragment.
#include <algorithm>

#include "banyan/controller/core/fixed_point.hpp"
#include "rooms.hpp"

namespace banyan::rivals::mst {
namespace {

constexpr float per_mm = 1000.0F;
constexpr float room_to_move = 0.97F;  // of the longest link: an edge must not be too long from its first moment

bool comes_first(const Edge& a, const Edge& b) noexcept {
  if (a.from == nobody || b.from == nobody) return b.from == nobody && a.from != nobody;
  if (a.mm != b.mm) return a.mm < b.mm;
  const auto [a_low, a_high] = std::minmax(a.from, a.to);
  const auto [b_low, b_high] = std::minmax(b.from, b.to);
  return a_low != b_low ? a_low < b_low : a_high < b_high;
}

// Nobody has a message; its answer is not waited for.
const Message* said_by(const Robot& robot, RobotId id) noexcept {
  const int k = robot.table().find(id);
  return k < 0 ? nullptr : &robot.table().message(k);
}
bool is_fellow(const State& self, const Message& m) noexcept { return m.epoch == self.epoch && m.level == self.level && m.fragment == self.fragment; }

void enter_level(State& self, int level, RobotId leader, RobotId up) noexcept {
  self.level = static_cast<std::uint8_t>(level);
  self.fragment = leader;
  self.up = up;
  self.ready = self.decided = false;
  self.best = self.choice = {};
  self.least = self.errand.sent ? nobody : self.id;
}

// Who names me as the end of an edge of the tree is one of mine.
void answer_branches(Robot& robot) noexcept {
  State& self = robot.self;
  for (int k = 0; k < robot.table().size(); ++k) {
    const Message& m = robot.table().message(k);
    if (m.epoch == self.epoch && std::find(m.branches.begin(), m.branches.end(), self.id) != m.branches.end()) self.branches.add(m.id);
  }
}

// The new fragment's leader has been heard of, or is me.
void join_next_level(Robot& robot) noexcept {
  State& self = robot.self;
  for (const RobotId end : self.branches) {
    const Message* m = said_by(robot, end);
    if (m == nullptr || m->epoch != self.epoch) continue;
    if (m->level > self.level) return enter_level(self, m->level, m->fragment, end);
    const bool mine = self.decided && self.choice.from == self.id && self.choice.to == end;
    const bool mutual = mine && m->level == self.level && m->decided && m->choice.from == end && m->choice.to == self.id;
    if (mutual && self.id > end && self.level < 255) return enter_level(self, self.level + 1, self.id, nobody);
  }
}

// My own shortest edge out of the fragment. False while a neighbour has not come so far that it could be told.
bool find_own_edge(const Robot& robot, Edge& edge) noexcept {
  const State& self = robot.self;
  for (int c = 0; c < self.candidate_count; ++c) {
    const Candidate& candidate = self.candidates[static_cast<std::size_t>(c)];
    const Message* m = said_by(robot, candidate.to);
    if (m == nullptr) continue;
    if (m->epoch != self.epoch || m->level < self.level) return false;
    const Edge out{self.id, candidate.to, candidate.mm};
    if (!is_fellow(self, *m) && comes_first(out, edge)) edge = out;
  }
  return true;
}

// The shortest of mine and of those below me. False while somebody is not ready.
bool gather(Robot& robot) noexcept {
  State& self = robot.self;
  Edge best;
  if (!find_own_edge(robot, best)) return false;
  RobotId least = self.errand.sent ? nobody : self.id;
  for (const RobotId end : self.branches) {
    if (end == self.up) continue;
    const Message* m = said_by(robot, end);
    if (m == nullptr || m->epoch != self.epoch || m->level < self.level) return false;
    if (!is_fellow(self, *m)) continue;  // another fragment's that has chosen the edge to me
    if (m->up != self.id || !m->ready) return false;
    if (comes_first(m->best, best)) best = m->best;
    least = std::min(least, m->root);
  }
  self.best = best;
  self.least = least;
  return true;
}

void adopt_tree(State& self, RobotId root) noexcept {
  self.done = self.has_tree = true;
  self.least = self.root = root;
  self.parent = self.up;
  self.old.add_all(self.tree);
  self.tree = self.branches;
  self.tree_epoch = self.epoch;
}

// The leader's word comes down the fragment.
void follow_leader(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.fragment == self.id) {
    self.decided = self.ready;
    self.choice = self.best;
    if (self.ready && self.best.from == nobody) adopt_tree(self, self.least);
  } else if (const Message* m = said_by(robot, self.up); m != nullptr && is_fellow(self, *m)) {
    self.decided = m->decided;
    self.choice = m->choice;
    if (m->done) adopt_tree(self, m->root);
  }
  if (self.decided && self.choice.from == self.id) self.branches.add(self.choice.to);
}

// No third robot is nearer to both ends: if everybody sees everybody, all edges of the minimum spanning tree are so.
bool is_narrow(const Table<Message>& table, int k) noexcept {
  const float d = table.range(k);
  for (int j = 0; j < table.size(); ++j)
    if (j != k && table.range(j) < d && distance(table.position(j), table.position(k)) < d) return false;
  return true;
}

}  // namespace

void begin_construction(Robot& robot) noexcept {
  State& self = robot.self;
  const Table<Message>& table = robot.table();
  // Of a construction that came to no end all that has been held is held on.
  if (!self.done) self.old.add_all(self.branches);
  const auto earlier = self.candidates;
  const int earlier_count = self.done ? 0 : self.candidate_count;
  const auto is_held = [&](RobotId id) {
    const bool narrow = std::any_of(earlier.begin(), earlier.begin() + earlier_count, [&](const Candidate& c) { return c.to == id && c.narrow; });
    return narrow || self.tree.has(id) || self.old.has(id);
  };
  self.done = false;
  self.branches.clear();
  self.candidate_count = 0;
  for (int k = 0; k < table.size(); ++k) {
    if (!is_held(table.id(k)) && !(table.range(k) < robot.params.longest_link_m * room_to_move)) continue;
    self.candidates[self.candidate_count++] = {table.id(k), to_fixed<std::uint16_t>(table.range(k), per_mm), is_narrow(table, k)};
  }
  enter_level(self, 0, self.id, nobody);
}

// An edge of an earlier tree is kept until its other end is in the same tree as I am, or gone: whatever went wrong with
// a construction, nobody is let go by it.
void drop_old_edges(Robot& robot) noexcept {
  State& self = robot.self;
  const Ends all = self.old;
  for (const RobotId end : all) {
    const Message* m = said_by(robot, end);
    if (m == nullptr || self.tree.has(end) || (self.done && m->done && m->epoch == self.epoch && m->fragment == self.fragment)) self.old.remove(end);
  }
}

void construct(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.fragment == nobody || self.done) return;
  answer_branches(robot);
  join_next_level(robot);
  if (!self.ready) self.ready = gather(robot);
  follow_leader(robot);
}

}  // namespace banyan::rivals::mst
