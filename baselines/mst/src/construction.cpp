// SPDX-License-Identifier: MIT
// Boruvka's algorithm (1926) among robots, as in Gallager, Humblet & Spira 1983, but each robot sends its own state at
// every tick, instead of messages that must not be lost. A fragment is a subtree of the minimum spanning tree; at
// first each robot is one. In a round each fragment finds its shortest outgoing edge: robots report candidates towards
// their leader, and the leader's choice comes back. Fragments merge along the chosen edges. Exactly one of these has
// been chosen from both sides; of its ends, the one with the larger id leads the new fragment.
#include <algorithm>

#include "banyan/controller/core/fixed_point.hpp"
#include "rooms.hpp"

namespace banyan::baselines::mst {
namespace {

constexpr float units_per_range = 2000.0F;
constexpr float room_to_move = 0.97F;  // of the longest link: a new edge must not be too long at once

bool comes_first(const Edge& a, const Edge& b) noexcept {
  if (a.from == nobody || b.from == nobody) return b.from == nobody && a.from != nobody;
  if (a.length != b.length) return a.length < b.length;
  const auto [a_low, a_high] = std::minmax(a.from, a.to);
  const auto [b_low, b_high] = std::minmax(b.from, b.to);
  return a_low != b_low ? a_low < b_low : a_high < b_high;
}

std::uint16_t units(float length) noexcept { return to_fixed<std::uint16_t>(length, units_per_range); }

bool names(const Message& m, RobotId id) noexcept {
  return std::find(m.branches.begin(), m.branches.end(), id) != m.branches.end();
}
bool is_fellow(const State& self, const Message& m) noexcept {
  return m.epoch == self.epoch && m.level == self.level && m.fragment == self.fragment;
}

void enter_level(State& self, int level, RobotId leader, RobotId up) noexcept {
  self.level = static_cast<std::uint8_t>(level);
  self.fragment = leader;
  self.up = up;
  self.ready = self.decided = false;
  self.best = self.choice = {};
  self.unanswered_ticks = self.decided_ticks = 0;
  self.least = self.assignment.sent ? nobody : self.id;
  self.least_by = nobody;
}

// False if there is no room: the other end sees that I do not name it.
bool add_branch(State& self, RobotId end) noexcept {
  if (!self.holds(end) && self.is_full()) return false;
  self.branches.add(end);
  return true;
}

// A robot that names me as the end of a tree edge becomes an end of mine, as long as there is room: otherwise it sees
// that I am full and do not name it.
void answer_branches(Robot& robot) noexcept {
  State& self = robot.self;
  for (int k = 0; k < robot.table().size(); ++k) {
    const Message& m = robot.table().message(k);
    if (m.epoch == self.epoch && names(m, self.id)) add_branch(self, m.id);
  }
}

// Enters the new fragment when its leader is known over an edge that both ends name, or is me.
void join_next_level(Robot& robot) noexcept {
  State& self = robot.self;
  for (const RobotId end : self.branches) {
    const Message* m = robot.said_by(end);
    if (m == nullptr || m->epoch != self.epoch || !names(*m, self.id)) continue;
    if (m->level > self.level) return enter_level(self, m->level, m->fragment, end);
    const bool mine = self.decided && self.choice.from == self.id && self.choice.to == end;
    const bool mutual =
        mine && m->level == self.level && m->decided && m->choice.from == end && m->choice.to == self.id;
    if (mutual && self.id > end && self.level < 255) return enter_level(self, self.level + 1, self.id, nobody);
  }
}

// Whether both ends have room for an edge to the sender of m.
bool has_room(const State& self, const Message& m) noexcept {
  return self.holds(m.id) || !(m.full || self.is_full() || self.refused.has(m.id));
}

// If ends disagree about lengths, the chosen edges can close a cycle. Both ends of an edge that is on neither's path to
// their leader drop it.
void cut_circles(Robot& robot) noexcept {
  State& self = robot.self;
  const Ends all = self.branches;
  for (const RobotId end : all) {
    const Message* m = robot.said_by(end);
    if (m != nullptr && is_fellow(self, *m) && m->up != self.id && self.up != end) self.branches.remove(end);
  }
}

// My own shortest edge out of the fragment. False while a neighbour is not far enough for me to know its fragment.
bool find_own_edge(const Robot& robot, Edge& edge) noexcept {
  const State& self = robot.self;
  for (int c = 0; c < self.candidate_count; ++c) {
    const Candidate& candidate = self.candidates[static_cast<std::size_t>(c)];
    const Message* m = robot.said_by(candidate.to);
    if (m == nullptr || !has_room(self, *m)) continue;
    if (m->epoch != self.epoch || m->level < self.level) return false;
    const Edge out{self.id, candidate.to, candidate.length};
    if (!is_fellow(self, *m) && comes_first(out, edge)) edge = out;
  }
  return true;
}

// The shortest edge of mine and of the robots below me. False while one of them is not ready.
bool gather(Robot& robot) noexcept {
  State& self = robot.self;
  Edge best;
  if (!find_own_edge(robot, best)) return false;
  RobotId least = self.assignment.sent ? nobody : self.id, by = nobody;
  for (const RobotId end : self.branches) {
    if (end == self.up) continue;
    const Message* m = robot.said_by(end);
    if (m == nullptr) self.failed = true;  // gone, with all robots below it
    if (m == nullptr || m->epoch != self.epoch || m->level < self.level) return false;
    if (!is_fellow(self, *m)) continue;  // of another fragment, which has chosen the edge to me
    if (m->up != self.id || !m->ready) return false;
    if (comes_first(m->best, best)) best = m->best;
    if (m->root < least) by = end;
    least = std::min(least, m->root);
  }
  self.best = best;
  self.least = least;
  self.least_by = by;
  return true;
}

// The construction ended at its leader, but parents must lead to the root: down if it is below me, else up.
void adopt_tree(State& self, RobotId root) noexcept {
  self.done = self.has_tree = true;
  self.parent = self.least == root && root != nobody ? self.least_by : self.up;
  self.least = self.root = root;
  self.refused.clear();
  self.old.add_all(self.tree);
  self.tree = self.branches;
  self.tree_epoch = self.epoch;
}

// Without the chosen edge the construction cannot end; the next one is to avoid it.
void refuse(State& self, RobotId end) noexcept {
  self.refused.add(end);
  self.failed = true;
}

std::uint16_t grown(std::uint16_t ticks, const Robot& robot) noexcept {
  return static_cast<std::uint16_t>(std::min(ticks + robot.elapsed_ticks, 0xFFFF));
}

// If both ends agreed about lengths, one chosen edge would have been chosen from both sides, and one of its ends would
// lead the next level. If that takes too long, any leader starts it: fragments joined to mine by a chosen edge follow.
// Leaders wait for different times, so that one of them is first.
bool is_stuck(const Robot& robot) noexcept {
  const State& self = robot.self;
  const int patience = whole(robot.params.liveness_rounds) + whole(robot.params.countdown_rounds);
  const auto more = static_cast<int>((self.id * 7919U + self.level * 104729U) % static_cast<unsigned>(patience + 1));
  return self.decided_ticks > patience + more && self.level < 255;
}

// The leader's choice travels down the fragment.
void follow_leader(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.fragment == self.id) {
    if (self.decided) self.decided_ticks = grown(self.decided_ticks, robot);
    if (is_stuck(robot)) return enter_level(self, self.level + 1, self.id, nobody);
    self.decided = self.ready;
    self.choice = self.best;
    if (self.ready && self.best.from == nobody) adopt_tree(self, self.least);
  } else if (const Message* m = robot.said_by(self.up); m != nullptr && is_fellow(self, *m)) {
    self.decided = m->decided;
    self.choice = m->choice;
    if (m->done) adopt_tree(self, m->root);
  }
  if (self.done || !self.decided || self.choice.from != self.id || self.refused.has(self.choice.to)) return;
  if (!add_branch(self, self.choice.to)) refuse(self, self.choice.to);
}

// The other end has no room, since others have chosen it at the same moment, or it does not hear me.
void give_up_refused(Robot& robot) noexcept {
  State& self = robot.self;
  const Message* m = self.decided && self.choice.from == self.id ? robot.said_by(self.choice.to) : nullptr;
  const bool refuses = m != nullptr && m->epoch == self.epoch && !names(*m, self.id);
  self.unanswered_ticks = refuses ? grown(self.unanswered_ticks, robot) : std::uint16_t{0};
  if (self.unanswered_ticks <= whole(robot.params.liveness_rounds)) return;
  refuse(self, self.choice.to);
  for (Ends* ends : {&self.branches, &self.tree, &self.old}) ends->remove(self.choice.to);
}

bool is_short(const Robot& robot, int k) noexcept {
  return robot.table().range(k) < robot.params.longest_link * room_to_move;
}

// No third robot is nearer to both ends, as with every edge of the minimum spanning tree when all robots are in range.
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
  // All edges kept by an unfinished construction stay kept.
  if (!self.done) self.old.add_all(self.branches);
  const auto earlier = self.candidates;
  const int earlier_count = self.done ? 0 : self.candidate_count;
  const auto is_held = [&](RobotId id) {
    const bool narrow = std::any_of(earlier.begin(), earlier.begin() + earlier_count,
                                    [&](const Candidate& c) { return c.to == id && c.narrow; });
    return narrow || self.holds(id);
  };
  self.done = self.failed = false;
  self.branches.clear();
  self.candidate_count = 0;
  for (int k = 0; k < table.size(); ++k) {
    if (!is_held(table.id(k)) && !is_short(robot, k)) continue;
    self.candidates[self.candidate_count++] = {table.id(k), units(table.range(k)), is_narrow(table, k)};
  }
  enter_level(self, 0, self.id, nobody);
}

// An edge of an earlier tree is kept until its other end is in the same tree as I am, or gone: so a construction that
// fails disconnects no robot.
void drop_old_edges(Robot& robot) noexcept {
  State& self = robot.self;
  const Ends all = self.old;
  for (const RobotId end : all) {
    const Message* m = robot.said_by(end);
    if (m == nullptr || self.tree.has(end) ||
        (self.done && m->done && m->epoch == self.epoch && m->fragment == self.fragment))
      self.old.remove(end);
  }
}

void construct(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.fragment == nobody || self.done) return;
  answer_branches(robot);
  join_next_level(robot);
  cut_circles(robot);
  if (!self.ready) self.ready = gather(robot);
  follow_leader(robot);
  give_up_refused(robot);
}

bool may_be_edge(const Robot& robot, int k) noexcept {
  const Message& m = robot.table().message(k);
  return robot.self.holds(m.id) || (is_short(robot, k) && has_room(robot.self, m));
}

}  // namespace banyan::baselines::mst
