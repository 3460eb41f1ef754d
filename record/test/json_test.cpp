// SPDX-License-Identifier: MIT
// Messages of a recording one by one: as numbers, and as JSON that a library reads.
#include "banyan/record/json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "banyan/controller/convoy/message.hpp"
#include "banyan/controller/paper/message.hpp"
#include "frame_json.hpp"
#include "message_json.hpp"
#include "sample.hpp"
#include "saying.hpp"

namespace banyan::record {
namespace {

using Json = nlohmann::json;

TEST(Pack, HasTheNumbersOfARecordedFrameColumnByColumn) {
  Frame frame;
  frame.robots.resize(3);
  frame.robots[1] = {.position = {1.25, -2.5},
                     .role = Role::worker,
                     .label_m = 0.17,
                     .parent = 2,
                     .want_m = 0.75,
                     .target = 1,
                     .spent = 0.125,
                     .raised = true};
  Text text;
  write_frame(text, frame);
  const Json recorded = Json::parse(text.view());
  std::vector<double> packed(5, 99.0);
  pack(frame, packed);
  ASSERT_EQ(packed.size(), 3 * frame_columns().size());
  for (std::size_t c = 0; c < frame_columns().size(); ++c)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(packed[c * 3 + i], recorded[std::string(frame_columns()[c].name)][i].get<double>())
          << frame_columns()[c].name << " of robot " << i;
  EXPECT_EQ(recorded.size(), frame_columns().size() + 2) << "tick and time_s are no columns";
}

// An array that is left out where it would hold nothing but zeros.
template <class Member, class Value>
void expect_only_if_any(std::string_view name, Member member, Value value, std::string_view array) {
  Frame frame;
  frame.robots.resize(2);
  const auto written = [&] {
    Text text;
    write_frame(text, frame);
    return std::string(text.view());
  };
  EXPECT_EQ(written().find(name), std::string::npos);
  frame.robots[1].*member = value;
  EXPECT_NE(written().find(array), std::string::npos) << written();
  Frame read;
  read_frame(written(), read);
  EXPECT_EQ(read, frame);
  frame.robots[1].*member = Value{};
  read_frame(written(), read);
  EXPECT_EQ(read, frame);
}

TEST(Frames, HaveNoArrayOfAntennasWhereNoneIsRaised) {
  expect_only_if_any("raised", &RobotFrame::raised, true, "\"raised\":[0,1]");
}

TEST(Frames, NameRobotsUpToTheLargest) {
  Frame frame;
  frame.robots.resize(2);
  const auto survives = [&](std::int32_t parent) {
    frame.robots[1].parent = parent;
    Text text;
    write_frame(text, frame);
    Frame read;
    read_frame(text.view(), read);
    return read == frame;
  };
  EXPECT_TRUE(survives(65'534));
  EXPECT_THROW((void)survives(65'535), std::runtime_error);
  EXPECT_EQ(read_targets(R"({"x_m":[1],"y_m":[3],"worker":[65534],"active":[1]})")[0].worker, 65'534);
}

TEST(Frames, HaveNoArrayOfChargesWithoutBatteries) {
  expect_only_if_any("spent", &RobotFrame::spent, 0.25, "\"spent\":[0.000,0.250]");
}

TEST(Targets, AreReadWholeOrNotAtAll) {
  const auto targets = read_targets(R"({"x_m":[1,2],"y_m":[3,4],"worker":[0,-1],"active":[1,0]})");
  ASSERT_EQ(targets.size(), 2U);
  EXPECT_TRUE(targets[0].active && !targets[1].active);
  for (const char* text :
       {R"({"x_m":[1],"y_m":[3],"worker":[0],"active":[]})", R"({"x_m":[1],"y_m":[3],"worker":[0]})"})
    EXPECT_THROW((void)read_targets(text), std::runtime_error) << text;
}

TEST(Settings, HaveNamesWhereRobotsHaveThem) {
  Text text;
  Setting setting;
  write_setting(text, setting);
  EXPECT_EQ(text.view().find("names"), std::string_view::npos);
  setting.names = {"cf_1", "", "l\u00e9o \"2\""};
  text.clear();
  write_setting(text, setting);
  EXPECT_TRUE(read_setting(text.view()) == setting);
  Json damaged = Json::parse(text.view());
  for (const Json& wrong : {Json(7), Json{1, 2}, Json("cf_1")}) {
    damaged["names"] = wrong;
    EXPECT_THROW((void)read_setting(damaged.dump()), std::runtime_error) << wrong;
  }
}

TEST(Settings, HaveAllTheirFields) {
  Text text;
  Setting setting;
  setting.dead_bodies = false;
  setting.sight_leak = 0.18;
  write_setting(text, setting);
  EXPECT_TRUE(read_setting(text.view()) == setting);
  const Json whole = Json::parse(text.view());
  for (const auto& field : whole.items()) {
    Json object = whole;
    object.erase(field.key());
    EXPECT_THROW((void)read_setting(object.dump()), std::runtime_error) << field.key();
  }
}

template <class Message> std::vector<double> shown(const Message& message) {
  const auto swarm = test::saying(message);
  MessageNumbers numbers;
  capture_messages(*swarm, swarm->size(), numbers);
  return numbers.numbers;
}

template <class Message> class MessageFields : public ::testing::Test {};
using MessageTypes = ::testing::Types<paper::Message, ConvoyMessage>;
TYPED_TEST_SUITE(MessageFields, MessageTypes);

// Each byte that travels must show in some field, and no field may be there twice.
TYPED_TEST(MessageFields, ShowEverythingThatTravels) {
  TypeParam message;
  message.id = 1;
  if constexpr (requires { message.q_x; }) message.q_x = message.q_y = 0.5F;  // minus nothing is nothing
  else message.q = {0.5F, 0.5F};
  std::set<std::string_view> names;
  for (const FieldInfo& field : test::saying(message)->message_fields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_FALSE(field.meaning.empty()) << field.name;
  }
  std::vector<std::uint8_t> wire(wire_size<TypeParam>());
  ASSERT_EQ(encode_fields(message, wire), wire.size());
  for (std::size_t at = 1; at < wire.size(); ++at) {
    bool seen = false;
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::vector<std::uint8_t> other = wire;
      other[at] = static_cast<std::uint8_t>(other[at] ^ (1U << bit));
      const auto decoded = decode_fields<TypeParam>(other);
      if (!decoded) continue;
      EXPECT_NE(shown(*decoded), shown(message)) << "byte " << at << ", bit " << bit;
      seen = true;
    }
    EXPECT_TRUE(seen) << at;
  }
}

TEST(MessageJson, HasRolePhaseAndNeedAsWords) {
  HealingMessage message;
  message.id = 4;
  message.role = Role::connector;
  message.phase = Phase::grow_tree;
  message.need = Need::await;
  message.want = 320;
  message.q_x = 0.5F, message.q_y = -0.25F;
  const auto swarm = test::saying(message);
  const Json json = Json::parse(message_json(*swarm, 0));
  EXPECT_EQ(json.size(), swarm->message_fields().size());
  EXPECT_EQ(json["id"], 4);
  EXPECT_EQ(json["role"], "connector");
  EXPECT_EQ(json["phase"], "grow_tree");
  EXPECT_EQ(json["need"], "await");
  EXPECT_EQ(json["want"], 1.25);
  EXPECT_EQ(json["q_y"], -0.25);
  EXPECT_EQ(json["parent"], -1);
  EXPECT_EQ(json["label"], -1);
  EXPECT_EQ(json["tree_hops"], -1);
}

TEST(ResultJson, HasTheColumnsThatARecordingKeeps) {
  measure::Run run;
  run.robots = 12;
  const Json json = Json::parse(result_json(run));
  EXPECT_EQ(json["robots"], "12");
  EXPECT_EQ(json["complete"], "false");
  EXPECT_EQ(json["completion_time_s"], "");
  EXPECT_EQ(json["hash"], "0000000000000000");
  EXPECT_FALSE(json.contains("name"));
}

}  // namespace
}  // namespace banyan::record
