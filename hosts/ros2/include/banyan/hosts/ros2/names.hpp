// SPDX-License-Identifier: MIT
// Names of topics, as ROS 2 has them (design.ros2.org, "topic and service names") and as DDS has them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace banyan::ros2 {

// With each {} replaced by the id, and {:02} by the id with at least two digits.
[[nodiscard]] std::string of_robot(std::string_view pattern, std::size_t id);
// What is wrong with an absolute topic's name; "" if it is one.
[[nodiscard]] std::string topic_fault(std::string_view name);
// What is wrong with a node's name; "" if it is one.
[[nodiscard]] std::string node_fault(std::string_view name);
// "/robot_3/pose" is rt/robot_3/pose.
[[nodiscard]] std::string dds_topic(std::string_view name);

}  // namespace banyan::ros2
