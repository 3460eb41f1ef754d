// SPDX-License-Identifier: MIT
// Between ROS 2 and a fleet: poses of ROS 2 go to the hub and, as odometry, to the robots; what robots say to their
// bases goes to ROS 2. The formats on this side are those of any other tracker and base (docs/robots.md).
#pragma once

#include "banyan/hosts/ros2/options.hpp"

namespace banyan::ros2 {

// Until a signal; all robots that it drives stand still then. Returns the exit code.
// Throws NodeError and udp::SocketError.
int run_bridge(const Options& options);

}  // namespace banyan::ros2
