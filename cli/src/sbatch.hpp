// SPDX-License-Identifier: MIT
// The job script of a study for a cluster with Slurm.
#pragma once

#include <string>

#include "banyan/config/config.hpp"

namespace banyan::cli {

struct StudyOptions {
  std::string file;
  std::vector<config::Override> overrides;  // of all runs
  std::string out;                          // "": out/<name>
  int threads = 0;                          // 0: all cores; under mpirun one a process
  std::string shard;                        // "3/8", "": everything
  std::string sbatch;                       // write a job script there instead
  int shards = 16;                          // of that script
  bool dry_run = false;
  bool yes = false;
  bool force = false;
  bool extend = false;
  bool retry = false;
  bool mix_versions = false;
  bool quiet = false;
};

// An array job of options.shards tasks, one shard each, with this program, this study and this
// folder by their absolute paths. A comment in it explains how to collect.
[[nodiscard]] std::string sbatch_script(const StudyOptions& options, const std::string& name,
                                        const std::string& folder);

}  // namespace banyan::cli
