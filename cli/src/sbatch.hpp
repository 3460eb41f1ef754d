// SPDX-License-Identifier: MIT
// The job script of a study for a cluster with Slurm.
#pragma once

#include <string>

#include "commands.hpp"

namespace banyan::cli {

// An array job of options.shards tasks, one shard each, with this program, this study and this
// folder by their absolute paths. A comment in it explains how to collect.
[[nodiscard]] std::string sbatch_script(const StudyOptions& options, const std::string& name,
                                        const std::string& folder);

}  // namespace banyan::cli
