// SPDX-License-Identifier: MIT
// What a mission and the banyan-ros2 beside it say to each other, in datagrams of a socket pair (SOCK_SEQPACKET): the
// end of a mission that is killed within a message never joins the beginning of the next one's. Needs no DDS.
#pragma once

#include <cstddef>
#include <cstdint>

namespace banyan::ros2::feed {

enum class FeedTopic : std::uint8_t {
  // From the mission: first what it is, then messages in CDR.
  hello,        // `robot`: how many there are; one byte: 1 if the clock and the bodies are simulated, else 0
  clock,        // rosgraph_msgs/Clock on /clock, where they are; so are the next two
  transforms,   // tf2_msgs/TFMessage on /tf
  odometry,     // nav_msgs/Odometry of `robot` on /robot_{}/odom
  markers,      // visualization_msgs/MarkerArray on /markers
  diagnostics,  // diagnostic_msgs/DiagnosticArray on /diagnostics
  log,          // rcl_interfaces/Log on /rosout
  // To the mission: hello, empty, when the node is there, and then what is asked.
  goal,     // of /goal_pose: x and y, 8 bytes each, and the name of the frame
  click,    // the same of /clicked_point
  command,  // text of /banyan/command
};

// In front of each datagram. `place`: whether it begins a message, ends it, or both.
constexpr std::uint8_t first_part = 1, last_part = 2, whole = first_part | last_part;
struct PartHead {
  FeedTopic topic = FeedTopic::hello;
  std::uint8_t place = whole;
  std::uint16_t robot = 0;
};
static_assert(sizeof(PartHead) == 4);

constexpr std::size_t largest_part = 32768;    // bytes after the head
constexpr std::size_t longest_command = 4096;  // characters
constexpr std::size_t most_odometers = 200;    // robots beyond have no topic of their own: each is two of DDS's to find

}  // namespace banyan::ros2::feed
