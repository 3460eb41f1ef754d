// SPDX-License-Identifier: MIT
// A node of ROS 2 as others see it: a DDS participant whose topics and types have the names that ROS 2 gives them. The
// only part that knows DDS (Eclipse Cyclone DDS, by its C interface).
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "banyan/controller/core/inputs.hpp"
#include "banyan/hosts/ros2/options.hpp"
#include "banyan/hosts/ros2/sightings.hpp"

namespace banyan::ros2 {

class NodeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Source : std::uint8_t { pose, odometry };

// Where a body is, for /tf.
struct BodyFrame {
  std::int64_t stamp_ns = 0;
  std::string parent, child;
  double x_m = 0.0, y_m = 0.0, heading_rad = 0.0;
};

class RosNode {
 public:
  using Take = std::function<void(Source, std::size_t place, const StampedPose&)>;

  // Throws NodeError.
  explicit RosNode(const Options& options);
  ~RosNode();
  RosNode(const RosNode&) = delete;
  RosNode& operator=(const RosNode&) = delete;

  // Can be read when something has arrived.
  [[nodiscard]] int descriptor() const noexcept;
  // Hands out what has arrived.
  void listen(const Take& take);
  void drive(std::size_t place, const Velocity& velocity, std::int64_t now_ns);
  void publish(std::vector<BodyFrame>& bodies);
  // How many publishers a robot's topic has.
  [[nodiscard]] std::size_t publishers(Source source, std::size_t place) const;
  [[nodiscard]] std::uint64_t unsent() const noexcept;
  // Until all readers have what was published; at most so long.
  void settle(double at_most_s) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace banyan::ros2
