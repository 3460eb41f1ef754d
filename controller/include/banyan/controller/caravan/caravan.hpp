// SPDX-License-Identifier: MIT
// Caravan (docs/caravan.md): one tree over all robots, towed by the workers. Begin with step.cpp; the rooms of a step
// stand here in its order.
#pragma once

#include "banyan/controller/caravan/params.hpp"
#include "banyan/controller/caravan/state.hpp"
#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/output.hpp"

namespace banyan::caravan {

[[nodiscard]] State initial(RobotId id, bool worker, bool root) noexcept;
[[nodiscard]] Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Report report(const State& state) noexcept;
void add_to(Digest& digest, const State& state) noexcept;  // every field that can influence a later step

}  // namespace banyan::caravan
