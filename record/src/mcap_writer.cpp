// SPDX-License-Identifier: MIT
// Writing MCAP (mcap.hpp). Schemas, channels and metadata stand outside the chunks, so a damaged
// chunk takes only its own messages with it.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "bytes.hpp"
#include "compression.hpp"

namespace banyan::record::mcap {

namespace {

// Eight tables: eight bytes per step instead of one ("slicing by 8", Kounavis & Berry 2005).
constexpr std::array<std::array<std::uint32_t, 256>, 8> crc_tables = [] {
  std::array<std::array<std::uint32_t, 256>, 8> tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t c = byte;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1U) != 0 ? 0xEDB88320U ^ (c >> 1) : c >> 1;
    tables[0][byte] = c;
  }
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    for (std::size_t k = 1; k < 8; ++k) {
      tables[k][byte] = tables[0][tables[k - 1][byte] & 0xFFU] ^ (tables[k - 1][byte] >> 8);
    }
  }
  return tables;
}();

struct ChunkEntry {
  Nanoseconds start = 0, end = 0;
  std::uint64_t offset = 0, length = 0;
  std::map<std::uint16_t, std::uint64_t> index_offsets;
  std::uint64_t index_length = 0;
  std::uint64_t compressed = 0, uncompressed = 0;
};

// The first chunk of a group is small and each one after it twice as large: of a file that is cut off early
// something can be shown, and a page has its first picture soon.
constexpr std::size_t first_chunk_bytes = std::size_t{1} << 14;

// A chunk that is being filled.
struct OpenChunk {
  std::size_t limit = first_chunk_bytes;
  std::string records;
  Nanoseconds start = 0, end = 0;
  std::map<std::uint16_t, std::vector<std::pair<Nanoseconds, std::uint64_t>>> index;  // per channel: time, offset
};

struct MetadataEntry {
  std::uint64_t offset = 0, length = 0;
  std::string name;
};

struct AttachmentEntry {
  std::uint64_t offset = 0, length = 0, size = 0;
  Nanoseconds time = 0;
  std::string name, media_type;
};

void put_map(std::string& out, const Map& map) {
  const LengthScope length(out);
  for (const auto& [key, value] : map) {
    put_string(out, key);
    put_string(out, value);
  }
}

void put_schema(std::string& out, const Schema& schema) {
  const RecordScope record(out, Op::schema);
  put(out, schema.id);
  put_string(out, schema.name);
  put_string(out, schema.encoding);
  put_string(out, schema.data);
}

void put_channel(std::string& out, const Channel& channel) {
  const RecordScope record(out, Op::channel);
  put(out, channel.id);
  put(out, channel.schema_id);
  put_string(out, channel.topic);
  put_string(out, channel.message_encoding);
  put_map(out, channel.metadata);
}

void put_chunk_index(std::string& out, const ChunkEntry& c, std::string_view compression) {
  const RecordScope record(out, Op::chunk_index);
  put(out, c.start);
  put(out, c.end);
  put(out, c.offset);
  put(out, c.length);
  {
    const LengthScope length(out);
    for (const auto& [id, offset] : c.index_offsets) {
      put(out, id);
      put(out, offset);
    }
  }
  put(out, c.index_length);
  put_string(out, compression);
  put(out, c.compressed);
  put(out, c.uncompressed);
}

void put_attachment_index(std::string& out, const AttachmentEntry& a) {
  const RecordScope record(out, Op::attachment_index);
  put(out, a.offset);
  put(out, a.length);
  put(out, a.time);
  put(out, a.time);
  put(out, a.size);
  put_string(out, a.name);
  put_string(out, a.media_type);
}

void put_metadata_index(std::string& out, const MetadataEntry& m) {
  const RecordScope record(out, Op::metadata_index);
  put(out, m.offset);
  put(out, m.length);
  put_string(out, m.name);
}

// The records of one kind in the summary: where they begin and end in it.
struct SummaryGroup {
  Op op;
  std::uint64_t begin, end;
};

// Where each group is, and the footer, behind a summary that begins at `start` of the file.
void put_end(std::string& out, std::uint64_t start, const std::vector<SummaryGroup>& groups) {
  const std::uint64_t offsets_start = start + out.size();
  for (const SummaryGroup& g : groups) {
    const RecordScope record(out, Op::summary_offset);
    put(out, static_cast<std::uint8_t>(g.op));
    put(out, start + g.begin);
    put(out, g.end - g.begin);
  }
  // The footer by hand: its CRC covers the summary and its own bytes up to the CRC itself.
  put(out, static_cast<std::uint8_t>(Op::footer));
  put(out, std::uint64_t{20});
  put(out, start);
  put(out, offsets_start);
  put(out, crc32(out));
  out.append(magic);
}

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t seed) noexcept {
  const auto& t = crc_tables;
  std::uint32_t c = ~seed;
  const auto* p = reinterpret_cast<const unsigned char*>(bytes.data());
  std::size_t left = bytes.size();
  const auto word = [](const unsigned char* at) {
    return static_cast<std::uint32_t>(at[0]) | static_cast<std::uint32_t>(at[1]) << 8 |
           static_cast<std::uint32_t>(at[2]) << 16 | static_cast<std::uint32_t>(at[3]) << 24;
  };
  for (; left >= 8; left -= 8, p += 8) {
    const std::uint32_t a = word(p) ^ c;
    const std::uint32_t b = word(p + 4);
    c = t[7][a & 0xFFU] ^ t[6][(a >> 8) & 0xFFU] ^ t[5][(a >> 16) & 0xFFU] ^ t[4][a >> 24] ^ t[3][b & 0xFFU] ^
        t[2][(b >> 8) & 0xFFU] ^ t[1][(b >> 16) & 0xFFU] ^ t[0][b >> 24];
  }
  for (; left > 0; --left, ++p) c = t[0][(c ^ *p) & 0xFFU] ^ (c >> 8);
  return ~c;
}

