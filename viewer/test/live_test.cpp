// SPDX-License-Identifier: MIT
// The run behind the page, natively; test/wasm/ plays it as WebAssembly.
#include "live.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>
#include <string>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"
#include "banyan/record/json.hpp"
#include "banyan/record/recording.hpp"
#include "banyan/world/world.hpp"

namespace banyan::viewer {
namespace {

using Json = nlohmann::json;

std::string file(const std::string& path) {
  std::ifstream in(std::string(BANYAN_SOURCE_DIR "/") + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string hexadecimal(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

class LiveTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(live.load("rooms.toml", file("scenarios/rooms.toml"), {}), Lines{}); }
  void expect_done(const std::string& event) { EXPECT_EQ(live.intervene(event), Lines{}) << event; }
  void play() {
    live.step(12);
    expect_done(R"({"kind": "die", "robot": 3})");
    expect_done(R"({"kind": "move_obstacle", "obstacle": 4, "position_m": [0.3, -0.7]})");
    live.step(1);
    expect_done(R"({"kind": "set_line_of_sight", "line_of_sight": false})");
    expect_done(R"({"kind": "kill", "count": 2, "every_s": 0.7})");
    live.step(27);
  }

  using Lines = std::vector<std::string>;
  Live live{algorithms()};
};

// One line of columns in src/frame.ts, one table in record/.
TEST(Frame, ThePageNamesTheColumnsThatTheSimulationPacks) {
  const std::string source = file("viewer/src/frame.ts");
  const std::size_t begin = source.find("export const columns = [");
  ASSERT_NE(begin, std::string::npos);
  const std::string list = source.substr(begin, source.find(']', begin) - begin);
  const std::regex name("'([a-z_]+)'");
  std::vector<std::string> names;
  for (std::sregex_iterator at(list.begin(), list.end(), name), end; at != end; ++at) names.push_back((*at)[1]);
  EXPECT_EQ(names, Live::columns());
  EXPECT_EQ(names.size(), 20U);
}

TEST_F(LiveTest, ItsFrameIsTheWorld) {
  live.step(40);
  world::World world(
      config::parse_configuration("rooms.toml", file("scenarios/rooms.toml"), algorithms()).configuration.scenario);
  for (int t = 0; t < 40; ++t) world.step();
  EXPECT_EQ(live.hash(), hexadecimal(world.hash()));
  record::Frame frame;
  capture(world, frame);
  const auto data = live.frame();
  ASSERT_EQ(live.robots(), world.size());
  ASSERT_EQ(data.size(), 20 * world.size());
  for (std::size_t i = 0; i < world.size(); ++i) {
    EXPECT_EQ(data[i], world.positions()[i].x);
    EXPECT_EQ(data[world.size() + i], world.positions()[i].y);
    EXPECT_EQ(data[3 * world.size() + i], static_cast<double>(world.reports()[i].role));
    EXPECT_EQ(data[12 * world.size() + i], frame.robots[i].parent);
    EXPECT_EQ(data[17 * world.size() + i], frame.robots[i].target);
  }
  const Json targets = Json::parse(live.targets_json());
  EXPECT_EQ(targets["x_m"].size(), world.targets().size());
  EXPECT_EQ(targets["worker"][0], world.targets()[0].worker);
  const Json metrics = Json::parse(live.metrics_json());
  EXPECT_EQ(metrics["tick"], 40);
  EXPECT_EQ(metrics["alive"], world.size());
}

TEST_F(LiveTest, WhatAVisitorDidIsInTheSavedScenario) {
  play();
  const auto saved = config::parse_configuration("saved.toml", live.scenario_toml(), algorithms());
  ASSERT_TRUE(saved.ok());
  world::World world(saved.configuration.scenario);
  while (world.tick() < live.tick()) world.step();
  EXPECT_EQ(hexadecimal(world.hash()), live.hash());
  EXPECT_EQ(Json::parse(live.config_json())["events"].size(), 4U);
  EXPECT_EQ(Json::parse(live.setting_json()), Json::parse(record::setting_json(record::setting_of(world))));
  EXPECT_FALSE(Json::parse(live.setting_json())["line_of_sight"].get<bool>());
}

// 0.1 has no exact binary form: times of ticks must come back to the last bit, whatever the tick.
TEST(Saved, TimesComeBackExactly) {
  for (const char* tick_s : {"tick_s=0.1", "tick_s=0.07", "tick_s=0.033333333333333333"}) {
    Live live(algorithms());
    static_cast<void>(live.load("a.toml", file("scenarios/three-targets.toml"), {tick_s}));  // warnings are fine
    ASSERT_TRUE(live.loaded());
    for (int k = 0; k < 60; ++k) {
      live.step(1);
      ASSERT_TRUE(live.intervene(R"({"kind": "set_loss", "loss": 0.)" + std::to_string(k) + "}").empty());
    }
    live.step(1);
    const auto saved = config::parse_configuration("saved.toml", live.scenario_toml(), algorithms());
    ASSERT_TRUE(saved.ok());
    world::World world(saved.configuration.scenario);
    while (world.tick() < live.tick()) world.step();
    EXPECT_EQ(hexadecimal(world.hash()), live.hash()) << tick_s;
  }
}

TEST_F(LiveTest, GoingBackForgetsWhatWasDoneFromThereOn) {
  live.step(12);
  expect_done(R"({"kind": "die", "robot": 3})");
  live.step(8);
  const std::string at_20 = live.hash();
  expect_done(R"({"kind": "set_loss", "loss": 0.5})");
  live.rewind(20);
  EXPECT_EQ(Json::parse(live.config_json())["events"].size(), 2U) << "the head is where it was: nothing is forgotten";
  live.step(20);
  live.rewind(20);
  EXPECT_EQ(live.hash(), at_20);
  EXPECT_EQ(Json::parse(live.config_json())["events"].size(), 1U);
  EXPECT_EQ(Json::parse(live.take_events_json()).size(), 0U);
  live.step(10);
  live.rewind(12);
  live.step(18);
  EXPECT_EQ(Json::parse(live.config_json()).value("events", Json::array()).size(), 0U);
  EXPECT_EQ(Json::parse(live.metrics_json())["alive"], live.robots());
  EXPECT_THROW(live.rewind(31), std::invalid_argument);
  EXPECT_EQ(live.tick(), 30U);
}

TEST_F(LiveTest, EventsComeOnce) {
  live.step(30);
  expect_done(R"({"kind": "die", "robot": 3})");
  static_cast<void>(live.take_events_json());
  live.step(2);
  const Json events = Json::parse(live.take_events_json());
  const auto death = std::find_if(events.begin(), events.end(), [](const Json& e) { return e["kind"] == "death"; });
  ASSERT_NE(death, events.end());
  EXPECT_EQ((*death)["robot"], 3);
  EXPECT_EQ((*death)["tick"], 31);
  EXPECT_EQ(live.take_events_json(), "[]");
}

TEST_F(LiveTest, ARecordingIsTheRunSoFar) {
  play();
  const std::string path = ::testing::TempDir() + "/banyan-live-test.mcap";
  std::ofstream(path, std::ios::binary) << live.recording();
  record::Recording recording(path);
  std::remove(path.c_str());
  EXPECT_EQ(recording.frames(), live.tick() + 1);
  EXPECT_EQ(recording.result().at("hash"), live.hash());
  EXPECT_EQ(recording.result().at("interrupted"), "true");
  EXPECT_EQ(Json::parse(recording.provenance().config_json), Json::parse(live.config_json()));
  EXPECT_TRUE(recording.warnings().empty());
}

TEST_F(LiveTest, ItEndsWhereTheProgramDoesAndGoesOnWhenAsked) {
  ASSERT_TRUE(live.load("three-targets.toml", file("scenarios/three-targets.toml"), {}).empty());
  while (!live.finished()) live.step();
  EXPECT_TRUE(live.complete());
  EXPECT_EQ(Json::parse(live.result_json())["complete"], "true");
  EXPECT_EQ(live.scenario_toml().find("stop_when_complete = false"), std::string::npos);
  live.step(50);
  EXPECT_NE(live.scenario_toml().find("stop_when_complete = false"), std::string::npos);
  EXPECT_TRUE(live.finished());
}

TEST_F(LiveTest, AMessageHasItsFields) {
  EXPECT_EQ(live.message_json(0), "null") << "it has not spoken";
  live.step(60);
  const Json message = Json::parse(live.message_json(2));
  EXPECT_EQ(message["id"], 2);
  EXPECT_TRUE(message["role"].is_string());
  EXPECT_TRUE(message["want"].is_number());
  EXPECT_EQ(live.message_json(36), "null");
}

TEST_F(LiveTest, TheSettingHasAnotherNumberWhenItChanges) {
  const std::uint64_t before = live.setting_version();
  live.step(5);
  expect_done(R"({"kind": "set_loss", "loss": 0.2})");
  live.step(5);
  EXPECT_EQ(live.setting_version(), before);
  expect_done(R"({"kind": "move_obstacle", "obstacle": 0, "position_m": [9, 9]})");
  live.step(1);
  const std::uint64_t then = live.setting_version();
  EXPECT_NE(then, before);
  live.rewind(4);
  EXPECT_NE(live.setting_version(), then);
}

TEST(Unloaded, SaysSo) {
  Live live(algorithms());
  EXPECT_FALSE(live.loaded());
  EXPECT_THROW(live.step(), std::logic_error);
  EXPECT_THROW(static_cast<void>(live.hash()), std::logic_error);
  const auto said = live.load("w.toml", "[radio]\nloss = 2\n[targets]\ncount = 2\n", {"tick_s=no"});
  ASSERT_EQ(said.size(), 2U);
  EXPECT_EQ(said[0], "w.toml:2: error: radio.loss: is 2; allowed: 0 to 1");
  EXPECT_TRUE(said[1].starts_with("--set tick_s=no: error: tick_s: must be a number"));
  EXPECT_FALSE(live.loaded());
}

TEST_F(LiveTest, RefusesInWords) {
  live.step(3);
  const std::string before = live.hash();
  const auto refuses = [&](const std::string& event, const std::string& words) {
    const auto said = live.intervene(event);
    EXPECT_TRUE(std::any_of(said.begin(), said.end(), [&](const std::string& line) { return line.starts_with(words); }))
        << event << ": " << (said.empty() ? "nothing" : said.front());
  };
  refuses("", "this is not JSON");
  refuses("[]", "an intervention is a table of keys");
  refuses("{}", "kind: is missing");
  refuses(R"({"kind": "die"})", "robot: is missing");
  refuses(R"({"kind": "die", "robot": 36})", "robot: there is no robot 36; the last one is 35");
  refuses(R"({"kind": "die", "robot": 1, "loss": 0})", "loss: has no meaning with kind = \"die\"");
  refuses(R"({"kind": "die", "robot": 1, "when": "complete"})", "when: ");
  refuses(R"({"kind": "die", "robot": 1, "time_s": 1})", "time_s: ");
  refuses(R"({"kind": "move_target", "target": 4, "position_m": [0, 0]})", "target: there is no target 4");
  live.step(1);
  live.rewind(3);
  EXPECT_EQ(live.hash(), before);
}

TEST_F(LiveTest, IsTheSameForAnyNumberOfThreads) {
  live.step(60);
  const std::string hash = live.hash();
  for (const int threads : {2, 3, 4}) {
    live.use_threads(threads);  // also in the middle of a run
    live.rewind(30);
    live.use_threads(1 + threads % 2);
    live.step(30);
    EXPECT_EQ(live.hash(), hash) << threads;
  }
}

}  // namespace
}  // namespace banyan::viewer
