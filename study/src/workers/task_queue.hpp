// SPDX-License-Identifier: MIT
// The tasks that are waiting and the number of those that run: what threads of this process and the
// hand-out to other processes draw from alike.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "banyan/study/workers.hpp"

namespace banyan::study {

struct QueuedTask {
  std::string bytes;
  Workers::Done done;
};

// post, wait and cancel are those of Workers. All functions may be called from any thread.
class TaskQueue {
 public:
  void post(QueuedTask task);
  // The next task, which runs from now on and must be delivered. Waits for one; nothing once closed.
  [[nodiscard]] std::optional<QueuedTask> take();
  // The same without waiting: nothing unless more than `left` tasks are queued.
  [[nodiscard]] std::optional<QueuedTask> try_take(std::size_t left);
  // Gives a task that was taken its result.
  void deliver(QueuedTask task, std::string result);
  void wait();
  void cancel();
  // Drops what is queued and whatever is still posted; returns when nothing runs any more.
  void close();
  [[nodiscard]] bool closed() const;

 private:
  [[nodiscard]] QueuedTask pop();
  void drop(std::unique_lock<std::mutex>& lock);
  void fail(std::exception_ptr thrown);
  void settle(std::size_t count);
  [[nodiscard]] bool idle() const { return queued_.empty() && running_ == 0; }

  mutable std::mutex mutex_;
  std::condition_variable posted_, settled_;
  std::deque<QueuedTask> queued_;
  std::size_t running_ = 0;     // taken or being dropped
  std::exception_ptr failure_;  // what a Done has thrown and wait() has not
  bool closed_ = false;
};

// Threads of this process that work until the queue is closed. Close it before they are destroyed.
class Threads {
 public:
  // std::system_error when the system has no more threads; the queue is closed then.
  Threads(TaskQueue& queue, Work work, std::size_t count);
  [[nodiscard]] std::size_t size() const { return threads_.size(); }

 private:
  std::vector<std::jthread> threads_;
};

}  // namespace banyan::study
