// SPDX-License-Identifier: MIT
// `banyan tune`: an evolutionary search over controller parameters, as in the paper's Sec. IV-A.
// docs/tuning.md describes the file, the fitness and what a tuning leaves behind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/config/config.hpp"
#include "banyan/study/figure.hpp"
#include "banyan/study/workers.hpp"

namespace banyan::study {

// ---------------------------------------------------------------------------------- what to do --

enum class Search : std::uint8_t { sga, nsga2, cmaes };
[[nodiscard]] std::string_view name_of(Search search) noexcept;

struct TuneOptimizer {
  Search search = Search::sga;
  std::uint32_t generations = 100;  // after the random one
  std::uint32_t population = 24;    // individuals of an island
  std::uint32_t islands = 4;        // independent instances
  std::uint64_t seed = 1;
  double crossover_probability = 0.9;  // sga, nsga2
  double mutation_probability = 0.0;   // sga, nsga2: per parameter
  double step = 0.3;                   // cmaes: first standard deviation, as a share of the bounds
};

// One parameter that is searched, in the parameter's own unit.
struct TuneBound {
  std::string parameter;         // key of a parameter of the algorithms
  double low = 0.0, high = 0.0;  // low < high
};

// What a point of the search space came to.
struct Merit {
  double infeasible = 0.0;    // 0: it can be run; else in (0, 1], the larger the farther from it
  double disconnected = 1.0;  // means over the trials, as in Trial
  double time = 1.0;
  double held = 0.0;
  double committed = 1.0;

  [[nodiscard]] bool operator==(const Merit&) const = default;
};

enum class Judgement : std::uint8_t { two_step, graded };
[[nodiscard]] std::string_view name_of(Judgement judgement) noexcept;

// From a point's merit to the number that is maximised, and to nsga2's two goals.
struct Fitness {
  // Not negative; what counts is their share of the sum.
  struct Weights {
    double held = 0.3, time = 0.4, disconnected = 0.2, committed = 0.1;
  };
  Judgement judgement = Judgement::two_step;
  Weights weights;  // graded

  // two_step, the paper's: 1 - disconnected, in [0, 1), if any trial was disconnected at any time; else 2 - time, in
  // [1, 2]. graded: the weighted mean of held, 1 - time, 1 - disconnected and 1 - committed, in [0, 1]. Either is below
  // 0, as far as -1, for what cannot be run.
  [[nodiscard]] double of(const Merit& merit) const noexcept;

  // What nsga2 minimises of a point that can be run, each in [0, 1]. two_step: disconnected and time. graded: the cost,
  // which is the weighted mean of 1 - held, disconnected and committed; and time.
  using Goals = std::array<double, 2>;
  [[nodiscard]] Goals goals(const Merit& merit) const noexcept;
  // The fitness follows from the goals, and is higher if one of them is lower. (With two_step, only as long as both
  // stay on one step.)
  [[nodiscard]] double of_goals(const Goals& goals) const noexcept;
  // For the columns of front.csv.
  [[nodiscard]] std::array<std::string_view, 2> goal_names() const noexcept;
};

struct TunePlan {
  std::string name;
  std::string description;
  std::vector<config::Configuration> worlds;  // at least one, all with the same algorithm and reading
  std::vector<std::uint64_t> training;        // seeds that the search sees
  std::vector<std::uint64_t> test;            // seeds that only the final comparison sees
  Fitness fitness;
  TuneOptimizer optimizer;
  std::vector<TuneBound> bounds;  // at least one, in the order of the file
  std::vector<double> initial;    // a point to start from, in the order of `bounds`; or empty

