// SPDX-License-Identifier: MIT
// Cohesive control: the swarm holds together like a liquid that its leaders drag apart. Its boundary has a tension, so
// that it tends to a Steiner tree of the leaders, as thick as there are robots for it (Krupke et al. 2015).
// docs/baselines.md has the equations and what the paper leaves open.
#pragma once

#include <span>

#include "banyan/baselines/cohesion/params.hpp"
#include "banyan/baselines/cohesion/state.hpp"
#include "banyan/baselines/common/robots.hpp"

namespace banyan::baselines::cohesion {

using Heard = HeardOf<Message>;

[[nodiscard]] State initial_state(RobotId id, bool worker, bool root) noexcept;
[[nodiscard]] Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Report report(const State& state) noexcept;
void add_to(Digest& digest, const State& state) noexcept;

using Robots = RobotsOf<Params, State, Message, initial_state, step, report, add_to>;

// By name and with its table, for hosts.
[[nodiscard]] const Algorithm& algorithm() noexcept;

}  // namespace banyan::baselines::cohesion
