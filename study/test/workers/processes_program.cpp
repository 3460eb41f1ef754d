// SPDX-License-Identifier: MIT
// Started by workers_test.cpp, alone and by mpirun: says the same for any number of processes.
#include <signal.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <iostream>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "banyan/study/workers.hpp"

namespace {

using banyan::study::Processes;
using banyan::study::Workers;

int own_rank = 0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): Work is a plain function

// "who": the process. "stop": the same after what Ctrl-C does, in a process that shall not mind.
// Anything else comes back the other way round.
std::string work(std::string_view task) {
  if (task == "stop" && own_rank != 0) {
    ::raise(SIGINT);
    ::raise(SIGTERM);
  }
  if (task == "who" || task == "stop") return std::to_string(own_rank);
  return {task.rbegin(), task.rend()};
}

void check(bool right, const char* what) {
  if (!right) throw std::runtime_error(what);
}

std::string text_of(std::size_t length) {
  std::string text(length, '\0');
  std::uint32_t state = static_cast<std::uint32_t>(length) + 1;
  for (char& c : text) c = static_cast<char>((state = state * 1664525U + 1013904223U) >> 24);
  return text;
}

// Around the length at which messages are cut, and many short ones.
void all_lengths(Workers& workers) {
  std::vector<std::size_t> lengths{1048575, 1048576, 1048577, 2097152, 3333333};
  for (std::size_t i = 0; i < 200; ++i) lengths.push_back(i);
  std::mutex mutex;
  std::vector<int> times(lengths.size(), 0);
  bool right = true;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    workers.post(text_of(lengths[i]), [&, i](const std::string& result) {
      std::string expected = text_of(lengths[i]);
      std::ranges::reverse(expected);
      const std::lock_guard lock(mutex);
      ++times[i];
      right = right && result == expected;
    });
  }
  workers.wait();
  check(right, "a result is not that of its task");
  check(std::ranges::count(times, 1) == std::ssize(times), "a task was done never or twice");
  std::cout << lengths.size() << " results\n";
}

// Asks until each process has answered: that every one of them gets tasks needs no luck.
class RollCall {
 public:
  RollCall(Workers& workers, std::size_t processes, std::string question = "who")
      : workers_(workers), processes_(processes), question_(std::move(question)) {}
  void run() {
    for (std::size_t i = 0; i < 2 * workers_.size(); ++i) ask();
    workers_.wait();
    std::cout << "every process\n";
  }

 private:
  void ask() {
    workers_.post(question_, [this](const std::string& rank) {
      const std::lock_guard lock(mutex_);
      seen_.insert(rank);
      if (seen_.size() < processes_) ask();
    });
  }

  Workers& workers_;
  std::size_t processes_;
  std::string question_;
  std::mutex mutex_;
  std::set<std::string> seen_;
};

void done_that_throws(Workers& workers) {
  workers.post("a", [](const std::string&) { throw std::runtime_error("disk full"); });
  try {
    workers.wait();
    check(false, "no exception");
  } catch (const std::runtime_error& error) { std::cout << error.what() << '\n'; }
  workers.wait();
}

// Until the first Done is through every thread can have taken one task and every other process one
// more.
void cancelled(Workers& workers, std::size_t processes) {
  std::mutex mutex;
  std::size_t delivered = 0;
  {
    const std::lock_guard all_posted(mutex);
    for (int i = 0; i < 1000; ++i) {
      workers.post("b", [&](const std::string&) {
        const std::lock_guard lock(mutex);
        workers.cancel();
        ++delivered;
      });
    }
  }
  workers.wait();
  check(delivered >= 1 && delivered <= workers.size() + processes - 1, "cancel let tasks through");
  std::cout << "cancelled\n";
}

void everything(Processes& processes) {
  const auto count = static_cast<std::size_t>(processes.size());
  {
    const auto workers = processes.workers(work, 2);
    check(workers->size() == 2 * count, "size");
    all_lengths(*workers);
    RollCall(*workers, count).run();
    done_that_throws(*workers);
    cancelled(*workers, count);
    RollCall(*workers, count, "stop").run();
    RollCall(*workers, count).run();
  }
  const auto again = processes.workers(work, 1);
  RollCall(*again, count).run();
  for (int i = 0; i < 100; ++i) again->post("left behind", [](const std::string&) {});
}

void lead(Processes& processes, std::string_view what) {
  if (what == "all") return everything(processes);
  if (what == "throw at once") throw std::runtime_error("first process throws");
  const auto workers = processes.workers(work, 1);
  if (what == "throw at work") {
    for (int i = 0; i < 1000; ++i) workers->post("d", [](const std::string&) {});
    throw std::runtime_error("first process throws");
  }
  // Of "desert": one of the others does not serve.
  check(workers->size() == static_cast<std::size_t>(processes.size()) - 1, "size without the deserter");
  RollCall(*workers, workers->size()).run();
}

}  // namespace

// Usage: <program> "all" | "throw at once" | "throw at work" | "desert"
int main(int count, char** arguments) {
  try {
    const std::string_view what = count > 1 ? arguments[1] : "all";
    Processes processes;
    own_rank = processes.rank();
    if (own_rank == 0) lead(processes, what);
    else if (what != "desert" || own_rank != 1) processes.serve(work, what == "all" ? 2 : 1);
    return 0;
  } catch (const std::exception& error) {
    std::cout << error.what() << std::endl;
    return 3;
  }
}
