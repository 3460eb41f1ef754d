// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/node.hpp"

#include <dds/dds.h>
#include <ros2_messages.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "banyan/hosts/ros2/names.hpp"

namespace banyan::ros2 {
namespace {

constexpr std::int32_t depth = 10;      // of rclcpp's default quality of service
constexpr std::int32_t tf_depth = 100;  // of tf2_ros
constexpr std::int64_t in_a_second = 1'000'000'000;

using PoseMessage = geometry_msgs_msg_dds__PoseStamped_;
using OdometryMessage = nav_msgs_msg_dds__Odometry_;
using TwistMessage = geometry_msgs_msg_dds__Twist_;
using TwistStampedMessage = geometry_msgs_msg_dds__TwistStamped_;
using TransformMessage = geometry_msgs_msg_dds__TransformStamped_;

// Cyclone DDS says what is wrong with a negative number.
dds_entity_t sound(dds_entity_t entity, const std::string& what) {
  if (entity < 0) throw NodeError(what + ": " + dds_strretcode(entity));
  return entity;
}

struct FreeQos {
  void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, FreeQos>;

// ROS 2 speaks the first version of the extended encoding.
Qos quality(dds_reliability_kind_t reliability, std::int32_t kept) {
  Qos qos(dds_create_qos());
  const dds_data_representation_id_t encoding = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &encoding);
  dds_qset_reliability(qos.get(), reliability, DDS_MSECS(10));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kept);
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  return qos;
}
// Those who come later get the last one, too.
Qos quality_of_discovery() {
  Qos qos = quality(DDS_RELIABILITY_RELIABLE, 1);
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED);
  return qos;
}

// What rmw_cyclonedds sets for LOCALHOST, and that nothing is sent by another interface.
constexpr const char* on_this_computer =
    "<CycloneDDS><Domain><General><AllowMulticast>false</AllowMulticast>"
    "<Interfaces><NetworkInterface address=\"127.0.0.1\" multicast=\"false\"/></Interfaces></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
    "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>";

dds_entity_t join(const Options& options) {
  if (!options.localhost) return DDS_ENTITY_NIL;  // as CYCLONEDDS_URI says
  const char* given = std::getenv("CYCLONEDDS_URI");
  const std::string configuration = std::string(on_this_computer) + (given == nullptr ? "" : std::string(",") + given);
  return sound(dds_create_domain(options.domain, configuration.c_str()), "domain " + std::to_string(options.domain));
}

dds_entity_t create_participant(const Options& options) {
  Qos qos(dds_create_qos());
  static constexpr std::string_view enclave = "enclave=/;";  // without it, ROS 2 takes this for no node
  dds_qset_userdata(qos.get(), enclave.data(), enclave.size());
  return sound(dds_create_participant(options.domain, qos.get(), nullptr), "domain " + std::to_string(options.domain));
}

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

// Hands out what a reader has; dds_take lends its samples.
template <class Message, class Use> void take_all(dds_entity_t reader, const Use& use) {
  constexpr std::uint32_t at_once = 16;
  for (;;) {
    std::array<void*, at_once> samples{};
    std::array<dds_sample_info_t, at_once> infos{};
    const dds_return_t count = dds_take(reader, samples.data(), infos.data(), at_once, at_once);
    if (count <= 0) return;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
      if (infos.at(k).valid_data) use(*static_cast<const Message*>(samples.at(k)));
    static_cast<void>(dds_return_loan(reader, samples.data(), count));
  }
}

// The message that says which node has these readers and writers; before and since ROS 2 Iron.
struct OfNow {
  using Gid = rmw_dds_common_msg_dds__Gid_;
  using NodeInfo = rmw_dds_common_msg_dds__NodeEntitiesInfo_;
  using Message = rmw_dds_common_msg_dds__ParticipantEntitiesInfo_;
  static const dds_topic_descriptor_t& descriptor() { return rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc; }
};
struct OfHumble {
  using Gid = humble_rmw_dds_common_msg_dds__Gid_;
  using NodeInfo = humble_rmw_dds_common_msg_dds__NodeEntitiesInfo_;
  using Message = humble_rmw_dds_common_msg_dds__ParticipantEntitiesInfo_;
  static const dds_topic_descriptor_t& descriptor() {
    static const dds_topic_descriptor_t renamed = [] {
      dds_topic_descriptor_t copy = humble_rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc;
      copy.m_typename = rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc.m_typename;
      return copy;
    }();
    return renamed;
  }
};

template <class Of> typename Of::Gid gid_of(dds_entity_t entity) {
  dds_guid_t guid{};
  sound(dds_get_guid(entity, &guid), "identifier");
  typename Of::Gid gid{};
  std::memcpy(gid.data, guid.v, sizeof guid.v);
  return gid;
}

