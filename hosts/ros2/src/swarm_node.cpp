// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/swarm_node.hpp"

#include <ros2_messages.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>

#include "banyan/hosts/ros2/names.hpp"
#include "cdr_topic.hpp"
#include "participant.hpp"

namespace banyan::ros2 {
namespace {

using feed::FeedTopic;

// A message that tells the mission of a point.
std::string point_text(const std_msgs_msg_dds__Header_& header, const geometry_msgs_msg_dds__Point_& point) {
  std::string text(2 * sizeof(double), '\0');
  std::memcpy(text.data(), &point.x, sizeof point.x);
  std::memcpy(text.data() + sizeof point.x, &point.y, sizeof point.y);
  return text + (header.frame_id == nullptr ? "" : header.frame_id);
}

// What rclcpp has for /rosout.
Qos quality_of_log() {
  constexpr std::int32_t log_depth = 1000;
  Qos qos = lasting_quality(log_depth);
  dds_qset_lifespan(qos.get(), DDS_SECS(10));
  return qos;
}

}  // namespace

struct SwarmNode::Parts {
  struct Channel {
    Channel(DdsParticipant& node, const std::string& name, const char* type, const Qos& qos)
        : topic(node.entity(), dds_topic(name).c_str(), type), writer(node.write(name, topic.entity(), qos)) {}
    CdrTopic topic;
    dds_entity_t writer;
  };

  explicit Parts(const Options& options) : node(options) {
    // Who asks is heard: what RViz, Foxglove and `ros2 topic pub` publish is reliable.
    const Qos all = quality(DDS_RELIABILITY_RELIABLE, usual_depth);
    goals = node.read("/goal_pose", geometry_msgs_msg_dds__PoseStamped__desc, all);
    clicks = node.read("/clicked_point", geometry_msgs_msg_dds__PointStamped__desc, all);
    commands = node.read("/banyan/command", std_msgs_msg_dds__String__desc, all);
    const Qos lossless = quality(DDS_RELIABILITY_RELIABLE, usual_depth);
    add(FeedTopic::markers, "/markers", "visualization_msgs::msg::dds_::MarkerArray_", lossless);
    add(FeedTopic::diagnostics, "/diagnostics", "diagnostic_msgs::msg::dds_::DiagnosticArray_", lossless);
    add(FeedTopic::log, "/rosout", "rcl_interfaces::msg::dds_::Log_", quality_of_log());
    node.introduce();
  }

  void add(FeedTopic topic, const std::string& name, const char* type, const Qos& qos) {
    channels.try_emplace({topic, 0}, node, name, type, qos);
  }

  DdsParticipant node;
  dds_entity_t goals = DDS_ENTITY_NIL, clicks = DDS_ENTITY_NIL, commands = DDS_ENTITY_NIL;
  std::map<std::pair<FeedTopic, std::size_t>, Channel> channels;  // the second: the robot, else 0
  std::uint64_t unsent = 0;
};

SwarmNode::SwarmNode(const Options& options) : parts_(std::make_unique<Parts>(options)) {}
SwarmNode::~SwarmNode() = default;

void SwarmNode::hello(std::size_t robots, bool simulated) {
  if (!simulated) return;
  Parts& p = *parts_;
  const std::size_t before = p.channels.size();
  p.add(FeedTopic::clock, "/clock", "rosgraph_msgs::msg::dds_::Clock_", quality(DDS_RELIABILITY_RELIABLE, 1));
  p.add(FeedTopic::transforms, "/tf", "tf2_msgs::msg::dds_::TFMessage_", quality(DDS_RELIABILITY_RELIABLE, tf_depth));
  for (std::size_t i = 0; i < std::min(robots, feed::most_odometers); ++i)
    p.channels.try_emplace({FeedTopic::odometry, i}, p.node, of_robot("/robot_{}/odom", i),
                           "nav_msgs::msg::dds_::Odometry_", quality(DDS_RELIABILITY_RELIABLE, usual_depth));
  if (p.channels.size() > before) p.node.introduce();
}

void SwarmNode::publish(FeedTopic topic, std::size_t robot, std::string_view cdr) {
  const auto found = parts_->channels.find({topic, topic == FeedTopic::odometry ? robot : 0});
  if (found == parts_->channels.end()) return;
  if (!found->second.topic.write(found->second.writer, cdr)) ++parts_->unsent;
}

int SwarmNode::descriptor() const noexcept { return parts_->node.descriptor(); }

void SwarmNode::listen(const Ask& ask) {
  parts_->node.reset();
  take_all<geometry_msgs_msg_dds__PoseStamped_>(parts_->goals, [&](const auto& message) {
    ask(FeedTopic::goal, point_text(message.header, message.pose.position));
  });
  take_all<geometry_msgs_msg_dds__PointStamped_>(
      parts_->clicks, [&](const auto& message) { ask(FeedTopic::click, point_text(message.header, message.point)); });
  take_all<std_msgs_msg_dds__String_>(parts_->commands, [&](const auto& message) {
    ask(FeedTopic::command, message.data == nullptr ? "" : message.data);
  });
}

std::uint64_t SwarmNode::unsent() const noexcept { return parts_->unsent; }

void SwarmNode::settle(double at_most_s) const {
  const auto until = dds_time() + static_cast<dds_duration_t>(1e9 * at_most_s);
  for (const auto& [key, channel] : parts_->channels)
    static_cast<void>(dds_wait_for_acks(channel.writer, std::max<dds_duration_t>(0, until - dds_time())));
}

}  // namespace banyan::ros2
