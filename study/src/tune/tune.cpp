// SPDX-License-Identifier: MIT
// The course of a tuning: islands in step, generation by generation, a checkpoint after each.
#include "banyan/study/tune.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "banyan/record/file.hpp"
#include "tune_checkpoint.hpp"
#include "tune_evaluator.hpp"
#include "tune_island.hpp"
#include "tune_outputs.hpp"
#include "tune_point.hpp"

namespace banyan::study {
namespace {

using namespace std::chrono_literals;
using Job = std::function<void()>;

class TuningRun {
 public:
  TuningRun(const TunePlan& plan, Workers& workers, const std::string& directory, const TuneHooks& hooks)
      : plan_(plan), evaluator_(plan, workers), directory_(directory), hooks_(hooks) {
    for (std::size_t i = 0; i < plan.optimizer.islands; ++i) islands_.emplace_back(plan, evaluator_, i);
  }

  // Throws Stopped.
  TuneResult run() {
    TuneResult result;
    if (auto saved = load_checkpoint(checkpoint_path(directory_), plan_)) {
      restore(std::move(*saved));
      result.resumed_at = generation_;
    } else {
      all_islands(&Island::populate);
      keep();
    }
    while (generation_ < plan_.optimizer.generations) {
      all_islands(&Island::evolve);
      ++generation_;
      keep();
    }
    conclude(result);
    return result;
  }

 private:
  // Runs all jobs at once, each on a thread of its own (they mostly wait for the workers), while
  // this thread looks after the hooks. The first failure makes the others stop.
  void attend(const std::vector<Job>& jobs) {
    std::mutex mutex;
    std::condition_variable news;
    std::size_t left = jobs.size();
    std::exception_ptr failure;
    std::vector<std::jthread> threads;
    threads.reserve(jobs.size());
    for (const auto& job : jobs) {
      threads.emplace_back([&] {
        std::exception_ptr mine;
        try {
          job();
        } catch (...) { mine = std::current_exception(); }
        const std::lock_guard lock(mutex);
        if (mine && !failure) {
          failure = mine;
          evaluator_.stop();
        }
        --left;
        news.notify_all();
      });
    }
    for (std::unique_lock lock(mutex); !news.wait_for(lock, 100ms, [&] { return left == 0; });) {
      lock.unlock();
      call_hooks();
      lock.lock();
    }
    threads.clear();
    if (failure) std::rethrow_exception(failure);
    call_hooks();
  }
  void all_islands(void (Island::*step)()) {
    std::vector<Job> jobs;
    for (auto& island : islands_) jobs.emplace_back([&island, step] { (island.*step)(); });
    attend(jobs);
  }
  void call_hooks() {
    if (hooks_.stopped && hooks_.stopped()) evaluator_.stop();
    if (!hooks_.progress) return;
    double best = -1.0;
    for (const auto& row : history_) best = std::max(best, row.best);
    std::string text = "generation " + std::to_string(history_.empty() ? 0 : generation_ + 1) + " of " +
                       std::to_string(plan_.optimizer.generations) + ", " + std::to_string(evaluator_.runs()) + " runs";
    if (generation_ == plan_.optimizer.generations) text = "comparing on the test seeds";
    if (!history_.empty()) text += ", best fitness " + std::to_string(best).substr(0, 6);
    hooks_.progress(share_done(), text);
  }
  // In runs, those of the comparison included. An evaluation counts as all its runs, whether or not
  // it needed them.
  [[nodiscard]] double share_done() const {
    const auto evaluations = plan_.evaluations() * plan_.optimizer.islands - evaluations_before_;
    const auto compared = runs_before_comparison_ ? evaluator_.runs() - *runs_before_comparison_ : 0;
    const auto done = evaluator_.evaluations() * plan_.runs() + compared;
    const auto total = evaluations * plan_.runs() + plan_.comparison_runs();
    return std::min(static_cast<double>(done) / static_cast<double>(total), 1.0);
  }

  void restore(Checkpoint saved) {
    for (std::size_t i = 0; i < islands_.size(); ++i) islands_[i].restore(saved.islands[i]);
    generation_ = saved.generation;
    history_ = std::move(saved.history);
    evaluations_before_ = plan_.optimizer.population * (generation_ + 1ULL) * plan_.optimizer.islands;
    write_generations(directory_, plan_, history_);  // may be a generation behind
  }

