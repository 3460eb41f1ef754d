// SPDX-License-Identifier: MIT
#include <algorithm>

#include "healing/healing.hpp"
#include "tree/epoch.hpp"
#include "tree/root_selection.hpp"

namespace banyan {
namespace {

// A token newer than mine. Two fragments may each have a root: when they meet, the larger one keeps its own.
// Each further token comes from a larger fragment than the last, so that this ends. True if I remain root
// and all robots have to hear of it.
bool hear_token(HealingRobot& robot, const HealingMessage& m) noexcept {
  HealingState& self = robot.self;
  const bool rival = robot.is_root() && m.root.id != self.id && m.root.id != self.new_root;
  if (robot.params.heals() && rival && m.root_size < self.root_size) {
    self.root.sequence = advanced(m.root.sequence);
    return true;
  }
  self.root = m.root;
  self.root_size = m.root_size;
  return false;
}

// The root waits while the flood still finds robots, however many hops away. For the choice of parents, which spreads
// along the same way, it waits at least as long as the flood took.
int barrier_patience_ticks(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  if (self.phase != Phase::start_tree && !robot.is_root()) return 0;
  const int least = whole(robot.params.barrier_rounds);
  if (self.phase == Phase::select_parent) return std::max<int>(least, self.flood_ticks);
  if (self.phase != Phase::start_tree) return least;
  if (self.phase_ticks <= robot.elapsed_ticks) self.flood_counted = 0;
  if (self.flood_robots > self.flood_counted) {
    self.flood_counted = self.flood_robots;
    self.flood_ticks = self.phase_ticks;
  }
  return self.flood_ticks + least;
}

}  // namespace

void listen_among_fragments(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  const Serial held = self.root.sequence;
  bool contested = false;
  for (const Heard& h : robot.news_of_tree())
    if (newer(h.message->root, self.root)) contested = hear_token(robot, said(h)) || contested;
  if (!robot.is_root()) hand_over(robot, held);
  const EpochPhase newest = newest_phase(robot);
  // Only robots that had another root can be ahead of this one: it opens an epoch for them, too.
  const bool ahead = is_newer(newest.epoch, self.epoch) && robot.params.heals();
  if (robot.is_root() && (contested || ahead)) return enter(robot, advanced(newest.epoch), Phase::start_tree);
  follow_phase(robot, newest);
}

void accept_offered_root(HealingRobot& robot) noexcept {
  if (const TreeMessage* offer = accept_offer(robot)) robot.self.root_size = healing_message(*offer).root_size;
}

void advance_and_count(HealingRobot& robot, bool tree_complete, bool may_reconstruct) noexcept {
  HealingState& self = robot.self;
  const Phase before = self.phase;
  advance(robot, tree_complete, may_reconstruct, barrier_patience_ticks(robot));
  if (before == Phase::start_tree && self.phase == Phase::select_parent && robot.is_root())
    self.root_size = self.flood_robots;
}

}  // namespace banyan
