// SPDX-License-Identifier: MIT
// What robots broadcast, as a table of fields and as a channel of a recording.
#include "message_json.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "banyan/measure/observer.hpp"
#include "banyan/record/mcap.hpp"
#include "banyan/world/world.hpp"
#include "sample.hpp"

namespace banyan::record {
namespace {

using nlohmann::json;
using Kept = MessageField::Kept;

world::Scenario scenario() {
  world::Scenario s;
  s.name = "messages";
  s.swarm.robots = 20;
  s.targets = world::RingTargets{3, 3.0, 0.0, {}};
  s.radio.line_of_sight = true;
  s.events = {{4.0, world::Event::Kind::die, 3, 0.0, {}}};
  return s;
}

json object(mcap::Reader& reader, const char* topic, std::uint64_t tick) {
  json found;
  reader.messages(reader.find_channel(topic)->id, [&](const mcap::Message& m) {
    json value = json::parse(m.data);
    if (value["tick"] != tick) return true;
    found = std::move(value);
    return false;
  });
  return found;
}

TEST(MessageFields, HaveEachANameAMeaningAndTheDocumentsField) {
  std::ifstream in(BANYAN_SOURCE_DIR "/docs/protocol.md");
  const std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::set<std::string_view> names;
  for (const MessageField& field : message_fields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_FALSE(field.meaning.empty()) << field.name;
    // "centroid_x_cm" is "centroid" there, "flood_done" is "flood done".
    std::string plain = std::regex_replace(std::string(field.name), std::regex("(_[xy])?(_c?m)?$"), "");
    plain = std::regex_replace(plain, std::regex("_"), " ");
    EXPECT_NE(page.find(plain), std::string::npos) << field.name << " as \"" << plain << "\"";
  }
  EXPECT_EQ(names.size(), 54U);
}

TEST(MessageFields, NobodyAndUnknownAreMinusOne) {
  const Message silent;
  const std::set<std::string_view> none{
      "id",           "root_id", "label_cm",    "tree_hops",      "call_hops", "parent",   "old_parent",
      "flood_parent", "grant",   "request",     "inserted_child", "warned",    "new_root", "serves",
      "told",         "task",    "task_holder", "task_host",      "above",     "below"};
  for (const MessageField& field : message_fields())
    EXPECT_EQ(field.get(silent), none.contains(field.name) ? -1.0 : 0.0) << field.name;
  Message message;
  message.pull_x = 8192;
  message.q = {1.5F, -2.0F};
  message.role = Role::worker;
  message.pinned = true;
  for (const MessageField& field : message_fields()) {
    if (field.name == "pull_x") { EXPECT_EQ(field.get(message), 0.5); }
    if (field.name == "q_y_m") { EXPECT_EQ(field.get(message), -2.0); }
    if (field.name == "role") { EXPECT_EQ(field.get(message), 2.0); }
    if (field.name == "pinned") { EXPECT_EQ(field.get(message), 1.0); }
  }
}

class RecordedMessages : public ::testing::Test {
 protected:
  // Every second tick of ten seconds; the messages of those are kept here too.
  void record(const std::string& path, bool messages) {
    world::World world(scenario());
    measure::Observer observer(world);
    RecorderOptions options;
    options.messages = messages;
    options.every_ticks = 2;
    Recorder recorder(path, {}, options);
    for (int t = 0; t < 100; ++t) {
      world.step();
      recorder.frame(world, observer.observe(world));
      if (world.tick() % 2 == 0) sent_[world.tick()] = {world.messages().begin(), world.messages().end()};
    }
    recorder.finish(observer.result(world));
  }
  const test::TemporaryDirectory directory_;
  std::map<std::uint64_t, std::vector<Message>> sent_;
};

// What is left out of the messages stands in the frame of the same moment: the page puts both together.
TEST_F(RecordedMessages, AreWhatWasSentAtEveryRecordedFrame) {
  const std::string path = directory_.file("a.mcap");
  record(path, true);
  mcap::Reader reader(path);
  EXPECT_EQ(reader.message_count(reader.find_channel("/banyan/messages")->id), sent_.size());
  EXPECT_EQ(reader.message_count(reader.find_channel("/banyan/frame")->id), sent_.size());
  for (const auto& [tick, sent] : sent_) {
    const json messages = object(reader, "/banyan/messages", tick);
    const json frame = object(reader, "/banyan/frame", tick);
    ASSERT_TRUE(messages.is_object() && frame.is_object()) << tick;
    for (const MessageField& field : message_fields()) {
      const std::string name(field.name);
      EXPECT_EQ(messages.contains(name), field.kept == Kept::in_messages) << name;
      for (std::size_t i = 0; i < sent.size() && field.kept != Kept::nowhere && name != "id"; ++i) {
        const bool centimetres = name == "want_cm";
        const json& values = field.kept == Kept::in_messages ? messages[name] : frame[centimetres ? "want_m" : name];
        const double value = values.at(i).get<double>() * (centimetres ? 100.0 : 1.0);
        EXPECT_NEAR(value, field.get(sent[i]), field.decimals == 0 ? 1e-6 : 0.51e-3)
            << name << " of " << i << " at " << tick;
      }
    }
  }
}

TEST_F(RecordedMessages, AreLeftOutWhereNotWantedOrNotKnown) {
  record(directory_.file("a.mcap"), false);
  EXPECT_EQ(mcap::Reader(directory_.file("a.mcap")).find_channel("/banyan/messages"), nullptr);
  test::record_sample(directory_.file("b.mcap"), 5, 10);  // frames without a world
  mcap::Reader reader(directory_.file("b.mcap"));
  EXPECT_EQ(reader.message_count(reader.find_channel("/banyan/messages")->id), 0U);
}

}  // namespace
}  // namespace banyan::record
