// SPDX-License-Identifier: MIT
// MCAP's little-endian fields: appended to a string, and read back with every length checked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "banyan/record/mcap.hpp"

namespace banyan::record::mcap {

// clang-format off
enum class Op : std::uint8_t {
  header = 0x01, footer, schema, channel, message, chunk, message_index, chunk_index, attachment,
  attachment_index, statistics, metadata, metadata_index, summary_offset, data_end
};
// clang-format on

inline constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
inline constexpr std::uint64_t record_header_bytes = 9;  // opcode, length

template <class Unsigned> void put(std::string& out, Unsigned value) {
  for (std::size_t k = 0; k < sizeof(Unsigned); ++k) out.push_back(static_cast<char>(value >> (8 * k)));
}
inline void put_string(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out.append(text);
}
// A record whose length is filled in when its content is known.
class RecordScope {
 public:
  RecordScope(std::string& out, Op op) : out_(out) {
    put(out_, static_cast<std::uint8_t>(op));
    put(out_, std::uint64_t{0});
    begin_ = out_.size();
  }
  RecordScope(const RecordScope&) = delete;
  RecordScope& operator=(const RecordScope&) = delete;
  ~RecordScope() {
    const std::uint64_t length = out_.size() - begin_;
    for (std::size_t k = 0; k < 8; ++k) out_[begin_ - 8 + k] = static_cast<char>(length >> (8 * k));
  }

 private:
  std::string& out_;
  std::size_t begin_;
};
// The byte length in front of a map or array, filled in like a record's.
class LengthScope {
 public:
  explicit LengthScope(std::string& out) : out_(out) {
    put(out_, std::uint32_t{0});
    begin_ = out_.size();
  }
  LengthScope(const LengthScope&) = delete;
  LengthScope& operator=(const LengthScope&) = delete;
  ~LengthScope() {
    const auto length = static_cast<std::uint32_t>(out_.size() - begin_);
    for (std::size_t k = 0; k < 4; ++k) out_[begin_ - 4 + k] = static_cast<char>(length >> (8 * k));
  }

 private:
  std::string& out_;
  std::size_t begin_;
};

// Takes fields from the front of some bytes. After the first field that is not there, ok() is
// false and every further field is zero or empty.
class Fields {
 public:
  explicit Fields(std::string_view bytes) noexcept : rest_(bytes) {}
  [[nodiscard]] bool ok() const noexcept { return ok_; }
  [[nodiscard]] bool done() const noexcept { return !ok_ || rest_.empty(); }
  [[nodiscard]] std::string_view rest() const noexcept { return rest_; }

  template <class Unsigned> Unsigned number() noexcept {
    const std::string_view bytes = take(sizeof(Unsigned));
    Unsigned value = 0;
    for (std::size_t k = 0; k < bytes.size(); ++k) {
      value = static_cast<Unsigned>(value | static_cast<Unsigned>(static_cast<unsigned char>(bytes[k])) << (8 * k));
    }
    return value;
  }
  std::string_view take(std::uint64_t size) noexcept {
    if (!ok_ || size > rest_.size()) {
      ok_ = false;
      return {};
    }
    const std::string_view bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return bytes;
  }
  std::string_view string() noexcept { return take(number<std::uint32_t>()); }

 private:
  std::string_view rest_;
  bool ok_ = true;
};

struct Record {
  std::uint8_t op = 0;
  std::string_view content;
};
// The next record; nothing at the end, or when its length is missing (then fields.ok() is false).
inline std::optional<Record> next_record(Fields& fields) noexcept {
  if (fields.done()) return std::nullopt;
  Record record;
  record.op = fields.number<std::uint8_t>();
  record.content = fields.take(fields.number<std::uint64_t>());
  if (!fields.ok()) return std::nullopt;
  return record;
}

}  // namespace banyan::record::mcap
