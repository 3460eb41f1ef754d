// SPDX-License-Identifier: MIT
// Epochs, phases and barriers (paper Fig. 1, protocol 4). (epoch, phase) spreads by gossip over the whole
// radio graph and only grows, so a lost message delays a robot but never strands it.
#pragma once

#include "tree/robot.hpp"

namespace banyan {

// The largest (epoch, phase) of mine and those just heard; and the step into it.
struct EpochPhase {
  Serial epoch;
  Phase phase;
  friend constexpr bool operator==(EpochPhase, EpochPhase) noexcept = default;
};
[[nodiscard]] EpochPhase newest_phase(const TreeRobot& robot) noexcept;
void follow_phase(TreeRobot& robot, EpochPhase newest) noexcept;

// The root's barriers: opens the next phase when its condition holds, or its time is over.
// `tree_complete`: every robot that should be in the tree is in it (barrier of SELECT PARENT); `may_reconstruct`: a new
// epoch may begin once R is over.
// `patience_ticks`: how long it waits in START TREE and SELECT PARENT.
void advance(TreeRobot& robot, bool tree_complete, bool may_reconstruct, int patience_ticks) noexcept;

// Enters (epoch, phase): a new epoch makes the parent the old parent and forgets labels and grants;
// GROW TREE forgets the old tree.
void enter(TreeRobot& robot, Serial epoch, Phase phase) noexcept;

}  // namespace banyan
