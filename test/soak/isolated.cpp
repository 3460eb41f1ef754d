// SPDX-License-Identifier: MIT
#include "isolated.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <sstream>
#include <utility>
#include <vector>

#include "terminal.hpp"

namespace banyan::soak {

using namespace cli;
namespace {

void write_all(int pipe, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(pipe, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;  // the reader is gone
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

// A line each; tabs between the parts.
std::string outcome_text(const SoakOutcome& outcome) {
  std::string text;
  for (const Finding& f : outcome.findings) text += format("%s\t%.17g\t%s\n", f.kind.c_str(), f.time_s, f.text.c_str());
  return text + format("end\t%d\t%.17g\t%.17g\t%.17g\t%016" PRIx64 "\n", outcome.complete ? 1 : 0, outcome.complete_s,
                       outcome.bound_s, outcome.time_s, outcome.hash);
}

[[noreturn]] void live(const world::Scenario& scenario, bool twice, int pipe) noexcept {
  try {
    write_all(pipe, outcome_text(watch(scenario, twice)));
    ::_exit(0);
  } catch (const std::exception& e) { write_all(pipe, std::string("crash\t0\t") + e.what() + "\n"); }
  ::_exit(1);
}

}  // namespace

Isolated::Isolated(const world::Scenario& scenario, bool twice) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw CommandError(exit_lost, std::string("no pipe: ") + std::strerror(errno));
  const pid_t soak = ::getpid();
  process_ = ::fork();
  if (process_ == 0) {
    static_cast<void>(::prctl(PR_SET_PDEATHSIG, SIGKILL));  // there would be no reader
    if (::getppid() != soak) ::_exit(1);
    static_cast<void>(::close(ends[0]));
    live(scenario, twice, ends[1]);
  }
  const int failure = errno;
  static_cast<void>(::close(ends[1]));
  pipe_ = ends[0];
  if (process_ < 0) {
    end();
    throw CommandError(exit_lost, std::string("no process: ") + std::strerror(failure));
  }
  static_cast<void>(::fcntl(pipe_, F_SETFL, O_NONBLOCK));
}

Isolated::Isolated(Isolated&& other) noexcept
    : process_{std::exchange(other.process_, -1)},
      pipe_{std::exchange(other.pipe_, -1)},
      said_{std::move(other.said_)},
      start_{other.start_} {}

Isolated& Isolated::operator=(Isolated&& other) noexcept {
  std::swap(process_, other.process_);
  std::swap(pipe_, other.pipe_);
  std::swap(said_, other.said_);
  std::swap(start_, other.start_);
  return *this;
}

Isolated::~Isolated() { end(); }

void Isolated::end() noexcept {
  if (pipe_ >= 0) static_cast<void>(::close(std::exchange(pipe_, -1)));
  if (process_ <= 0) return;
  static_cast<void>(::kill(process_, SIGKILL));
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {}
  process_ = -1;
}

std::optional<SoakOutcome> Isolated::take() {
  std::array<char, 4096> buffer{};
  while (true) {
    const ssize_t n = ::read(pipe_, buffer.data(), buffer.size());
    if (n > 0) {
      said_.append(buffer.data(), static_cast<std::size_t>(n));
    } else if (n < 0 && errno == EINTR) {
      continue;
    } else if (n < 0 && errno == EAGAIN) {
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start_;
      if (took.count() < most_s) return std::nullopt;
      end();
      return SoakOutcome{.findings = {{"crash", 0.0, format("no end after %.0f s", most_s)}}};
    } else {
      break;  // its end of the pipe is closed
    }
  }
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {}
  process_ = -1;
  return read_outcome(status);
}

SoakOutcome Isolated::wait() {
  while (true) {
    pollfd waiting{pipe_, POLLIN, 0};
    static_cast<void>(::poll(&waiting, 1, 200));
    if (auto outcome = take()) return *std::move(outcome);
    if (stop_signal() != 0) {
      end();
      return {};
    }
  }
}

SoakOutcome Isolated::read_outcome(int status) const {
  SoakOutcome outcome;
  std::istringstream lines(said_);
  bool ended = false;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> parts;
    std::istringstream text(line);
    for (std::string part; std::getline(text, part, '\t');) parts.push_back(part);
    const auto number = [&](std::size_t k) { return std::strtod(parts[k].c_str(), nullptr); };
    ended = parts.size() == 6 && parts[0] == "end";
    if (ended) {
      outcome.complete = parts[1] == "1";
      outcome.complete_s = number(2);
      outcome.bound_s = number(3);
      outcome.time_s = number(4);
      outcome.hash = std::strtoull(parts[5].c_str(), nullptr, 16);
    } else if (parts.size() >= 2) {
      outcome.findings.push_back({parts[0], number(1), parts.size() > 2 ? parts[2] : ""});
    }
  }
  if (!ended && WIFSIGNALED(status))
    outcome.findings.push_back({"crash", 0.0, format("ended by signal %d", WTERMSIG(status))});
  else if (!ended && outcome.findings.empty())
    outcome.findings.push_back({"crash", 0.0, format("ended with status %d", WEXITSTATUS(status))});
  return outcome;
}

}  // namespace banyan::soak
