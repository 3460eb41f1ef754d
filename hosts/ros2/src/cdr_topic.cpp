// SPDX-License-Identifier: MIT
#include "cdr_topic.hpp"

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include "participant.hpp"

namespace banyan::ros2 {
namespace {

// The functions below are called by C: none of them may throw but by ending the program for want of memory.
// Nobody reads such a topic in this process, so what makes samples of bytes is never called.

struct CdrMessage : ddsi_serdata {
  CdrMessage(const ddsi_sertype* type, ddsi_serdata_kind what, std::string_view cdr) : ddsi_serdata{}, bytes(cdr) {
    ddsi_serdata_init(this, type, what);
    bytes.resize((bytes.size() + 3) / 4 * 4);  // as far as DDS reads
  }
  std::string bytes;
};

// In C's way of deriving, no cast is checked. NOLINTBEGIN(cppcoreguidelines-pro-type-static-cast-downcast)
const CdrMessage& message_of(const ddsi_serdata* data) noexcept { return *static_cast<const CdrMessage*>(data); }
void free_message(ddsi_serdata* data) noexcept { delete static_cast<CdrMessage*>(data); }
// NOLINTEND(cppcoreguidelines-pro-type-static-cast-downcast)

const ddsi_serdata_ops message_functions = [] {
  ddsi_serdata_ops all{};
  all.eqkey = [](const ddsi_serdata* /*a*/, const ddsi_serdata* /*b*/) { return true; };
  all.get_size = [](const ddsi_serdata* data) { return static_cast<std::uint32_t>(message_of(data).bytes.size()); };
  all.from_ser = [](const ddsi_sertype* /*type*/, ddsi_serdata_kind /*kind*/, const auto* /*parts*/,
                    std::size_t /*size*/) -> ddsi_serdata* { return nullptr; };
  all.from_ser_iov = [](const ddsi_sertype* /*type*/, ddsi_serdata_kind /*kind*/, ddsrt_msg_iovlen_t /*count*/,
                        const ddsrt_iovec_t* /*parts*/, std::size_t /*size*/) -> ddsi_serdata* { return nullptr; };
  all.from_keyhash = [](const ddsi_sertype* type, const ddsi_keyhash* /*hash*/) -> ddsi_serdata* {
    return new CdrMessage(type, SDK_KEY, {});
  };
  all.from_sample = [](const ddsi_sertype* type, ddsi_serdata_kind kind, const void* /*sample*/) -> ddsi_serdata* {
    return new CdrMessage(type, kind, {});
  };
  all.to_ser = [](const ddsi_serdata* data, std::size_t from, std::size_t size, void* to) {
    std::memcpy(to, message_of(data).bytes.data() + from, size);
  };
  all.to_ser_ref = [](const ddsi_serdata* data, std::size_t from, std::size_t size, ddsrt_iovec_t* to) {
    to->iov_base = const_cast<char*>(message_of(data).bytes.data()) + from;
    to->iov_len = static_cast<ddsrt_iov_len_t>(size);
    return ddsi_serdata_ref(data);
  };
  all.to_ser_unref = [](ddsi_serdata* data, const ddsrt_iovec_t* /*given*/) { ddsi_serdata_unref(data); };
  all.to_sample = [](const ddsi_serdata* /*data*/, void* /*sample*/, void** /*room*/, void* /*end*/) { return false; };
  all.to_untyped = [](const ddsi_serdata* data) -> ddsi_serdata* {
    auto key = std::make_unique<CdrMessage>(data->type, SDK_KEY, std::string_view());
    key->type = nullptr;
    return key.release();
  };
  all.untyped_to_sample = [](const ddsi_sertype* /*type*/, const ddsi_serdata* /*data*/, void* /*sample*/,
                             void** /*room*/, void* /*end*/) { return true; };
  all.free = free_message;
  all.print = [](const ddsi_sertype* /*type*/, const ddsi_serdata* /*data*/, char* text, std::size_t size) {
    if (size > 0) *text = '\0';
    return std::size_t{0};
  };
  all.get_keyhash = [](const ddsi_serdata* /*data*/, ddsi_keyhash* hash, bool /*md5*/) {
    std::memset(hash, 0, sizeof *hash);
  };
  return all;
}();

const ddsi_sertype_ops type_functions = [] {
  ddsi_sertype_ops all{};
  all.version = ddsi_sertype_v0;
  all.free = [](ddsi_sertype* type) {
    ddsi_sertype_fini(type);
    delete type;
  };
  all.zero_samples = [](const ddsi_sertype* /*type*/, void* /*samples*/, std::size_t /*count*/) {};
  all.realloc_samples = [](void** list, const ddsi_sertype* /*type*/, void* /*old*/, std::size_t /*was*/,
                           std::size_t count) { std::fill_n(list, count, nullptr); };
  all.free_samples = [](const ddsi_sertype* /*type*/, void** /*list*/, std::size_t /*count*/, dds_free_op_t /*how*/) {};
  all.equal = [](const ddsi_sertype* /*a*/, const ddsi_sertype* /*b*/) { return true; };  // whose names are equal
  all.hash = [](const ddsi_sertype* /*type*/) { return std::uint32_t{0}; };
  all.get_serialized_size = [](const ddsi_sertype* /*type*/, const void* /*sample*/) { return std::size_t{0}; };
  all.serialize_into = [](const ddsi_sertype* /*type*/, const void* /*sample*/, void* /*to*/, std::size_t /*size*/) {
    return false;
  };
  return all;
}();

}  // namespace

CdrTopic::CdrTopic(dds_entity_t participant, const char* name, const char* type) {
  type_ = new ddsi_sertype{};  // the domain owns it once there is a topic, and may give back one that is its equal
  ddsi_sertype_init_flags(type_, type, &type_functions, &message_functions, DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  type_->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  topic_ = dds_create_topic_sertype(participant, name, &type_, nullptr, nullptr, nullptr);
  if (topic_ < 0) ddsi_sertype_unref(type_);
  sound(topic_, name);
}

bool CdrTopic::write(dds_entity_t writer, std::string_view cdr) const {
  return dds_writecdr(writer, new CdrMessage(type_, SDK_DATA, cdr)) == DDS_RETCODE_OK;
}

}  // namespace banyan::ros2
