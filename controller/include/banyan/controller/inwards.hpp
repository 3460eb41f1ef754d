// SPDX-License-Identifier: MIT
// The inwards algorithm (paper Sec. III-E): branches grow from the workers towards the root; only robots that are
// named as a parent join.
#pragma once

#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/output.hpp"
#include "banyan/controller/healing/params.hpp"
#include "banyan/controller/healing/state.hpp"

namespace banyan {

// Table I, inwards column.
[[nodiscard]] HealingParams inwards_defaults() noexcept;

// One tick of one robot. `inputs`: every packet received since the last step, in any order, duplicates allowed
// (the last counts); what they are in is worked on. Changes `state` only; allocates nothing; same arguments, same
// result on every machine. As printed, and as corrected (docs/algorithms.md).
[[nodiscard]] Output<TreeMessage> inwards_literal_step(const TreeParams& params, TreeState& state,
                                                       const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Output<HealingMessage> inwards_step(const HealingParams& params, HealingState& state,
                                                  const Inputs<Heard>& inputs) noexcept;

}  // namespace banyan
