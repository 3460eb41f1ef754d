// SPDX-License-Identifier: MIT
// Every run is done once and written down, whoever stops it, whatever fails.
#include "banyan/study/execute.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <thread>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/record/file.hpp"
#include "temporary_folder.hpp"

namespace banyan::study {
namespace {

// Work is a plain function: what it has seen is kept here.
struct Seen {
  std::mutex mutex;
  std::map<std::string, int, std::less<>> tasks;
};
Seen& seen() {
  static Seen all;
  return all;
}

std::string noted(std::string_view task, const Outcome& outcome) {
  auto& all = seen();
  const std::lock_guard lock(all.mutex);
  ++all.tasks[std::string(task)];
  return encode(outcome);
}
std::string good(std::string_view task) { return noted(task, {"row", "", 0.25}); }
std::string bad(std::string_view task) { return noted(task, {"", "it failed", 0.25}); }
std::string garbage(std::string_view) { return "not an outcome"; }
std::string slow(std::string_view task) {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return good(task);
}

Plan plan_of(std::size_t runs) {
  Plan plan;
  plan.combinations.emplace_back();
  plan.combinations.back().scenario = world::plain_scenario(algorithms());
  plan.combinations.back().output["record"] = false;
  for (std::size_t i = 0; i < runs; ++i)
    plan.runs.push_back({"id" + std::to_string(i), 0, i, "all/seed=" + std::to_string(i), 1.0});
  return plan;
}

std::vector<std::size_t> all_of(const Plan& plan) {
  std::vector<std::size_t> todo(plan.runs.size());
  std::iota(todo.begin(), todo.end(), 0);
  return todo;
}

bool go_on(const Standing&) { return true; }

class ExecuteTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    seen().tasks.clear();
  }
  Standing execute_with(Work work, const Plan& plan, const std::vector<std::size_t>& todo, int threads = 3,
                        const Watch& watch = go_on) {
    Journal journal(path("j"), "s", "v", "g");
    const auto workers = thread_workers(work, threads);
    return execute(plan, todo, *workers, journal, path("runs"), watch);
  }
  [[nodiscard]] std::vector<std::string> journaled() const {
    std::vector<std::string> ids;
    for (const auto& entry : read_journal(path("j")).entries) ids.push_back(entry.id);
    return ids;
  }
  void expect_each_once(const Plan& plan) const {
    auto ids = journaled();
    std::sort(ids.begin(), ids.end());
    std::vector<std::string> wanted;
    for (const auto& run : plan.runs) wanted.push_back(run.id);
    std::sort(wanted.begin(), wanted.end());
    EXPECT_EQ(ids, wanted);
    EXPECT_EQ(seen().tasks.size(), plan.runs.size());
    for (const auto& [task, times] : seen().tasks) EXPECT_EQ(times, 1);
  }
};

TEST_F(ExecuteTest, DoesEachRunOnce) {
  const auto plan = plan_of(500);
  const auto standing = execute_with(good, plan, all_of(plan));
  EXPECT_EQ(standing.wanted, 500U);
  EXPECT_EQ(standing.done, 500U);
  EXPECT_EQ(standing.failed, 0U);
  EXPECT_FALSE(standing.stopped);
  EXPECT_EQ(standing.share, 1.0);
  expect_each_once(plan);
}

TEST_F(ExecuteTest, NothingToDoIsDone) {
  const auto standing = execute_with(good, plan_of(3), {});
  EXPECT_EQ(standing.done, 0U);
  EXPECT_FALSE(standing.stopped);
  EXPECT_TRUE(journaled().empty());
}

TEST_F(ExecuteTest, DoesOnlyWhatItIsTold) {
  const auto plan = plan_of(10);
  execute_with(good, plan, {7, 2, 4}, 1);
  EXPECT_EQ(journaled(), (std::vector<std::string>{"id7", "id2", "id4"}));
}

TEST_F(ExecuteTest, BeginsWithTheLongest) {
  auto plan = plan_of(5);
  for (std::size_t i = 0; i < 5; ++i) plan.runs[i].cost = i == 3 ? 9.0 : 1.0 + static_cast<double>(i % 2);
  execute_with(good, plan, all_of(plan), 1);
  EXPECT_EQ(journaled(), (std::vector<std::string>{"id3", "id1", "id0", "id2", "id4"}));
}

