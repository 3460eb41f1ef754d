// SPDX-License-Identifier: MIT
// The beginning and the end of a tick, the same for every algorithm of the tree: what was remembered and
// heard comes in, the message goes out.
#pragma once

#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/function_ref.hpp"
#include "tree/robot.hpp"

namespace banyan {

// A robot before its first step. Exactly one robot of a swarm starts as root; a robot that is sent to a target
// is told so at every step (Orders).
[[nodiscard]] TreeState initial_tree_state(RobotId id, bool worker, bool root) noexcept;
// What makes a new state that robot's, in place.
void begin_as(TreeState& self, RobotId id, bool worker, bool root) noexcept;
template <class State> State begun(RobotId id, bool worker, bool root) noexcept {
  State state;
  begin_as(state, id, worker, root);
  return state;
}

// A robot that is sent to a target is a worker until it is called back.
void follow_orders(TreeRobot& robot, const Orders& orders) noexcept;
void carry_memory(TreeState& self, const Carry& carry) noexcept;

// The neighbour table and the tree's array beside it are brought up to date in two steps: robots that were heard
// are entered (Heard::place), and those silent for too long are removed. Algorithms that heal keep arrays of their
// own in step, and write them in between. Beside the parents, those stay of which `is_tied(k)`. `close(k, size)`: entry
// k is removed, and those behind it, up to `size`, move up by one.
void file_heard(TreeRobot& robot) noexcept;
void forget_silent(TreeRobot& robot, FunctionRef<bool(int k)> is_tied,
                   FunctionRef<void(int k, int size)> close) noexcept;

// The tree's part of the message, and what an observer may know of it.
void write_tree(const TreeRobot& robot, TreeMessage& message) noexcept;
[[nodiscard]] Report tree_report(const TreeState& state) noexcept;

// Every field that can influence a later step, padding excluded.
void add_to(Digest& digest, const TreeState& state) noexcept;
void add_to(Digest& digest, const TreeMessage& message) noexcept;

}  // namespace banyan
