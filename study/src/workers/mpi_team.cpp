// SPDX-License-Identifier: MIT
// In every process only one thread calls MPI: messages continue whatever the main thread and the
// workers are busy with, and MPI need not support several callers.
#include <mpi.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <future>
#include <list>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "mpi_message.hpp"
#include "team.hpp"

namespace banyan::study {
namespace {

// A task and its result have the tag of the slot that the first process keeps for it: 1, 2, ….
// With this tag another process reports its number of threads, and the first one releases it.
constexpr int control_tag = 0;

// Time between polls for messages: waiting in Open MPI itself would keep a core busy.
class Idle {
 public:
  void pause() {
    std::this_thread::sleep_for(pause_);
    pause_ = std::min(2 * pause_, longest);
  }
  void over() { pause_ = shortest; }

 private:
  static constexpr std::chrono::microseconds shortest{200}, longest{1000};
  std::chrono::microseconds pause_ = shortest;
};

// What the first process knows of another one.
class Other {
 public:
  [[nodiscard]] bool announced() const { return announced_; }
  [[nodiscard]] std::size_t free() const { return free_; }
  [[nodiscard]] bool busy() const { return free_ < slots_.size(); }

  // One more task than threads is queued there, so that a thread that is done need not wait for us.
  void announce(std::size_t threads) {
    announced_ = true;
    free_ = threads == 0 ? 0 : threads + 1;
    slots_ = std::vector<Slot>(free_);
  }

  void give(int rank, QueuedTask task, std::shared_ptr<TaskQueue> queue) {
    const auto slot = std::ranges::find_if(slots_, [](const Slot& s) { return s.queue == nullptr; });
    slot->queue = std::move(queue);
    slot->done = std::move(task.done);
    slot->sending.emplace(std::move(task.bytes), rank, static_cast<int>(slot - slots_.begin()) + 1);
    --free_;
  }

  void deliver(MpiMessage message) {
    Slot& slot = slots_.at(static_cast<std::size_t>(message.tag) - 1);
    slot.sending->finish();
    slot.sending.reset();
    const auto queue = std::move(slot.queue);
    ++free_;
    queue->deliver({{}, std::move(slot.done)}, std::move(message.bytes));
  }

 private:
  struct Slot {
    std::shared_ptr<TaskQueue> queue;  // null: free
    Workers::Done done;
    std::optional<Sending> sending;
  };

  bool announced_ = false;
  std::vector<Slot> slots_;
  std::size_t free_ = 0;  // slots
};

class MpiTeam final : public Team {
 public:
  MpiTeam() : thread_([this] { run(); }) { joined_.get_future().get(); }
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;
  ~MpiTeam() override {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
    changed_.notify_all();
  }

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }
  [[nodiscard]] std::size_t threads_elsewhere() override;
  void draw_from(std::shared_ptr<TaskQueue> queue, std::size_t threads) override;
  void serve(TaskQueue& queue, std::size_t threads) override;

 private:
  void run() noexcept;  // out of memory on this thread ends the program, and so all processes
  void lead();
  bool take_in(std::vector<Other>& others);
  bool hand_out(std::vector<Other>& others);
  void follow();
  void accept(MpiMessage task);
  bool send_results(std::list<Sending>& sending);

  std::promise<void> joined_;
  int rank_ = 0, size_ = 1;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool leaving_ = false;
  // Of the first process.
  std::shared_ptr<TaskQueue> source_;
  std::size_t all_threads_ = 0;
  int announced_ = 0;
  std::size_t threads_elsewhere_ = 0;
  // Of the others. What is served and with how many threads stays once it is set.
  TaskQueue* served_ = nullptr;
  std::size_t threads_ = 0;
  bool let_go_ = false;
  std::vector<MpiMessage> results_;

  std::jthread thread_;  // last: it uses all the others
};

void MpiTeam::run() noexcept {
  int again = 0;
  MPI_Initialized(&again);
  if (again != 0) {
    joined_.set_exception(std::make_exception_ptr(std::logic_error("Processes: a program joins the others once")));
    return;
  }
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED) {
    MPI_Finalize();
    joined_.set_exception(std::make_exception_ptr(std::runtime_error("this MPI does not allow a program threads")));
    return;
  }
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  joined_.set_value();
  rank_ == 0 ? lead() : follow();
  MPI_Finalize();
}

