// SPDX-License-Identifier: MIT
#include "banyan/world/threads.hpp"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace banyan::world {
namespace {

// How many forks lie between the first process and this one. A forked process has the memory of its parent's teams,
// but not their threads.
unsigned forks = 0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): all that a handler can reach
[[maybe_unused]] const int counted = ::pthread_atfork(nullptr, nullptr, [] { ++forks; });

}  // namespace

struct Executor::Team {
  std::mutex mutex;
  std::condition_variable start;
  std::condition_variable done;
  std::uint64_t generation = 0;
  int running = 0;
  bool stop = false;
  std::size_t n = 0;
  Call call = nullptr;
  void* context = nullptr;
  std::vector<std::thread> members;  // no std::jthread: emscripten has none yet
  const unsigned of = forks;         // the process that has the threads
  Team* other = nullptr;

  // Also where a thread could not be started: those that were must not wait for ever.
  ~Team() {
    {
      const std::lock_guard lock(mutex);
      stop = true;
    }
    start.notify_all();
    for (std::thread& member : members) member.join();
  }

  void work(int worker, int threads) {
    std::uint64_t seen = 0;
    for (;;) {
      std::unique_lock lock(mutex);
      start.wait(lock, [&] { return stop || generation != seen; });
      if (stop) return;
      seen = generation;
      lock.unlock();
      chunk(worker, threads);
      lock.lock();
      if (--running == 0) done.notify_one();
    }
  }

  void chunk(int worker, int threads) const {
    const std::size_t w = static_cast<std::size_t>(worker);
    const std::size_t t = static_cast<std::size_t>(threads);
    call(context, n * w / t, n * (w + 1) / t, worker);
  }
};

// Threads of another process can be neither stopped nor joined, and destroying what they wait for would wait for them.
// So their team stays where it is, one in a chain.
void Executor::End::operator()(Team* team) const {
  static std::atomic<Team*> left_behind = nullptr;
  if (team->of == forks) delete team;
  else team->other = left_behind.exchange(team);
}

Executor::Executor(int threads) : threads_(std::max(1, threads)) {
  if (threads_ > 1) start();
}

void Executor::start() {
  std::unique_ptr<Team, End> team(new Team);
  for (int worker = 1; worker < threads_; ++worker)
    team->members.emplace_back([of = team.get(), worker, threads = threads_] { of->work(worker, threads); });
  team_ = std::move(team);
}

Executor::~Executor() = default;

void Executor::run(std::size_t n, Call call, void* context) {
  if (team_->of != forks) start();
  {
    const std::lock_guard lock(team_->mutex);
    team_->n = n;
    team_->call = call;
    team_->context = context;
    team_->running = threads_ - 1;
    ++team_->generation;
  }
  team_->start.notify_all();
  team_->chunk(0, threads_);
  std::unique_lock lock(team_->mutex);
  team_->done.wait(lock, [&] { return team_->running == 0; });
}

}  // namespace banyan::world
