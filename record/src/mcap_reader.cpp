// SPDX-License-Identifier: MIT
// Reading MCAP (mcap.hpp): from the summary if it is sound, else by walking through the file.
#include <algorithm>
#include <optional>
#include <set>

#include "bytes.hpp"
#include "compression.hpp"

namespace banyan::record::mcap {

namespace {

// A chunk is held in memory while it is read; writers make them of some MiB.
constexpr std::uint64_t largest_chunk = std::uint64_t{1} << 30;
constexpr std::uint64_t footer_content = 20;

// A stretch of the file that holds messages: a chunk, or messages that stand outside of any.
struct Stretch {
  Nanoseconds start = 0, end = 0;
  std::uint64_t offset = 0, length = 0;  // of the chunk record, or of the loose records
  bool chunk = true;
  std::map<std::uint16_t, std::uint64_t> channels;  // what is in it; empty: unknown
};

std::optional<Map> read_map(std::string_view bytes) {
  Map map;
  Fields fields(bytes);
  while (!fields.done()) {
    const std::string_view key = fields.string();
    const std::string_view value = fields.string();
    if (fields.ok()) map.insert_or_assign(std::string(key), std::string(value));
  }
  if (!fields.ok()) return std::nullopt;
  return map;
}

std::optional<Schema> read_schema(std::string_view content) {
  Fields f(content);
  Schema s;
  s.id = f.number<std::uint16_t>();
  s.name = f.string();
  s.encoding = f.string();
  s.data = f.string();
  if (!f.ok() || s.id == 0) return std::nullopt;
  return s;
}

std::optional<Channel> read_channel(std::string_view content) {
  Fields f(content);
  Channel c;
  c.id = f.number<std::uint16_t>();
  c.schema_id = f.number<std::uint16_t>();
  c.topic = f.string();
  c.message_encoding = f.string();
  auto map = read_map(f.string());
  if (!f.ok() || !map) return std::nullopt;
  c.metadata = std::move(*map);
  return c;
}

std::optional<LoggedMessage> read_message(std::string_view content) {
  Fields f(content);
  LoggedMessage m;
  m.channel_id = f.number<std::uint16_t>();
  m.sequence = f.number<std::uint32_t>();
  m.log_time = f.number<Nanoseconds>();
  m.publish_time = f.number<Nanoseconds>();
  m.data = f.rest();
  if (!f.ok()) return std::nullopt;
  return m;
}

std::optional<Metadata> read_metadata(std::string_view content) {
  Fields f(content);
  Metadata m;
  m.name = f.string();
  auto map = read_map(f.string());
  if (!f.ok() || !map) return std::nullopt;
  m.entries = std::move(*map);
  return m;
}

std::optional<Stretch> read_chunk_index(std::string_view content, std::uint64_t file_size) {
  Fields f(content);
  Stretch s;
  s.start = f.number<Nanoseconds>();
  s.end = f.number<Nanoseconds>();
  s.offset = f.number<std::uint64_t>();
  s.length = f.number<std::uint64_t>();
  Fields offsets(f.string());
  while (!offsets.done()) {
    const auto id = offsets.number<std::uint16_t>();
    const auto offset = offsets.number<std::uint64_t>();
    if (offsets.ok()) s.channels.emplace(id, offset);
  }
  const bool inside = s.offset <= file_size && s.length <= file_size - s.offset && s.length >= record_header_bytes;
  if (!f.ok() || !offsets.ok() || !inside || s.start > s.end) return std::nullopt;
  return s;
}

struct ChunkHeader {
  Nanoseconds start = 0, end = 0;
  std::uint64_t uncompressed = 0;
  std::uint32_t crc = 0;
  std::string_view compression;
  std::string_view records;
};

std::optional<ChunkHeader> read_chunk(std::string_view content) {
  Fields f(content);
  ChunkHeader c;
  c.start = f.number<Nanoseconds>();
  c.end = f.number<Nanoseconds>();
  c.uncompressed = f.number<std::uint64_t>();
  c.crc = f.number<std::uint32_t>();
  c.compression = f.string();
  c.records = f.take(f.number<std::uint64_t>());
  if (!f.ok()) return std::nullopt;
  return c;
}

std::string at_byte(std::uint64_t offset) { return " (at byte " + std::to_string(offset) + ")"; }

}  // namespace

struct Reader::Impl {
  explicit Impl(const std::string& path) : file(path) {}

