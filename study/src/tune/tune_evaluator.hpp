// SPDX-License-Identifier: MIT
// From points of the search space to their merit: every point is worlds x seeds runs, and the runs
// of all points that are wanted at once go to the workers together.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "banyan/study/tune.hpp"

namespace banyan::study {

// The tuning was asked to stop; what was being evaluated is given up.
class Stopped : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "stopped"; }
};

// All functions may be called from any thread.
class Evaluator {
 public:
  Evaluator(const TunePlan& plan, Workers& workers) : plan_(plan), workers_(workers) {}

  // The merits of points in parameter units, on the training seeds. Points that cannot be run cost
  // nothing, those seen before are remembered. Throws Stopped, and TuneError if a run fails.
  [[nodiscard]] std::vector<Merit> merits(const std::vector<std::vector<double>>& points);

  // The trials of each of the given parameter sets (none: the worlds as they are) in all worlds, for
  // all these seeds.
  [[nodiscard]] std::vector<std::vector<Trial>> trials(const std::vector<std::optional<std::vector<double>>>& points,
                                                       const std::vector<std::uint64_t>& seeds);

  // Makes every call that waits, and every later one, throw Stopped.
  void stop() noexcept { stopped_ = true; }
  // Runs that were delivered so far.
  [[nodiscard]] std::uint64_t runs() const noexcept { return runs_; }
  // Merits that were given out so far.
  [[nodiscard]] std::uint64_t evaluations() const noexcept { return evaluations_; }

 private:
  struct Batch;
  [[nodiscard]] std::vector<Trial> run(std::vector<std::string> tasks);

  const TunePlan& plan_;
  Workers& workers_;
  std::atomic<bool> stopped_{false};
  std::atomic<std::uint64_t> runs_{0};
  std::atomic<std::uint64_t> evaluations_{0};
  std::mutex known_mutex_;
  std::map<std::vector<double>, Merit> known_;
};

}  // namespace banyan::study
