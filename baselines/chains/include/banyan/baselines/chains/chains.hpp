// SPDX-License-Identifier: MIT
// Chains from a base: relays join each worker to the base, which stays where it is; free robots enter a chain at its
// base end, and a chain closes up where a relay dies (SwarmRelays, Varadharajan et al. 2020, without its planner; with
// k chains a worker as in their earlier work, 2019). docs/baselines.md has the equations and what the papers leave
// open.
#pragma once

#include <span>

#include "banyan/baselines/chains/params.hpp"
#include "banyan/baselines/chains/state.hpp"
#include "banyan/baselines/common/robots.hpp"

namespace banyan::baselines::chains {

using Heard = HeardOf<Message>;

[[nodiscard]] State initial_state(RobotId id, bool worker, bool root) noexcept;
[[nodiscard]] Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Report report(const State& state) noexcept;
void add_to(Digest& digest, const State& state) noexcept;

using Robots = RobotsOf<Params, State, Message, initial_state, step, report, add_to>;

// By name and with its table, for hosts.
[[nodiscard]] const Algorithm& algorithm() noexcept;

}  // namespace banyan::baselines::chains
