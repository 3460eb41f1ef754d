// SPDX-License-Identifier: MIT
// "The algorithms can be formalized through a high-level state machine that encodes the behavior of every robot [...]
// barriers [...] correspond to 'wait states' in which the robots must stay until a certain condition is verified for
// every robot. [...] the root aggregates the information necessary to evaluate a certain condition, and then broadcasts
// a 'go' signal throughout the tree." (paper Sec. III-B, Fig. 1)
//
// "Go" is the pair (epoch, phase): it only grows, and every robot passes on the largest that it hears, so a lost
// message delays a robot but never strands it.
#include "banyan/controller/paper/rules.hpp"

namespace banyan::paper {
namespace {

// "At the end of this state, a robot is part of two trees - the one from the previous iteration [...] and a new one"
void begin_epoch(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.parent != nobody) robot.set_old_parent(self.parent);  // without one, the old parent is the only tie
  robot.set_parent(nobody);
  static_cast<OfThisTree&>(self) = {};
  self.centroid_known = false;
  self.spare_state = SpareState::wait;
  self.label_wait_ticks = self.search_ticks = self.orphan_ticks = 0;
}

}  // namespace

// "The 'go' signal triggers a state transition in the robots that receive it."
void listen(Robot& robot) noexcept {
  State& self = robot.self;
  const Serial held = self.root.sequence;
  Serial epoch = self.epoch;
  Phase phase = self.phase;
  for (int k = 0; k < robot.size(); ++k) {
    const Message& m = robot.said(k);
    if (!robot.heard_now(k)) continue;
    if (newer(m.root, self.root)) self.root = m.root;
    if (m.epoch == epoch ? m.phase > phase : is_newer(m.epoch, epoch)) epoch = m.epoch, phase = m.phase;
  }
  if (!robot.is_root()) end_offer(robot, held);
  robot.add_elapsed(self.phase_ticks);
  if (epoch != self.epoch || phase != self.phase) enter(robot, epoch, phase);
}

// "the robots forget the tree from the previous iteration"
void enter(Robot& robot, Serial epoch, Phase phase) noexcept {
  State& self = robot.self;
  if (epoch != self.epoch) begin_epoch(robot);
  self.epoch = epoch;
  self.phase = phase;
  self.phase_ticks = self.done_ticks = 0;
  // One that has no new parent would drift away (row d).
  const bool hangs_on_it = self.parent == nobody && self.role != Role::spare && !robot.is_root();
  if (phase >= Phase::grow_tree && !hangs_on_it) robot.set_old_parent(nobody);
}

// "Init -> Start Tree -> Select Parent -> parent selected? -> Grow Tree -> growth done? -> Select Root -> root
// selected?" (Fig. 1), of which the root decides the diamonds
void advance(Robot& robot) noexcept {
  constexpr int settle_ticks = 3;      // a barrier holds, and SELECT PARENT lasts, at least so long
  constexpr int patience_ticks = 100;  // with motion and occlusion a count may never be reached (row 7)
  State& self = robot.self;
  if (!robot.is_root()) return;
  const bool timeout = self.phase_ticks >= patience_ticks;
  self.done_ticks = self.flood_done ? advanced(self.done_ticks) : std::uint16_t{0};
  switch (self.phase) {
    case Phase::init: return enter(robot, 1, Phase::start_tree);
    case Phase::start_tree:
      if (self.done_ticks >= settle_ticks || timeout) enter(robot, self.epoch, Phase::select_parent);
      return;
    case Phase::select_parent:  // parent selected?
      if ((robot.growth.is_complete(robot) && self.phase_ticks >= settle_ticks) || timeout)
        enter(robot, self.epoch, Phase::grow_tree);
      return;
    case Phase::grow_tree:  // growth done?
      if (self.phase_ticks >= robot.params.rounds(robot.params.reconfiguration_drives))
        enter(robot, self.epoch, Phase::select_root);
      return;
    case Phase::select_root: return;  // root selected? (select_root.cpp)
  }
}

}  // namespace banyan::paper
