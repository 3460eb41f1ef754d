// SPDX-License-Identifier: MIT
#include "tree/epoch.hpp"

namespace banyan {
namespace {

void begin_epoch(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  robot.retire_parent();
  self.committed = false;
  self.label = unknown_label;
  self.label_wait_ticks = 0;
  self.seqno = 0;
  self.seqno_ticks = 0;
  self.flood_parent = nobody;
  self.flood_done = false;
  self.flood_robots = self.flood_workers = 0;
  self.search_ticks = self.orphan_ticks = 0;
  self.need = Need::no_need;
  self.grant = self.request = self.inserted_child = self.pending_parent = nobody;
  self.spare_state = SpareState::wait;
  self.centroid_known = false;
  self.new_root = nobody;
}

// GROW TREE: the old parent is dropped. A robot that has found no new one keeps it as a constraint on its motion
// until it has one: otherwise the branch would drift out of range before it could re-attach.
void forget_old_tree(TreeRobot& robot) noexcept {
  if (robot.self.parent == nobody && robot.self.role != Role::spare && !robot.is_root()) return;
  robot.drop_old_parent();
}

// The barrier of the root's phase: whether the root may open the next one.
bool barrier_holds(const TreeRobot& robot, bool tree_complete) noexcept {
  const TreeState& self = robot.self;
  switch (self.phase) {
    case Phase::start_tree: return self.flood_done;
    case Phase::select_parent: return tree_complete;
    default: return false;
  }
}

}  // namespace

EpochPhase newest_phase(const TreeRobot& robot) noexcept {
  EpochPhase newest{robot.self.epoch, robot.self.phase};
  for (const Heard& h : robot.news_of_tree()) {
    const TreeMessage& m = *h.message;
    if (m.epoch == newest.epoch ? m.phase > newest.phase : is_newer(m.epoch, newest.epoch)) newest = {m.epoch, m.phase};
  }
  return newest;
}

void follow_phase(TreeRobot& robot, EpochPhase newest) noexcept {
  TreeState& self = robot.self;
  robot.add_elapsed(self.phase_ticks);
  if (newest != EpochPhase{self.epoch, self.phase}) enter(robot, newest.epoch, newest.phase);
}

void enter(TreeRobot& robot, Serial epoch, Phase phase) noexcept {
  TreeState& self = robot.self;
  if (epoch != self.epoch) begin_epoch(robot);
  self.epoch = epoch;
  self.phase = phase;
  self.phase_ticks = 0;
  self.done_ticks = 0;
  if (phase >= Phase::grow_tree) forget_old_tree(robot);
}

void advance(TreeRobot& robot, bool tree_complete, bool may_reconstruct, int patience_ticks) noexcept {
  constexpr int settle_ticks = 3;  // a barrier must hold, and SELECT PARENT last, for so long
  TreeState& self = robot.self;
  const TreeParams& p = robot.params;
  if (!robot.is_root()) return;
  if (self.phase == Phase::init) return enter(robot, 1, Phase::start_tree);
  self.done_ticks =
      barrier_holds(robot, tree_complete) ? static_cast<std::uint16_t>(self.done_ticks + 1) : std::uint16_t{0};
  const bool timeout = self.phase_ticks >= patience_ticks;
  switch (self.phase) {
    case Phase::start_tree:
      if (self.done_ticks < settle_ticks && !timeout) break;
      enter(robot, self.epoch, Phase::select_parent);
      break;
    case Phase::select_parent:
      if ((self.done_ticks > 0 && self.phase_ticks >= settle_ticks) || timeout)
        enter(robot, self.epoch, Phase::grow_tree);
      break;
    case Phase::grow_tree:
      if (self.phase_ticks >= p.rounds(p.reconfiguration_drives) && may_reconstruct)
        enter(robot, self.epoch, Phase::select_root);
      break;
    default: break;  // SELECT ROOT ends with the root's next epoch (root_selection.hpp)
  }
}

}  // namespace banyan