template <class Of>
void introduce(dds_entity_t writer, dds_entity_t participant, const std::string& name,
               const std::vector<dds_entity_t>& readers, const std::vector<dds_entity_t>& writers) {
  std::vector<typename Of::Gid> reader_gids, writer_gids;
  for (const dds_entity_t entity : readers) reader_gids.push_back(gid_of<Of>(entity));
  for (const dds_entity_t entity : writers) writer_gids.push_back(gid_of<Of>(entity));
  const auto sequence = [](auto& into, auto& list) {
    into._length = into._maximum = static_cast<std::uint32_t>(list.size());
    into._buffer = list.data();
  };
  typename Of::NodeInfo node{};
  node.node_namespace[0] = '/';
  name.copy(node.node_name, sizeof node.node_name - 1);
  sequence(node.reader_gid_seq, reader_gids);
  sequence(node.writer_gid_seq, writer_gids);
  typename Of::Message message{};
  message.gid = gid_of<Of>(participant);
  message.node_entities_info_seq._length = message.node_entities_info_seq._maximum = 1;
  message.node_entities_info_seq._buffer = &node;
  sound(dds_write(writer, &message), "ros_discovery_info");
}

}  // namespace

struct RosNode::Parts {
  explicit Parts(const Options& options) : stamped(options.stamped), frame(options.frame) {
    if (wake < 0) throw NodeError(std::string("eventfd: ") + std::strerror(errno));
    domain = join(options);
    participant = create_participant(options);
    listener = dds_create_listener(this);
    dds_lset_data_available(listener, [](dds_entity_t /*reader*/, void* self) { static_cast<Parts*>(self)->call(); });
    for (std::size_t id = options.first; id < options.first + options.robots; ++id) add_robot(options, id);
    if (options.tf) transforms = write("/tf", tf2_msgs_msg_dds__TFMessage__desc, tf_depth);
    introduce_node(options);
  }
  ~Parts() {
    // Deleting waits for callbacks that are under way.
    dds_delete(participant);
    if (domain != DDS_ENTITY_NIL) dds_delete(domain);
    dds_delete_listener(listener);
    if (wake >= 0) ::close(wake);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void add_robot(const Options& options, std::size_t id) {
    if (!options.pose_topic.empty())
      poses.push_back(read(of_robot(options.pose_topic, id), geometry_msgs_msg_dds__PoseStamped__desc));
    if (!options.odometry_topic.empty())
      odometry.push_back(read(of_robot(options.odometry_topic, id), nav_msgs_msg_dds__Odometry__desc));
    if (options.bases.empty()) return;
    commands.push_back(write(of_robot(options.command_topic, id),
                             stamped ? geometry_msgs_msg_dds__TwistStamped__desc : geometry_msgs_msg_dds__Twist__desc,
                             depth));
  }

  dds_entity_t topic(const std::string& name, const dds_topic_descriptor_t& descriptor) const {
    return sound(dds_create_topic(participant, &descriptor, name.c_str(), nullptr, nullptr), name);
  }
  // Best effort, which any publisher can serve; a pose that was lost is overtaken by the next.
  dds_entity_t read(const std::string& name, const dds_topic_descriptor_t& descriptor) {
    const Qos qos = quality(DDS_RELIABILITY_BEST_EFFORT, depth);
    readers.push_back(
        sound(dds_create_reader(participant, topic(dds_topic(name), descriptor), qos.get(), listener), name));
    return readers.back();
  }
  dds_entity_t write(const std::string& name, const dds_topic_descriptor_t& descriptor, std::int32_t kept) {
    const Qos qos = quality(DDS_RELIABILITY_RELIABLE, kept);
    writers.push_back(
        sound(dds_create_writer(participant, topic(dds_topic(name), descriptor), qos.get(), nullptr), name));
    return writers.back();
  }

  void introduce_node(const Options& options) const {
    const Qos qos = quality_of_discovery();
    const dds_topic_descriptor_t& descriptor = options.humble ? OfHumble::descriptor() : OfNow::descriptor();
    const dds_entity_t writer =
        sound(dds_create_writer(participant, topic("ros_discovery_info", descriptor), qos.get(), nullptr),
              "ros_discovery_info");
    if (options.humble) introduce<OfHumble>(writer, participant, options.node, readers, writers);
    else introduce<OfNow>(writer, participant, options.node, readers, writers);
  }

  void call() const noexcept {
    const std::uint64_t one = 1;
    static_cast<void>(::write(wake, &one, sizeof one));
  }
  void count(dds_return_t written) noexcept { unsent += written < 0 ? 1 : 0; }

  int wake = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  bool stamped;
  std::string frame;
  dds_entity_t domain = DDS_ENTITY_NIL, participant = DDS_ENTITY_NIL, transforms = DDS_ENTITY_NIL;
  dds_listener_t* listener = nullptr;
  std::vector<dds_entity_t> readers, writers;           // all of them
  std::vector<dds_entity_t> poses, odometry, commands;  // by robot
  std::uint64_t unsent = 0;
};

RosNode::RosNode(const Options& options) : parts_(std::make_unique<Parts>(options)) {}
RosNode::~RosNode() = default;

int RosNode::descriptor() const noexcept { return parts_->wake; }

void RosNode::listen(const Take& take) {
  std::uint64_t calls = 0;
  static_cast<void>(::read(parts_->wake, &calls, sizeof calls));
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
