// SPDX-License-Identifier: MIT
#include "task_queue.hpp"

#include <utility>

namespace banyan::study {

void TaskQueue::post(QueuedTask task) {
  {
    const std::lock_guard lock(mutex_);
    if (closed_ || failure_) return;
    queued_.push_back(std::move(task));
  }
  posted_.notify_one();
}

std::optional<QueuedTask> TaskQueue::take() {
  std::unique_lock lock(mutex_);
  posted_.wait(lock, [this] { return closed_ || !queued_.empty(); });
  if (queued_.empty()) return std::nullopt;
  return pop();
}

std::optional<QueuedTask> TaskQueue::try_take(std::size_t left) {
  const std::lock_guard lock(mutex_);
  if (queued_.size() <= left) return std::nullopt;
  return pop();
}

QueuedTask TaskQueue::pop() {
  QueuedTask task = std::move(queued_.front());
  queued_.pop_front();
  ++running_;
  return task;
}

void TaskQueue::deliver(QueuedTask task, std::string result) {
  try {
    task.done(std::move(result));
  } catch (...) { fail(std::current_exception()); }
  task.done = nullptr;  // the waiting caller may destroy what it refers to
  settle(1);
}

void TaskQueue::wait() {
  std::unique_lock lock(mutex_);
  settled_.wait(lock, [this] { return idle(); });
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void TaskQueue::cancel() {
  std::unique_lock lock(mutex_);
  drop(lock);
}

void TaskQueue::close() {
  std::unique_lock lock(mutex_);
  closed_ = true;
  drop(lock);
  posted_.notify_all();
  settled_.wait(lock, [this] { return idle(); });
}

bool TaskQueue::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

// Unlocked in between, since destroying what a Done holds may call us; counted as running until
// then.
void TaskQueue::drop(std::unique_lock<std::mutex>& lock) {
  std::deque<QueuedTask> dropped;
  dropped.swap(queued_);
  const std::size_t count = dropped.size();
  running_ += count;
  lock.unlock();
  dropped.clear();
  settle(count);
  lock.lock();
}

void TaskQueue::fail(std::exception_ptr thrown) {
  std::unique_lock lock(mutex_);
  if (!failure_) failure_ = std::move(thrown);
  drop(lock);
}

void TaskQueue::settle(std::size_t count) {
  const std::lock_guard lock(mutex_);
  running_ -= count;
  // Under the lock: a waiting caller may destroy the queue as soon as it gets it.
  if (idle()) settled_.notify_all();
}

Threads::Threads(TaskQueue& queue, Work work, std::size_t count) {
  // An exception of Work is not caught: it must not throw.
  const auto run = [&queue, work]() noexcept {
    while (auto task = queue.take()) {
      std::string result = work(task->bytes);
      queue.deliver(std::move(*task), std::move(result));
    }
  };
  threads_.reserve(count);
  try {
    while (threads_.size() < count) threads_.emplace_back(run);
  } catch (...) {
    queue.close();  // or those that did start would never end
    throw;
  }
}

}  // namespace banyan::study
