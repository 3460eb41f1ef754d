// SPDX-License-Identifier: MIT
// The container: round trips, seeking, and files that are cut short, foreign or damaged.
// record/test/readers/ reads recordings with the libraries of others.
#include "banyan/record/mcap.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "banyan/world/random.hpp"
#include "sample.hpp"

namespace banyan::record::mcap {
namespace {

// Without the fsync of write_file(): these tests write thousands of files.
void spill(const std::string& path, std::string_view bytes) {
  std::filesystem::remove(path);  // ext4 forces a truncated file to the disk, not a new one
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

// Two channels; "a" at every millisecond, "b" at every tenth.
void write_sample(const std::string& path, int messages, const WriterOptions& options, bool finish = true) {
  OutputFile file(path, Existing::replace);
  Writer writer(file, options);
  const auto schema = writer.add_schema("T", "jsonschema", "{}");
  const auto a = writer.add_channel(schema, "/a", "json", {{"key", "value"}});
  const auto b = writer.add_channel(0, "/b", "text");
  writer.metadata({"about", {{"x", "1"}, {"y", ""}}});
  for (int k = 0; k < messages; ++k) {
    const auto time = static_cast<Nanoseconds>(k) * 1000000;
    writer.message(a, time, "{\"k\":" + std::to_string(k) + "}");
    if (k % 10 == 0) writer.message(b, time, std::to_string(k));
  }
  writer.attachment("note.txt", "text/plain", 5, "hello");
  if (finish) writer.finish();
  file.commit();
}

std::vector<std::string> texts(Reader& reader, std::string_view topic, Nanoseconds from = 0,
                               Nanoseconds to = std::numeric_limits<Nanoseconds>::max()) {
  std::vector<std::string> all;
  const Channel* channel = reader.find_channel(topic);
  if (channel == nullptr) return all;
  reader.messages(
      channel->id,
      [&](const LoggedMessage& m) {
        all.emplace_back(m.data);
        return true;
      },
      from, to);
  return all;
}

std::string last_text(Reader& reader, std::string_view topic, Nanoseconds time) {
  std::string text = "none";
  reader.last_before(reader.find_channel(topic)->id, time, [&](const LoggedMessage& m) {
    text = m.data;
    return true;
  });
  return text;
}

TEST(Crc32, KnownValuesAndPieces) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);  // the check value of CRC-32/ISO-HDLC
  EXPECT_EQ(crc32(""), 0U);
  const std::string text = "The quick brown fox jumps over the lazy dog";
  EXPECT_EQ(crc32(text), 0x414FA339U);
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    EXPECT_EQ(crc32(std::string_view(text).substr(cut), crc32(std::string_view(text).substr(0, cut))), 0x414FA339U);
  }
}

class Mcap : public ::testing::TestWithParam<int> {};  // compression level

TEST_P(Mcap, RoundTripAndSeek) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  write_sample(path, 1000, {"profile", "library", GetParam(), 3000});
  Reader reader(path);
  EXPECT_TRUE(reader.indexed());
  EXPECT_TRUE(reader.warnings().empty());
  ASSERT_EQ(reader.channels().size(), 2U);
  EXPECT_EQ(reader.find_channel("/a")->metadata.at("key"), "value");
  EXPECT_EQ(reader.find_channel("/c"), nullptr);
  ASSERT_EQ(reader.schemas().size(), 1U);
  EXPECT_EQ(reader.schemas().begin()->second.name, "T");
  ASSERT_EQ(reader.metadata().size(), 1U);
  EXPECT_EQ(reader.metadata()[0].entries.at("x"), "1");
  EXPECT_EQ(reader.message_count(reader.find_channel("/a")->id), 1000U);
  EXPECT_EQ(reader.message_count(reader.find_channel("/b")->id), 100U);
  EXPECT_EQ(reader.time_range(), (std::pair<Nanoseconds, Nanoseconds>{0, 999000000}));
  const auto all = texts(reader, "/a");
  ASSERT_EQ(all.size(), 1000U);
  for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(all[k], "{\"k\":" + std::to_string(k) + "}");
  EXPECT_EQ(texts(reader, "/b", 195000000, 220000000), (std::vector<std::string>{"200", "210", "220"}));
  for (const std::uint64_t k : {0U, 1U, 9U, 500U, 998U, 999U}) {
    EXPECT_EQ(last_text(reader, "/a", k * 1000000 + 1), "{\"k\":" + std::to_string(k) + "}");
    EXPECT_EQ(last_text(reader, "/b", k * 1000000), std::to_string(k / 10 * 10));
  }
  EXPECT_EQ(last_text(reader, "/a", ~std::uint64_t{0}), "{\"k\":999}");
}

