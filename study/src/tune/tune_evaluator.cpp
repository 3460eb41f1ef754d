// SPDX-License-Identifier: MIT
#include "tune_evaluator.hpp"

#include <chrono>
#include <condition_variable>

#include "banyan/study/simulate.hpp"
#include "tune_point.hpp"

namespace banyan::study {

using namespace std::chrono_literals;

// The work under way for one caller. The workers share it: their last results may come after the
// caller has given up.
struct Evaluator::Batch {
  std::mutex mutex;
  std::condition_variable news;
  std::vector<Trial> trials;
  std::size_t missing = 0;
  std::string error;

  void deliver(std::size_t index, const std::string& result) {
    const auto outcome = decode_outcome(result);
    const auto trial = outcome.error.empty() ? trial_of(outcome.row) : std::nullopt;
    const std::lock_guard lock(mutex);
    if (trial) trials[index] = *trial;
    else if (error.empty()) error = outcome.error.empty() ? "a worker sent a row that cannot be read" : outcome.error;
    --missing;
    news.notify_all();
  }
};

std::vector<Trial> Evaluator::run(std::vector<std::string> tasks) {
  if (stopped_) throw Stopped();
  const auto batch = std::make_shared<Batch>();
  batch->trials.resize(tasks.size());
  batch->missing = tasks.size();
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    workers_.post(std::move(tasks[i]), [this, batch, i](const std::string& result) {
      ++runs_;
      batch->deliver(i, result);
    });
  }
  std::unique_lock lock(batch->mutex);
  // A cancelled task is never delivered, so a stop has to be looked for.
  while (!batch->news.wait_for(lock, 50ms, [&] { return batch->missing == 0; })) {
    if (stopped_) throw Stopped();
  }
  if (!batch->error.empty()) throw TuneError("a run failed: " + batch->error);
  return std::move(batch->trials);
}

std::vector<std::vector<Trial>> Evaluator::trials(const std::vector<std::optional<std::vector<double>>>& points,
                                                  const std::vector<std::uint64_t>& seeds) {
  std::vector<std::string> tasks;
  for (const auto& point : points) {
    for (const auto& world : plan_.worlds) {
      config::Configuration configuration = world;
      if (point) configuration.scenario = with_parameters(world.scenario, plan_.bounds, *point);
      for (const auto seed : seeds) {
        configuration.scenario.seed = seed;
        tasks.push_back(encode(RunTask{config::config_json(configuration), ""}));
      }
    }
  }
  const auto all = run(std::move(tasks));
  const auto each = static_cast<std::ptrdiff_t>(plan_.worlds.size() * seeds.size());
  std::vector<std::vector<Trial>> grouped;
  for (auto first = all.begin(); first != all.end(); first += each) grouped.emplace_back(first, first + each);
  return grouped;
}

std::vector<Merit> Evaluator::merits(const std::vector<std::vector<double>>& points) {
  std::map<std::vector<double>, Merit> found;
  std::vector<std::optional<std::vector<double>>> unknown;
  for (const auto& point : points) {
    if (found.contains(point)) continue;
    const std::lock_guard lock(known_mutex_);
    if (const auto known = known_.find(point); known != known_.end()) {
      found[point] = known->second;
    } else if (const double distance = infeasibility(plan_, point); distance > 0.0) {
      found[point] = Merit{distance};
    } else {
      found[point] = {};
      unknown.emplace_back(point);
    }
  }
  if (!unknown.empty()) {
    const auto results = trials(unknown, plan_.training);
    const std::lock_guard lock(known_mutex_);
    for (std::size_t i = 0; i < unknown.size(); ++i) known_[*unknown[i]] = found[*unknown[i]] = merit_of(results[i]);
  }
  if (stopped_) throw Stopped();
  evaluations_ += points.size();
  std::vector<Merit> merits;
  merits.reserve(points.size());
  for (const auto& point : points) merits.push_back(found[point]);
  return merits;
}

}  // namespace banyan::study
