// SPDX-License-Identifier: MIT
#include "page_beside.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <thread>
#include <utility>

#include "beside.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

constexpr std::size_t recording_format = 0;
static_assert(record::output_formats[recording_format].key == "record");

}  // namespace

PageBeside::PageBeside(const RunOutputs& outputs, const record::OutputSettings& output)
    : recording_(outputs.path(record::output_formats[recording_format])) {
  if (!output["record"]) throw CommandError(exit_usage, "--view shows the recording, and none is to be written");
  // The part: under the other name there may be the recording of an earlier run.
  std::array<std::string, 4> words{own_program(), "view", "--wait", recording_ + ".part"};
  std::array<char*, 5> argv{words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0) throw CommandError(exit_lost, std::string("the page cannot be started: ") + std::strerror(errno));
  if (process_ > 0) return;
  ::setpgid(0, 0);                     // a terminal's Ctrl-C reaches the mission alone
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // a mission that is killed leaves nothing behind
  if (::getppid() == parent) {
    ::dup2(STDERR_FILENO, STDOUT_FILENO);  // standard output is the mission's: its result as JSON, perhaps
    ::execv(argv[0], argv.data());
  }
  ::_exit(exit_lost);
}

PageBeside::PageBeside(PageBeside&& other) noexcept
    : process_(std::exchange(other.process_, 0)), recording_(std::move(other.recording_)) {}

PageBeside::~PageBeside() {
  if (process_ == 0 || ::waitpid(process_, nullptr, WNOHANG) != 0)
    return;  // it has ended, and somebody may know already
  ::kill(process_, SIGTERM);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {}
}

void PageBeside::stay() {
  std::error_code none;
  const bool begun = std::filesystem::exists(recording_, none) || std::filesystem::exists(recording_ + ".part", none);
  if (process_ == 0 || !begun || stop_signal() != 0) return;
  while (stop_signal() == 0 && ::waitpid(process_, nullptr, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace banyan::cli
