// SPDX-License-Identifier: MIT
// Who does the work of many runs: threads of this process, or with MPI also other processes. Tasks
// and results are byte strings, so that it makes no difference which.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace banyan::study {

// From a task to its result. The same function in every process, called from several threads at
// once; must not throw.
using Work = std::string (*)(std::string_view task);

// All functions may be called from any thread.
class Workers {
 public:
  // Gets the result of a task, on a thread of the workers' own: lock what it shares. It may post,
  // but not wait.
  using Done = std::function<void(std::string result)>;

  virtual ~Workers() = default;
  // Queues a task; tasks start in the order posted.
  virtual void post(std::string task, Done done) = 0;
  // Until every task that was not cancelled has had its Done. An exception that a Done has thrown
  // ends here, once; it also cancels what was queued.
  virtual void wait() = 0;
  // Drops all tasks that have not started; those that run are finished and delivered.
  virtual void cancel() = 0;
  // Tasks that can run at once, at least 1.
  [[nodiscard]] virtual std::size_t size() const = 0;
};

// `threads` threads of this process, at least 1.
[[nodiscard]] std::unique_ptr<Workers> thread_workers(Work work, int threads);

// The processes that mpirun or srun started together; a single one if it did not, or if this was
// built without MPI. At most one object per process.
class Processes {
 public:
  // Joins the others. Without the environment of an MPI launcher nothing of MPI is touched.
  Processes();
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;
  // The first process lets go of the others.
  ~Processes();

  [[nodiscard]] static bool supported() noexcept;   // built with MPI
  [[nodiscard]] int rank() const noexcept;          // 0: the first, which has the workers
  [[nodiscard]] int size() const noexcept;          // 1 without MPI

  // In the first process: workers with `threads` threads in every process, this one included. A
  // task goes to whoever is free next. Must be destroyed before the Processes.
  [[nodiscard]] std::unique_ptr<Workers> workers(Work work, int threads);
  // In every other process: does tasks until the first process lets go.
  void serve(Work work, int threads);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace banyan::study