  // Evaluations of one island, the random generation included.
  [[nodiscard]] std::uint64_t evaluations() const noexcept;
  // Runs that one evaluation needs.
  [[nodiscard]] std::size_t runs() const noexcept { return worlds.size() * training.size(); }
  // Runs of the comparison at the end, at most: of the best, the default and each island's best.
  [[nodiscard]] std::uint64_t comparison_runs() const noexcept {
    return (optimizer.islands + 2ULL) * worlds.size() * (training.size() + test.size());
  }
};

struct LoadedTune {
  TunePlan plan;                          // complete only if ok()
  std::vector<config::Problem> problems;  // in the order of the file; warnings of the scenarios too
  [[nodiscard]] bool ok() const noexcept;
};
// Reads a tune file (TOML or JSON) and the scenarios it names, relative to its own place. Strict,
// all problems at once, as for scenarios; never throws for bad input.
[[nodiscard]] LoadedTune load_tune(const std::string& path, const AlgorithmList& algorithms);
// The same for text that is already in memory.
[[nodiscard]] LoadedTune parse_tune(const std::string& path, std::string_view text, const AlgorithmList& algorithms);

// Everything that decides the result, as one JSON object; and 16 hexadecimal digits that differ
// when it does. Comments and the layout of files do not count, the scenarios' content does.
[[nodiscard]] std::string tune_json(const TunePlan& plan);
[[nodiscard]] std::string tune_digest(const TunePlan& plan);

// ------------------------------------------------------------------------------------ fitness --

// One run, as fitness sees it.
struct Trial {
  bool complete = false;
  double disconnected = 0.0;       // share of its ticks, in [0, 1]: a tree edge broken, or the
                                   // radio graph in several pieces, whichever was more often
  double normalized_time = 1.0;    // completion time / limit, in [0, 1]; 1 if not complete
  double completion_time_s = 0.0;  // if complete
  double held = 0.0;               // share of the targets that are held at the end, in [0, 1]
  double committed = 1.0;          // share of the robots that are committed at the end, in [0, 1]
};
// From a row of the table of runs; nothing if it is no such row.
[[nodiscard]] std::optional<Trial> trial_of(std::string_view run_csv_row);

// Of at least one trial.
[[nodiscard]] Merit merit_of(std::span<const Trial> trials) noexcept;

// How far parameters are from being accepted in all the plan's worlds: 0 if they are. `point` is in
// the order of the plan's bounds, in the parameters' own units.
[[nodiscard]] double infeasibility(const TunePlan& plan, std::span<const double> point);

// ------------------------------------------------------------------------------------- results --

// A set of trials in numbers for people.
struct TuneScore {
  Merit merit;
  std::size_t trials = 0;
  double complete_share = 0.0;
  std::optional<double> median_time_s;  // completion time; a run never complete is later than all
                                        // others; none unless more than half are complete
  double disconnected_share = 0.0;      // of the trials, with any disconnection at all
};
[[nodiscard]] TuneScore score_of(std::span<const Trial> trials);

struct TuneCandidate {
  std::string name;           // "best", "island 2", "default"
  std::vector<double> point;  // in the order of the bounds
  TuneScore training, test;
};

struct TuneResult {
  bool interrupted = false;               // nothing below then; the next tune() goes on
  std::uint32_t resumed_at = 0;           // generations that were already there
  std::uint64_t evaluations = 0;          // of all islands, from the beginning
  std::vector<TuneCandidate> candidates;  // the best, the default, then the best of each island
  std::size_t front = 0;                  // nsga2: rows of front.csv
  std::vector<std::string> warnings;      // such as a figure that could not be drawn
};

// The tuning cannot go on: a broken checkpoint, a checkpoint of another tuning, a run that failed.
class TuneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Another process has the TuneLock.
class TuneBusy : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Keeps `directory`, which exists, for one tuning as long as it lives; a process that dies gives it
// up. Its file tune.lock goes with it. Throws TuneBusy, and record::FileError if it cannot lock.
class TuneLock {
 public:
  explicit TuneLock(const std::string& directory);
  ~TuneLock();
  TuneLock(const TuneLock&) = delete;
  TuneLock& operator=(const TuneLock&) = delete;

 private:
  std::string path_;
  int descriptor_ = -1;
};

struct TuneHooks {
  std::function<bool()> stopped;  // asked about ten times a second; true: leave soon
  // The share of what this call has to do that is done, in [0, 1], and words; as often.
  std::function<void(double share, const std::string& text)> progress;
  Drawer drawer;
};

// Whether `directory` holds the results of a tuning that came to its end.
[[nodiscard]] bool tune_finished(const std::string& directory);
// The first file of `directory` that has the name of one of tune()'s but is not known to be from a
// tuning: nothing says so, or it is itself what should and does not. Empty if there is none.
[[nodiscard]] std::string foreign_tune_output(const std::string& directory);
// Removes what tune() writes from `directory`, and nothing else. Only where foreign_tune_output()
// finds none; throws record::FileError.
void remove_tune_outputs(const std::string& directory);

// Searches, and writes into `directory` (which exists) a checkpoint and generations.csv after every
// generation, at the end best.toml, front.csv (nsga2), the figure fitness and tune.json in place of
// the checkpoint. Goes on from the checkpoint that is there. The same plan gives the same result however often it was
// stopped and whatever does the work. `workers` must do study::simulate. Throws TuneError and
// record::FileError.
[[nodiscard]] TuneResult tune(const TunePlan& plan, Workers& workers, const std::string& directory,
                              const TuneHooks& hooks = {});

}  // namespace banyan::study
