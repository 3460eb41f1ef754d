// SPDX-License-Identifier: MIT
#include "banyan/study/workers.hpp"

#include <algorithm>
#include <utility>

#include "task_queue.hpp"

namespace banyan::study {
namespace {

class ThreadWorkers final : public Workers {
 public:
  ThreadWorkers(Work work, std::size_t threads) : threads_(queue_, work, threads) {}
  ThreadWorkers(const ThreadWorkers&) = delete;
  ThreadWorkers& operator=(const ThreadWorkers&) = delete;
  ~ThreadWorkers() override { queue_.close(); }

  void post(std::string task, Done done) override { queue_.post({std::move(task), std::move(done)}); }
  void wait() override { queue_.wait(); }
  void cancel() override { queue_.cancel(); }
  [[nodiscard]] std::size_t size() const override { return threads_.size(); }

 private:
  TaskQueue queue_;
  Threads threads_;
};

}  // namespace

std::unique_ptr<Workers> thread_workers(Work work, int threads) {
  return std::make_unique<ThreadWorkers>(work, static_cast<std::size_t>(std::max(threads, 1)));
}

}  // namespace banyan::study
