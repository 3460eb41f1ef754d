// SPDX-License-Identifier: MIT
#include "banyan/study/execute.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace banyan::study {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t queued_per_worker = 4;  // enough to keep all workers busy, few enough to save memory

std::string task_of(const Plan& plan, const PlannedRun& run, const std::string& runs_folder) {
  const auto configuration = configuration_of(plan, run);
  return encode(
      RunTask{config::config_json(configuration), keeps_files(configuration) ? runs_folder + "/" + run.directory : ""});
}

class Execution {
 public:
  Execution(const Plan& plan, std::vector<std::size_t> todo, Workers& workers, Journal& journal,
            std::string runs_folder)
      : plan_(plan),
        todo_(std::move(todo)),
        workers_(workers),
        journal_(journal),
        runs_folder_(std::move(runs_folder)) {
    standing_.wanted = todo_.size();
    for (const auto run : todo_) work_ += plan_.runs[run].cost;
  }

  Execution(const Execution&) = delete;
  Execution& operator=(const Execution&) = delete;
  // Running tasks refer to this object: an exception of run() must not leave them behind.
  ~Execution() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    workers_.cancel();
    try {
      workers_.wait();
    } catch (...) {  // NOLINT(bugprone-empty-catch): a second failure; the first is on its way
    }
  }

  Standing run(const Watch& watch) {
    {
      const std::lock_guard lock(mutex_);
      for (std::size_t i = 0; i < workers_.size() * queued_per_worker; ++i) post_next();
    }
    std::unique_lock lock(mutex_);
    while (in_flight_ > 0 && !broken_) {
      changed_.wait_for(lock, 100ms);
      const Standing now = standing_;
      if (stopping_) continue;
      lock.unlock();
      const bool go_on = watch(now);
      if (!go_on) stop();
      lock.lock();
    }
    lock.unlock();
    workers_.wait();  // an exception of deliver() ends here
    journal_.sync();
    standing_.stopped = standing_.done < standing_.wanted;
    if (standing_.wanted > 0 && !stopping_) watch(standing_);  // short runs may all be over before the first call
    return standing_;
  }

 private:
  // With the lock held. Nothing more is posted once it stops.
  void post_next() {
    if (next_ == todo_.size() || stopping_) return;
    const std::size_t run = todo_[next_++];
    ++in_flight_;
    workers_.post(task_of(plan_, plan_.runs[run], runs_folder_),
                  [this, run](const std::string& result) { deliver(run, result); });
  }

  // On a thread of the workers.
  void deliver(std::size_t run, const std::string& result) {
    const std::lock_guard lock(mutex_);
    --in_flight_;
    try {
      note(run, decode_outcome(result));
      post_next();
    } catch (...) {  // ends in wait()
      broken_ = stopping_ = true;
      changed_.notify_all();
      throw;
    }
    if (in_flight_ == 0) changed_.notify_all();
  }

  void note(std::size_t run, const Outcome& outcome) {
    journal_.append({plan_.runs[run].id, outcome});
    ++standing_.done;
    if (!outcome.error.empty()) ++standing_.failed;
    done_work_ += plan_.runs[run].cost;
    standing_.share = work_ > 0.0 ? std::min(1.0, done_work_ / work_) : 1.0;
  }

  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    workers_.cancel();
    workers_.wait();
    const std::lock_guard lock(mutex_);
    in_flight_ = 0;  // what was cancelled is never delivered
  }

  const Plan& plan_;
  std::vector<std::size_t> todo_;
  Workers& workers_;
  Journal& journal_;
  std::string runs_folder_;

  std::mutex mutex_;  // all that follows
  std::condition_variable changed_;
  std::size_t next_ = 0;
  std::size_t in_flight_ = 0;
  double work_ = 0.0, done_work_ = 0.0;
  Standing standing_{.share = 0.0};
  bool stopping_ = false;
  bool broken_ = false;
};

}  // namespace

Standing execute(const Plan& plan, const std::vector<std::size_t>& todo, Workers& workers, Journal& journal,
                 const std::string& runs_folder, const Watch& watch) {
  auto order = todo;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return plan.runs[a].cost > plan.runs[b].cost; });
  return Execution(plan, std::move(order), workers, journal, runs_folder).run(watch);
}

double estimate_s(const Plan& plan, const std::vector<std::size_t>& todo, double patience_s) {
  if (todo.empty()) return 0.0;
  double work = 0.0, sampled_work = 0.0, sampled_s = 0.0;
  for (const auto run : todo) work += plan.runs[run].cost;
  // Steps of the golden section cover the plan evenly, however soon they end.
  double at = 0.0;
  for (std::size_t n = 0; n < std::min<std::size_t>(todo.size(), 64) && sampled_s < patience_s; ++n) {
    const auto& run = plan.runs[todo[static_cast<std::size_t>(at * static_cast<double>(todo.size()))]];
    auto configuration = configuration_of(plan, run);
    sampled_s += decode_outcome(simulate(encode(RunTask{config::config_json(configuration), ""}),
                                         *configuration.scenario.algorithms))
                     .wall_s;
    sampled_work += run.cost;
    at += 0.6180339887498949;
    if (at >= 1.0) at -= 1.0;
  }
  return sampled_work > 0.0 ? sampled_s / sampled_work * work : 0.0;
}

}  // namespace banyan::study
