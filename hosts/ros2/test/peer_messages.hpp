// SPDX-License-Identifier: MIT
// Messages of ROS 2 for Fast DDS, written field by field from the public .msg files and from nothing of ours: if
// ros2_messages.idl is wrong, the two do not understand each other.
#pragma once

#include <fastcdr/Cdr.h>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace banyan::ros2::peer {

using Cdr = eprosima::fastcdr::Cdr;

struct Header {  // std_msgs/Header
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  std::string frame_id;
  void write(Cdr& to) const { to << sec << nanosec << frame_id; }
  void read(Cdr& from) { from >> sec >> nanosec >> frame_id; }
};
struct Pose {  // geometry_msgs/Pose: position x y z, orientation x y z w
  std::array<double, 7> values{0, 0, 0, 0, 0, 0, 1};
  void write(Cdr& to) const { to << values; }
};
struct PoseStamped {
  static constexpr const char* type = "geometry_msgs::msg::dds_::PoseStamped_";
  Header header;
  Pose pose;
  void write(Cdr& to) const {
    header.write(to);
    pose.write(to);
  }
  void read(Cdr& /*from*/) {}
};
struct Odometry {  // nav_msgs/Odometry
  static constexpr const char* type = "nav_msgs::msg::dds_::Odometry_";
  Header header;
  std::string child_frame_id;
  Pose pose;
  void write(Cdr& to) const {
    const std::array<double, 36> covariance{};
    header.write(to);
    to << child_frame_id;
    pose.write(to);
    to << covariance << twist << covariance;
  }
  void read(Cdr& from) {
    std::array<double, 36> covariance{};
    header.read(from);
    from >> child_frame_id >> pose.values >> covariance >> twist >> covariance;
  }
  std::array<double, 6> twist{};  // linear x y z, angular x y z
};
struct Twist {  // linear x y z, angular x y z
  static constexpr const char* type = "geometry_msgs::msg::dds_::Twist_";
  std::array<double, 6> values{};
  void write(Cdr& /*to*/) const {}
  void read(Cdr& from) { from >> values; }
};
struct TwistStamped {
  static constexpr const char* type = "geometry_msgs::msg::dds_::TwistStamped_";
  Header header;
  std::array<double, 6> values{};
  void write(Cdr& /*to*/) const {}
  void read(Cdr& from) {
    header.read(from);
    from >> values;
  }
};
struct TFMessage {
  static constexpr const char* type = "tf2_msgs::msg::dds_::TFMessage_";
  struct Transform {
    Header header;
    std::string child_frame_id;
    std::array<double, 7> values{};  // translation x y z, rotation x y z w
  };
  std::vector<Transform> transforms;
  void write(Cdr& /*to*/) const {}
  void read(Cdr& from) {
    std::uint32_t count = 0;
    from >> count;
    transforms.assign(count, {});
    for (Transform& t : transforms) {
      t.header.read(from);
      from >> t.child_frame_id >> t.values;
    }
  }
};
struct Clock {  // rosgraph_msgs/Clock
  static constexpr const char* type = "rosgraph_msgs::msg::dds_::Clock_";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  void write(Cdr& /*to*/) const {}
  void read(Cdr& from) { from >> sec >> nanosec; }
};
struct PointStamped {
  static constexpr const char* type = "geometry_msgs::msg::dds_::PointStamped_";
  Header header;
  std::array<double, 3> values{};
  void write(Cdr& to) const {
    header.write(to);
    to << values;
  }
  void read(Cdr& /*from*/) {}
};
struct String {
  static constexpr const char* type = "std_msgs::msg::dds_::String_";
  std::string data;
  void write(Cdr& to) const { to << data; }
  void read(Cdr& /*from*/) {}
};
struct Log {  // rcl_interfaces/Log
  static constexpr const char* type = "rcl_interfaces::msg::dds_::Log_";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0, line = 0;
  std::uint8_t level = 0;
  std::string name, text, file, function;
  void write(Cdr& /*to*/) const {}
  void read(Cdr& from) { from >> sec >> nanosec >> level >> name >> text >> file >> function >> line; }
};
struct DiagnosticArray {
  static constexpr const char* type = "diagnostic_msgs::msg::dds_::DiagnosticArray_";
  struct Status {
    std::uint8_t level = 0;
    std::string name, message, hardware_id;
    std::vector<std::array<std::string, 2>> values;
  };
  Header header;
  std::vector<Status> list;
  void write(Cdr& /*to*/) const {}
  void read(Cdr& from) {
    std::uint32_t count = 0;
    header.read(from);
    from >> count;
    list.assign(count, {});
    for (Status& status : list) {
      from >> status.level >> status.name >> status.message >> status.hardware_id >> count;
      status.values.assign(count, {});
      for (auto& [key, value] : status.values) from >> key >> value;
    }
  }
};
struct MarkerArray {  // visualization_msgs, since ROS 2 Humble
  static constexpr const char* type = "visualization_msgs::msg::dds_::MarkerArray_";
  struct Marker {
    Header header, texture_header;
    std::string ns, texture_resource, texture_format, text, mesh_resource, mesh_filename;
    std::int32_t id = 0, type = 0, action = 0, lifetime_sec = 0;
    std::uint32_t lifetime_nanosec = 0;
    std::array<double, 7> pose{};
    std::array<double, 3> scale{};
    std::array<float, 4> color{};
    bool frame_locked = false, mesh_use_embedded_materials = false;
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<float, 4>> colors;
    std::vector<std::array<float, 2>> uv_coordinates;
    std::vector<std::uint8_t> texture_data, mesh_data;
    void read(Cdr& from) {
      header.read(from);
      from >> ns >> id >> type >> action >> pose >> scale >> color >> lifetime_sec >> lifetime_nanosec >> frame_locked;
      read_list(from, points);
      read_list(from, colors);
      from >> texture_resource;
      texture_header.read(from);
      from >> texture_format >> texture_data;
      read_list(from, uv_coordinates);
      from >> text >> mesh_resource >> mesh_filename >> mesh_data >> mesh_use_embedded_materials;
    }
    template <class List> static void read_list(Cdr& from, List& list) {
      std::uint32_t count = 0;
      from >> count;
      list.assign(count, {});
      for (auto& one : list) from >> one;
    }
  };
  std::vector<Marker> markers;
  void write(Cdr& /*to*/) const {}
  void read(Cdr& from) {
    std::uint32_t count = 0;
    from >> count;
    markers.assign(count, {});
    for (Marker& marker : markers) marker.read(from);
  }
};
// Size: of an identifier, 24 bytes in ROS 2 Humble and older, 16 since.
template <std::size_t Size> struct ParticipantEntitiesInfo {
  static constexpr const char* type = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";
  using Gid = std::array<std::uint8_t, Size>;
  struct Node {
    std::string space, name;
    std::vector<Gid> readers, writers;
  };
  Gid gid{};
  std::vector<Node> nodes;
  void write(Cdr& /*to*/) const {}
  void read(Cdr& from) {
    std::uint32_t count = 0;
    from >> gid >> count;
    nodes.assign(count, {});
    for (Node& node : nodes) {
      from >> node.space >> node.name;
      for (std::vector<Gid>* list : {&node.readers, &node.writers}) {
        from >> count;
        list->assign(count, {});
        for (Gid& one : *list) from >> one;
      }
    }
  }
};

// What Fast DDS asks of a type; as in ROS 2, without a key and without a description of the type.
template <class Message> class DataType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  DataType() {
    setName(Message::type);
    m_typeSize = largest;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
  bool serialize(void* data, Payload* payload) override {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
    Cdr to(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    payload->encapsulation = to.endianness() == Cdr::BIG_ENDIANNESS ? CDR_BE : CDR_LE;
    to.serialize_encapsulation();
    static_cast<const Message*>(data)->write(to);
    payload->length = static_cast<std::uint32_t>(to.getSerializedDataLength());
    return true;
  }
  bool deserialize(Payload* payload, void* data) override {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
    Cdr from(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    from.read_encapsulation();
    static_cast<Message*>(data)->read(from);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* /*data*/) override {
    return [] { return largest; };
  }
  void* createData() override { return new Message; }
  void deleteData(void* data) override { delete static_cast<Message*>(data); }
  bool getKey(void* /*data*/, eprosima::fastrtps::rtps::InstanceHandle_t* /*key*/, bool /*md5*/) override {
    return false;
  }

 private:
  static constexpr std::uint32_t largest = 1U << 20U;
};

}  // namespace banyan::ros2::peer