  // The row of an island's present generation.
  [[nodiscard]] GenerationRow row_of(std::size_t i) const {
    const auto fitness = islands_[i].fitness();
    const auto best = std::max_element(fitness.begin(), fitness.end());
    GenerationRow row;
    row.island = static_cast<std::uint32_t>(i);
    row.generation = generation_;
    row.best = *best;
    row.best_point = islands_[i].points()[static_cast<std::size_t>(best - fitness.begin())];
    row.mean = std::accumulate(fitness.begin(), fitness.end(), 0.0) / static_cast<double>(fitness.size());
    row.worst = *std::min_element(fitness.begin(), fitness.end());
    if (generation_ == 0) return row;
    // A population may lose its best (cmaes does not keep it).
    const auto& before = history_[history_.size() - islands_.size()];  // rows of this generation are being added
    if (before.best >= row.best) {
      row.best = before.best;
      row.best_point = before.best_point;
    }
    return row;
  }
  void keep() {
    for (std::size_t i = 0; i < islands_.size(); ++i) history_.push_back(row_of(i));
    Checkpoint checkpoint{generation_, states(), history_};
    save_checkpoint(checkpoint_path(directory_), plan_, checkpoint);
    write_generations(directory_, plan_, history_);
  }
  [[nodiscard]] std::vector<IslandState> states() const {
    std::vector<IslandState> list;
    for (const auto& island : islands_) list.push_back(island.state());
    return list;
  }

  // ------------------------------------------------------------------------------------- the end --

  void conclude(TuneResult& result) {
    const auto last = history_.end() - static_cast<std::ptrdiff_t>(islands_.size());
    // The first of equals, so that it is always the same.
    const auto best =
        std::max_element(last, history_.end(), [](const auto& a, const auto& b) { return a.best < b.best; });
    if (best->best < 0.0)
      throw TuneError("nothing was found that can be run: no point kept 0 < A < E < S < delta < C. Change [bounds]");
    result.candidates.push_back({"best", best->best_point, {}, {}});
    result.candidates.push_back({"default", untuned_point(plan_), {}, {}});
    for (auto row = last; row != history_.end(); ++row)
      result.candidates.push_back({"island " + std::to_string(row->island), row->best_point, {}, {}});
    runs_before_comparison_ = evaluator_.runs();
    std::vector<FrontPoint> front;
    attend({[&] {
      compare(result.candidates);
      front = judged_front();
    }});
    result.evaluations = plan_.evaluations() * plan_.optimizer.islands;
    write_results(directory_, plan_, history_, front, hooks_.drawer, result);
  }
  // With what its goals are made of: known from the search, but for what was evaluated before it was resumed.
  [[nodiscard]] std::vector<FrontPoint> judged_front() {
    if (plan_.optimizer.search != Search::nsga2) return {};
    auto front = front_of(plan_, states());
    std::vector<std::vector<double>> points(front.size());
    for (std::size_t i = 0; i < front.size(); ++i) points[i] = front[i].point;
    const auto merits = evaluator_.merits(points);
    for (std::size_t i = 0; i < front.size(); ++i) front[i].merit = merits[i];
    return front;
  }
  void compare(std::vector<TuneCandidate>& candidates) {
    std::vector<std::optional<std::vector<double>>> points;
    std::vector<TuneCandidate*> scored;
    for (auto& candidate : candidates) {
      const bool as_it_is = candidate.name == "default";
      if (const double distance = as_it_is ? 0.0 : infeasibility(plan_, candidate.point); distance > 0.0) {
        candidate.training.merit = candidate.test.merit = Merit{distance};
        continue;
      }
      points.push_back(as_it_is ? std::nullopt : std::optional(candidate.point));
      scored.push_back(&candidate);
    }
    const auto training = evaluator_.trials(points, plan_.training);
    const auto test = evaluator_.trials(points, plan_.test);
    for (std::size_t i = 0; i < scored.size(); ++i) {
      scored[i]->training = score_of(training[i]);
      scored[i]->test = score_of(test[i]);
    }
  }

  const TunePlan& plan_;
  Evaluator evaluator_;
  const std::string& directory_;
  const TuneHooks& hooks_;
  std::vector<Island> islands_;
  std::vector<GenerationRow> history_;
  std::uint32_t generation_ = 0;
  std::uint64_t evaluations_before_ = 0;
  std::optional<std::uint64_t> runs_before_comparison_;  // once it has begun
};

}  // namespace

TuneResult tune(const TunePlan& plan, Workers& workers, const std::string& directory, const TuneHooks& hooks) {
  TuningRun course(plan, workers, directory, hooks);
  try {
    return course.run();
  } catch (const Stopped&) {
    workers.cancel();
    workers.wait();  // what still runs reports to the course
    TuneResult result;
    result.interrupted = true;
    return result;
  } catch (...) {
    workers.cancel();
    workers.wait();
    throw;
  }
}

}  // namespace banyan::study
