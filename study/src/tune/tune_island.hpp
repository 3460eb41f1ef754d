// SPDX-License-Identifier: MIT
// One independent instance of the search: a population and its algorithm. The only file pair that
// knows pagmo.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tune_evaluator.hpp"

namespace banyan::study {

// All that a search needs to continue as if it had never stopped.
struct IslandState {
  std::vector<std::vector<double>> points;      // the population, in the unit cube
  std::vector<std::vector<double>> objectives;  // what pagmo minimises: one number, or two for nsga2
  std::string algorithm;                        // the algorithm with its random engine, a boost text archive
};

class Island {
 public:
  // Before anything else: populate() or restore(). Both references must outlive the island.
  Island(const TunePlan& plan, Evaluator& evaluator, std::size_t index);
  Island(Island&&) noexcept;
  ~Island();

  // The random generation, with the plan's initial point if there is one. As far as some thousand
  // tries find them, all its individuals can be run.
  void populate();
  // One generation more. If it throws (Stopped, TuneError) the island is of no further use.
  void evolve();

  [[nodiscard]] IslandState state() const;
  // Throws TuneError if this is no state of an island of this plan.
  void restore(const IslandState& state);

  // The fitness of each individual (Fitness::of), and its parameters.
  [[nodiscard]] std::vector<double> fitness() const;
  [[nodiscard]] std::vector<std::vector<double>> points() const;

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

}  // namespace banyan::study
