// SPDX-License-Identifier: MIT
// The files of a tuning.
#pragma once

#include <string>
#include <vector>

#include "tune_checkpoint.hpp"

namespace banyan::study {

[[nodiscard]] std::string checkpoint_path(const std::string& directory);

// generations.csv: a row per generation and island. Replaces the file.
void write_generations(const std::string& directory, const TunePlan& plan, const std::vector<GenerationRow>& history);

// A point that no other is better than in both goals.
struct FrontPoint {
  std::uint32_t island = 0;
  Fitness::Goals goals{};
  std::vector<double> point;  // in the order of the bounds
  Merit merit;                // on the training seeds; front_of() does not know it
};
// Of all islands' last populations, ascending in the first goal, each pair of goals once.
[[nodiscard]] std::vector<FrontPoint> front_of(const TunePlan& plan, const std::vector<IslandState>& islands);

// All files of a finished tuning, tune.json last, since it marks the tuning as finished.
// What could not be drawn is a warning of `result`. Throws record::FileError.
void write_results(const std::string& directory, const TunePlan& plan, const std::vector<GenerationRow>& history,
                   const std::vector<FrontPoint>& front, const Drawer& drawer, TuneResult& result);

}  // namespace banyan::study
