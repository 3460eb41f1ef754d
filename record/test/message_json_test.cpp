// SPDX-License-Identifier: MIT
// What robots broadcast, as a table of fields and as a channel of a recording.
#include "message_json.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "banyan/controller/convoy/message.hpp"
#include "banyan/measure/observer.hpp"
#include "banyan/record/mcap.hpp"
#include "banyan/world/world.hpp"
#include "plain_scenario.hpp"
#include "sample.hpp"
#include "saying.hpp"

namespace banyan::record {
namespace {

using nlohmann::json;

world::Scenario scenario() {
  world::Scenario s = world::plain_scenario();
  s.name = "messages";
  s.swarm.robots = 20;
  s.targets = world::RingTargets{3, 3.0, 0.0, {}};
  s.radio.line_of_sight = true;
  s.events = {{.time_s = 4.0, .action = world::Die{3}}};
  return s;
}

json object(mcap::Reader& reader, const char* topic, std::uint64_t tick) {
  json found;
  reader.messages(reader.find_channel(topic)->id, [&](const mcap::LoggedMessage& m) {
    json value = json::parse(m.data);
    if (value["tick"] != tick) return true;
    found = std::move(value);
    return false;
  });
  return found;
}

// The table of docs/protocol.md, section 1, made anew from the lists of fields: name and bits.
struct Rows {
  std::vector<std::string> list;
  void add(const std::string& name, std::size_t bits) { list.push_back(name + " " + std::to_string(bits)); }
  template <class T> void add_bytes(const char* name, const T&) { add(name, 8 * sizeof(T)); }
  template <class E> void choice(const char* name, const char*, const E&, int bits, E) {
    add(name, static_cast<std::size_t>(bits));
  }
  void flag(const char* name, const char*, bool) { add(name, 1); }
  template <class T> void number(const char* name, const char*, const T& v) { add_bytes(name, v); }
  template <class T> void known(const char* name, const char*, const T& v) { add_bytes(name, v); }
  void robot(const char* name, const char*, RobotId v) { add_bytes(name, v); }
  void count(const char* name, const char*, RobotCount v) { add_bytes(name, v); }
  template <class T> void scaled(const char* name, const char*, const T& v, float) { add_bytes(name, v); }
  void coordinate(const char* name, const char*, Coordinate v) { add_bytes(name, v.bits); }
  void real(const char* name, const char*, float v, float) { add_bytes(name, v); }
};

std::vector<std::string> rows_of_document() {
  std::ifstream in(BANYAN_SOURCE_DIR "/docs/protocol.md");
  const std::regex row(R"(`(\w+)`(, `(\w+)`)?: (2 \S+ )?(\d+) \|.*)");
  std::vector<std::string> list;
  std::string line;
  std::smatch match;
  while (std::getline(in, line)) {
    if (!std::regex_match(line, match, row)) continue;
    list.push_back(match[1].str() + " " + match[5].str());
    if (match[3].matched) list.push_back(match[3].str() + " " + match[5].str());
  }
  return list;
}

TEST(MessageFields, StandInTheDocumentInTheirOrderWithTheirSizes) {
  Rows rows;
  const PoweredConvoyMessage message;  // has all blocks
  visit_fields(rows, message);
  EXPECT_EQ(rows.list.size(), 64U);
  EXPECT_EQ(rows_of_document(), rows.list);
}

// The numbers of a message, by name.
std::map<std::string_view, double> numbers_of(const ConvoyMessage& message) {
  const auto swarm = test::saying(message);
  MessageNumbers captured;
  capture_messages(*swarm, swarm->size(), captured);
  std::map<std::string_view, double> numbers;
  for (std::size_t f = 0; f < captured.fields.size(); ++f) numbers[captured.fields[f].name] = captured.numbers[f];
  return numbers;
}

TEST(MessageFields, NobodyAndUnknownAreMinusOne) {
  const std::set<std::string_view> none{
      "id",           "root_id", "label",       "tree_hops",      "call_hops", "parent",   "old_parent",
      "flood_parent", "grant",   "request",     "inserted_child", "warned",    "new_root", "serves",
      "told",         "task",    "task_holder", "task_host",      "above",     "below"};
  for (const auto& [name, number] : numbers_of({})) EXPECT_EQ(number, none.contains(name) ? -1.0 : 0.0) << name;
  ConvoyMessage message;
  message.pull_x = 8192;
  message.q_x = 1.5F, message.q_y = -2.0F;
  message.role = Role::worker;
  message.pinned = true;
  const auto numbers = numbers_of(message);
  EXPECT_EQ(numbers.at("pull_x"), 0.5);
  EXPECT_EQ(numbers.at("q_y"), -2.0);
  EXPECT_EQ(numbers.at("role"), 2.0);
  EXPECT_EQ(numbers.at("pinned"), 1.0);
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
      if (world.tick() % 2 == 0) capture_messages(world.swarm(), world.size(), sent_[world.tick()]);
    }
    recorder.finish(observer.result(world));
  }
  const test::TemporaryDirectory directory_;
  std::map<std::uint64_t, MessageNumbers> sent_;
};

