// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/network.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace banyan::udp {
namespace {

// "10.77.X.Y" of a robot, and the hardware address of the same numbers, so that nobody has to ask for it: a question
// that gets lost would hold up all datagrams, not one.
struct NetworkPlace {
  std::string address, hardware;
};
NetworkPlace place_of(std::size_t robot) {
  const std::size_t number = robot + 2;
  std::array<char, 32> address{}, hardware{};
  std::snprintf(address.data(), address.size(), "10.77.%zu.%zu", number / 250, number % 250 + 1);
  std::snprintf(hardware.data(), hardware.size(), "02:00:0a:4d:%02zx:%02zx", number / 250, number % 250 + 1);
  return {address.data(), hardware.data()};
}

int wait_for_end(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// `ip` or `tc` with lines of their batch form on standard input. False if any failed; what they had to say goes to
// `complaints`, an open file.
bool batch(const char* program, const std::string& lines, int complaints = -1) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return false;
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(pipe[0], STDIN_FILENO);
    ::dup2(complaints >= 0 ? complaints : ::open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
    become({program, "-batch", "-"});
  }
  ::close(pipe[0]);
  const bool told = child > 0 && ::write(pipe[1], lines.data(), lines.size()) == static_cast<ssize_t>(lines.size());
  ::close(pipe[1]);
  return child > 0 && wait_for_end(child) == 0 && told;
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
constexpr const char* bridge_hardware = "02:00:0a:4d:00:01";
bool make_bridge() {
  const std::string link = std::string("link add br0 address ") + bridge_hardware + " type bridge\n";
  const std::string address = std::string("addr add ") + bridge_address + "/16 dev br0\n";
  return batch("ip", "link set lo up\n" + link + address + "link set br0 up\n");
}

constexpr const char* trial_wire = "link add w0 type veth peer name w1\n";

// Whether a process may do all of it; tried by one that ends.
bool network_works() {
  const pid_t trial = ::fork();
  if (trial == 0) {
    const bool works = unshare_network() && make_bridge() &&
                       batch("ip", std::string(trial_wire) + "link set w0 master br0 up\n") &&
                       ::unshare(CLONE_NEWNET) == 0;
    ::_exit(works ? 0 : 1);
  }
  return trial > 0 && wait_for_end(trial) == 0;
}

std::string contents_of(int file) {
  std::string text;
  std::array<char, 512> room{};
  ::lseek(file, 0, SEEK_SET);
  for (ssize_t n = 0; (n = ::read(file, room.data(), room.size())) > 0;)
    text.append(room.data(), static_cast<std::size_t>(n));
  return text;
}

// "Error: Specified qdisc kind is unknown." out of several lines.
std::string first_line(std::string text) {
  if (text.starts_with("Error: ")) text.erase(0, 7);
  text.resize(std::min(text.size(), text.find('\n')));
  while (text.ends_with('.')) text.pop_back();
  return text;
}

std::string number(const char* form, double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), form, value);
  return text.data();
}

bool say(int pipe) {
  const char byte = 0;
  return ::write(pipe, &byte, 1) == 1;
}

bool hear(int pipe) {
  char byte = 0;
  return ::read(pipe, &byte, 1) == 1;
}

void close_end(int& pipe) {
  if (pipe >= 0) ::close(pipe);
  pipe = -1;
}

}  // namespace

void become(const Arguments& arguments) {
  std::vector<char*> words;
  words.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  ::execvp(words[0], words.data());
  std::fprintf(stderr, "banyan: %s: %s\n", words[0], std::strerror(errno));
  ::_exit(127);
}

bool enter_network() { return network_works() && unshare_network() && make_bridge(); }

std::string netem_words(const Impairment& hop, double speed) {
  constexpr const char* headers = "-42";  // of Ethernet, IP and UDP: the rate is that of what datagrams contain
  std::string words = "netem limit " + std::to_string(most_under_way);
  const double delay_us = hop.delay_s * 1e6 / speed, jitter_us = hop.jitter_s * 1e6 / speed;
  if (delay_us > 0.0 || jitter_us > 0.0) {
    words += " delay " + number("%.0fus", std::max(1.0, delay_us));  // without one it neither varies nor reorders
    if (jitter_us > 0.0) words += number(" %.0fus", jitter_us);
    if (hop.reorder > 0.0) words += " reorder " + number("%.6f%%", 100.0 * hop.reorder);
  }
  if (hop.loss > 0.0) words += " loss random " + number("%.6f%%", 100.0 * hop.loss);
  if (hop.duplicate > 0.0) words += " duplicate " + number("%.6f%%", 100.0 * hop.duplicate);
  if (hop.rate_bytes_s > 0.0) words += " rate " + number("%.0fbit ", 8.0 * hop.rate_bytes_s * speed) + headers;
  return words;
}

std::string netem_fault(const Impairment& hop, double speed) {
  const int complaints = ::memfd_create("banyan-tc", MFD_CLOEXEC);
  const pid_t trial = ::fork();
  if (trial == 0) {
    const bool works = ::unshare(CLONE_NEWNET) == 0 && batch("ip", trial_wire, complaints) &&
                       batch("tc", "qdisc add dev w0 root " + netem_words(hop, speed) + "\n", complaints);
    ::_exit(works ? 0 : 1);
  }
  const bool works = trial > 0 && wait_for_end(trial) == 0;
  const std::string said = first_line(contents_of(complaints));
  ::close(complaints);
  if (works) return {};
  return said.empty() ? "tc failed" : said;
}

Wire::Wire(std::size_t robot, const Impairment& hop, double speed)
    : robot_(robot), netem_(hop.any() ? netem_words(hop, speed) : "") {
  if (::pipe2(there_.data(), O_CLOEXEC) != 0 || ::pipe2(wired_.data(), O_CLOEXEC) != 0)
    throw FleetError(std::string("pipe: ") + std::strerror(errno));
}

Wire::~Wire() {
  for (auto* pipe : {&there_, &wired_})
    for (int& end : *pipe) close_end(end);
}

bool Wire::become_far_end() {
  close_end(wired_[1]);
  if (::unshare(CLONE_NEWNET) != 0 || !say(there_[1]) || !hear(wired_[0])) return false;
  const NetworkPlace here = place_of(robot_);
  const std::string address = "addr add " + here.address + "/16 dev eth0\n";
  const std::string hub =
      std::string("neigh add ") + bridge_address + " lladdr " + bridge_hardware + " dev eth0 nud permanent\n";
  return batch("ip", "link set lo up\n" + address + "link set eth0 up\n" + hub) &&
         (netem_.empty() || batch("tc", "qdisc add dev eth0 root " + netem_ + "\n"));
}

bool Wire::join(pid_t far) {
  close_end(there_[1]);
  close_end(wired_[0]);
  const NetworkPlace there = place_of(robot_);
  const std::string wire = "w" + std::to_string(robot_), process = std::to_string(far);
  const std::string ends =
      "link add " + wire + " type veth peer name eth0 address " + there.hardware + " netns " + process + "\n";
  const std::string robot = "neigh replace " + there.address + " lladdr " + there.hardware + " dev br0 nud permanent\n";
  return hear(there_[0]) && batch("ip", ends + "link set " + wire + " master br0 up\n" + robot) &&
         (netem_.empty() || batch("tc", "qdisc add dev " + wire + " root " + netem_ + "\n")) && say(wired_[1]);
}

}  // namespace banyan::udp