TEST_F(ExecuteTest, StopsWhenToldAndGoesOnFromThere) {
  const auto plan = plan_of(2000);
  const auto stopped = execute_with(slow, plan, all_of(plan), 2, [](const Standing& now) { return now.done == 0; });
  EXPECT_TRUE(stopped.stopped);
  EXPECT_GT(stopped.done, 0U);
  ASSERT_LT(stopped.done, 2000U);
  EXPECT_LT(stopped.share, 1.0);
  const auto done = journaled();
  EXPECT_EQ(done.size(), stopped.done);
  EXPECT_EQ(seen().tasks.size(), stopped.done) << "what was begun is finished and written down";

  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < 2000; ++i)
    if (std::find(done.begin(), done.end(), plan.runs[i].id) == done.end()) left.push_back(i);
  const auto rest = execute_with(good, plan, left);
  EXPECT_FALSE(rest.stopped);
  expect_each_once(plan);
}

TEST_F(ExecuteTest, CountsWhatFails) {
  const auto plan = plan_of(40);
  const auto standing = execute_with(bad, plan, all_of(plan));
  EXPECT_EQ(standing.done, 40U);
  EXPECT_EQ(standing.failed, 40U);
  EXPECT_FALSE(standing.stopped);
  for (const auto& entry : read_journal(path("j")).entries) EXPECT_EQ(entry.outcome.error, "it failed");
}

TEST_F(ExecuteTest, AWorkerThatTalksNonsenseIsAFailedRun) {
  const auto plan = plan_of(4);
  EXPECT_EQ(execute_with(garbage, plan, all_of(plan)).failed, 4U);
  EXPECT_EQ(read_journal(path("j")).entries.at(0).outcome.error, "a worker sent what is no outcome");
}

TEST_F(ExecuteTest, AJournalThatCannotBeWrittenEndsIt) {
  const auto plan = plan_of(300);
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{5000, 5000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      execute_with(good, plan, all_of(plan));
    } catch (const record::FileError& e) { ::_exit(e.error_number() == EFBIG ? 0 : 2); }
    ::_exit(1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  auto done = journaled();
  EXPECT_GT(done.size(), 10U);
  EXPECT_LT(done.size(), 100U);

  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < 300; ++i)
    if (std::find(done.begin(), done.end(), plan.runs[i].id) == done.end()) left.push_back(i);
  execute_with(good, plan, left);
  done = journaled();
  std::sort(done.begin(), done.end());
  EXPECT_EQ(done.size(), 300U);
  EXPECT_EQ(std::unique(done.begin(), done.end()), done.end());
}

TEST_F(ExecuteTest, OnlyRunsThatKeepFilesGetAFolder) {
  auto plan = plan_of(2);
  plan.combinations.push_back(plan.combinations[0]);
  plan.combinations[1].output["record"] = true;
  plan.runs[1].combination = 1;
  execute_with(good, plan, all_of(plan), 1);
  for (const auto& [task, times] : seen().tasks) {
    const bool keeps = task.find(path("runs") + "/all/seed=1") != std::string::npos;
    EXPECT_EQ(keeps, task.find("\"record\":true") != std::string::npos);
    EXPECT_EQ(task.find(path("runs")) != std::string::npos, keeps);
  }
}

TEST_F(ExecuteTest, EstimatesFromRealRuns) {
  auto plan = plan_of(100);
  auto& scenario = plan.combinations[0].scenario;
  scenario.swarm.robots = 6;
  scenario.mission.time_limit_s = 2.0;
  EXPECT_EQ(estimate_s(plan, {}, 1.0), 0.0);
  const double estimate = estimate_s(plan, all_of(plan), 0.001);
  EXPECT_GT(estimate, 0.0);
  EXPECT_TRUE(std::isfinite(estimate));
  EXPECT_TRUE(seen().tasks.empty());
}

}  // namespace
}  // namespace banyan::study
