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

// All functions may be called from any thread. Destroying the workers cancels what is queued and
// waits for what runs; an exception of a Done that nobody has waited for is lost then.
class Workers {
 public:
  // Gets the result of a task, on a thread of the workers' own: lock what it shares. It may post and
  // cancel, but not wait, and should be short, since the next results may have to queue behind it.
  using Done = std::function<void(std::string result)>;

  virtual ~Workers() = default;
  // Queues a task; tasks are handed out in the order posted.
  virtual void post(std::string task, Done done) = 0;
  // Until every task that was not cancelled has had its Done. An exception that a Done has thrown
  // ends here, once (the first, if there are several). It has also cancelled what was queued, and
  // what is posted before it ends here is dropped.
  virtual void wait() = 0;
  // Drops all tasks that have not started; those that run are finished and delivered, as are those
  // that another process already has, which is at most one more than it has threads.
  virtual void cancel() = 0;
  // Tasks that can run at once, at least 1.
  [[nodiscard]] virtual std::size_t size() const = 0;
};

// `threads` threads of this process, at least 1. std::system_error if the system has no more.
[[nodiscard]] std::unique_ptr<Workers> thread_workers(Work work, int threads);

// The processes that mpirun or srun (with --mpi=pmix, or what `srun --mpi=list` offers) started
// together; a single one if they did not. At most one object per process.
//
// SIGINT, SIGTERM and SIGHUP are the first process's business, which may cancel and end in order: the
// others ignore them while they have this object. Open MPI's mpirun answers Ctrl-C, and SIGTERM, with SIGTERM
// to every process and a second later with SIGKILL (--mca odls_base_sigkill_timeout <seconds> gives
// more time), so what matters has to be in its file by then. If a process dies, the launcher ends all.
class Processes {
 public:
  // Joins the others and waits for all of them to do so. Without the environment of a launcher
  // nothing of MPI is touched. std::runtime_error if there are several processes but this was built
  // without MPI, std::logic_error for the second object in a process that was launched.
  Processes();
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;
  // The first process lets go of the others, whether it ever had workers or not; each of the others
  // waits for that, whether it served or not.
  ~Processes();

  [[nodiscard]] static bool supported() noexcept;  // built with MPI
  [[nodiscard]] int rank() const noexcept;         // 0: the first, which has the workers
  [[nodiscard]] int size() const noexcept;         // 1 without MPI

  // In the first process: workers with `threads` threads (at least 1) in this process and in the
  // others as many as they serve with. A task goes to whoever is free next. Waits until every other
  // process serves or leaves. Must be destroyed before the Processes, and before the next workers
  // are asked for. std::logic_error in another process.
  [[nodiscard]] std::unique_ptr<Workers> workers(Work work, int threads);
  // In every other process, once: does tasks with `threads` threads (at least 1) until the first
  // process lets go. std::logic_error in the first process and the second time.
  void serve(Work work, int threads);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace banyan::study