// What is left out of the messages stands in the frame of the same moment: the page puts both together.
TEST_F(RecordedMessages, AreWhatWasSentAtEveryRecordedFrame) {
  const std::string path = directory_.file("a.mcap");
  record(path, true);
  mcap::Reader reader(path);
  EXPECT_EQ(reader.message_count(reader.find_channel("/banyan/messages")->id), sent_.size());
  EXPECT_EQ(reader.message_count(reader.find_channel("/banyan/frame")->id), sent_.size());
  const std::set<std::string> nowhere{"root_x", "root_y", "task_x", "task_y"};
  const std::size_t robots = *scenario().swarm.robots;
  for (const auto& [tick, sent] : sent_) {
    const json messages = object(reader, "/banyan/messages", tick);
    const json frame = object(reader, "/banyan/frame", tick);
    ASSERT_TRUE(messages.is_object() && frame.is_object()) << tick;
    for (std::size_t f = 0; f < sent.fields.size(); ++f) {
      const FieldInfo& field = sent.fields[f];
      const std::string name(field.name);
      const bool in_frame = !is_recorded(field) && !nowhere.contains(name);
      EXPECT_EQ(messages.contains(name), is_recorded(field)) << name;
      if (nowhere.contains(name) || name == "id") continue;
      const bool length = name == "want" || name == "label";  // in metres in the frame
      const json& values = in_frame ? frame[length ? name + "_m" : name] : messages[name];
      ASSERT_EQ(values.size(), robots) << name;
      for (std::size_t i = 0; i < robots; ++i) {
        const double number = sent.numbers[i * sent.fields.size() + f];
        const double sent_m =
            number < 0.0 ? -1.0 : scenario().radio.range_m * (name == "label" ? number / 256.0 : number);
        const double step_m = scenario().radio.range_m / 256.0;  // on the wire
        const double rounding = name == "want"                   ? 0.51e-3 + 0.5 * step_m
                                : field.decimals == 0 && !length ? 1e-6
                                                                 : 0.51e-3;
        EXPECT_NEAR(values.at(i).get<double>(), length ? sent_m : number, rounding)
            << name << " of " << i << " at " << tick;
      }
    }
  }
}

TEST_F(RecordedMessages, AreLeftOutWhereNotWantedOrNotKnown) {
  record(directory_.file("a.mcap"), false);
  EXPECT_EQ(mcap::Reader(directory_.file("a.mcap")).find_channel("/banyan/messages"), nullptr);
  test::record_sample(directory_.file("b.mcap"), 5, 10);  // frames without a world
  EXPECT_EQ(mcap::Reader(directory_.file("b.mcap")).find_channel("/banyan/messages"), nullptr);
}

}  // namespace
}  // namespace banyan::record