  InputFile file;
  Decompressor decompressor;
  bool indexed = false;
  std::vector<std::string> warnings;
  std::set<std::uint64_t> warned;  // offsets of chunks that were complained about
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::vector<Metadata> metadata;
  std::vector<Stretch> stretches;  // by start
  std::map<std::uint16_t, std::uint64_t> counts;

  std::string record;  // the last chunk record read
  std::string unpacked;
  const Stretch* loaded = nullptr;  // whose records are in `contents`
  std::string_view contents;

  void warn(std::uint64_t offset, const std::string& text) {
    if (warned.insert(offset).second) warnings.push_back(text + at_byte(offset));
  }
  void check_magic() const;
  std::string load_summary();  // what is wrong with it, "" if it is sound
  std::string take_summary(std::string_view records);
  std::string take_metadata(const std::vector<std::pair<std::uint64_t, std::uint64_t>>& places);
  void forget();
  void scan();
  void scan_record(const Record& record, std::uint64_t offset, std::uint64_t length);
  void scan_chunk(std::uint64_t offset, std::uint64_t length);
  void scan_loose(const Record& record, std::uint64_t offset, std::uint64_t length);
  std::optional<std::string_view> unpack(std::string_view content, std::string& problem);
  bool load(const Stretch& stretch);
  std::vector<LoggedMessage> messages_in(const Stretch& stretch, std::uint16_t channel, Nanoseconds from,
                                         Nanoseconds to);
  [[nodiscard]] static bool may_hold(const Stretch& s, std::uint16_t channel) {
    return s.channels.empty() || s.channels.contains(channel);
  }
};

void Reader::Impl::check_magic() const {
  std::string start;
  if (file.size() == 0) throw FileError(file.path(), "is empty");
  if (!file.read(0, magic.size(), start) || start != magic) throw FileError(file.path(), "is not an MCAP file");
}

std::string Reader::Impl::load_summary() {
  const std::uint64_t tail = record_header_bytes + footer_content + magic.size();
  std::string footer;
  if (file.size() < magic.size() + tail || !file.read(file.size() - tail, tail, footer) || !footer.ends_with(magic) ||
      static_cast<Op>(footer[0]) != Op::footer) {
    return "the file was cut short: it has no end";
  }
  Fields fields(std::string_view(footer).substr(1));
  const auto length = fields.number<std::uint64_t>();
  const auto start = fields.number<std::uint64_t>();
  (void)fields.number<std::uint64_t>();  // offsets of groups: everything is read anyway
  const auto crc = fields.number<std::uint32_t>();
  if (length != footer_content) return "its footer is damaged";
  if (start == 0) return "it has no index";
  const std::uint64_t end = file.size() - tail;
  std::string summary;
  if (start < magic.size() || start > end || !file.read(start, end - start, summary)) return "its footer is damaged";
  const std::string_view covered = std::string_view(footer).substr(0, tail - magic.size() - sizeof crc);
  if (crc != 0 && crc32(covered, crc32(summary)) != crc) return "its index is damaged (checksum)";
  return take_summary(summary);
}

std::string Reader::Impl::take_summary(std::string_view records) {
  Fields fields(records);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> metadata_places;
  bool statistics = false;
  std::uint64_t messages = 0;
  bool sound = true;
  while (const auto r = next_record(fields)) {
    Fields f(r->content);
    switch (static_cast<Op>(r->op)) {
      case Op::schema:
        if (auto s = read_schema(r->content)) schemas.insert_or_assign(s->id, std::move(*s));
        else sound = false;
        break;
      case Op::channel:
        if (auto c = read_channel(r->content)) channels.insert_or_assign(c->id, std::move(*c));
        else sound = false;
        break;
      case Op::chunk_index:
        if (auto s = read_chunk_index(r->content, file.size())) stretches.push_back(std::move(*s));
        else sound = false;
        break;
      case Op::metadata_index: {
        const auto offset = f.number<std::uint64_t>();
        metadata_places.emplace_back(offset, f.number<std::uint64_t>());
        break;
      }
      case Op::statistics: {
        statistics = true;
        messages = f.number<std::uint64_t>();
        (void)f.take(2 + 4 * 4 + 2 * 8);
        Fields pairs(f.string());
        while (!pairs.done()) {
          const auto id = pairs.number<std::uint16_t>();
          counts[id] = pairs.number<std::uint64_t>();
        }
        sound = sound && pairs.ok();
        break;
      }
      default: break;
    }
    sound = sound && f.ok();
  }
  if (!sound || !fields.ok()) return "its index is damaged";
  if (!statistics || (messages > 0 && stretches.empty())) return "it has no index";
  return take_metadata(metadata_places);
}

std::string Reader::Impl::take_metadata(const std::vector<std::pair<std::uint64_t, std::uint64_t>>& places) {
  std::string bytes;
  for (const auto& [offset, length] : places) {
    if (!file.read(offset, length, bytes)) return "its index is damaged (metadata)";
    Fields fields(bytes);
    const auto r = next_record(fields);
    auto m = r && static_cast<Op>(r->op) == Op::metadata ? read_metadata(r->content) : std::nullopt;
    if (!m) return "its index is damaged (metadata)";
    metadata.push_back(std::move(*m));
  }
  return {};
}

void Reader::Impl::forget() {
  schemas.clear();
  channels.clear();
  metadata.clear();
  stretches.clear();
  counts.clear();
}

void Reader::Impl::scan() {
  std::uint64_t offset = magic.size();
  std::string bytes;
  bool ended = false;
  while (!ended && offset < file.size()) {
    const std::uint64_t left = file.size() - offset;
    if (left == magic.size() && file.read(offset, left, bytes) && bytes == magic) break;
    if (left < record_header_bytes || !file.read(offset, record_header_bytes, bytes)) {
      return warn(offset, "the file ends in the middle of a record");
    }
    Fields fields(bytes);
    const auto op = fields.number<std::uint8_t>();
    const auto length = fields.number<std::uint64_t>();
    if (op == 0) return warn(offset, "what follows is not MCAP");
    if (length > left - record_header_bytes) return warn(offset, "the file ends in the middle of a record");
    const std::uint64_t whole = record_header_bytes + length;
    if (static_cast<Op>(op) == Op::chunk) {
      scan_chunk(offset, whole);
    } else if (file.read(offset + record_header_bytes, length, bytes)) {
      scan_record({op, bytes}, offset, whole);
    }
    ended = static_cast<Op>(op) == Op::data_end;
    offset += whole;
  }
}

void Reader::Impl::scan_record(const Record& r, std::uint64_t offset, std::uint64_t length) {
  bool sound = true;
  switch (static_cast<Op>(r.op)) {
    case Op::schema:
      if (auto s = read_schema(r.content)) schemas.insert_or_assign(s->id, std::move(*s));
      else sound = false;
      break;
    case Op::channel:
      if (auto c = read_channel(r.content)) channels.insert_or_assign(c->id, std::move(*c));
      else sound = false;
      break;
    case Op::metadata:
      if (auto m = read_metadata(r.content)) metadata.push_back(std::move(*m));
      else sound = false;
      break;
    case Op::message: scan_loose(r, offset, length); break;
    default: break;
  }
  if (!sound) warn(offset, "a damaged record was skipped");
}

void Reader::Impl::scan_loose(const Record& r, std::uint64_t offset, std::uint64_t length) {
  const auto m = read_message(r.content);
  if (!m) return warn(offset, "a damaged message was skipped");
  const bool continues = !stretches.empty() && !stretches.back().chunk &&
                         stretches.back().offset + stretches.back().length == offset &&
                         stretches.back().length < (std::uint64_t{1} << 20);
  if (!continues) stretches.push_back({m->log_time, m->log_time, offset, 0, false, {}});
  Stretch& s = stretches.back();
  s.start = std::min(s.start, m->log_time);
  s.end = std::max(s.end, m->log_time);
  s.length += length;
  ++s.channels[m->channel_id];
  ++counts[m->channel_id];
}

void Reader::Impl::scan_chunk(std::uint64_t offset, std::uint64_t length) {
  // The times of the header are not trusted: messages have their own.
  Stretch s{0, 0, offset, length, true, {}};
  if (!load(s)) return;
  loaded = nullptr;  // `s` is about to go
  Fields fields(contents);
  bool any = false;
  while (const auto r = next_record(fields)) {
    if (static_cast<Op>(r->op) != Op::message) {
      scan_record(*r, offset, 0);
      continue;
    }
    const auto m = read_message(r->content);
    if (!m) continue;
    s.start = any ? std::min(s.start, m->log_time) : m->log_time;
    s.end = any ? std::max(s.end, m->log_time) : m->log_time;
    any = true;
    ++s.channels[m->channel_id];
    ++counts[m->channel_id];
  }
  if (!fields.ok()) warn(offset, "a chunk ends in the middle of a record");
  if (any) stretches.push_back(std::move(s));
}

std::optional<std::string_view> Reader::Impl::unpack(std::string_view content, std::string& problem) {
  const auto chunk = read_chunk(content);
  if (!chunk || chunk->uncompressed > largest_chunk) {
    problem = "a damaged chunk was skipped";
    return std::nullopt;
  }
  std::string_view records = chunk->records;
  // Of such a file nothing could be read, chunk for chunk.
  if (chunk->compression == "zstd" && !reads_zstd())
    throw FileError(file.path(),
                    "is compressed, and reading it needs zstd, which this banyan was built without; install "
                    "libzstd-dev and build again");
  if (chunk->compression == "zstd") {
    if (!decompressor.decompress(chunk->records, chunk->uncompressed, unpacked)) {
      problem = "a damaged chunk was skipped";
      return std::nullopt;
    }
    records = unpacked;
  } else if (!chunk->compression.empty()) {
    problem = "a chunk was skipped: compression '" + std::string(chunk->compression.substr(0, 16)) +
              "' is not supported, only zstd and none";
    return std::nullopt;
  }
  if (chunk->crc != 0 && crc32(records) != chunk->crc) {
    problem = "a damaged chunk was skipped (checksum)";
    return std::nullopt;
  }
  return records;
}

bool Reader::Impl::load(const Stretch& s) {
  if (loaded == &s) return true;
  loaded = nullptr;
  if (!file.read(s.offset, s.length, record)) {
    warn(s.offset, "a chunk is missing");
    return false;
  }
  if (!s.chunk) {
    contents = record;
    loaded = &s;
    return true;
  }
  Fields fields(record);
  const auto r = next_record(fields);
  std::string problem = "a damaged chunk was skipped";
  const auto records = r && static_cast<Op>(r->op) == Op::chunk ? unpack(r->content, problem) : std::nullopt;
  if (!records) {
    warn(s.offset, problem);
    return false;
  }
  contents = *records;
  loaded = &s;
  return true;
}

std::vector<LoggedMessage> Reader::Impl::messages_in(const Stretch& s, std::uint16_t channel, Nanoseconds from,
                                                     Nanoseconds to) {
  std::vector<LoggedMessage> found;
  if (!may_hold(s, channel) || !load(s)) return found;
  Fields fields(contents);
  while (const auto r = next_record(fields)) {
    if (static_cast<Op>(r->op) != Op::message) continue;
    const auto m = read_message(r->content);
    if (m && m->channel_id == channel && m->log_time >= from && m->log_time <= to) found.push_back(*m);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const LoggedMessage& a, const LoggedMessage& b) { return a.log_time < b.log_time; });
  return found;
}

