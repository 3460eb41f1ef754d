// SPDX-License-Identifier: MIT
#include "banyan/study/workers.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace banyan::study {
namespace {

std::string backwards(std::string_view task) { return {task.rbegin(), task.rend()}; }

void ignore(const std::string& /*result*/) {}

// What tasks named "gate" wait at, and how many stand there: puts tests into a known state.
class Gate {
 public:
  void pass() {
    std::unique_lock lock(mutex_);
    ++arrived_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }
  void await_arrivals(int count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this, count] { return arrived_ >= count; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int arrived_ = 0;
  bool open_ = false;
};

// Work is a plain function, so what it shares with a test is global.
Gate* gate = nullptr;              // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
std::vector<std::string> started;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

std::string gated(std::string_view task) {
  if (task == "gate") gate->pass();
  return std::string(task);
}

std::string recorded(std::string_view task) {
  started.emplace_back(task);
  return {};
}

class WorkersGated : public testing::Test {
 protected:
  void SetUp() override { gate = &own_; }
  void TearDown() override { gate = nullptr; }

 private:
  Gate own_;
};

// Of things that a Done holds: until the last Done that has it is gone.
void await_gone(const std::weak_ptr<int>& token) {
  while (!token.expired()) std::this_thread::yield();
}

TEST(Workers, EachTaskHasItsResultOnce) {
  for (const int threads : {1, 2, 5}) {
    const auto workers = thread_workers(backwards, threads);
    std::vector<std::vector<std::string>> results(2000);
    for (std::size_t i = 0; i < results.size(); ++i) {
      workers->post("task " + std::to_string(i), [&results, i](std::string r) { results[i].push_back(std::move(r)); });
    }
    workers->wait();
    for (std::size_t i = 0; i < results.size(); ++i) {
      ASSERT_EQ(results[i], std::vector{backwards("task " + std::to_string(i))});
    }
  }
}

TEST(Workers, EmptyAndLongByteStringsPassUnchanged) {
  const auto workers = thread_workers(backwards, 2);
  std::string long_one(1 << 20, '\0');
  for (std::size_t i = 0; i < long_one.size(); ++i) long_one[i] = static_cast<char>(i * 31 >> 3);
  std::string from_empty = "untouched", from_long;
  workers->post("", [&](std::string result) { from_empty = std::move(result); });
  workers->post(long_one, [&](std::string result) { from_long = std::move(result); });
  workers->wait();
  EXPECT_EQ(from_empty, "");
  EXPECT_TRUE(std::equal(long_one.rbegin(), long_one.rend(), from_long.begin(), from_long.end()));
}

TEST(Workers, TasksStartInTheOrderPosted) {
  started.clear();
  std::vector<std::string> posted;
  const auto workers = thread_workers(recorded, 1);
  for (int i = 0; i < 500; ++i) {
    posted.push_back(std::to_string(i * 7919 % 1000));
    workers->post(posted.back(), ignore);
  }
  workers->wait();
  EXPECT_EQ(started, posted);
}

TEST(Workers, HaveAtLeastOneThread) {
  EXPECT_EQ(thread_workers(backwards, 0)->size(), 1);
  EXPECT_EQ(thread_workers(backwards, -4)->size(), 1);
  EXPECT_EQ(thread_workers(backwards, 3)->size(), 3);
}

TEST_F(WorkersGated, AsManyTasksAsThreadsRunAtOnce) {
  const auto workers = thread_workers(gated, 3);
  for (int i = 0; i < 3; ++i) workers->post("gate", ignore);
  gate->await_arrivals(3);  // would never end with fewer
  gate->open();
  workers->wait();
}

TEST(Workers, WaitReturnsAtOnceWithoutTasks) {
  const auto workers = thread_workers(backwards, 2);
  workers->wait();
  workers->cancel();
  workers->wait();
}

TEST(Workers, DoneMayPostAndWaitSeesIt) {
  const auto workers = thread_workers(backwards, 3);
  std::atomic<int> delivered = 0;
  std::function<void(int)> grow = [&](int depth) {
    workers->post("x", [&, depth](const std::string&) {
      ++delivered;
      for (int branch = 0; branch < 2 && depth > 0; ++branch) grow(depth - 1);
    });
  };
  grow(10);
  workers->wait();
  EXPECT_EQ(delivered, (1 << 11) - 1);
}

TEST(Workers, AnyThreadMayPost) {
  const auto workers = thread_workers(backwards, 2);
  std::vector<std::atomic<int>> times(1200);
  {
    std::vector<std::jthread> posters;
    for (std::size_t p = 0; p < 4; ++p) {
      posters.emplace_back([&, p] {
        for (std::size_t i = 0; i < 300; ++i)
          workers->post("x", [&, p, i](const std::string&) { ++times[300 * p + i]; });
      });
    }
  }
  workers->wait();
  EXPECT_TRUE(std::ranges::all_of(times, [](const auto& n) { return n == 1; }));
}

TEST(Workers, WhatDonesHoldIsGoneAfterWait) {
  const auto workers = thread_workers(backwards, 2);
  std::atomic<bool> gone = false;
  // Slow to go, so that a wait() that returns too early has no luck; a right one needs none.
  std::shared_ptr<void> held(nullptr, [&](void*) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    gone = true;
  });
  workers->post("x", [held = std::move(held)](const std::string&) {});
  workers->wait();
  EXPECT_TRUE(gone);
}

TEST_F(WorkersGated, AnExceptionOfDoneCancelsAndEndsInWaitOnce) {
  const auto workers = thread_workers(gated, 1);
  std::atomic<int> delivered = 0;
  workers->post("gate", [](const std::string&) { throw std::runtime_error("disk full"); });
  for (int i = 0; i < 10; ++i) workers->post("x", [&](const std::string&) { ++delivered; });
  gate->open();
  try {
    workers->wait();
    ADD_FAILURE() << "no exception";
  } catch (const std::runtime_error& error) { EXPECT_STREQ(error.what(), "disk full"); }
  EXPECT_EQ(delivered, 0);
  EXPECT_NO_THROW(workers->wait());
  workers->post("x", [&](const std::string&) { ++delivered; });
  EXPECT_NO_THROW(workers->wait());
  EXPECT_EQ(delivered, 1);
}

TEST_F(WorkersGated, TheFirstExceptionWinsAndOthersThatRunAreDelivered) {
  const auto workers = thread_workers(gated, 2);
  std::atomic<int> delivered = 0;
  workers->post("gate", [&](const std::string&) {
    ++delivered;
    throw std::runtime_error("second");
  });
  gate->await_arrivals(1);
  auto first = std::make_shared<int>(0);
  const std::weak_ptr<int> gone = first;
  workers->post("x", [held = std::move(first)](const std::string&) { throw std::runtime_error("first"); });
  await_gone(gone);
  gate->open();
  try {
    workers->wait();
    ADD_FAILURE() << "no exception";
  } catch (const std::runtime_error& error) { EXPECT_STREQ(error.what(), "first"); }
  EXPECT_EQ(delivered, 1);
  EXPECT_NO_THROW(workers->wait());
}

TEST(Workers, WhatIsPostedBetweenExceptionAndWaitIsDropped) {
  const auto workers = thread_workers(backwards, 1);
  auto token = std::make_shared<int>(0);
  const std::weak_ptr<int> gone = token;
  workers->post("x", [held = std::move(token)](const std::string&) { throw std::runtime_error("disk full"); });
  await_gone(gone);
  std::atomic<int> delivered = 0;
  workers->post("x", [&](const std::string&) { ++delivered; });
  EXPECT_THROW(workers->wait(), std::runtime_error);
  EXPECT_EQ(delivered, 0);
}

TEST(Workers, AnEmptyDoneIsAnExceptionOfDone) {
  const auto workers = thread_workers(backwards, 1);
  workers->post("x", nullptr);
  EXPECT_THROW(workers->wait(), std::bad_function_call);
}

TEST_F(WorkersGated, CancelDropsWhatHasNotStartedAndDeliversWhatRuns) {
  const auto workers = thread_workers(gated, 2);
  std::atomic<int> running = 0, queued = 0;
  for (int i = 0; i < 2; ++i) workers->post("gate", [&](const std::string&) { ++running; });
  const auto token = std::make_shared<int>(0);
  for (int i = 0; i < 100; ++i) workers->post("x", [&, token](const std::string&) { ++queued; });
  gate->await_arrivals(2);
  workers->cancel();
  EXPECT_EQ(token.use_count(), 1);
  gate->open();
  workers->wait();
  EXPECT_EQ(running, 2);
  EXPECT_EQ(queued, 0);
  workers->post("x", [&](const std::string&) { ++queued; });
  workers->wait();
  EXPECT_EQ(queued, 1);
}

TEST_F(WorkersGated, CancelFromDoneLetsNothingMoreStart) {
  const auto workers = thread_workers(gated, 1);
  int delivered = 0;
  workers->post("gate", [&](const std::string&) {
    ++delivered;
    workers->cancel();
  });
  for (int i = 0; i < 100; ++i) workers->post("x", [&](const std::string&) { ++delivered; });
  gate->open();
  workers->wait();
  EXPECT_EQ(delivered, 1);
}

TEST_F(WorkersGated, DestructionDropsTheQueueAndWaitsForWhatRuns) {
  std::atomic<int> running = 0, queued = 0;
  auto token = std::make_shared<int>(0);
  const std::weak_ptr<int> gone = token;
  auto workers = thread_workers(gated, 1);
  workers->post("gate", [&](const std::string&) {
    ++running;
    // A Done may still post, into nothing.
    workers->post("x", [&](const std::string&) { ++queued; });
  });
  workers->post("x", [&, held = std::move(token)](const std::string&) { ++queued; });
  gate->await_arrivals(1);
  const std::jthread opener([&] {
    await_gone(gone);
    gate->open();
  });
  workers.get_deleter()(workers.get());  // the pointer stays, for the Done
  [[maybe_unused]] const auto* destroyed = workers.release();
  EXPECT_EQ(running, 1);
  EXPECT_EQ(queued, 0);
}

TEST(Workers, AnExceptionNobodyWaitsForIsLostInDestruction) {
  auto token = std::make_shared<int>(0);
  const std::weak_ptr<int> gone = token;
  auto workers = thread_workers(backwards, 1);
  workers->post("x", [held = std::move(token)](const std::string&) { throw std::runtime_error("disk full"); });
  await_gone(gone);
  EXPECT_NO_THROW(workers.reset());
}

// What mpirun says to the processes that it starts; the tests themselves may run under it.
void forget_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"}) ::unsetenv(name);
}

