// SPDX-License-Identifier: MIT
// Branch repositioning: connectors are left behind by teams that go to the targets, and a branch of their tree moves
// to a neighbouring connector where that makes the network shorter (minimal-length swarm networks, Miyauchi et al.,
// IROS 2024). docs/baselines.md has the equations and what differs from the authors' program.
#pragma once

#include <span>

#include "banyan/baselines/branches/params.hpp"
#include "banyan/baselines/branches/state.hpp"
#include "banyan/baselines/common/robots.hpp"

namespace banyan::baselines::branches {

using Heard = HeardOf<Message>;

[[nodiscard]] State initial_state(RobotId id, bool worker, bool root) noexcept;
[[nodiscard]] Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Report report(const State& state) noexcept;
void add_to(Digest& digest, const State& state) noexcept;

using Robots = RobotsOf<Params, State, Message, initial_state, step, report, add_to>;

// By name and with its table, for hosts.
[[nodiscard]] const Algorithm& algorithm() noexcept;

}  // namespace banyan::baselines::branches
