// SPDX-License-Identifier: MIT
// How the program talks to a person and to a shell: exit codes, signals, progress, plain output.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/config/document.hpp"

namespace banyan::cli {

// Documented in `banyan --help`. A mission that ends without completion is a result, not a failure.
enum ExitCode : int {
  exit_done = 0,
  exit_lost = 1,     // not everything came out: a file cannot be read or written, an internal error
  exit_usage = 2,    // bad options or a bad scenario; nothing was started
  exit_signal = 128  // + signal number: stopped by SIGHUP (129), Ctrl-C (130) or SIGTERM (143), valid files written
};

// A message for the user and the exit code to leave with.
class CommandError : public std::runtime_error {
 public:
  CommandError(int code, const std::string& text) : std::runtime_error(text), exit_code(code) {}
  int exit_code;
};

// From now on the first SIGINT, SIGTERM or SIGHUP is only noted; the second one kills as usual. Where SIGHUP is
// ignored, by nohup, it stays so.
void catch_stop_signals();
// The signal that was caught, 0 for none; and what it is called.
[[nodiscard]] int stop_signal() noexcept;
[[nodiscard]] const char* stop_signal_name() noexcept;

// Whether a variable of the environment is there, and not empty.
[[nodiscard]] bool is_set(const char* variable);
[[nodiscard]] bool has_desktop();

// Occupies standard input, output and error where they are closed: otherwise the next file opened would get their
// number, and messages to the user would end up in a recording. Writing there still fails.
void reserve_standard_streams() noexcept;

// Writes everything to standard output; throws CommandError(exit_lost) when that fails (disk full).
void print(std::string_view text);
// The same for a person to read: names from outside cannot reach the terminal as control characters. What a program
// reads (JSON, CSV, TOML, command lines) goes through print().
void print_text(std::string_view text);
// A message to standard error, prefixed "banyan: ", printable.
void complain(std::string_view text);
// All problems to standard error, at most a hundred; then, for errors, their number.
void print_problems(const std::vector<config::Problem>& problems);

// A line on standard error with the progress of a run: rewritten in place on a terminal, else a
// line every ten seconds. Silent for runs shorter than two seconds and when not wanted.
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Whether it is time for show(). Cheap: call it every tick.
  [[nodiscard]] bool due();
  // `share` of the work that is done, in [0, 1], 0 if that is not known; `at_most`: it may end sooner.
  void show(double share, std::string_view text, bool at_most);
  void clear();
  [[nodiscard]] double elapsed_s() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool wanted_;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
};

// "3 s", "2 min 05 s", "1 h 10 min".
[[nodiscard]] std::string duration_text(double seconds);
// "12,345,678".
[[nodiscard]] std::string grouped(double number);
// "1 robot", "12,345 robots".
[[nodiscard]] std::string plural(std::uint64_t n, const char* noun);
// A line of a summary: what it is about, and the text.
[[nodiscard]] std::string summary_line(const char* label, const std::string& text);
// printf into a string.
[[nodiscard]] [[gnu::format(printf, 1, 2)]] std::string format(const char* text, ...);

}  // namespace banyan::cli