TEST_P(Mcap, WithoutAnEndItIsScanned) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  write_sample(path, 1000, {"", "", GetParam(), 3000});
  const std::string whole = test::contents(path);
  Reader complete(path);
  const auto expected = texts(complete, "/a");
  std::size_t longest = 0;
  for (std::size_t size = 8; size < whole.size(); size += size < 600 ? 1 : 97) {
    spill(path, std::string_view(whole).substr(0, size));
    Reader reader(path);
    EXPECT_FALSE(reader.indexed());
    ASSERT_FALSE(reader.warnings().empty());
    const auto some = texts(reader, "/a");
    ASSERT_LE(some.size(), expected.size());
    EXPECT_TRUE(std::equal(some.begin(), some.end(), expected.begin())) << size;
    EXPECT_GE(some.size(), longest);  // more bytes never tell less
    longest = some.size();
  }
  EXPECT_EQ(longest, expected.size());
}

INSTANTIATE_TEST_SUITE_P(Compression, Mcap, ::testing::Values(0, 1, 9));

TEST(McapReader, NotMcapAtAll) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a");
  for (const std::string text : {"", "x", "tick,time_s\n1,2\n", "\x89MCAP1\r\n", "\x89MCAP"}) {
    spill(path, text);
    EXPECT_THROW(Reader{path}, FileError);
  }
  EXPECT_THROW(Reader{directory.file("missing")}, FileError);
  EXPECT_THROW(Reader{directory.file("")}, FileError);
}

TEST(McapReader, ADamagedChunkCostsOnlyItself) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  write_sample(path, 1000, {"", "", 0, 3000});
  std::string bytes = test::contents(path);
  const std::size_t at = bytes.find("{\"k\":500}");
  ASSERT_NE(at, std::string::npos);
  bytes[at + 5] = '6';
  spill(path, bytes);
  Reader reader(path);
  EXPECT_TRUE(reader.indexed());
  const auto some = texts(reader, "/a");
  EXPECT_LT(some.size(), 1000U);
  EXPECT_GT(some.size(), 900U);
  EXPECT_EQ(std::count(some.begin(), some.end(), "{\"k\":600}"), 1);  // not the forged one
  ASSERT_EQ(reader.warnings().size(), 1U);
  EXPECT_NE(reader.warnings()[0].find("checksum"), std::string::npos);
}

// Every chunk of the large group is damaged: whoever reads the small one does not even notice.
TEST(McapWriter, GroupsShareNoChunk) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  {
    OutputFile file(path);
    Writer writer(file, {"", "", 0, 2000});
    const auto frame = writer.add_channel(0, "/frame", "text", {}, 0);
    const auto plot = writer.add_channel(0, "/plot", "text", {}, 1);
    const auto event = writer.add_channel(0, "/event", "text", {}, 1);
    for (Nanoseconds t = 0; t < 400; ++t) {
      writer.message(frame, t, "LARGE" + std::string(100, '.'));
      writer.message(plot, t, "small");
      if (t % 100 == 50) writer.message(event, t, "event");
      if (t == 200) writer.end_chunks();
    }
    EXPECT_THROW(writer.message(7, 0, ""), std::out_of_range);
    writer.finish();
    file.commit();
  }
  std::string bytes = test::contents(path);
  for (std::size_t at = 0; (at = bytes.find("LARGE", at)) != std::string::npos; ++at) bytes[at] = 'l';
  spill(path, bytes);
  Reader reader(path);
  EXPECT_EQ(texts(reader, "/plot"), std::vector<std::string>(400, "small"));
  EXPECT_EQ(texts(reader, "/event", 100, 300), std::vector<std::string>(2, "event"));
  EXPECT_EQ(last_text(reader, "/event", 149), "event");
  EXPECT_TRUE(reader.indexed());
  EXPECT_TRUE(reader.warnings().empty());
  EXPECT_TRUE(texts(reader, "/frame").empty());
  EXPECT_GT(reader.warnings().size(), 10U);
}

