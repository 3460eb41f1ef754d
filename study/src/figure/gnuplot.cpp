// SPDX-License-Identifier: MIT
// Starting gnuplot (gnuplot.hpp).
#include "gnuplot.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "banyan/study/figure.hpp"

namespace banyan::study {

namespace {

constexpr std::size_t most_said = 4096;  // bytes of gnuplot's messages that are kept

std::string reason(int error_number) { return std::generic_category().message(error_number); }

[[noreturn]] void cannot_start(int error_number) {
  if (error_number == ENOENT) throw FigureError("gnuplot is not installed (Debian: gnuplot-nox), or not in PATH");
  throw FigureError("gnuplot cannot be started: " + reason(error_number));
}

struct Pipe {
  int read = -1, write = -1;

  Pipe() {
    std::array<int, 2> ends{};
    // Closed on exec: a child that another thread starts meanwhile must not hold our end open.
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) cannot_start(errno);
    read = ends[0];
    write = ends[1];
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    ::close(read);
    close_write();
  }
  void close_write() noexcept {
    if (write >= 0) ::close(write);
    write = -1;
  }
};

// posix_spawn's settings: what gnuplot inherits.
class SpawnSettings {
 public:
  explicit SpawnSettings(int messages) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawnattr_init(&attributes_);
    // Its standard output must not mix with ours, which may be JSON for another program.
    int error = ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (error == 0) error = ::posix_spawn_file_actions_adddup2(&actions_, messages, STDOUT_FILENO);
    if (error == 0) error = ::posix_spawn_file_actions_adddup2(&actions_, messages, STDERR_FILENO);
    if (error == 0) error = default_signals();
    if (error != 0) {
      destroy();
      cannot_start(error);
    }
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() { destroy(); }

  [[nodiscard]] const posix_spawn_file_actions_t* actions() const noexcept { return &actions_; }
  [[nodiscard]] const posix_spawnattr_t* attributes() const noexcept { return &attributes_; }

 private:
  // Otherwise a thread that blocks signals would start a gnuplot that Ctrl-C cannot end.
  int default_signals() {
    sigset_t none, ended_by;
    ::sigemptyset(&none);
    ::sigemptyset(&ended_by);
    for (const int signal : {SIGINT, SIGTERM, SIGQUIT, SIGPIPE, SIGCHLD}) ::sigaddset(&ended_by, signal);
    int error = ::posix_spawnattr_setsigmask(&attributes_, &none);
    if (error == 0) error = ::posix_spawnattr_setsigdefault(&attributes_, &ended_by);
    if (error == 0) error = ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    return error;
  }
  void destroy() noexcept {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }

  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

// Reads until gnuplot ends. Output beyond the first bytes is read, too, or it would wait for ever.
std::string read_all(int descriptor) {
  std::string said;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    said.append(buffer.data(), static_cast<std::size_t>(got));
    if (said.size() > most_said) said.resize(most_said);
  }
  while (!said.empty() && (said.back() == '\n' || said.back() == ' ')) said.pop_back();
  return said;
}

// "" for success.
std::string how_it_ended(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return "with an unknown result: " + reason(errno);
  }
  if (WIFSIGNALED(status)) return "by signal " + std::to_string(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return "with status " + std::to_string(WEXITSTATUS(status));
  return "";
}

}  // namespace

void run_gnuplot(const std::string& script, const std::string& output) {
  std::string program = "gnuplot", no_settings = "-d", call = "-c", target = output;
  // gnuplot would take "-x.gp" for an option and "<x.gp" for a command.
  std::string path = script.starts_with('/') ? script : "./" + script;
  const std::array<char*, 6> arguments{program.data(), no_settings.data(), call.data(),
                                       path.data(),    target.data(),      nullptr};
  Pipe pipe;
  const SpawnSettings settings(pipe.write);
  pid_t child = 0;
  const int error =
      ::posix_spawnp(&child, program.c_str(), settings.actions(), settings.attributes(), arguments.data(), environ);
  if (error != 0) cannot_start(error);
  pipe.close_write();
  const std::string said = read_all(pipe.read);
  const std::string ended = how_it_ended(child);
  if (!ended.empty()) {
    throw FigureError("gnuplot ended " + ended + " at " + script + (said.empty() ? "" : ":\n" + said));
  }
}

}  // namespace banyan::study
