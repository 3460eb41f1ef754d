// SPDX-License-Identifier: MIT
#include <signal.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "banyan/study/workers.hpp"
#include "task_queue.hpp"
#include "team.hpp"

namespace banyan::study {
namespace {

// The variables that Open MPI's mpirun, srun with PMIx and srun with PMI or PMI-2 set for a process, in this order.
bool launched() {
  return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMIX_RANK") != nullptr ||
         std::getenv("PMI_RANK") != nullptr;
}

#ifndef BANYAN_HAVE_MPI
// Each would do all the work, and all would write the same files.
void refuse_company() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* size = std::getenv(name);
    if (size != nullptr && std::atoi(size) > 1) {
      throw std::runtime_error(
          std::string(name) + " = " + size +
          ": this banyan was built without MPI; start it once, or install libopenmpi-dev and build again");
    }
  }
}
#endif

// The launcher's Ctrl-C reaches every process. Only the first one handles it.
class StopSignalsIgnored {
 public:
  StopSignalsIgnored() {
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &ignore, &before_[i]);
  }
  StopSignalsIgnored(const StopSignalsIgnored&) = delete;
  StopSignalsIgnored& operator=(const StopSignalsIgnored&) = delete;
  ~StopSignalsIgnored() {
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before_[i], nullptr);
  }

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, signals.size()> before_{};
};

std::size_t at_least_one(int threads) { return static_cast<std::size_t>(std::max(threads, 1)); }

class ProcessWorkers final : public Workers {
 public:
  ProcessWorkers(Team& team, Work work, std::size_t threads)
      : team_(team), size_(threads + team.threads_elsewhere()), threads_(*queue_, work, threads) {
    try {
      team_.draw_from(queue_, size_);
    } catch (...) {
      queue_->close();
      throw;
    }
  }
  ProcessWorkers(const ProcessWorkers&) = delete;
  ProcessWorkers& operator=(const ProcessWorkers&) = delete;
  ~ProcessWorkers() override {
    queue_->close();
    team_.draw_from(nullptr, 0);
  }

  void post(std::string task, Done done) override { queue_->post({std::move(task), std::move(done)}); }
  void wait() override { queue_->wait(); }
  void cancel() override { queue_->cancel(); }
  [[nodiscard]] std::size_t size() const override { return size_; }

 private:
  Team& team_;
  std::size_t size_;
  std::shared_ptr<TaskQueue> queue_ = std::make_shared<TaskQueue>();
  Threads threads_;
};

}  // namespace

struct Processes::Impl {
  std::unique_ptr<StopSignalsIgnored> ignored;
  std::unique_ptr<Team> team;  // null: a single process. Destroyed before the signals are restored
};

Processes::Processes() : impl_(std::make_unique<Impl>()) {
  if (!launched()) return;
#ifdef BANYAN_HAVE_MPI
  impl_->team = join_team();
  if (rank() != 0) impl_->ignored = std::make_unique<StopSignalsIgnored>();
#else
  refuse_company();
#endif
}

Processes::~Processes() = default;

bool Processes::supported() noexcept {
#ifdef BANYAN_HAVE_MPI
  return true;
#else
  return false;
#endif
}

int Processes::rank() const noexcept { return impl_->team ? impl_->team->rank() : 0; }

int Processes::size() const noexcept { return impl_->team ? impl_->team->size() : 1; }

std::unique_ptr<Workers> Processes::workers(Work work, int threads) {
  if (rank() != 0) throw std::logic_error("Processes: only the first process has the workers");
  if (size() == 1) return thread_workers(work, threads);
  return std::make_unique<ProcessWorkers>(*impl_->team, work, at_least_one(threads));
}

void Processes::serve(Work work, int threads) {
  if (rank() == 0) throw std::logic_error("Processes: the first process does not serve");
  TaskQueue queue;
  const Threads pool(queue, work, at_least_one(threads));
  try {
    impl_->team->serve(queue, pool.size());
  } catch (...) {
    queue.close();
    throw;
  }
  queue.close();
}

}  // namespace banyan::study