TEST(Processes, WithoutALauncherThereIsOne) {
  forget_launcher();
  Processes processes;
  EXPECT_EQ(processes.rank(), 0);
  EXPECT_EQ(processes.size(), 1);
  EXPECT_THROW(processes.serve(backwards, 1), std::logic_error);
  const auto workers = processes.workers(backwards, 2);
  EXPECT_EQ(workers->size(), 2);
  std::string got;
  workers->post("abc", [&](std::string result) { got = std::move(result); });
  workers->wait();
  EXPECT_EQ(got, "cba");
}

TEST(Processes, SeveralWithoutMpiAreRefused) {
  if (Processes::supported()) GTEST_SKIP() << "this build has MPI";
  forget_launcher();
  ::setenv("OMPI_COMM_WORLD_SIZE", "1", 1);
  EXPECT_EQ(Processes().size(), 1);
  ::setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
  EXPECT_THROW(Processes(), std::runtime_error);
  forget_launcher();
}

struct Ended {
  int status = -1;
  std::string output;
};

Ended run(const std::string& command) {
  Ended outcome;
  std::FILE* pipe = ::popen((command + " </dev/null").c_str(), "r");  // NOLINT(cert-env33-c): our own command
  if (pipe == nullptr) return outcome;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) outcome.output += static_cast<char>(c);
  const int status = ::pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