Reader::Reader(const std::string& path) : impl_(std::make_unique<Impl>(path)) {
  Impl& r = *impl_;
  r.check_magic();
  const std::string problem = r.load_summary();
  r.indexed = problem.empty();
  if (!r.indexed) {
    r.forget();
    r.warnings.push_back(problem + "; read by scanning what is there");
    r.scan();
  }
  std::stable_sort(r.stretches.begin(), r.stretches.end(),
                   [](const Stretch& a, const Stretch& b) { return a.start < b.start; });
}

Reader::Reader(Reader&&) noexcept = default;
Reader& Reader::operator=(Reader&&) noexcept = default;
Reader::~Reader() = default;

const std::string& Reader::path() const noexcept { return impl_->file.path(); }
bool Reader::indexed() const noexcept { return impl_->indexed; }
const std::vector<std::string>& Reader::warnings() const noexcept { return impl_->warnings; }
const std::map<std::uint16_t, Schema>& Reader::schemas() const noexcept { return impl_->schemas; }
const std::map<std::uint16_t, Channel>& Reader::channels() const noexcept { return impl_->channels; }
const std::vector<Metadata>& Reader::metadata() const noexcept { return impl_->metadata; }

const Channel* Reader::find_channel(std::string_view topic) const noexcept {
  for (const auto& [id, channel] : impl_->channels) {
    if (channel.topic == topic) return &channel;
  }
  return nullptr;
}

