// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/fleet.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <thread>

namespace banyan::udp {
namespace {

constexpr double turn_s = 0.02;  // of the wall
constexpr int most_hub_failures = 10;
constexpr auto patience = std::chrono::seconds(2);  // from the wish that a process ends to force

// The kernel tells the child when its parent is gone, however it went.
void end_with(pid_t parent, int signal) {
  ::prctl(PR_SET_PDEATHSIG, signal);
  if (::getppid() != parent) ::_exit(1);
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

Address with_free_port(const std::string& address) { return Socket(parse_address(address + ":0")).local(); }

}  // namespace

Fleet::Fleet(Plan plan) : plan_(std::move(plan)), robots_(plan_.robots.size()) {
  const std::string here = plan_.namespaces ? bridge_address : "127.0.0.1";
  hub_address_ = with_free_port(here);
  if (plan_.way.any() && !plan_.netem)
    relay_ =
        std::make_unique<Relay>(parse_address(here + ":0"), hub_address_, per_hop(plan_.way), plan_.seed, plan_.speed);
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

void Fleet::start_robot(std::size_t i) {
  Arguments arguments = plan_.robots[i];
  arguments.insert(arguments.end(), {"--hub", to_string(relay_ ? relay_->local() : hub_address_)});
  robots_[i] = {};
  if (!plan_.namespaces) {
    robots_[i].pid = begin(arguments, SIGTERM, [] { return true; });
    return;
  }
  Wire wire(i, plan_.netem ? per_hop(plan_.way) : Impairment{}, plan_.speed);
  robots_[i].pid = begin(arguments, SIGTERM, [&] { return wire.become_far_end(); });
  if (!wire.join(robots_[i].pid)) throw FleetError("robot " + std::to_string(i) + " cannot be joined to the bridge");
}

void Fleet::ended(pid_t pid, int status) {
  const auto again_at =
      Wall::now() + std::chrono::duration_cast<Wall::duration>(std::chrono::duration<double>(plan_.restart_after_s));
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
