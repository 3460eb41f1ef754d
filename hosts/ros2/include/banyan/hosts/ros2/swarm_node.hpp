// SPDX-License-Identifier: MIT
// The node of ROS 2 that shows a mission: publishes what the mission says (feed.hpp) and hears what is asked of it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "banyan/hosts/ros2/feed.hpp"
#include "banyan/hosts/ros2/options.hpp"

namespace banyan::ros2 {

class SwarmNode {
 public:
  // The message for the mission, as feed.hpp has it.
  using Ask = std::function<void(feed::FeedTopic, std::string_view)>;

  // Publishes nothing until it is told by hello() what there is. Throws NodeError, as does hello().
  explicit SwarmNode(const Options& options);
  ~SwarmNode();
  SwarmNode(const SwarmNode&) = delete;
  SwarmNode& operator=(const SwarmNode&) = delete;

  // So many robots; `simulated`: with a clock, transforms and odometry. Again when there are more.
  void hello(std::size_t robots, bool simulated);
  // What has no topic is left out.
  void publish(feed::FeedTopic topic, std::size_t robot, std::string_view cdr);
  // Can be read when something has arrived.
  [[nodiscard]] int descriptor() const noexcept;
  void listen(const Ask& ask);
  // Messages that were not taken, because reliable readers are slow.
  [[nodiscard]] std::uint64_t unsent() const noexcept;
  // Until all readers have what was published; at most so long.
  void settle(double at_most_s) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace banyan::ros2