std::uint64_t Reader::message_count(std::uint16_t channel_id) const noexcept {
  const auto found = impl_->counts.find(channel_id);
  return found == impl_->counts.end() ? 0 : found->second;
}

std::pair<Nanoseconds, Nanoseconds> Reader::time_range() const noexcept {
  const auto& stretches = impl_->stretches;
  if (stretches.empty()) return {0, 0};
  Nanoseconds last = 0;
  for (const Stretch& s : stretches) last = std::max(last, s.end);
  return {stretches.front().start, last};
}

void Reader::messages(std::uint16_t channel_id, const Visit& visit, Nanoseconds from, Nanoseconds to) {
  for (const Stretch& s : impl_->stretches) {
    if (s.end < from || s.start > to) continue;
    for (const LoggedMessage& m : impl_->messages_in(s, channel_id, from, to)) {
      if (!visit(m)) return;
    }
  }
}

bool Reader::last_before(std::uint16_t channel_id, Nanoseconds time, const Visit& visit) {
  // Backwards by end: once a stretch ends before the best message so far, nothing later is left.
  std::vector<const Stretch*> order;
  for (const Stretch& s : impl_->stretches) {
    if (s.start <= time && Impl::may_hold(s, channel_id)) order.push_back(&s);
  }
  std::stable_sort(order.begin(), order.end(), [](const Stretch* a, const Stretch* b) { return a->end > b->end; });
  std::optional<Nanoseconds> best;
  std::string data;
  LoggedMessage latest;
  for (const Stretch* s : order) {
    if (best && s->end <= *best) break;
    const auto found = impl_->messages_in(*s, channel_id, best.value_or(0), time);
    if (found.empty() || (best && found.back().log_time <= *best)) continue;
    latest = found.back();
    best = latest.log_time;
    data.assign(latest.data);
  }
  if (!best) return false;
  latest.data = data;
  visit(latest);
  return true;
}

}  // namespace banyan::record::mcap