std::size_t MpiTeam::threads_elsewhere() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return announced_ == size_ - 1; });
  return threads_elsewhere_;
}

void MpiTeam::draw_from(std::shared_ptr<TaskQueue> queue, std::size_t threads) {
  const std::lock_guard lock(mutex_);
  if (queue && source_) throw std::logic_error("Processes: one object of workers at a time");
  source_ = std::move(queue);
  all_threads_ = threads;
}

void MpiTeam::lead() {
  std::vector<Other> others(static_cast<std::size_t>(size_));  // by rank; ourselves never used
  const auto waits = [](const Other& other) { return !other.announced() || other.busy(); };
  for (Idle idle;;) {
    const bool came = take_in(others);
    const bool went = hand_out(others);
    if (came || went) {
      idle.over();
      continue;
    }
    {
      const std::lock_guard lock(mutex_);
      if (leaving_ && std::none_of(others.begin() + 1, others.end(), waits)) break;
    }
    idle.pause();
  }
  for (int other = 1; other < size_; ++other) Sending({}, other, control_tag).finish();
}

bool MpiTeam::take_in(std::vector<Other>& others) {
  auto message = receive();
  if (!message) return false;
  Other& from = others[static_cast<std::size_t>(message->from)];
  if (message->tag != control_tag) {
    from.deliver(std::move(*message));
    return true;
  }
  std::size_t threads = 0;
  std::from_chars(message->bytes.data(), message->bytes.data() + message->bytes.size(), threads);
  from.announce(threads);
  const std::lock_guard lock(mutex_);
  threads_elsewhere_ += threads;
  ++announced_;
  changed_.notify_all();
  return true;
}

// The process with most free threads comes first. One whose threads are all busy gets another task
// only while there is one for every thread anywhere: otherwise it would lie there while others idle.
bool MpiTeam::hand_out(std::vector<Other>& others) {
  std::shared_ptr<TaskQueue> queue;
  std::size_t threads = 0;
  {
    const std::lock_guard lock(mutex_);
    queue = source_;
    threads = all_threads_;
  }
  for (bool any = false; queue; any = true) {
    const auto other = std::ranges::max_element(others, {}, &Other::free);
    if (other->free() == 0) return any;
    auto task = queue->try_take(other->free() > 1 ? 0 : threads);
    if (!task) return any;
    other->give(static_cast<int>(other - others.begin()), std::move(*task), queue);
  }
  return false;
}

void MpiTeam::serve(TaskQueue& queue, std::size_t threads) {
  std::unique_lock lock(mutex_);
  if (served_ != nullptr) throw std::logic_error("Processes: serve is over");
  served_ = &queue;
  threads_ = threads;
  changed_.notify_all();
  changed_.wait(lock, [this] { return let_go_; });
}

// A process that leaves without having served reports that it has no threads and waits like the others.
void MpiTeam::follow() {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return served_ != nullptr || leaving_; });
  }
  std::list<Sending> sending;  // Sending cannot be moved
  sending.emplace_back(std::to_string(threads_), 0, control_tag);
  for (Idle idle;;) {
    const bool went = send_results(sending);
    auto message = receive();
    if (message && message->tag == control_tag) break;
    if (message) accept(std::move(*message));
    if (message || went) idle.over();
    else idle.pause();
  }
  for (Sending& last : sending) last.finish();
  const std::lock_guard lock(mutex_);
  let_go_ = true;
  changed_.notify_all();
}

void MpiTeam::accept(MpiMessage task) {
  // A lost result would be waited for without end: better to end here.
  served_->post({std::move(task.bytes), [this, tag = task.tag](std::string result) noexcept {
                   const std::lock_guard lock(mutex_);
                   results_.push_back({0, tag, std::move(result)});
                 }});
}

bool MpiTeam::send_results(std::list<Sending>& sending) {
  std::vector<MpiMessage> results;
  {
    const std::lock_guard lock(mutex_);
    results.swap(results_);
  }
  sending.remove_if([](Sending& earlier) { return earlier.sent(); });
  for (MpiMessage& result : results) sending.emplace_back(std::move(result.bytes), 0, result.tag);
  return !results.empty();
}

}  // namespace

std::unique_ptr<Team> join_team() { return std::make_unique<MpiTeam>(); }

}  // namespace banyan::study
