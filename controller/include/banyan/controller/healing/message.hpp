// SPDX-License-Identifier: MIT
// What a robot also broadcasts so that living robots can take the place of dead ones (protocol 12): every
// robot passes on where the root and the targets are, at each tick one target to one addressee. The other
// receivers use the counts alone.
#pragma once

#include "banyan/controller/tree/message.hpp"

namespace banyan {

struct HealingStanding {
  RobotId serves = nobody;  // worker: whose target this is, the id of the worker first sent there

  friend bool operator==(const HealingStanding&, const HealingStanding&) = default;
};

struct HealingNews {
  bool root_told = false;    // I know where the root is
  RobotCount root_size = 0;  // robots that this root counted last; 0: none yet
  Serial heartbeat = 0;      // gossip: the root's count of ticks
  RobotId told = nobody;     // addressee of the vectors that follow
  Coordinate root_x;         // root - addressee, edge frame to `told`
  Coordinate root_y;
  RobotId task_serves = nobody;  // a target, by its first worker; nobody: I know none
  RobotId task_holder = nobody;  // gossip: the robot that serves it; nobody: it has been given up
  Serial task_beat = 0;          // gossip: the holder's count of ticks
  bool task_reached = false;     // gossip: its holder is there
  bool task_silent = false;  // gossip: the robots that heard the holder last no longer hear it; without holder: put off
  bool task_below = false;   // the holder is below me in the tree, or I am the holder
  bool forgets = false;      // gossip: some robot has had no room for a target
  Coordinate task_x;         // target - addressee, edge frame to `told`
  Coordinate task_y;

  friend bool operator==(const HealingNews&, const HealingNews&) = default;
};

struct HealingMessage : TreeMessage, HealingStanding, HealingNews {
  static constexpr std::uint8_t blocks = TreeMessage::blocks | block::healing;
  friend bool operator==(const HealingMessage&, const HealingMessage&) = default;
};

// Gossip: the longest burst of loss that the sender knows, ticks (loss.cpp). It travels in a field that only an offer
// of the token needs, since a message has no byte left; robots that do not heal leave it 0.
[[nodiscard]] constexpr int burst_of(const TreeMessage& m) noexcept {
  return m.new_root == nobody ? m.centroid_x.bits / 4 : 0;
}
constexpr void set_burst(TreeMessage& m, std::uint8_t ticks) noexcept {
  if (m.new_root == nobody) m.centroid_x = {static_cast<std::int16_t>(4 * ticks)};
}

// The healing block, field by field (wire.hpp).
template <class Visitor, class M> constexpr void visit_healing_block(Visitor& visit, M& m) noexcept {
  visit.flag("root_told", "1: knows where the root is", m.root_told);
  visit.flag("task_reached", "1: the holder of `task` is at the target", m.task_reached);
  visit.flag("task_silent", "1: the holder of `task` is in doubt; without holder: put off", m.task_silent);
  visit.flag("task_below", "1: the holder of `task` is the sender, or below it in the tree", m.task_below);
  visit.flag("forgets", "1: some robot has had no room for a target", m.forgets);
  visit.count("root_size", "robots that the root counted last, 0: none yet", m.root_size);
  visit.number("heartbeat", "the root's count of ticks, modulo 65536", m.heartbeat);
  visit.robot("serves", "of a worker: its target, by the worker first sent there, -1: none", m.serves);
  visit.robot("told", "addressee of root and task, -1: nobody", m.told);
  visit.coordinate("root_x", "where the root is, relative to `told`, along the edge to it", m.root_x);
  visit.coordinate("root_y", "the same, to the left of that edge", m.root_y);
  visit.robot("task", "a target, by the worker first sent there, -1: none", m.task_serves);
  visit.robot("task_holder", "the robot that serves it, -1: given up", m.task_holder);
  visit.number("task_beat", "the holder's count of ticks, modulo 65536", m.task_beat);
  visit.coordinate("task_x", "where the target is, relative to `told`, along the edge to it", m.task_x);
  visit.coordinate("task_y", "the same, to the left of that edge", m.task_y);
}

template <class Visitor> constexpr void visit_fields(Visitor& visit, HealingMessage& m) noexcept {
  visit_tree_block(visit, static_cast<TreeMessage&>(m), true), visit_healing_block(visit, m);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, const HealingMessage& m) noexcept {
  visit_tree_block(visit, static_cast<const TreeMessage&>(m), true), visit_healing_block(visit, m);
}

}  // namespace banyan
