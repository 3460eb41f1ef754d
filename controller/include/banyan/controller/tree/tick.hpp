// SPDX-License-Identifier: MIT
// The begin and the end of a tick, the same for every algorithm of the tree: what was remembered and heard
// comes in, the message goes out.
#pragma once

#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/tree/robot.hpp"

namespace banyan {

// A robot before its first step. Exactly one robot of a swarm starts as root; who is sent to a target is
// told so at every step (Orders).
[[nodiscard]] TreeState initial_tree_state(RobotId id, bool worker, bool root) noexcept;

// What is remembered moves with the robot's own frame, the neighbour table is brought up to date, and the
// orders are followed.
void begin_tick(TreeRobot& robot, const Admitted& admitted) noexcept;

// Its parts. Who is sent to a target is a worker, until it is called back.
void follow_orders(TreeRobot& robot, const Orders& orders) noexcept;
void carry_memory(TreeState& self, const Carry& carry) noexcept;

// The tree's array beside the neighbour table (Neighbors). Who heals adds its own.
struct TreeColumns {
  TreeState& self;

  [[nodiscard]] bool names_me(const TreeStanding& m) const noexcept { return m.parent == self.id || m.old_parent == self.id; }
  [[nodiscard]] bool ties(int k) const noexcept {
    const TreeStanding& m = self.neighbors.message(k);
    return m.id == self.parent || m.id == self.old_parent || names_me(m);
  }
  void write(int k, const TreeMessage& m) noexcept { self.neighbors.standings[static_cast<std::size_t>(k)] = static_cast<const TreeStanding&>(m); }
  void close(int k, int size) noexcept { close_gap(self.neighbors.standings, k, size); }
};

// Brings the neighbour table and all arrays beside it up to date.
template <class Columns>
void update_table(TreeRobot& robot, Columns columns) noexcept {
  TreeState& self = robot.self;
  Neighbors& table = self.neighbors;
  table.begin(robot.elapsed_ticks);
  for (Heard& h : robot.heard) {
    const TreeMessage& m = *h.message;
    if (m.id == self.id || m.id == nobody) continue;
    const bool ties = m.id == self.parent || m.id == self.old_parent || columns.names_me(m);
    h.before = table.file(m.id, h.position, ties, m, columns);
  }
  table.end(robot.carry, robot.liveness_ticks(), {self.parent, self.old_parent}, columns);
}

// The tree's part of the message, and what an observer may know of it.
void write_tree(const TreeRobot& robot, TreeMessage& message) noexcept;
[[nodiscard]] Report tree_report(const TreeState& state) noexcept;

// Every field that can influence a later step, padding excluded.
void add_to(Digest& digest, const TreeState& state) noexcept;
void add_to(Digest& digest, const TreeMessage& message) noexcept;

}  // namespace banyan
