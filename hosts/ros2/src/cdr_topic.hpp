// SPDX-License-Identifier: MIT
// Topics whose messages come in CDR already, of any type without a key. Cyclone DDS is told of a type by functions of
// its own, as rmw_cyclonedds does it.
#pragma once

#include <dds/dds.h>

#include <string_view>

struct ddsi_sertype;

namespace banyan::ros2 {

class CdrTopic {
 public:
  // `name` and `type` as DDS has them ("rt/tf", "tf2_msgs::msg::dds_::TFMessage_"). Throws NodeError.
  CdrTopic(dds_entity_t participant, const char* name, const char* type);
  [[nodiscard]] dds_entity_t entity() const noexcept { return topic_; }
  // `cdr` begins with the header that says how it is encoded. False: it was not taken in time.
  [[nodiscard]] bool write(dds_entity_t writer, std::string_view cdr) const;

 private:
  ddsi_sertype* type_ = nullptr;  // the topic's own
  dds_entity_t topic_;
};

}  // namespace banyan::ros2
