// SPDX-License-Identifier: MIT
// Another program, run to its end (child_program.hpp).
#include "child_program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace banyan::study {

namespace {

constexpr std::size_t most_said = 4096;  // bytes of its messages that are kept

[[noreturn]] void fail(int error_number) { throw std::system_error(error_number, std::generic_category()); }

struct Pipe {
  int read = -1, write = -1;

  Pipe() {
    std::array<int, 2> ends{};
    // Closed on exec: a child that another thread starts meanwhile must not hold our end open.
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail(errno);
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

// posix_spawn's settings: what the program inherits.
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
      fail(error);
    }
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() { destroy(); }

  [[nodiscard]] const posix_spawn_file_actions_t* actions() const noexcept { return &actions_; }
  [[nodiscard]] const posix_spawnattr_t* attributes() const noexcept { return &attributes_; }

 private:
  // Otherwise a thread that blocks signals would start a program that Ctrl-C cannot end.
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

// Reads until the program ends. The last bytes are kept: an error stands at the end.
std::string read_all(int descriptor) {
  std::string said;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    said.append(buffer.data(), static_cast<std::size_t>(got));
    if (said.size() > most_said) said.erase(0, said.size() - most_said);
  }
  while (!said.empty() && (said.back() == '\n' || said.back() == ' ')) said.pop_back();
  return said;
}

void wait_for(pid_t child, ChildEnd& end) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno == EINTR) continue;
    end.status = -1;
    end.ended = "with an unknown result: " + std::generic_category().message(errno);
    return;
  }
  end.status = WIFSIGNALED(status) ? -1 : WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.ended = "by signal " + std::to_string(WTERMSIG(status));
  else if (end.status != 0) end.ended = "with status " + std::to_string(end.status);
}

}  // namespace

ChildEnd run_program(std::vector<std::string> words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ChildEnd end;
  try {
    Pipe pipe;
    const SpawnSettings settings(pipe.write);
    pid_t child = 0;
    const int error =
        ::posix_spawnp(&child, arguments.front(), settings.actions(), settings.attributes(), arguments.data(), environ);
    if (error != 0) fail(error);
    pipe.close_write();
    end.said = read_all(pipe.read);
    wait_for(child, end);
  } catch (const std::system_error& error) { end.start_error = error.code().value(); }
  return end;
}

}  // namespace banyan::study
