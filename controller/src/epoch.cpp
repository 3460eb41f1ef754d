// SPDX-License-Identifier: MIT
#include "banyan/controller/epoch.hpp"

#include "banyan/controller/policy.hpp"

namespace banyan {
namespace {

void begin_epoch(Robot& robot) noexcept {
  State& self = robot.self;
  // A robot that has only an old parent keeps it: it is the one edge that ties it to the tree.
  if (self.parent != nobody) {
    self.old_parent = self.parent;
    robot.old_parent = robot.parent;
  }
  self.parent = nobody;
  robot.parent = -1;
  self.committed = false;
  self.label_cm = unknown_label;
  self.label_wait_ticks = 0;
  self.pulse = 0;
  self.flood_parent = nobody;
  self.flood_done = false;
  self.flood_robots = self.flood_workers = 0;
  self.search_ticks = self.orphan_ticks = 0;
  self.need = Need::no_need;
  self.grant = self.request = self.inserted_child = self.wish = nobody;
  self.spare_state = SpareState::wait;
  self.centroid_known = false;
  self.new_root = nobody;
}

// GROW TREE: the old parent goes. Whoever found no new one keeps it as a constraint on its motion
// until it has: dropped, the branch would drift out of range before it can re-attach.
void forget_old_tree(Robot& robot) noexcept {
  if (robot.self.parent == nobody && robot.self.role != Role::spare && !robot.is_root()) return;
  robot.self.old_parent = nobody;
  robot.old_parent = -1;
}

// A newer token than mine. Two fragments may each have had a root: when they meet, the larger keeps
// its own. Each further token is of a larger fragment than the last, so that there is an end to it.
// True if I remain root and all have to hear of it.
bool hear_token(Robot& robot, const Message& m) noexcept {
  State& self = robot.self;
  const bool rival = robot.is_root() && m.root.id != self.id && m.root.id != self.new_root;
  if (robot.params.heals() && rival && m.root_size < self.root_size) {
    self.root.sequence = static_cast<std::uint16_t>(m.root.sequence + 1);
    return true;
  }
  self.root = m.root;
  self.root_size = m.root_size;
  return false;
}

// The barrier of the root's phase: may it open the next one?
bool barrier_holds(const Robot& robot) noexcept {
  const State& self = robot.self;
  switch (self.phase) {
    case Phase::start_tree: return self.flood_done;
    case Phase::select_parent: return robot.policy.tree_complete(robot);
    default: return false;
  }
}

}  // namespace

void listen(Robot& robot) noexcept {
  State& self = robot.self;
  std::uint16_t epoch = self.epoch;
  Phase phase = self.phase;
  bool contested = false;
  for (const Heard& h : robot.heard) {
    const Message& m = *h.message;
    if (newer(m.root, self.root)) contested = hear_token(robot, m) || contested;
    if (m.epoch > epoch || (m.epoch == epoch && m.phase > phase)) {
      epoch = m.epoch;
      phase = m.phase;
    }
  }
  if (self.phase_ticks < UINT16_MAX) ++self.phase_ticks;
  // A root is ahead of everybody but those who had another one: it opens an epoch for them, too.
  const bool ahead = epoch > self.epoch && robot.params.heals();
  if (robot.is_root() && (contested || ahead)) return enter(robot, static_cast<std::uint16_t>(epoch + 1), Phase::start_tree);
  if (epoch != self.epoch || phase != self.phase) enter(robot, epoch, phase);
}

void enter(Robot& robot, std::uint16_t epoch, Phase phase) noexcept {
  State& self = robot.self;
  if (epoch != self.epoch) begin_epoch(robot);
  self.epoch = epoch;
  self.phase = phase;
  self.phase_ticks = 0;
  self.done_ticks = 0;
  if (phase >= Phase::grow_tree) forget_old_tree(robot);
}

void advance(Robot& robot) noexcept {
  constexpr int settle_ticks = 3;  // a barrier must hold, and SELECT PARENT last, for so long
  State& self = robot.self;
  const Params& p = robot.params;
  if (!robot.is_root()) return;
  if (self.phase == Phase::init) return enter(robot, 1, Phase::start_tree);
  self.done_ticks = barrier_holds(robot) ? static_cast<std::uint16_t>(self.done_ticks + 1) : std::uint16_t{0};
  const bool timeout = self.phase_ticks >= p.ticks(p.barrier_timeout_s);
  switch (self.phase) {
    case Phase::start_tree:
      if (self.done_ticks < settle_ticks && !timeout) break;
      self.root_size = self.flood_robots;
      enter(robot, self.epoch, Phase::select_parent);
      break;
    case Phase::select_parent:
      if ((self.done_ticks > 0 && self.phase_ticks >= settle_ticks) || timeout) enter(robot, self.epoch, Phase::grow_tree);
      break;
    case Phase::grow_tree:
      if (self.phase_ticks >= p.ticks(p.reconfiguration_period_s) && robot.policy.reconstructs(robot))
        enter(robot, self.epoch, Phase::select_root);
      break;
    default: break;  // SELECT ROOT ends with the root's next epoch (root_selection.hpp)
  }
}

}  // namespace banyan
