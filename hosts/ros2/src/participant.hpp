// SPDX-License-Identifier: MIT
// What makes a DDS participant a node of ROS 2: how it joins, qualities of service, and how it introduces itself.
// Behind node.hpp and swarm_node.hpp: with Eclipse Cyclone DDS, by its C interface.
#pragma once

#include <dds/dds.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "banyan/hosts/ros2/node.hpp"

namespace banyan::ros2 {

// Throws NodeError where Cyclone DDS says by a negative number that something is wrong.
dds_entity_t sound(dds_entity_t entity, const std::string& what);

struct FreeQos {
  void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, FreeQos>;

constexpr std::int32_t usual_depth = 10;  // of rclcpp's default quality of service
constexpr std::int32_t tf_depth = 100;    // of tf2_ros

// Volatile, the last `kept` of each topic, in the first version of the extended encoding, as ROS 2 speaks it.
[[nodiscard]] Qos quality(dds_reliability_kind_t reliability, std::int32_t kept);
// Those who come later get the last `kept`, too.
[[nodiscard]] Qos lasting_quality(std::int32_t kept);

class DdsParticipant {
 public:
  // Throws NodeError.
  explicit DdsParticipant(const Options& options);
  ~DdsParticipant();
  DdsParticipant(const DdsParticipant&) = delete;
  DdsParticipant& operator=(const DdsParticipant&) = delete;

  [[nodiscard]] dds_entity_t entity() const noexcept { return participant_; }
  // Can be read when something has arrived; reset() then.
  [[nodiscard]] int descriptor() const noexcept { return wake_; }
  void reset() const noexcept;

  // `name`: as ROS 2 has it.
  dds_entity_t read(const std::string& name, const dds_topic_descriptor_t& descriptor, const Qos& qos);
  dds_entity_t write(const std::string& name, const dds_topic_descriptor_t& descriptor, const Qos& qos);
  dds_entity_t write(const std::string& name, dds_entity_t topic, const Qos& qos);
  // Says whose readers and writers these are, again after more have come.
  void introduce();

 private:
  [[nodiscard]] dds_entity_t topic(const std::string& name, const dds_topic_descriptor_t& descriptor) const;

  int wake_;
  std::string node_;
  bool humble_;
  dds_entity_t domain_ = DDS_ENTITY_NIL, participant_ = DDS_ENTITY_NIL, introduction_ = DDS_ENTITY_NIL;
  dds_listener_t* listener_ = nullptr;
  std::vector<dds_entity_t> readers_, writers_;
};

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

}  // namespace banyan::ros2
