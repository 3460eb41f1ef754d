// SPDX-License-Identifier: MIT
// Link consensus: robots keep links, motion obeys the links that are kept, and a link is given up only when its two
// ends agree that a path of kept links remains (Zavlanos & Pappas 2008, Michael et al. 2009; local choice of links as
// Cornejo et al. 2009). docs/baselines.md has the equations and what the papers leave open.
#pragma once

#include <span>

#include "banyan/baselines/common/robots.hpp"
#include "banyan/baselines/link_consensus/params.hpp"
#include "banyan/baselines/link_consensus/state.hpp"

namespace banyan::baselines::link_consensus {

using Heard = HeardOf<Message>;

[[nodiscard]] State initial_state(RobotId id, bool worker, bool root) noexcept;
[[nodiscard]] Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Report report(const State& state) noexcept;
void add_to(Digest& digest, const State& state) noexcept;

using Robots = RobotsOf<Params, State, Message, initial_state, step, report, add_to>;

// By name and with its table, for hosts.
[[nodiscard]] const Algorithm& algorithm() noexcept;

}  // namespace banyan::baselines::link_consensus
