// SPDX-License-Identifier: MIT
// The processes of a fleet on one machine: a hub, robots, and, where wires do not make the radio bad, the relay between
// them, in this process. All of them end with it: when it is destroyed, and, because the kernel then ends them, when it
// is killed.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "banyan/hosts/udp/network.hpp"
#include "banyan/hosts/udp/relay.hpp"

namespace banyan::udp {

class Fleet {
 public:
  struct Plan {
    Arguments hub;                  // gets --listen ADDRESS, and --resume when it starts again
    std::vector<Arguments> robots;  // get --hub ADDRESS
    bool namespaces = false;        // after enter_network()
    bool restart = true;            // robots that end unasked
    double restart_after_s = 1.0;   // of the wall
    Impairment way;                 // from robot to robot
    bool netem = false;             // by the wires of namespaces, after netem_fault(); otherwise by a relay
    double speed = 1.0;
    std::uint64_t seed = 1;
  };
  explicit Fleet(Plan plan);  // starts all; throws FleetError
  ~Fleet();                   // ends all
  Fleet(const Fleet&) = delete;
  Fleet& operator=(const Fleet&) = delete;

  // A moment of work. The hub's exit code once it has ended by itself.
  [[nodiscard]] std::optional<int> turn();
  void interrupt(int signal);  // for the hub, which then stops all

  [[nodiscard]] pid_t hub() const noexcept { return hub_; }
  [[nodiscard]] pid_t robot(std::size_t i) const noexcept { return robots_[i].pid; }  // 0: it is not running
  [[nodiscard]] std::size_t restarts() const noexcept { return restarts_; }

 private:
  using Wall = std::chrono::steady_clock;
  struct Process {
    pid_t pid = 0;
    std::optional<Wall::time_point> start_at;  // again
  };
  void start_hub(bool again);
  void start_robot(std::size_t i);
  void ended(pid_t pid, int status);
  void end_all() noexcept;

  Plan plan_;
  Address hub_address_;
  std::unique_ptr<Relay> relay_;
  pid_t hub_ = 0;
  int hub_failures_ = 0;
  std::vector<Process> robots_;
  std::size_t restarts_ = 0;
  std::optional<int> done_;
  bool interrupted_ = false;
};

}  // namespace banyan::udp
