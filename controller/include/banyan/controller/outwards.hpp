// SPDX-License-Identifier: MIT
// The outwards algorithm (paper Sec. III-D): a spanning tree that grows from the root; branches without a
// worker are pruned from their leaves.
#pragma once

#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/output.hpp"
#include "banyan/controller/healing/params.hpp"
#include "banyan/controller/healing/state.hpp"

namespace banyan {

// Table I, outwards column.
[[nodiscard]] HealingParams outwards_defaults() noexcept;

// One tick of one robot. `inputs`: every packet received since the last step, in any order, duplicates allowed
// (the last counts); what they are in is worked on. Changes `state` only; allocates nothing; same arguments, same
// result on every machine. As printed, and as corrected (docs/algorithms.md).
[[nodiscard]] Output<TreeMessage> outwards_literal_step(const TreeParams& params, TreeState& state,
                                                        const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Output<HealingMessage> outwards_step(const HealingParams& params, HealingState& state,
                                                   const Inputs<Heard>& inputs) noexcept;

}  // namespace banyan
