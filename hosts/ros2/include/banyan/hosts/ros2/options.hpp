// SPDX-License-Identifier: MIT
// The command line of banyan-ros2, with what a ROS 2 environment says (ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY,
// ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and ROS_DISTRO).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "banyan/hosts/udp/option_error.hpp"

namespace banyan::ros2 {

// In names of topics and frames, {} stands for the robot's id.
struct Options {
  std::size_t first = 0;   // the id of the first robot
  std::size_t robots = 0;  // as many, with ids one after the other
  std::string names;       // as given; "": robots are called by their ids. Names of topics have them already
  std::string poses;       // ADDRESS:PORT of the hub's --poses; "": there is no hub to tell
  std::string bases;  // ADDRESS:PORT of the first robot's base, the others' follow; "": robots are driven by others
  std::string pose_topic;      // geometry_msgs/PoseStamped; "": none
  std::string odometry_topic;  // nav_msgs/Odometry; "": none. Without a pose topic, these are the tracker's poses, too
  std::string command_topic = "/robot_{}/cmd_vel";
  bool stamped = false;  // commands are geometry_msgs/TwistStamped
  std::string frame = "map";
  std::string body_frame = "robot_{}/base_link";
  bool tf = true;
  double max_age_s = 0.3;  // 0: stamps are not compared with the clock
  std::string node = "banyan_ros2";
  std::uint32_t domain = 0;
  bool localhost = false;
  std::vector<std::string> peers;  // addresses at which others are looked for, beside multicast; not with localhost
  bool humble = false;             // ros_discovery_info as in ROS 2 Humble and older
  int swarm = -1;                  // the socket of a mission that is to be shown, instead of all else; -1: none
};

using Environment = std::function<const char*(const char*)>;  // as std::getenv

[[nodiscard]] std::string usage();
// Throws udp::OptionError, also for values that are out of range, missing or contradict each other.
[[nodiscard]] Options parse_options(std::span<const std::string> arguments, const Environment& environment);

}  // namespace banyan::ros2
