// SPDX-License-Identifier: MIT
// What tests of several processes have in common: waiting for them, looking at them, and ports for them.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <chrono>
#include <functional>
#include <sstream>
#include <thread>

#include "started_program.hpp"

namespace banyan::cli {

class StartedProcesses : public StartedProgram {
 protected:
  using Clock = std::chrono::steady_clock;

  // Polls until it is so, at most 20 s.
  static bool becomes(const std::function<bool()>& so) {
    const auto end = Clock::now() + std::chrono::seconds(20);
    while (!so()) {
      if (Clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
  }
  static std::vector<pid_t> children_of(pid_t parent) {
    std::istringstream list(
        contents("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children"));
    std::vector<pid_t> children;
    for (pid_t child = 0; list >> child;) children.push_back(child);
    return children;
  }
  static std::string command_line(pid_t pid) {
    std::string line = contents("/proc/" + std::to_string(pid) + "/cmdline");
    std::replace(line.begin(), line.end(), '\0', ' ');
    return line;
  }
  static bool runs(pid_t pid) {
    const std::string status = contents("/proc/" + std::to_string(pid) + "/status");
    return !status.empty() && !has(status, "State:\tZ");
  }
};

// A port that nobody has; and so, most likely, are the next ones.
inline int free_port() {
  const int s = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  EXPECT_EQ(::bind(s, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  socklen_t length = sizeof address;
  ::getsockname(s, reinterpret_cast<sockaddr*>(&address), &length);
  ::close(s);
  return ntohs(address.sin_port) % 20000 + 10000;  // below those that the system hands out
}

inline bool answers(int port) {
  const int s = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool connected = ::connect(s, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  ::close(s);
  return connected;
}

}  // namespace banyan::cli
