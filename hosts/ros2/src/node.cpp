// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/node.hpp"

#include <ros2_messages.h>

#include <cmath>

#include "banyan/hosts/ros2/names.hpp"
#include "participant.hpp"

namespace banyan::ros2 {
namespace {

constexpr std::int64_t in_a_second = 1'000'000'000;

using PoseMessage = geometry_msgs_msg_dds__PoseStamped_;
using OdometryMessage = nav_msgs_msg_dds__Odometry_;
using TwistMessage = geometry_msgs_msg_dds__Twist_;
using TwistStampedMessage = geometry_msgs_msg_dds__TwistStamped_;
using TransformMessage = geometry_msgs_msg_dds__TransformStamped_;

std::int64_t nanoseconds_of(const builtin_interfaces_msg_dds__Time_& time) noexcept {
  return static_cast<std::int64_t>(time.sec) * in_a_second + time.nanosec;
}
builtin_interfaces_msg_dds__Time_ time_of(std::int64_t ns) noexcept {
  return {static_cast<std::int32_t>(ns / in_a_second), static_cast<std::uint32_t>(ns % in_a_second)};
}

StampedPose sighting_of(const std_msgs_msg_dds__Header_& header, const geometry_msgs_msg_dds__Pose_& pose) {
  const auto& q = pose.orientation;
  return {nanoseconds_of(header.stamp),
          header.frame_id == nullptr ? "" : header.frame_id,
          pose.position.x,
          pose.position.y,
          {q.x, q.y, q.z, q.w}};
}
StampedPose sighting_of(const PoseMessage& message) { return sighting_of(message.header, message.pose); }
StampedPose sighting_of(const OdometryMessage& message) { return sighting_of(message.header, message.pose.pose); }

TwistMessage twist_of(const Velocity& v) noexcept {
  return {{v.forward_m_s, v.sideways_m_s, 0.0}, {0.0, 0.0, v.turn_rad_s}};
}

}  // namespace

struct RosNode::Parts {
  explicit Parts(const Options& options) : node(options), stamped(options.stamped), frame(options.frame) {
    for (std::size_t id = options.first; id < options.first + options.robots; ++id) add_robot(options, id);
    if (options.tf)
      transforms = node.write("/tf", tf2_msgs_msg_dds__TFMessage__desc, quality(DDS_RELIABILITY_RELIABLE, tf_depth));
    node.introduce();
  }

  // Poses are read with best effort, which any publisher can serve: one that was lost is overtaken by the next.
  void add_robot(const Options& options, std::size_t id) {
    const Qos newest = quality(DDS_RELIABILITY_BEST_EFFORT, usual_depth);
    if (!options.pose_topic.empty())
      poses.push_back(node.read(of_robot(options.pose_topic, id), geometry_msgs_msg_dds__PoseStamped__desc, newest));
    if (!options.odometry_topic.empty())
      odometry.push_back(node.read(of_robot(options.odometry_topic, id), nav_msgs_msg_dds__Odometry__desc, newest));
    if (options.bases.empty()) return;
    commands.push_back(
        node.write(of_robot(options.command_topic, id),
                   stamped ? geometry_msgs_msg_dds__TwistStamped__desc : geometry_msgs_msg_dds__Twist__desc,
                   quality(DDS_RELIABILITY_RELIABLE, usual_depth)));
  }
  void count(dds_return_t written) noexcept { unsent += written < 0 ? 1 : 0; }

  DdsParticipant node;
  bool stamped;
  std::string frame;
  dds_entity_t transforms = DDS_ENTITY_NIL;
  std::vector<dds_entity_t> poses, odometry, commands;  // by robot
  std::uint64_t unsent = 0;
};

RosNode::RosNode(const Options& options) : parts_(std::make_unique<Parts>(options)) {}
RosNode::~RosNode() = default;

int RosNode::descriptor() const noexcept { return parts_->node.descriptor(); }

void RosNode::listen(const Take& take) {
  parts_->node.reset();
  for (std::size_t k = 0; k < parts_->odometry.size(); ++k)
    take_all<OdometryMessage>(parts_->odometry[k],
                              [&](const auto& message) { take(Source::odometry, k, sighting_of(message)); });
  for (std::size_t k = 0; k < parts_->poses.size(); ++k)
    take_all<PoseMessage>(parts_->poses[k], [&](const auto& message) { take(Source::pose, k, sighting_of(message)); });
}

void RosNode::drive(std::size_t place, const Velocity& velocity, std::int64_t now_ns) {
  const TwistMessage twist = twist_of(velocity);
  if (!parts_->stamped) return parts_->count(dds_write(parts_->commands[place], &twist));
  TwistStampedMessage stamped{};
  stamped.header.stamp = time_of(now_ns);
  stamped.header.frame_id = parts_->frame.data();
  stamped.twist = twist;
  parts_->count(dds_write(parts_->commands[place], &stamped));
}

void RosNode::publish(std::vector<BodyFrame>& bodies) {
  if (parts_->transforms == DDS_ENTITY_NIL || bodies.empty()) return;
  std::vector<TransformMessage> list(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    BodyFrame& body = bodies[k];
    list[k].header = {time_of(body.stamp_ns), body.parent.data()};
    list[k].child_frame_id = body.child.data();
    list[k].transform = {{body.x_m, body.y_m, 0.0},
                         {0.0, 0.0, std::sin(body.heading_rad / 2.0), std::cos(body.heading_rad / 2.0)}};
  }
  tf2_msgs_msg_dds__TFMessage_ message{};
  message.transforms._length = message.transforms._maximum = static_cast<std::uint32_t>(list.size());
  message.transforms._buffer = list.data();
  parts_->count(dds_write(parts_->transforms, &message));
}

std::size_t RosNode::publishers(Source source, std::size_t place) const {
  dds_subscription_matched_status_t status{};
  const auto& readers = source == Source::pose ? parts_->poses : parts_->odometry;
  static_cast<void>(dds_get_subscription_matched_status(readers[place], &status));
  return status.current_count;
}

std::uint64_t RosNode::unsent() const noexcept { return parts_->unsent; }

void RosNode::settle(double at_most_s) const {
  const auto until = dds_time() + static_cast<dds_duration_t>(1e9 * at_most_s);
  for (const dds_entity_t writer : parts_->commands)
    static_cast<void>(dds_wait_for_acks(writer, std::max<dds_duration_t>(0, until - dds_time())));
}

}  // namespace banyan::ros2
