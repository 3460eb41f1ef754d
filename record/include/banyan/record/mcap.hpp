// SPDX-License-Identifier: MIT
// The MCAP container (mcap.dev/spec), written and read by ourselves: Debian has no library for it.
// Chunks are compressed with zstd and carry a CRC; the summary at the end indexes them by time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/record/file.hpp"

namespace banyan::record::mcap {

using Nanoseconds = std::uint64_t;
using Map = std::map<std::string, std::string>;

struct Schema {
  std::uint16_t id = 0;
  std::string name;
  std::string encoding;  // "jsonschema"
  std::string data;
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  // 0: none
  std::string topic;
  std::string message_encoding;  // "json"
  Map metadata;
};

struct LoggedMessage {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  Nanoseconds log_time = 0;
  Nanoseconds publish_time = 0;
  std::string_view data;  // valid during the call that hands it out
};

struct Metadata {
  std::string name;
  Map entries;
};

[[nodiscard]] std::uint32_t crc32(std::string_view bytes, std::uint32_t seed = 0) noexcept;  // as in zlib

struct WriterOptions {
  std::string profile;
  std::string library;
  int compression_level = 1;          // zstd; 0: chunks are stored uncompressed
  std::size_t chunk_bytes = 1 << 20;  // a chunk is closed when it exceeds this; a group's first ones are smaller
};

// Channels of one group share chunks, and no chunk holds channels of two groups: who wants the small
// channels of a large file need not unpack the large ones. A group is any number; 0 is as good as another.
using ChunkGroup = std::uint8_t;

// Writes a whole MCAP file into `file`, which must outlive it. Times may come in any order.
class Writer {
 public:
  Writer(OutputFile& file, const WriterOptions& options);
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer();

  [[nodiscard]] std::uint16_t add_schema(std::string name, std::string encoding, std::string data);
  [[nodiscard]] std::uint16_t add_channel(std::uint16_t schema_id, std::string topic, std::string message_encoding,
                                          Map metadata = {}, ChunkGroup group = 0);
  // Ends the group's chunk once that exceeds chunk_bytes. std::out_of_range for an unknown channel.
  void message(std::uint16_t channel_id, Nanoseconds time, std::string_view data);
  void metadata(const Metadata& metadata);  // in the file at once, before what the open chunks hold
  void attachment(std::string_view name, std::string_view media_type, Nanoseconds time, std::string_view data);
  void end_chunks();  // of all groups: what came so far survives a crash
  void finish();      // data end, summary, footer; once, nothing may follow

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Reads any MCAP file with zstd or no compression. With a sound summary only the chunks that are
// asked for are read; else the file is scanned and warnings() says why. Throws FileError if the
// file is no MCAP file at all. Never trusts a length: each is checked against what is there.
class Reader {
 public:
  explicit Reader(const std::string& path);
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) noexcept;
  ~Reader();

  [[nodiscard]] const std::string& path() const noexcept;
  [[nodiscard]] bool indexed() const noexcept;                              // the summary was sound
  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept;  // grows while reading
  [[nodiscard]] const std::map<std::uint16_t, Schema>& schemas() const noexcept;
  [[nodiscard]] const std::map<std::uint16_t, Channel>& channels() const noexcept;
  [[nodiscard]] const Channel* find_channel(std::string_view topic) const noexcept;
  [[nodiscard]] const std::vector<Metadata>& metadata() const noexcept;
  [[nodiscard]] std::uint64_t message_count(std::uint16_t channel_id) const noexcept;
  // First and last log time of the chunks; {0, 0} without any.
  [[nodiscard]] std::pair<Nanoseconds, Nanoseconds> time_range() const noexcept;

  // Messages of one channel with log time in [from, to], by time. `visit` returns false to stop.
  using Visit = std::function<bool(const LoggedMessage&)>;
  void messages(std::uint16_t channel_id, const Visit& visit, Nanoseconds from = 0,
                Nanoseconds to = std::numeric_limits<Nanoseconds>::max());
  // The latest message of the channel at or before `time`, if there is one.
  bool last_before(std::uint16_t channel_id, Nanoseconds time, const Visit& visit);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace banyan::record::mcap
