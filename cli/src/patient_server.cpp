// SPDX-License-Identifier: MIT
#include "patient_server.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace banyan::cli {

namespace {

using Steady = std::chrono::steady_clock;

constexpr std::chrono::seconds longest_pause{5};  // in which a reader takes nothing

// Whether the socket is ready for that before the moment has come.
bool await(socket_t socket, short events, Steady::time_point until) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Steady::now()).count();
    if (left <= 0) return false;
    pollfd wanted{socket, events, 0};
    const int ready = ::poll(&wanted, 1, static_cast<int>(std::min<std::int64_t>(left, 1'000'000)));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

// A connection whose reading ends at a deadline, however often data arrives.
class Connection final : public httplib::Stream {
 public:
  Connection(socket_t socket, std::chrono::milliseconds patience) : socket_(socket), until_(Steady::now() + patience) {}

  [[nodiscard]] bool is_readable() const override { return at_ < size_ || await(socket_, POLLIN, until_); }
  [[nodiscard]] bool is_writable() const override { return await(socket_, POLLOUT, Steady::now() + longest_pause); }

  ssize_t read(char* into, std::size_t size) override {
    if (at_ == size_) {
      if (!await(socket_, POLLIN, until_)) return -1;
      const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
      if (got <= 0) return got;
      at_ = 0;
      size_ = static_cast<std::size_t>(got);
    }
    const std::size_t some = std::min(size, size_ - at_);
    std::copy_n(buffer_.data() + at_, some, into);
    at_ += some;
    return static_cast<ssize_t>(some);
  }
  ssize_t write(const char* bytes, std::size_t size) override {
    return is_writable() ? ::send(socket_, bytes, size, MSG_DONTWAIT | MSG_NOSIGNAL) : -1;
  }

  void get_remote_ip_and_port(std::string&, int&) const override {}  // not used: all are this machine's
  void get_local_ip_and_port(std::string&, int&) const override {}
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  socket_t socket_;
  Steady::time_point until_;
  std::array<char, 4096> buffer_;
  std::size_t at_ = 0, size_ = 0;
};

}  // namespace

// The open connections, and the threads that serve them.
class Crowd final : public httplib::TaskQueue {
 public:
  Crowd() { threads_.reserve(PatientServer::most_visitors); }

  void enqueue(std::function<void()> visit) override {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(visit));
    if (idle_ < waiting_.size() && threads_.size() < PatientServer::most_visitors && !no_more_) add_thread();
    make_room();
    changed_.notify_one();
  }

  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
      while (!staying_.empty()) send_away();
    }
    changed_.notify_all();
    for (auto& thread : threads_) thread.join();
  }

  // On a thread of ours.
  void enter(socket_t socket) {
    const std::lock_guard lock(mutex_);
    // By arrival: a thread may pause between taking its visitor and coming here.
    const auto later = std::ranges::find_if(staying_, [](const Visitor& v) { return v.arrival > taken_as(); });
    staying_.insert(later, {socket, taken_as()});
    if (ending_) send_away();
    else make_room();
  }
  // Under the lock: the number of a closed socket may be reused at once.
  void leave(socket_t socket) {
    const std::lock_guard lock(mutex_);
    if (staying_.remove_if([&](const Visitor& v) { return v.socket == socket; }) == 0) --leaving_;
    ::shutdown(socket, SHUT_RDWR);
    ::close(socket);
  }

 private:
  void add_thread() {
    try {
      threads_.emplace_back([this] { run(); });
    } catch (const std::system_error&) {  // the system has no more: the existing ones must do
      no_more_ = true;
    }
  }

  void run() {
    std::unique_lock lock(mutex_);
    for (;;) {
      ++idle_;
      changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
      --idle_;
      if (waiting_.empty()) return;
      const auto visit = std::move(waiting_.front());
      waiting_.pop_front();
      taken_as() = arrivals_++;
      lock.unlock();
      visit();
      lock.lock();
    }
  }

  // For each waiting connection there is a thread that is idle, new or about to be free.
  void make_room() {
    if (threads_.size() < PatientServer::most_visitors && !no_more_) return;
    while (waiting_.size() > idle_ + leaving_ && !staying_.empty()) send_away();
  }
  void send_away() {
    ::shutdown(staying_.front().socket, SHUT_RDWR);
    staying_.pop_front();
    ++leaving_;
  }

  struct Visitor {
    socket_t socket;
    std::uint64_t arrival;
  };
  static std::uint64_t& taken_as() {  // arrival of this thread's visitor
    static thread_local std::uint64_t arrival = 0;
    return arrival;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  std::uint64_t arrivals_ = 0;
  std::list<Visitor> staying_;  // the first has been there longest
  std::size_t leaving_ = 0;     // sent away, but not gone yet
  std::size_t idle_ = 0;
  bool ending_ = false;
  bool no_more_ = false;  // threads than there are
  std::vector<std::thread> threads_;
};

PatientServer::PatientServer(std::chrono::milliseconds patience) : patience_(patience) {
  new_task_queue = [this] { return crowd_ = new Crowd; };  // httplib deletes it
}

void PatientServer::lengthen_queue() const { static_cast<void>(::listen(svr_sock_, SOMAXCONN)); }

// One request only: httplib would take the body of one that is refused for the next request, with whatever Host it
// claims.
bool PatientServer::process_and_close_socket(socket_t socket) {
  crowd_->enter(socket);
  Connection connection(socket, patience_);
  bool closed = false;
  const bool good = process_request(connection, true, closed, nullptr);
  crowd_->leave(socket);
  return good;
}

}  // namespace banyan::cli
