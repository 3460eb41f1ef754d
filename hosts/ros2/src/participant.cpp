// SPDX-License-Identifier: MIT
#include "participant.hpp"

#include <ros2_messages.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "banyan/hosts/ros2/names.hpp"

namespace banyan::ros2 {
namespace {

// What rmw_cyclonedds sets for LOCALHOST, and that nothing is sent by another interface.
constexpr const char* on_this_computer =
    "<CycloneDDS><Domain><General><AllowMulticast>false</AllowMulticast>"
    "<Interfaces><NetworkInterface address=\"127.0.0.1\" multicast=\"false\"/></Interfaces></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
    "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>";

// What rmw_cyclonedds sets for ROS_STATIC_PEERS.
std::string with_peers(const std::vector<std::string>& peers) {
  std::string text =
      "<CycloneDDS><Domain><Discovery><ParticipantIndex>auto</ParticipantIndex>"
      "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex><Peers>";
  for (const std::string& peer : peers) text += "<Peer address=\"" + peer + "\"/>";
  return text + "</Peers></Discovery></Domain></CycloneDDS>";
}

dds_entity_t join(const Options& options) {
  if (!options.localhost && options.peers.empty()) return DDS_ENTITY_NIL;  // as CYCLONEDDS_URI says
  const char* given = std::getenv("CYCLONEDDS_URI");
  const std::string own = options.localhost ? on_this_computer : with_peers(options.peers);
  const std::string configuration = own + (given == nullptr ? "" : std::string(",") + given);
  return sound(dds_create_domain(options.domain, configuration.c_str()), "domain " + std::to_string(options.domain));
}

dds_entity_t create_participant(const Options& options) {
  Qos qos(dds_create_qos());
  static constexpr std::string_view enclave = "enclave=/;";  // without it, ROS 2 takes this for no node
  dds_qset_userdata(qos.get(), enclave.data(), enclave.size());
  return sound(dds_create_participant(options.domain, qos.get(), nullptr), "domain " + std::to_string(options.domain));
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
void introduce_as(dds_entity_t writer, dds_entity_t participant, const std::string& name,
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

dds_entity_t sound(dds_entity_t entity, const std::string& what) {
  if (entity < 0) throw NodeError(what + ": " + dds_strretcode(entity));
  return entity;
}

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

Qos lasting_quality(std::int32_t kept) {
  Qos qos = quality(DDS_RELIABILITY_RELIABLE, kept);
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, kept, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED);
  return qos;
}

DdsParticipant::DdsParticipant(const Options& options)
    : wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)), node_(options.node), humble_(options.humble) {
  if (wake_ < 0) throw NodeError(std::string("eventfd: ") + std::strerror(errno));
  domain_ = join(options);
  participant_ = create_participant(options);
  listener_ = dds_create_listener(this);
  dds_lset_data_available(listener_, [](dds_entity_t /*reader*/, void* self) {
    const std::uint64_t one = 1;
    static_cast<void>(::write(static_cast<DdsParticipant*>(self)->wake_, &one, sizeof one));
  });
}

DdsParticipant::~DdsParticipant() {
  // Deleting waits for callbacks that are under way.
  dds_delete(participant_);
  if (domain_ != DDS_ENTITY_NIL) dds_delete(domain_);
  dds_delete_listener(listener_);
  ::close(wake_);
}

void DdsParticipant::reset() const noexcept {
  std::uint64_t calls = 0;
  static_cast<void>(::read(wake_, &calls, sizeof calls));
}

dds_entity_t DdsParticipant::topic(const std::string& name, const dds_topic_descriptor_t& descriptor) const {
  return sound(dds_create_topic(participant_, &descriptor, name.c_str(), nullptr, nullptr), name);
}

dds_entity_t DdsParticipant::read(const std::string& name, const dds_topic_descriptor_t& descriptor, const Qos& qos) {
  readers_.push_back(
      sound(dds_create_reader(participant_, topic(dds_topic(name), descriptor), qos.get(), listener_), name));
  return readers_.back();
}

dds_entity_t DdsParticipant::write(const std::string& name, const dds_topic_descriptor_t& descriptor, const Qos& qos) {
  return write(name, topic(dds_topic(name), descriptor), qos);
}

dds_entity_t DdsParticipant::write(const std::string& name, dds_entity_t topic, const Qos& qos) {
  writers_.push_back(sound(dds_create_writer(participant_, topic, qos.get(), nullptr), name));
  return writers_.back();
}

void DdsParticipant::introduce() {
  const char* name = "ros_discovery_info";
  if (introduction_ == DDS_ENTITY_NIL)
    introduction_ =
        sound(dds_create_writer(participant_, topic(name, humble_ ? OfHumble::descriptor() : OfNow::descriptor()),
                                lasting_quality(1).get(), nullptr),
              name);
  if (humble_) introduce_as<OfHumble>(introduction_, participant_, node_, readers_, writers_);
  else introduce_as<OfNow>(introduction_, participant_, node_, readers_, writers_);
}

}  // namespace banyan::ros2
