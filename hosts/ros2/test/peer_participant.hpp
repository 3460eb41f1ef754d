// SPDX-License-Identifier: MIT
// The other side of the tests: a participant of another implementation of DDS (eProsima Fast DDS), and what it finds.
#pragma once

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <cstdio>
#include <mutex>
#include <set>
#include <stdexcept>

#include "peer_messages.hpp"

namespace banyan::ros2::peer {

using namespace eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

inline std::string hex(const std::uint8_t* bytes, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) {
    std::array<char, 3> digits{};
    std::snprintf(digits.data(), digits.size(), "%02x", bytes[k]);
    text += digits.data();
  }
  return text;
}
inline std::string hex(const rtps::GUID_t& guid) {
  return hex(guid.guidPrefix.value, 12) + hex(guid.entityId.value, 4);
}

// What discovery tells of others: the source of ROS 2's graph of topics.
class Discovery final : public DomainParticipantListener {
 public:
  void on_participant_discovery(DomainParticipant* /*own*/, rtps::ParticipantDiscoveryInfo&& info) override {
    if (info.status != rtps::ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT) return;
    const std::lock_guard lock(mutex_);
    const auto& data = info.info.m_userData;
    lines_.insert("participant " + std::string(data.begin(), data.end()));
    guids_.insert(hex(info.info.m_guid));
  }
  void on_subscriber_discovery(DomainParticipant* own, rtps::ReaderDiscoveryInfo&& info) override {
    if (info.status == rtps::ReaderDiscoveryInfo::DISCOVERED_READER) note(*own, "reader ", info.info);
  }
  void on_publisher_discovery(DomainParticipant* own, rtps::WriterDiscoveryInfo&& info) override {
    if (info.status == rtps::WriterDiscoveryInfo::DISCOVERED_WRITER) note(*own, "writer ", info.info);
  }
  [[nodiscard]] bool knows(const std::string& guid) const {
    const std::lock_guard lock(mutex_);
    return guids_.contains(guid);
  }
  [[nodiscard]] std::set<std::string> lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

 private:
  template <class Data> void note(const DomainParticipant& own, const std::string& kind, const Data& data) {
    if (data.guid().guidPrefix == own.guid().guidPrefix) return;
    const std::lock_guard lock(mutex_);
    guids_.insert(hex(data.guid()));
    const auto durability = data.m_qos.m_durability.kind;
    lines_.insert(kind + data.topicName().to_string() + " " + data.typeName().to_string() +
                  (data.m_qos.m_reliability.kind == RELIABLE_RELIABILITY_QOS ? " reliable" : " best-effort") +
                  (durability == VOLATILE_DURABILITY_QOS          ? " volatile"
                   : durability == TRANSIENT_LOCAL_DURABILITY_QOS ? " transient-local"
                                                                  : " other") +
                  (data.topicKind() == rtps::NO_KEY ? "" : " keyed") +
                  (data.m_qos.m_partition.empty() ? "" : " partition"));
  }
  mutable std::mutex mutex_;
  std::set<std::string> lines_, guids_;
};

enum class Reading : std::uint8_t {
  all,     // reliable
  late,    // reliable, with what was published before
  newest,  // best effort, as sensor data and clocks are read
};

// On loopback alone.
class Participant {
 public:
  Participant(std::uint32_t domain, Discovery& discovery) {
    DomainParticipantQos qos = PARTICIPANT_QOS_DEFAULT;
    const auto loopback = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    loopback->interfaceWhiteList.emplace_back("127.0.0.1");
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(loopback);
    rtps::Locator_t neighbour;
    rtps::IPLocator::setIPv4(neighbour, "127.0.0.1");
    qos.wire_protocol().builtin.initialPeersList.push_back(neighbour);
    qos.wire_protocol().builtin.discovery_config.initial_announcements.count = 50;
    participant_ =
        DomainParticipantFactory::get_instance()->create_participant(domain, qos, &discovery, StatusMask::none());
    if (participant_ == nullptr) throw std::runtime_error("no participant");
    publisher_ = participant_->create_publisher(PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
  }
  ~Participant() {
    participant_->delete_contained_entities();
    DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  // With rclcpp's default quality of service.
  template <class Message> DataWriter* writer(const std::string& name) {
    DataWriterQos qos = DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = VOLATILE_DURABILITY_QOS;
    qos.history().kind = KEEP_LAST_HISTORY_QOS;
    qos.history().depth = 10;
    return publisher_->create_datawriter(topic<Message>(name), qos);
  }
  template <class Message> DataReader* reader(const std::string& name, Reading how = Reading::all) {
    DataReaderQos qos = DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = how == Reading::newest ? BEST_EFFORT_RELIABILITY_QOS : RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = how == Reading::late ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
    qos.history().kind = KEEP_LAST_HISTORY_QOS;
    qos.history().depth = 100;
    return subscriber_->create_datareader(topic<Message>(name), qos);
  }

 private:
  template <class Message> Topic* topic(const std::string& name) {
    TypeSupport type(new DataType<Message>);
    type.register_type(participant_);
    return participant_->create_topic(name, Message::type, TOPIC_QOS_DEFAULT);
  }
  DomainParticipant* participant_ = nullptr;
  Publisher* publisher_ = nullptr;
  Subscriber* subscriber_ = nullptr;
};

template <class Message, class Use> void take_all(DataReader* reader, const Use& use) {
  Message message;
  SampleInfo info;
  while (reader->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK)
    if (info.valid_data) use(message);
}

// The nodes of the others, and whether discovery knows all readers and writers that are said to be theirs.
template <std::size_t Size> void print_nodes(DataReader* reader, const Discovery& discovery) {
  using Info = ParticipantEntitiesInfo<Size>;
  take_all<Info>(reader, [&](const Info& info) {
    for (const auto& node : info.nodes) {
      std::size_t strangers = discovery.knows(hex(info.gid.data(), 16)) ? 0 : 1;
      for (const auto* list : {&node.readers, &node.writers})
        for (const auto& gid : *list) strangers += discovery.knows(hex(gid.data(), 16)) ? 0 : 1;
      std::printf("node %s %s: %zu readers, %zu writers, %zu unknown\n", node.space.c_str(), node.name.c_str(),
                  node.readers.size(), node.writers.size(), strangers);
    }
  });
}

}  // namespace banyan::ros2::peer