TEST(McapReader, AnUnknownCompressionIsSaidSo) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  write_sample(path, 10, {"", "", 1, 100000});
  std::string bytes = test::contents(path);
  for (std::size_t at = 0; (at = bytes.find("zstd", at)) != std::string::npos; ++at) bytes.replace(at, 4, "lz4x");
  spill(path, bytes);
  Reader reader(path);
  EXPECT_TRUE(texts(reader, "/a").empty());
  EXPECT_NE(reader.warnings().back().find("lz4x"), std::string::npos);
}

TEST(McapReader, MessagesOutsideChunks) {
  // A writer that makes no chunks and no index (allowed by the format).
  std::string bytes("\x89MCAP0\r\n", 8);
  const auto record = [&](int op, const std::string& content) {
    bytes.push_back(static_cast<char>(op));
    for (std::size_t k = 0; k < 8; ++k) bytes.push_back(static_cast<char>(content.size() >> (8 * k)));
    bytes += content;
  };
  record(1, std::string(8, '\0'));
  record(4, std::string("\0\0\0\0\2\0\0\0/a\4\0\0\0json\0\0\0\0", 22));
  for (char k = 0; k < 5; ++k) {
    std::string message(22, '\0');
    message[6] = message[14] = k;
    record(5, message + std::to_string(k));
  }
  record(15, std::string(4, '\0'));
  record(2, std::string(20, '\0'));
  bytes += std::string("\x89MCAP0\r\n", 8);
  const test::TemporaryDirectory directory;
  write_file(directory.file("a"), bytes);
  Reader reader(directory.file("a"));
  EXPECT_EQ(texts(reader, "/a"), (std::vector<std::string>{"0", "1", "2", "3", "4"}));
  EXPECT_EQ(texts(reader, "/a", 2, 3), (std::vector<std::string>{"2", "3"}));
  EXPECT_EQ(last_text(reader, "/a", 3), "3");
}

TEST(McapReader, AForgedSizeCostsNoMemory) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  write_sample(path, 100, {"", "", 1, 1000000});
  std::string bytes = test::contents(path);
  Reader sound(path);
  // The chunk's uncompressed size stands 16 bytes into its content; claim a bit below 1 GiB.
  std::size_t at = 8;
  while (bytes[at] != 6) {
    std::uint64_t length = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      length |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + 1 + k])) << (8 * k);
    }
    at += 9 + length;
  }
  bytes[at + 9 + 16 + 3] = '\x3F';
  spill(path, bytes);
  Reader reader(path);
  EXPECT_TRUE(texts(reader, "/a").empty());
  EXPECT_FALSE(reader.warnings().empty());
}

// Thousands of damaged files: an error or fewer messages, never a crash. Under the address
// sanitizer this also shows that nothing is read out of bounds.
TEST(McapReader, SurvivesMutations) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  std::uint64_t seed = 1;
  const auto draw = [&](std::size_t below) { return static_cast<std::size_t>(world::mix(++seed) % below); };
  std::size_t readable = 0;
  for (const int level : {0, 1}) {
    write_sample(path, 120, {"p", "l", level, 900});
    const std::string whole = test::contents(path);
    for (int round = 0; round < 1500; ++round) {
      std::string bytes = whole;
      for (std::size_t k = 0; k <= draw(4); ++k) {
        // Anywhere, or in the summary at the end.
        const std::size_t from = draw(2) == 0 || bytes.size() < 900 ? 0 : bytes.size() - 900;
        const std::size_t at = from + draw(bytes.size() - from);
        switch (draw(5)) {
          case 0: bytes[at] = static_cast<char>(draw(256)); break;
          case 1: bytes[at] = static_cast<char>(bytes[at] ^ (1 << draw(8))); break;
          case 2: bytes.erase(at, draw(40)); break;
          case 3: bytes.insert(at, std::string(draw(20), '\xFF')); break;
          default:
            for (std::size_t b = at; b < std::min(at + 8, bytes.size()); ++b) bytes[b] = draw(2) == 0 ? '\xFF' : '\0';
        }
        if (bytes.empty()) bytes.push_back('x');
      }
      spill(path, bytes);
      try {
        Reader reader(path);
        ++readable;
        for (const auto& [id, channel] : reader.channels()) {
          reader.messages(id, [](const LoggedMessage&) { return true; });
          reader.last_before(id, 60000000, [](const LoggedMessage&) { return true; });
        }
      } catch (const FileError&) {}
    }
  }
  EXPECT_GT(readable, 1000U);
}

}  // namespace
}  // namespace banyan::record::mcap