struct Writer::Impl {
  OutputFile& file;
  WriterOptions options;
  Compressor compressor;
  std::uint32_t data_crc = 0;
  std::vector<Schema> schemas;
  std::vector<Channel> channels;
  std::vector<std::uint32_t> sequences;  // per channel: messages so far
  std::vector<ChunkEntry> chunks;
  std::vector<MetadataEntry> metadata;
  std::vector<AttachmentEntry> attachments;
  bool any_message = false;
  Nanoseconds first = 0, last = 0;

  std::map<ChunkGroup, OpenChunk> open;
  std::vector<OpenChunk*> chunk_of;  // per channel; nodes of a map stay where they are
  std::string scratch;

  Impl(OutputFile& output, WriterOptions wanted) : file(output), options(std::move(wanted)) {
    options.compression_level = possible_level(options.compression_level);
  }

  void data(std::string_view bytes) {  // of the data section
    data_crc = crc32(bytes, data_crc);
    file.write(bytes);
  }
  std::string_view compress(std::string_view records);
  void end(OpenChunk& chunk);
  void write_index(OpenChunk& chunk, ChunkEntry& entry);
  void put_statistics(std::string& out) const;
  [[nodiscard]] std::string summary(std::uint64_t start) const;
};

Writer::Writer(OutputFile& file, const WriterOptions& options) : impl_(std::make_unique<Impl>(file, options)) {
  Impl& w = *impl_;
  w.scratch.assign(magic);
  {
    const RecordScope record(w.scratch, Op::header);
    put_string(w.scratch, options.profile);
    put_string(w.scratch, options.library);
  }
  w.data(w.scratch);
}

Writer::~Writer() = default;

std::uint16_t Writer::add_schema(std::string name, std::string encoding, std::string data) {
  Impl& w = *impl_;
  const auto id = static_cast<std::uint16_t>(w.schemas.size() + 1);  // 0 means "no schema"
  w.schemas.push_back({id, std::move(name), std::move(encoding), std::move(data)});
  w.scratch.clear();
  put_schema(w.scratch, w.schemas.back());
  w.data(w.scratch);
  return id;
}

std::uint16_t Writer::add_channel(std::uint16_t schema_id, std::string topic, std::string message_encoding,
                                  Map metadata, ChunkGroup group) {
  Impl& w = *impl_;
  const auto id = static_cast<std::uint16_t>(w.channels.size());
  w.channels.push_back({id, schema_id, std::move(topic), std::move(message_encoding), std::move(metadata)});
  w.sequences.push_back(0);
  w.chunk_of.push_back(&w.open[group]);
  w.scratch.clear();
  put_channel(w.scratch, w.channels.back());
  w.data(w.scratch);
  return id;
}

void Writer::message(std::uint16_t channel_id, Nanoseconds time, std::string_view data) {
  Impl& w = *impl_;
  OpenChunk& chunk = *w.chunk_of.at(channel_id);
  if (chunk.records.empty()) chunk.start = chunk.end = time;
  chunk.start = std::min(chunk.start, time);
  chunk.end = std::max(chunk.end, time);
  w.first = w.any_message ? std::min(w.first, time) : time;
  w.last = w.any_message ? std::max(w.last, time) : time;
  w.any_message = true;
  chunk.index[channel_id].emplace_back(time, chunk.records.size());
  {
    const RecordScope record(chunk.records, Op::message);
    put(chunk.records, channel_id);
    put(chunk.records, w.sequences[channel_id]++);
    put(chunk.records, time);
    put(chunk.records, time);
    chunk.records.append(data);
  }
  if (chunk.records.size() >= std::min(chunk.limit, w.options.chunk_bytes)) w.end(chunk);
}

std::string_view Writer::Impl::compress(std::string_view records) {
  if (options.compression_level == 0) return records;
  try {
    return compressor.compress(records, options.compression_level);
  } catch (const std::runtime_error& e) { throw FileError(file.path(), std::string("cannot compress: ") + e.what()); }
}

void Writer::end_chunks() {
  for (auto& [group, chunk] : impl_->open) impl_->end(chunk);
}

