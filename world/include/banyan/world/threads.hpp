// SPDX-License-Identifier: MIT
// A fixed team of threads for the parallel phases of a tick. Work is cut into one contiguous chunk
// per thread and every item writes only its own slots, so the result never depends on the team. A forked process makes
// a team of its own when it first needs one.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace banyan::world {

class Executor {
 public:
  explicit Executor(int threads = 1);  // at least 1; the caller is one of them
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  [[nodiscard]] int threads() const noexcept { return threads_; }

  // Calls f(begin, end, worker) for chunks that cover [0, n), worker in [0, threads). Returns when
  // all are done; rethrows nothing: f must not throw. No allocation, except in a process that was forked since.
  template <class F> void parallel_for(std::size_t n, F&& f) {
    if (threads_ == 1) return f(std::size_t{0}, n, 0);
    run(
        n,
        [](void* context, std::size_t begin, std::size_t end, int worker) {
          (*static_cast<std::remove_reference_t<F>*>(context))(begin, end, worker);
        },
        &f);
  }

 private:
  using Call = void (*)(void*, std::size_t, std::size_t, int);
  void start();
  void run(std::size_t n, Call call, void* context);
  struct Team;
  struct End {
    void operator()(Team* team) const;
  };
  int threads_;
  std::unique_ptr<Team, End> team_;
};

}  // namespace banyan::world
