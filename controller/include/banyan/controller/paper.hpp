// SPDX-License-Identifier: MIT
// What the paper's two algorithms have in common: one tick of one robot, as printed and as corrected
// (docs/algorithms.md).
#pragma once

#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/output.hpp"
#include "banyan/controller/healing/robot.hpp"

namespace banyan {

// Where they differ: from which end the tree grows.
struct Growth {
  bool (*all_counted)(const TreeRobot&) noexcept;  // START TREE: who has to be in the tree before it goes on
  void (*select_parent)(TreeRobot&) noexcept;      // SELECT PARENT: who joins, and to whom
};

// `inputs`: every packet received since the last step, in any order, duplicates allowed (the last counts); what they
// are in is worked on. Changes `state` only; allocates nothing; same arguments, same result on every machine.
[[nodiscard]] Output<TreeMessage> literal_step(const Growth& growth, const TreeParams& params, TreeState& state,
                                               const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Output<HealingMessage> corrected_step(const Growth& growth, const HealingParams& params,
                                                    HealingState& state, const Inputs<Heard>& inputs) noexcept;

}  // namespace banyan