void Writer::Impl::end(OpenChunk& chunk) {
  if (chunk.records.empty()) return;
  const std::string_view stored = compress(chunk.records);
  ChunkEntry entry;
  entry.start = chunk.start;
  entry.end = chunk.end;
  entry.offset = file.position();
  entry.compressed = stored.size();
  entry.uncompressed = chunk.records.size();
  scratch.clear();
  {
    const RecordScope record(scratch, Op::chunk);
    put(scratch, entry.start);
    put(scratch, entry.end);
    put(scratch, entry.uncompressed);
    put(scratch, crc32(chunk.records));
    put_string(scratch, options.compression_level == 0 ? "" : "zstd");
    put(scratch, entry.compressed);
    scratch.append(stored);
  }
  entry.length = scratch.size();
  chunk.records.clear();
  chunk.limit = std::min(2 * chunk.limit, options.chunk_bytes);
  data(scratch);
  write_index(chunk, entry);
  chunks.push_back(std::move(entry));
  file.flush();
}

void Writer::Impl::write_index(OpenChunk& chunk, ChunkEntry& entry) {
  const std::uint64_t begin = file.position();
  for (auto& [id, places] : chunk.index) {
    if (places.empty()) continue;
    std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    entry.index_offsets.emplace(id, file.position());
    scratch.clear();
    {
      const RecordScope record(scratch, Op::message_index);
      put(scratch, id);
      const LengthScope length(scratch);
      for (const auto& [time, offset] : places) {
        put(scratch, time);
        put(scratch, offset);
      }
    }
    data(scratch);
    places.clear();
  }
  entry.index_length = file.position() - begin;
}

void Writer::metadata(const Metadata& metadata) {
  Impl& w = *impl_;
  const std::uint64_t offset = w.file.position();
  w.scratch.clear();
  {
    const RecordScope record(w.scratch, Op::metadata);
    put_string(w.scratch, metadata.name);
    put_map(w.scratch, metadata.entries);
  }
  w.data(w.scratch);
  w.metadata.push_back({offset, w.scratch.size(), metadata.name});
  w.file.flush();
}

void Writer::attachment(std::string_view name, std::string_view media_type, Nanoseconds time, std::string_view data) {
  Impl& w = *impl_;
  const std::uint64_t offset = w.file.position();
  w.scratch.clear();
  {
    const RecordScope record(w.scratch, Op::attachment);
    put(w.scratch, time);
    put(w.scratch, time);
    put_string(w.scratch, name);
    put_string(w.scratch, media_type);
    put(w.scratch, std::uint64_t{data.size()});
    w.scratch.append(data);
    put(w.scratch, crc32(std::string_view(w.scratch).substr(record_header_bytes)));
  }
  w.data(w.scratch);
  w.attachments.push_back({offset, w.scratch.size(), data.size(), time, std::string(name), std::string(media_type)});
}

// Groups of one kind of record each, then where each group is.
void Writer::Impl::put_statistics(std::string& out) const {
  const RecordScope record(out, Op::statistics);
  std::uint64_t messages = 0;
  for (const std::uint32_t n : sequences) messages += n;
  put(out, messages);
  put(out, static_cast<std::uint16_t>(schemas.size()));
  put(out, static_cast<std::uint32_t>(channels.size()));
  put(out, static_cast<std::uint32_t>(attachments.size()));
  put(out, static_cast<std::uint32_t>(metadata.size()));
  put(out, static_cast<std::uint32_t>(chunks.size()));
  put(out, first);
  put(out, last);
  const LengthScope length(out);
  for (std::size_t id = 0; id < sequences.size(); ++id) {
    put(out, static_cast<std::uint16_t>(id));
    put(out, std::uint64_t{sequences[id]});
  }
}

std::string Writer::Impl::summary(std::uint64_t start) const {
  std::string out;
  std::vector<SummaryGroup> groups;
  const auto group = [&](Op op, const auto& items, const auto& put_item) {
    const std::uint64_t begin = out.size();
    for (const auto& item : items) put_item(out, item);
    if (out.size() > begin) groups.push_back({op, begin, out.size()});
  };
  group(Op::schema, schemas, put_schema);
  group(Op::channel, channels, put_channel);
  group(Op::statistics, std::array{this}, [](std::string& to, const Impl* w) { w->put_statistics(to); });
  const std::string_view compression = options.compression_level == 0 ? "" : "zstd";
  group(Op::chunk_index, chunks, [&](std::string& to, const ChunkEntry& c) { put_chunk_index(to, c, compression); });
  group(Op::attachment_index, attachments, put_attachment_index);
  group(Op::metadata_index, metadata, put_metadata_index);
  put_end(out, start, groups);
  return out;
}

void Writer::finish() {
  Impl& w = *impl_;
  end_chunks();
  w.scratch.clear();
  {
    const RecordScope record(w.scratch, Op::data_end);
    put(w.scratch, w.data_crc);
  }
  w.file.write(w.scratch);
  w.file.write(w.summary(w.file.position()));
}

}  // namespace banyan::record::mcap
