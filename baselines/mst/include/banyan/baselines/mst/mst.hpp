// SPDX-License-Identifier: MIT
// MST preservation: a minimum spanning tree of the radio graph, found by the robots themselves, is kept, and built anew
// when one of its edges gets long (Aragues et al. 2014, Soleymani et al. 2015). docs/baselines.md has the equations and
// what the papers leave open.
#pragma once

#include <span>

#include "banyan/baselines/common/robots.hpp"
#include "banyan/baselines/mst/params.hpp"
#include "banyan/baselines/mst/state.hpp"

namespace banyan::baselines::mst {

using Heard = HeardOf<Message>;

[[nodiscard]] State initial_state(RobotId id, bool worker, bool root) noexcept;
[[nodiscard]] Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Report report(const State& state) noexcept;
void add_to(Digest& digest, const State& state) noexcept;

using Robots = RobotsOf<Params, State, Message, initial_state, step, report, add_to>;

// By name and with its table, for hosts.
[[nodiscard]] const Algorithm& algorithm() noexcept;

}  // namespace banyan::baselines::mst
