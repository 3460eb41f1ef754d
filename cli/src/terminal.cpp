// SPDX-License-Identifier: MIT
#include "terminal.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "banyan/controller/core/printable.hpp"

namespace banyan::cli {

using namespace config;
namespace {

// A signal handler can reach nothing but a global, and runs on whichever thread the system chooses.
std::atomic<int> caught_signal{0};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

static_assert(std::atomic<int>::is_always_lock_free);  // otherwise a handler might wait for itself

constexpr double silent_s = 2.0;  // shorter runs need no progress
constexpr double terminal_period_s = 0.2;
constexpr double log_period_s = 10.0;

void write_error(std::string_view text) {
  // If even this fails, there is nowhere to report it.
  [[maybe_unused]] const auto written = std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = [](int number) { caught_signal = number; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // not SA_RESTART: a blocked write is to be interrupted
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  struct sigaction before {};
  if (::sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);
}

int stop_signal() noexcept { return caught_signal; }

const char* stop_signal_name() noexcept {
  switch (caught_signal) {
    case SIGINT: return "Ctrl-C";
    case SIGHUP: return "SIGHUP";
    default: return "SIGTERM";
  }
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool has_desktop() { return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY"); }

void reserve_standard_streams() noexcept {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free descriptor is this one. Opened for the opposite direction: it exists, but using it fails.
    static_cast<void>(::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  }
}

void print(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0) {
    throw CommandError(exit_lost, std::string("standard output: ") + std::strerror(errno));
  }
}

void print_text(std::string_view text) { print(printable_lines(text)); }

void complain(std::string_view text) { write_error("banyan: " + printable_lines(text) + "\n"); }

void print_problems(const std::vector<Problem>& problems) {
  constexpr std::size_t most = 100;
  std::string text;
  for (std::size_t i = 0; i < std::min(problems.size(), most); ++i) text += to_string(problems[i]) + "\n";
  if (problems.size() > most) text += "... and " + std::to_string(problems.size() - most) + " more\n";
  const auto errors = std::count_if(problems.begin(), problems.end(), [](const auto& p) { return !p.warning; });
  if (errors > 1) text += std::to_string(errors) + " errors\n";
  write_error(text);
}

ProgressLine::ProgressLine(bool wanted)
    : wanted_(wanted),
      terminal_(::isatty(STDERR_FILENO) == 1),
      next_(start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(silent_s))) {}

bool ProgressLine::due() { return wanted_ && Clock::now() >= next_; }

void ProgressLine::show(double share, std::string_view text, bool at_most) {
  const double elapsed = elapsed_s();
  std::string line = printable(text);
  if (share > 0.0) {
    const double left = elapsed / share * (1.0 - share);
    line += (at_most ? ", at most " : ", about ") + duration_text(left) + " left";
  }
  if (terminal_) {
    const auto width = terminal_width() - 1;
    if (line.size() > width) line.resize(width);
    write_error("\r\033[K" + line);
  } else {
    write_error(line + "\n");
  }
  shown_ = true;
  next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                             std::chrono::duration<double>(terminal_ ? terminal_period_s : log_period_s));
}

void ProgressLine::clear() {
  if (shown_ && terminal_) write_error("\r\033[K");
  shown_ = false;
}

double ProgressLine::elapsed_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::clamp(std::ceil(seconds), 0.0, 1e12));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return format("%lld min %02lld s", whole / 60, whole % 60);
  return format("%lld h %02lld min", whole / 3600, whole / 60 % 60);
}

std::string grouped(double number) {
  std::string text = format("%.0f", number);
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > static_cast<std::ptrdiff_t>(first); at -= 3) {
    text.insert(static_cast<std::size_t>(at), 1, ',');
  }
  return text;
}

std::string plural(std::uint64_t n, const char* noun) {
  return grouped(static_cast<double>(n)) + " " + noun + (n == 1 ? "" : "s");
}

std::string summary_line(const char* label, const std::string& text) { return format("  %-10s ", label) + text + "\n"; }

std::string format(const char* text, ...) {
  va_list arguments, again;
  va_start(arguments, text);
  va_copy(again, arguments);
  const int size = std::vsnprintf(nullptr, 0, text, arguments);
  va_end(arguments);
  std::string result(static_cast<std::size_t>(std::max(size, 0)), '\0');
  std::vsnprintf(result.data(), result.size() + 1, text, again);
  va_end(again);
  return result;
}

}  // namespace banyan::cli
