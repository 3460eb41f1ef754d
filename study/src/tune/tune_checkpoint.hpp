// SPDX-License-Identifier: MIT
// How far a tuning is, and the file that keeps it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tune_island.hpp"

namespace banyan::study {

// One island after one generation: a row of generations.csv.
struct GenerationRow {
  std::uint32_t island = 0;
  std::uint32_t generation = 0;    // 0: the random one
  double best = 0.0;               // fitness of the best point that the island has seen so far
  double mean = 0.0, worst = 0.0;  // of its population
  std::vector<double> best_point;  // in the order of the bounds
};

struct Checkpoint {
  std::uint32_t generation = 0;  // all islands have finished it
  std::vector<IslandState> islands;
  std::vector<GenerationRow> history;  // generation by generation, in it island by island
};

// Replaces the file, atomically. Throws record::FileError.
void save_checkpoint(const std::string& path, const TunePlan& plan, const Checkpoint& checkpoint);
// Nothing if there is no such file. Throws TuneError if it is damaged, of another plan or of another
// version of Banyan; record::FileError if it cannot be read.
[[nodiscard]] std::optional<Checkpoint> load_checkpoint(const std::string& path, const TunePlan& plan);

}  // namespace banyan::study
