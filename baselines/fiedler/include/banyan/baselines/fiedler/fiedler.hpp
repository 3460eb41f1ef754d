// SPDX-License-Identifier: MIT
// Fiedler control: robots estimate the algebraic connectivity lambda_2 of the network and the eigenvector that belongs
// to it by power iteration, and move up its gradient (Yang et al. 2010, Sabattini et al. 2013). docs/baselines.md has
// the equations and what the papers leave open.
#pragma once

#include <span>

#include "banyan/baselines/common/robots.hpp"
#include "banyan/baselines/fiedler/params.hpp"
#include "banyan/baselines/fiedler/state.hpp"

namespace banyan::baselines::fiedler {

using Heard = HeardOf<Message>;

[[nodiscard]] State initial_state(RobotId id, bool worker, bool root) noexcept;
[[nodiscard]] Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Report report(const State& state) noexcept;
void add_to(Digest& digest, const State& state) noexcept;

// The direction in which a robot would increase lambda_2: (5) of docs/baselines.md. In its own frame, in 1 / m.
[[nodiscard]] Vec2 connectivity_gradient(const Params& params, const State& state) noexcept;

using Robots = RobotsOf<Params, State, Message, initial_state, step, report, add_to>;

// By name and with its table, for hosts.
[[nodiscard]] const Algorithm& algorithm() noexcept;

}  // namespace banyan::baselines::fiedler
