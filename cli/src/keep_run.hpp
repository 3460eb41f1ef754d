// SPDX-License-Identifier: MIT
// From a world to the results of its run: what `banyan run` and `banyan hub` have in common.
#pragma once

#include <functional>
#include <string>

#include "banyan/controller/core/function_ref.hpp"
#include "banyan/record/simulation.hpp"
#include "options.hpp"
#include "outputs.hpp"

namespace banyan::cli {

// How the world is stepped to its end, as record::run_scenario does.
using Play = std::function<record::RunEnd(world::World, record::Sink&, world::Executor&, const record::GoOn&)>;

// Opens the outputs, makes the world, plays, prints the summary; returns the exit code. The world of a large swarm
// takes a while, and a run that is stopped meanwhile has files, too. `remarks`: asked at the end, for
// SummaryExtras::remarks.
int keep_run(const config::Configuration& configuration, const RunOutputs& outputs, const RunOptions& options,
             FunctionRef<world::World()> make_world, const Play& play,
             const std::function<std::string()>& remarks = {});

}  // namespace banyan::cli
