// SPDX-License-Identifier: MIT
// Between a mission and ROS 2: what `banyan run --ros2` and the like start beside them.
#pragma once

#include "banyan/hosts/ros2/options.hpp"

namespace banyan::ros2 {

// Until the mission ends or a signal comes; `options.swarm` is the socket on which it speaks (feed.hpp). Returns the
// exit code. Throws NodeError.
int show_swarm(const Options& options);

}  // namespace banyan::ros2
