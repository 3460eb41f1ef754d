// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/fleet.hpp"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <thread>

namespace banyan::udp {
namespace {

constexpr const char* bridge_address = "10.77.0.1";
constexpr double turn_s = 0.02;         // of the wall
constexpr int most_hub_failures = 10;
constexpr auto patience = std::chrono::seconds(2);  // from the wish that a process ends to force

std::string robot_address(std::size_t i) {
  const std::size_t number = i + 2;
  return "10.77." + std::to_string(number / 250) + "." + std::to_string(number % 250 + 1);
}

// The kernel tells the child when its parent is gone, however it went.
void end_with(pid_t parent, int signal) {
  ::prctl(PR_SET_PDEATHSIG, signal);
  if (::getppid() != parent) ::_exit(1);
}

[[noreturn]] void become(const Arguments& arguments) {
  std::vector<char*> words;
  words.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  ::execvp(words[0], words.data());
  std::fprintf(stderr, "banyan: %s: %s\n", words[0], std::strerror(errno));
  ::_exit(127);
}

pid_t begin(const Arguments& arguments, int signal, const std::function<bool()>& before) {
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw FleetError(std::string("fork: ") + std::strerror(errno));
  if (child > 0) return child;
  end_with(parent, signal);
  ::setpgid(0, 0);  // a terminal's Ctrl-C reaches the fleet alone, which tells the hub
  if (!before()) ::_exit(126);
  become(arguments);
}

// `ip` with lines of its batch form on standard input. False if any failed.
bool ip(const std::string& lines) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return false;
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(pipe[0], STDIN_FILENO);
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    ::dup2(nowhere, STDERR_FILENO);
    become({"ip", "-batch", "-"});
  }
  ::close(pipe[0]);
  const bool told = child > 0 && ::write(pipe[1], lines.data(), lines.size()) == static_cast<ssize_t>(lines.size());
  ::close(pipe[1]);
  int status = 0;
  if (child > 0)
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  return told && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool write_file(const char* path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  return static_cast<bool>(file);
}

// A network of its own; who is not root gets it with a user namespace in which he is.
bool unshare_network() {
  if (::unshare(CLONE_NEWNET) == 0) return true;
  const std::string user = std::to_string(::getuid()), group = std::to_string(::getgid());
  if (::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return false;
  return write_file("/proc/self/setgroups", "deny") && write_file("/proc/self/uid_map", "0 " + user + " 1") &&
         write_file("/proc/self/gid_map", "0 " + group + " 1");
}

// Without an address of its own the bridge takes that of a port, another one whenever a port is added, and robots go on
// sending to the one that they know.
constexpr const char* make_bridge =
    "link set lo up\n"
    "link add br0 address 02:00:0a:4d:00:01 type bridge\n"
    "addr add 10.77.0.1/16 dev br0\n"
    "link set br0 up\n";

std::string make_wire(std::size_t i, pid_t robot) {
  const std::string wire = "w" + std::to_string(i);
  return "link add " + wire + " type veth peer name eth0 netns " + std::to_string(robot) + "\nlink set " + wire +
         " master br0 up\n";
}

// Whether a process may do all of it; tried by one that ends.
bool network_works() {
  const pid_t trial = ::fork();
  if (trial == 0) {
    const bool works = unshare_network() && ip(make_bridge) &&
                       ip("link add w0 type veth peer name w1\nlink set w0 master br0 up\n") && ::unshare(CLONE_NEWNET) == 0;
    ::_exit(works ? 0 : 1);
  }
  int status = 0;
  while (trial > 0 && ::waitpid(trial, &status, 0) < 0 && errno == EINTR) {}
  return trial > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

Address with_free_port(const std::string& address) { return Socket(parse_address(address + ":0")).local(); }

}  // namespace

bool enter_network() { return network_works() && unshare_network() && ip(make_bridge); }

Fleet::Fleet(Plan plan) : plan_(std::move(plan)), robots_(plan_.robots.size()) {
  const std::string here = plan_.namespaces ? bridge_address : "127.0.0.1";
  hub_address_ = with_free_port(here);
  if (plan_.way.any())
    relay_ = std::make_unique<Relay>(parse_address(here + ":0"), hub_address_, per_hop(plan_.way), plan_.seed, plan_.speed);
  try {
    start_hub(false);
    for (std::size_t i = 0; i < robots_.size(); ++i) start_robot(i);
  } catch (...) {
    end_all();
    throw;
  }
}

Fleet::~Fleet() { end_all(); }

void Fleet::start_hub(bool again) {
  Arguments arguments = plan_.hub;
  arguments.insert(arguments.end(), {"--listen", to_string(hub_address_)});
  if (again) arguments.emplace_back("--resume");
  hub_ = begin(arguments, SIGTERM, [] { return true; });
}

// The robot waits in its own network until its wire is there.
void Fleet::start_robot(std::size_t i) {
  Arguments arguments = plan_.robots[i];
  arguments.insert(arguments.end(), {"--hub", to_string(relay_ ? relay_->local() : hub_address_)});
  robots_[i] = {};
  if (!plan_.namespaces) {
    robots_[i].pid = begin(arguments, SIGTERM, [] { return true; });
    return;
  }
  std::array<int, 2> there{}, wired{};
  if (::pipe2(there.data(), O_CLOEXEC) != 0 || ::pipe2(wired.data(), O_CLOEXEC) != 0)
    throw FleetError(std::string("pipe: ") + std::strerror(errno));
  robots_[i].pid = begin(arguments, SIGTERM, [&] {
    char byte = 0;
    return ::unshare(CLONE_NEWNET) == 0 && ::write(there[1], &byte, 1) == 1 && ::close(wired[1]) == 0 &&
           ::read(wired[0], &byte, 1) == 1 &&
           ip("link set lo up\naddr add " + robot_address(i) + "/16 dev eth0\nlink set eth0 up\n");
  });
  ::close(there[1]);
  ::close(wired[0]);
  char byte = 0;
  const bool joined = ::read(there[0], &byte, 1) == 1 && ip(make_wire(i, robots_[i].pid)) && ::write(wired[1], &byte, 1) == 1;
  ::close(there[0]);
  ::close(wired[1]);
  if (!joined) throw FleetError("robot " + std::to_string(i) + " cannot be joined to the bridge");
}

void Fleet::ended(pid_t pid, int status) {
  const auto again_at = Wall::now() + std::chrono::duration_cast<Wall::duration>(std::chrono::duration<double>(plan_.restart_after_s));
  if (pid == hub_) {
    hub_ = 0;
    const bool killed = WIFSIGNALED(status);
    if (killed && !interrupted_ && ++hub_failures_ <= most_hub_failures) {
      ++restarts_;
      return start_hub(true);
    }
    done_ = killed ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    return;
  }
  for (Process& robot : robots_) {
    if (robot.pid != pid) continue;
    robot.pid = 0;
    const bool dismissed = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (plan_.restart && !dismissed && !interrupted_) robot.start_at = again_at;
  }
}

std::optional<int> Fleet::turn() {
  if (relay_) relay_->pump(turn_s);
  else std::this_thread::sleep_for(std::chrono::duration<double>(turn_s));
  int status = 0;
  for (pid_t pid = ::waitpid(-1, &status, WNOHANG); pid > 0; pid = ::waitpid(-1, &status, WNOHANG)) ended(pid, status);
  for (std::size_t i = 0; i < robots_.size() && !done_ && !interrupted_; ++i) {
    if (!robots_[i].start_at || Wall::now() < *robots_[i].start_at) continue;
    ++restarts_;
    start_robot(i);
  }
  return done_;
}

void Fleet::interrupt(int signal) {
  interrupted_ = true;
  if (hub_ > 0) ::kill(hub_, signal);
}

void Fleet::end_all() noexcept {
  std::vector<pid_t> running;
  for (const Process& robot : robots_)
    if (robot.pid > 0) running.push_back(robot.pid);
  if (hub_ > 0) running.push_back(hub_);
  for (const pid_t pid : running) ::kill(pid, SIGTERM);
  const auto end = Wall::now() + patience;
  while (!running.empty()) {
    const bool by_force = Wall::now() > end;
    std::erase_if(running, [&](pid_t pid) {
      if (by_force) ::kill(pid, SIGKILL);
      return ::waitpid(pid, nullptr, by_force ? 0 : WNOHANG) != 0;
    });
    if (!running.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace banyan::udp