// Open MPI's own memory is no leak of ours. The other settings let it run as root, with more
// processes than cores, over shared memory alone (half a second's search for networks less) and
// without asking for debugging rights. By the last one the status of mpirun says whether all
// processes ended by themselves; otherwise it would kill the others as soon as one reports failure.
Ended mpirun(int processes, const std::string& what) {
  return run(
      "env ASAN_OPTIONS=detect_leaks=0 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
      "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl=self,vader OMPI_MCA_pml=ob1 "
      "OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_orte_abort_on_non_zero_status=0 "
      "timeout 60 '" BANYAN_MPIRUN "' -n " +
      std::to_string(processes) + " '" BANYAN_PROCESSES_PROGRAM "' '" + what + "'");
}

class ProcessesStarted : public testing::Test {
 protected:
  void SetUp() override {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "Open MPI is not built with the thread sanitizer, which would see races in it";
#endif
    if (!Processes::supported()) GTEST_SKIP() << "this build has no MPI";
    forget_launcher();
  }
};

TEST_F(ProcessesStarted, AnyNumberOfThemDoesWhatThreadsDo) {
  const Ended alone = run("'" BANYAN_PROCESSES_PROGRAM "' all");
  EXPECT_EQ(alone.status, 0) << alone.output;
  for (const int processes : {1, 2, 3}) {
    const Ended together = mpirun(processes, "all");
    EXPECT_EQ(together.status, 0) << processes << " processes";
    EXPECT_EQ(together.output, alone.output) << processes << " processes";
  }
}

TEST_F(ProcessesStarted, TheFirstMayThrowBeforeItHasWorkers) {
  const Ended outcome = mpirun(3, "throw at once");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.output, "first process throws\n");
}

TEST_F(ProcessesStarted, TheFirstMayThrowWithTasksUnderWay) {
  const Ended outcome = mpirun(3, "throw at work");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.output, "first process throws\n");
}

TEST_F(ProcessesStarted, OneThatDoesNotServeIsDoneWithout) {
  const Ended outcome = mpirun(3, "desert");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.output, "every process\n");
}

}  // namespace
}  // namespace banyan::study
