// SPDX-License-Identifier: MIT
#include "tree/tree_index.hpp"

#include <algorithm>

#include "tree/parent_selection.hpp"

namespace banyan {

void index_neighbors(TreeRobot& robot) noexcept {
  const TreeState& self = robot.self;
  const TreeTable& table = robot.table();
  const RobotId me = self.id;
  robot.parent = table.find(self.parent);
  robot.old_parent = table.find(self.old_parent);
  robot.children.size = robot.old_children.size = 0;
  robot.useful_children = 0;
  table.below.for_each([&](int k) {
    if (!table.alive(k)) return;
    const TreeStanding& m = table.message(k);
    // A robot that has not entered this epoch yet names its parent of the last one.
    (m.parent == me && m.epoch == self.epoch ? robot.children : robot.old_children).push(k);
    if (m.role != Role::spare) ++robot.useful_children;
  });
  std::uint8_t call_hops = nobody_calls;
  for (int k = 0, size = table.size(); k < size; ++k)
    call_hops = std::min(call_hops, table.alive(k) ? table.message(k).call_hops : nobody_calls);
  robot.call_hops = call_hops;
}

void update_role(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  const bool joins = robot.useful_children > 0 || self.inserted_child != nobody || robot.carries_on;
  if (robot.is_root()) self.role = Role::root;
  else if (self.is_worker) self.role = Role::worker;
  else if (joins || self.role != Role::spare) self.role = Role::connector;  // so is a root that has handed over
  else return;
  // Patience: a child may only have been silent, or be about to name me (protocol 3).
  if (self.role == Role::connector && !joins) robot.add_elapsed(self.childless_ticks);
  else self.childless_ticks = 0;
  if (self.childless_ticks <= robot.patience_ticks()) return;
  self.role = Role::spare;
  self.childless_ticks = 0;
  if (robot.children.size == 0) leave_tree(robot);
}

}  // namespace banyan
