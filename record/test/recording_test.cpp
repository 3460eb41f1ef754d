// SPDX-License-Identifier: MIT
// What is recorded comes back; what is broken is said so.
#include "banyan/record/recording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "banyan/measure/observer.hpp"
#include "banyan/record/draw.hpp"
#include "banyan/record/export.hpp"
#include "banyan/record/mcap.hpp"
#include "banyan/world/world.hpp"
#include "plain_scenario.hpp"
#include "sample.hpp"

namespace banyan::record {
namespace {

namespace fs = std::filesystem;

// Zero is "no CRC": damage is then found by whoever reads the messages, or not at all.
std::string without_checksums(std::string bytes) {
  constexpr char chunk = 6, footer = 2;
  for (std::size_t at = 8; at + 9 < bytes.size();) {
    std::uint64_t length = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      length |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + 1 + k])) << (8 * k);
    }
    if (bytes[at] == chunk) bytes.replace(at + 9 + 24, 4, 4, '\0');
    if (bytes[at] == footer) bytes.replace(at + 9 + 16, 4, 4, '\0');
    at += 9 + length;
  }
  return bytes;
}

// Positions and angles are kept with four decimals, other lengths with three.
void expect_recorded(const Frame& got, const Frame& given) {
  EXPECT_EQ(got.tick, given.tick);
  EXPECT_NEAR(got.time_s, given.time_s, 1e-9);
  ASSERT_EQ(got.robots.size(), given.robots.size());
  for (std::size_t i = 0; i < given.robots.size(); ++i) {
    RobotFrame rounded = got.robots[i];
    EXPECT_NEAR(rounded.position.x, given.robots[i].position.x, 0.51e-4);
    EXPECT_NEAR(rounded.position.y, given.robots[i].position.y, 0.51e-4);
    EXPECT_NEAR(rounded.heading_rad, given.robots[i].heading_rad, 0.51e-4);
    EXPECT_NEAR(rounded.label_m, given.robots[i].label_m, 0.51e-3);
    rounded.position = given.robots[i].position;
    rounded.label_m = given.robots[i].label_m;
    rounded.heading_rad = given.robots[i].heading_rad;
    EXPECT_TRUE(rounded == given.robots[i]) << "robot " << i;
  }
  EXPECT_TRUE(got.targets == given.targets);
}

TEST(Recording, EveryFieldOfEveryFrameComesBack) {
  const test::TemporaryDirectory directory;
  RecorderOptions options;
  options.chunk_bytes = 10000;
  test::record_sample(directory.file("a.mcap"), 30, 120, options);
  EXPECT_FALSE(fs::exists(directory.file("a.mcap.part")));
  Recording recording(directory.file("a.mcap"));
  EXPECT_TRUE(recording.warnings().empty()) << recording.warnings()[0];
  EXPECT_EQ(recording.frames(), 120U);
  EXPECT_DOUBLE_EQ(recording.start_s(), 0.0);
  EXPECT_NEAR(recording.end_s(), 11.9, 1e-9);
  std::uint64_t tick = 0;
  recording.for_each([&](const Frame& frame) {
    expect_recorded(frame, test::sample_frame(30, 3.0, tick++));
    return true;
  });
  EXPECT_EQ(tick, 120U);
}

TEST(Recording, ProvenanceSettingAndResultComeBack) {
  const test::TemporaryDirectory directory;
  test::record_sample(directory.file("a.mcap"), 9, 20);
  const Recording recording(directory.file("a.mcap"));
  const Provenance given = test::sample_provenance();
  EXPECT_EQ(recording.provenance().config_json, given.config_json);
  EXPECT_EQ(recording.provenance().version, given.version);
  EXPECT_EQ(recording.provenance().git, given.git);
  EXPECT_EQ(recording.provenance().seed, given.seed);
  const Setting setting = test::sample_setting();
  EXPECT_EQ(recording.setting().name, setting.name);
  EXPECT_EQ(recording.setting().seed, setting.seed);
  EXPECT_EQ(recording.setting().radius_m, setting.radius_m);
  EXPECT_EQ(recording.setting().line_of_sight, setting.line_of_sight);
  ASSERT_EQ(recording.setting().obstacles.size(), 3U);
  EXPECT_EQ(std::get<world::Disc>(recording.setting().obstacles[0]).radius_m, 0.25);
  EXPECT_EQ(std::get<world::Box>(recording.setting().obstacles[1]).angle_rad, 0.5);
  EXPECT_EQ(std::get<world::Wall>(recording.setting().obstacles[2]).to, (Vec2{1.0, -2.5}));
  EXPECT_EQ(recording.result().at("hash"), "0123456789abcdef");
  EXPECT_EQ(recording.result().at("complete"), "true");
  EXPECT_EQ(recording.result().at("interrupted"), "false");
}

TEST(Recording, ObstaclesAndSightAreThoseOfTheTime) {
  world::Scenario scenario = world::plain_scenario();
  scenario.obstacles = {world::Disc{{9.0, 9.0}, 0.5}};
  scenario.events = {{.time_s = 1.0, .action = world::MoveObstacle{0, {7.0, -7.0}}},
                     {.time_s = 2.0, .action = world::SetLineOfSight{true}}};
  world::World world(scenario);
  measure::Observer observer(world);
  const std::string path = ::testing::TempDir() + "/settings.mcap";
  RecorderOptions options;
  options.existing = Existing::replace;
  Recorder recorder(path, {}, options);
  recorder.frame(world, observer.last());
  while (world.tick() < 30) {
    world.step();
    recorder.frame(world, observer.observe(world));
  }
  recorder.finish(observer.result(world));
  Recording recording(path);
  fs::remove(path);
  EXPECT_EQ(recording.warnings().size(), 0U);
  const auto center = [&](double time_s) {
    return std::get<world::Disc>(recording.setting_at(time_s).obstacles[0]).center;
  };
  EXPECT_EQ(center(0.0), (Vec2{9.0, 9.0}));
  EXPECT_EQ(center(1.05), (Vec2{9.0, 9.0}));
  EXPECT_EQ(center(1.1), (Vec2{7.0, -7.0})) << "it is there after the step that begins at 1 s";
  EXPECT_EQ(center(99.0), (Vec2{7.0, -7.0}));
  EXPECT_FALSE(recording.setting_at(2.0).line_of_sight);
  EXPECT_TRUE(recording.setting_at(2.1).line_of_sight);
  EXPECT_FALSE(recording.setting().line_of_sight);
  std::string told;
  for (const RecordedEvent& event : recording.events())
    if (event.kind == "obstacle_moved" || event.kind == "line_of_sight")
      told += std::to_string(event.tick) + " " + event.text + "\n";
  EXPECT_EQ(told, "11 obstacle 0 has moved to (7.00, -7.00) m\n21 links need a line of sight from now on\n");
}

TEST(Recording, FrameAtIsTheLastOneBefore) {
  const test::TemporaryDirectory directory;
  test::record_sample(directory.file("a.mcap"), 9, 50);
  Recording recording(directory.file("a.mcap"));
  EXPECT_EQ(recording.frame_at(-1.0).tick, 0U);
  EXPECT_EQ(recording.frame_at(0.0).tick, 0U);
  EXPECT_EQ(recording.frame_at(0.3).tick, 3U);  // 0.3 is not 3 x 0.1 in binary
  EXPECT_EQ(recording.frame_at(0.35).tick, 3U);
  EXPECT_EQ(recording.frame_at(4.9).tick, 49U);
  EXPECT_EQ(recording.frame_at(1e9).tick, 49U);
  EXPECT_EQ(recording.frame_at(std::numeric_limits<double>::infinity()).tick, 49U);
  EXPECT_EQ(recording.frame_at(std::numeric_limits<double>::quiet_NaN()).tick, 0U);
}

TEST(Recording, RangesStepsAndStopping) {
  const test::TemporaryDirectory directory;
  test::record_sample(directory.file("a.mcap"), 9, 50);
  Recording recording(directory.file("a.mcap"));
  std::vector<std::uint64_t> ticks;
  const auto note = [&](const Frame& frame) {
    ticks.push_back(frame.tick);
    return ticks.size() < 4;
  };
  recording.for_each(note, 1.0, 2.0, 5);
  EXPECT_EQ(ticks, (std::vector<std::uint64_t>{10, 15, 20}));
  ticks.clear();
  recording.for_each(note, 0.5);
  EXPECT_EQ(ticks, (std::vector<std::uint64_t>{5, 6, 7, 8}));
}

TEST(Recording, EveryNthTickAndAlwaysTheLast) {
  const test::TemporaryDirectory directory;
  RecorderOptions options;
  options.every_ticks = 20;
  test::record_sample(directory.file("a.mcap"), 9, 50, options);
  Recording recording(directory.file("a.mcap"));
  std::vector<std::uint64_t> ticks;
  recording.for_each([&](const Frame& frame) {
    ticks.push_back(frame.tick);
    return true;
  });
  EXPECT_EQ(ticks, (std::vector<std::uint64_t>{0, 20, 40, 49}));
  EXPECT_EQ(recording.metrics().size(), 50U);
}

TEST(Recording, MetricsComeBack) {
  const test::TemporaryDirectory directory;
  test::record_sample(directory.file("a.mcap"), 9, 50);
  Recording recording(directory.file("a.mcap"));
  const auto metrics = recording.metrics();
  ASSERT_EQ(metrics.size(), 50U);
  for (std::uint64_t t = 0; t < 50; ++t) {
    const measure::Tick given = test::sample_tick(test::sample_frame(9, 3.0, t));
    const measure::Tick& got = metrics[t];
    EXPECT_EQ(got.tick, t);
    EXPECT_NEAR(got.time_s, given.time_s, 1e-9);
    EXPECT_EQ(got.broken_by_distance, given.broken_by_distance);
    EXPECT_EQ(got.components, given.components);
    EXPECT_EQ(got.fiedler_low, given.fiedler_low);
    EXPECT_EQ(got.fiedler, given.fiedler);
    EXPECT_EQ(got.worst_target_distance_m, given.worst_target_distance_m);
    EXPECT_EQ(got.targets_reached, given.targets_reached);
  }
}

TEST(Recording, EventsTellWhatChanged) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  const Setting setting = test::sample_setting();
  Frame frame;
  frame.robots.resize(4);
  frame.robots[0].role = Role::root;
  frame.robots[3].role = Role::worker;
  frame.robots[3].target = 0;
  frame.targets = {{{1.0, 0.0}, 3}};
  measure::Tick whole;
  whole.components = whole.active_targets = 1;
  {
    Recorder recorder(path, {});
    const auto next = [&](measure::Tick tick) {
      recorder.frame(setting, frame, tick);
      frame.time_s = 0.1 * static_cast<double>(++frame.tick);
    };
    next(whole);
    frame.robots[1].alive = false;
    next(whole);
    frame.robots[0].role = Role::connector;
    frame.robots[2].role = Role::root;
    measure::Tick split = whole;
    split.components = 2;
    next(split);
    frame.robots[2].epoch = 1;
    frame.robots[2].phase = Phase::start_tree;
    frame.robots[3].position = {0.9, 0.1};
    whole.targets_reached = 1;
    next(whole);
    whole.targets_reached = 0;
    frame.targets[0].position = {2.0, 0.0};
    frame.targets.push_back({{0.0, 2.0}, 0});
    next(whole);
    recorder.event("remark", "\"quoted\"");
    recorder.finish(test::sample_run(5), true);
  }
  Recording recording(path);
  std::vector<std::string> kinds;
  for (const RecordedEvent& event : recording.events()) kinds.push_back(std::to_string(event.tick) + " " + event.kind);
  EXPECT_EQ(kinds,
            (std::vector<std::string>{"1 death", "2 root", "2 split", "3 epoch", "3 phase", "3 joined", "3 arrival",
                                      "3 complete", "4 target_moved", "4 target_added", "4 remark", "4 interrupted"}));
  EXPECT_EQ(recording.events()[1].robot, 2);
  EXPECT_EQ(recording.events()[10].text, "\"quoted\"");
  EXPECT_EQ(recording.result().at("interrupted"), "true");
  EXPECT_EQ(recording.frame_at(0.3).targets.size(), 1U);
  EXPECT_EQ(recording.frame_at(0.4).targets.size(), 2U);
  EXPECT_EQ(recording.frame_at(0.4).targets[0].position, (Vec2{2.0, 0.0}));
}

// What a crash costs: of every channel at most ten simulated seconds.
TEST(Recording, AtEveryMomentThePartHoldsAllButTheLastTenSeconds) {
  const test::TemporaryDirectory directory;
  Recorder recorder(directory.file("a.mcap"), test::sample_provenance());
  for (std::uint64_t t = 0; t < 390; ++t) {
    const Frame frame = test::sample_frame(3, 3.0, t);
    recorder.frame(test::sample_setting(), frame, test::sample_tick(frame));
    if (t % 97 != 0) continue;
    Recording crashed(directory.file("a.mcap.part"));
    const std::size_t safe = t > 100 ? t - 100 : 0;
    EXPECT_GE(crashed.frames(), safe);
    EXPECT_GE(crashed.metrics().size(), safe);
    const auto is_safe = [&](const RecordedEvent& e) { return e.tick < safe; };
    if (t > 200) { EXPECT_TRUE(std::ranges::any_of(crashed.events(), is_safe)); }
  }
}

measure::Tick calm() {
  measure::Tick tick;
  tick.components = 1;
  return tick;
}

measure::Tick of_targets(std::uint32_t active, std::uint32_t reached) {
  measure::Tick tick = calm();
  tick.active_targets = active;
  tick.targets_reached = reached;
  return tick;
}

// Frames are handed in one by one; the texts of the events that come of them, with kind and robot.
class Told {
 public:
  explicit Told(const std::string& path) : path_(path), recorder_(std::in_place, path, Provenance{}) {}
  void next(const Setting& setting, const Frame& frame, const measure::Tick& tick = calm()) {
    Frame now = frame;
    now.tick = tick_;
    now.time_s = 0.1 * static_cast<double>(tick_++);
    recorder_->frame(setting, now, tick);
  }
  std::vector<std::string> events() {
    recorder_->finish(test::sample_run(tick_));
    recorder_.reset();
    std::vector<std::string> all;
    for (const RecordedEvent& e : Recording(path_).events()) {
      all.push_back(e.kind + " " + std::to_string(e.robot) + ": " + e.text);
    }
    return all;
  }

 private:
  std::string path_;
  std::optional<Recorder> recorder_;
  std::uint64_t tick_ = 0;
};

// Robot 0 is root at the origin, 1 a connector, 2 a worker, 3 a spare; a chain along x.
Frame chain() {
  Frame frame;
  frame.robots.resize(4);
  for (std::size_t i = 0; i < 4; ++i) frame.robots[i].position = {static_cast<double>(i), 0.5};
  frame.robots[0].role = Role::root;
  frame.robots[1].role = Role::connector;
  frame.robots[2].role = Role::worker;
  frame.robots[1].parent = 0;
  frame.robots[2].parent = 1;
  return frame;
}

TEST(Events, SayWhatHappenedToWhom) {
  const test::TemporaryDirectory directory;
  Told told(directory.file("a.mcap"));
  Setting setting;
  Frame frame = chain();
  frame.robots[3].request = 2;
  told.next(setting, frame);
  frame.robots[3].role = Role::connector;  // let into the edge of 2
  frame.robots[3].request = -1;
  frame.robots[3].parent = 1;
  told.next(setting, frame);
  frame.robots[3].role = Role::spare;
  told.next(setting, frame);
  frame.robots[3].role = Role::connector;  // without having asked: 2 has chosen it
  frame.robots[2].parent = 3;
  told.next(setting, frame);
  frame.robots[1].role = Role::root;  // hand-over along the tree
  told.next(setting, frame);
  frame.robots[0].role = Role::connector;
  told.next(setting, frame);
  frame.robots[1].alive = false;
  told.next(setting, frame);
  frame.robots[3].role = Role::root;
  told.next(setting, frame);
  frame.robots[2].alive = false;
  frame.robots[0].role = Role::worker;
  told.next(setting, frame);
  EXPECT_EQ(
      told.events(),
      (std::vector<std::string>{
          "inserted 3: robot 3 is inserted between robot 2 and robot 1", "released 3: robot 3 is spare again",
          "recruited 3: robot 3 is a connector: robot 2 hangs on it",
          "root 1: robot 1 takes over the root from robot 0", "death 1: robot 1 died, the root; 1 child hangs on it",
          "root 3: robot 3 is root in place of robot 1, which is dead",
          "worker 0: robot 0 takes over the target of a worker that is lost", "death 2: robot 2 died, a worker"}));
}

TEST(Events, CallRobotsByTheirNames) {
  const test::TemporaryDirectory directory;
  Told told(directory.file("a.mcap"));
  Setting setting;
  setting.names = {"cf_1", "cf_2", "lead"};
  Frame frame = chain();
  told.next(setting, frame);
  frame.robots[1].alive = false;
  told.next(setting, frame);
  frame.robots[2].role = Role::root;
  told.next(setting, frame);
  setting.names.emplace_back("cf_7");
  frame.robots.emplace_back();
  frame.robots[3].alive = false;  // without a name until now
  told.next(setting, frame);
  EXPECT_EQ(told.events(), (std::vector<std::string>{"death 1: robot cf_2 died, a connector; 1 child hangs on it",
                                                     "root 2: robot lead is root beside robot cf_1",
                                                     "death 3: robot cf_7 died, a spare",
                                                     "join 4: robot 4 has joined at (0.00, 0.00) m"}));
}

TEST(Events, ABrokenEdgeIsNamedWithItsReason) {
  const test::TemporaryDirectory directory;
  Setting setting;
  setting.line_of_sight = true;
  const auto text = [&](const Frame& frame, std::uint32_t far, std::uint32_t hidden) {
    const std::string path = directory.file(std::to_string(far) + std::to_string(hidden) + ".mcap");
    Told told(path);
    told.next(setting, chain());
    measure::Tick tick = calm();
    tick.broken_by_distance = far;
    tick.broken_by_occlusion = hidden;
    told.next(setting, frame, tick);
    told.next(setting, frame, tick);  // still the same: said once
    told.next(setting, chain());
    const auto all = told.events();
    EXPECT_EQ(all.size(), 2U);
    EXPECT_EQ(all.back(), "edges_whole -1: no tree edge is broken any more");
    return all.empty() ? std::string() : all.front();
  };
  Frame away = chain();
  away.robots[2].position = {3.25, 0.5};
  EXPECT_EQ(text(away, 1, 0),
            "edges_broken 2: the edge from robot 2 to its parent, robot 1, is broken: 2.25 m apart, out of range");
  Frame hidden = chain();
  hidden.robots[3].position = {0.5, 0.52};
  hidden.robots[1].old_parent = 0;  // the same edge, not another one
  EXPECT_EQ(text(hidden, 0, 1),
            "edges_broken 1: the edge from robot 1 to its parent, robot 0, is broken: occluded by robot 3");
  Frame both = hidden;
  both.robots[2].position = {9.0, 0.5};
  EXPECT_EQ(text(both, 1, 1),
            "edges_broken 1: 2 tree edges are broken, 1 out of range, 1 occluded: of the robots 1 and 2");
  setting.obstacles = {world::Wall{{-1.0, 0.0}, {-1.0, 1.0}}, world::Wall{{0.5, 0.0}, {0.5, 1.0}}};
  Frame old = chain();
  old.robots[1].parent = -1;
  old.robots[1].old_parent = 0;
  EXPECT_EQ(text(old, 0, 2),
            "edges_broken 1: the edge from robot 1 to its old parent, robot 0, is broken: occluded by obstacle 1");
}

TEST(Events, EveryFurtherBrokenEdgeIsTold) {
  const test::TemporaryDirectory directory;
  Told told(directory.file("a.mcap"));
  const Setting setting;
  const auto broken = [](std::uint32_t edges) {
    measure::Tick tick = calm();
    tick.broken_by_distance = edges;
    return tick;
  };
  Frame frame = chain();
  told.next(setting, frame);
  frame.robots[1].position.x = -3.0;  // 1 from 0, and 2 from 1
  told.next(setting, frame, broken(2));
  frame.robots[1].position.x = 3.5;  // 2 is back
  told.next(setting, frame, broken(1));
  frame.robots[2].position.x = 9.0;
  told.next(setting, frame, broken(2));
  told.next(setting, frame, broken(2));
  told.next(setting, chain());
  EXPECT_EQ(told.events(),
            (std::vector<std::string>{"edges_broken 1: 2 tree edges are broken, 2 out of range: of the robots 1 and 2",
                                      "edges_broken 2: the edge from robot 2 to its parent, robot 1, is broken: 5.50 m "
                                      "apart, out of range; 2 are now",
                                      "edges_whole -1: no tree edge is broken any more"}));
}

TEST(Events, WhatMovesOnAndOnIsSaidOnce) {
  const test::TemporaryDirectory directory;
  Told told(directory.file("a.mcap"));
  Setting setting;
  Frame frame = chain();
  frame.robots[2].target = 0;
  frame.targets = {{{2.0, 0.5}, 2}};
  for (int t = 0; t < 40; ++t) {
    if (t >= 5 && t < 30) {  // the worker keeps up, 0.1 m behind
      frame.targets[0].position.x += 0.1;
      frame.robots[2].position.x = frame.targets[0].position.x - 0.1;
    }
    if (t == 35) frame.targets[0].position = {0.0, 0.0};
    told.next(setting, frame, of_targets(1, t < 35 ? 1 : 0));
  }
  EXPECT_EQ(told.events(), (std::vector<std::string>{"arrival 2: robot 2 has reached target T0",
                                                     "complete -1: all targets are held, and the tree is in one piece",
                                                     "target_moved 2: target T0 has moved to (2.10, 0.50) m",
                                                     "target_moved 2: target T0 has moved to (0.00, 0.00) m"}));
}

// Target 0 names robot 2, which dies on its way and, in another run, at the target.
TEST(Events, WhoTakesOverATargetArrivesAndCompletes) {
  const test::TemporaryDirectory directory;
  for (const bool had_arrived : {false, true}) {
    Told told(directory.file(had_arrived ? "at.mcap" : "way.mcap"));
    const Setting setting;
    Frame frame = chain();
    frame.robots[2].target = 0;
    frame.targets = {{had_arrived ? Vec2{2.1, 0.5} : Vec2{5.0, 0.5}, 2}};
    told.next(setting, frame, of_targets(1, had_arrived ? 1 : 0));
    frame.robots[2].alive = false;
    told.next(setting, frame, of_targets(1, 0));
    frame.robots[3].role = Role::worker;
    frame.robots[3].target = 0;
    told.next(setting, frame, of_targets(1, 0));
    frame.robots[3].position = frame.targets[0].position;
    for (int t = 0; t < 3; ++t) told.next(setting, frame, of_targets(1, 1));
    std::vector<std::string> expected;
    const std::string complete = "complete -1: all targets are held, and the tree is in one piece";
    if (had_arrived) expected = {"arrival 2: robot 2 has reached target T0", complete};
    expected.insert(expected.end(), {"death 2: robot 2 died, a worker of target T0",
                                     "worker 3: robot 3 takes over target T0 of a worker that is lost",
                                     "arrival 3: robot 3 has reached target T0", complete});
    EXPECT_EQ(told.events(), expected);
  }
}

TEST(Events, ATargetGivenUpIsToldAndNoLongerCounts) {
  const test::TemporaryDirectory directory;
  Told told(directory.file("a.mcap"));
  const Setting setting;
  Frame frame = chain();
  frame.robots[2].target = 0;
  frame.robots[3].role = Role::worker;
  frame.robots[3].target = 1;
  frame.targets = {{{2.0, 0.5}, 2}, {{9.0, 9.0}, 3}};
  told.next(setting, frame, of_targets(2, 1));
  frame.targets[1].active = false;
  frame.robots[3].target = -1;  // as capture() has it
  frame.robots[3].role = Role::spare;
  told.next(setting, frame, of_targets(1, 1));
  frame.targets[1].position = frame.robots[3].position;  // whatever becomes of it
  told.next(setting, frame, of_targets(1, 1));
  frame.robots[3].alive = false;
  frame.targets[0].active = false;
  told.next(setting, frame, of_targets(0, 0));
  EXPECT_EQ(told.events(), (std::vector<std::string>{
                               "arrival 2: robot 2 has reached target T0", "target_removed 3: target T1 is given up",
                               "complete -1: all targets are held, and the tree is in one piece",
                               "death 3: robot 3 died, a spare", "target_removed 2: target T0 is given up"}));
}

TEST(Events, TheVanishedHideNobody) {
  const test::TemporaryDirectory directory;
  for (const bool dead_bodies : {true, false}) {
    Told told(directory.file(dead_bodies ? "stay.mcap" : "vanish.mcap"));
    Setting setting;
    setting.line_of_sight = true;
    setting.dead_bodies = dead_bodies;
    setting.obstacles = {world::Wall{{0.6, 0.0}, {0.6, 1.0}}};
    Frame frame = chain();
    frame.robots[3].alive = false;
    told.next(setting, frame);
    frame.robots[3].position = {0.5, 0.52};
    measure::Tick tick = calm();
    tick.broken_by_occlusion = 1;
    told.next(setting, frame, tick);
    const std::string who = dead_bodies ? "robot 3" : "obstacle 0";
    EXPECT_EQ(told.events(), (std::vector<std::string>{"edges_broken 1: the edge from robot 1 to its parent, robot 0, "
                                                       "is broken: occluded by " +
                                                       who}));
  }
}

TEST(Recording, WhatIsGivenUpAndWhetherTheDeadVanishComesBack) {
  const test::TemporaryDirectory directory;
  Told told(directory.file("a.mcap"));
  Setting setting;
  setting.dead_bodies = false;
  Frame frame = chain();
  frame.targets = {{{2.0, 0.5}, 2}, {{9.0, 9.0}, 3}};
  told.next(setting, frame);
  frame.targets[1].active = false;
  told.next(setting, frame);
  (void)told.events();
  Recording recording(directory.file("a.mcap"));
  EXPECT_FALSE(recording.setting().dead_bodies);
  EXPECT_FALSE(recording.setting_at(0.1).dead_bodies);
  EXPECT_TRUE(recording.frame_at(0.0).targets[1].active);
  EXPECT_FALSE(recording.frame_at(0.1).targets[1].active);
  EXPECT_TRUE(recording.frame_at(0.1).targets[0].active);
}

// The text of a frame has four decimals, a tick may have more.
TEST(Recording, AFrameIsOfTheTimeOfItsMessage) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  constexpr double tick_s = 0.00013;
  Setting first;
  first.tick_s = tick_s;
  Setting second = first;
  second.line_of_sight = true;
  {
    Recorder recorder(path, {});
    for (std::uint64_t t = 0; t < 20; ++t) {
      Frame frame = chain();
      frame.tick = t;
      frame.time_s = tick_s * static_cast<double>(t);
      recorder.frame(t < 10 ? first : second, frame, calm());
    }
    recorder.finish(test::sample_run(20));
  }
  Recording recording(path);
  std::uint64_t tick = 0;
  recording.for_each([&](const Frame& frame) {
    EXPECT_NEAR(frame.time_s, tick_s * static_cast<double>(tick), 1e-12);
    EXPECT_EQ(recording.setting_at(frame.time_s).line_of_sight, tick >= 10) << tick;
    EXPECT_EQ(recording.frame_at(frame.time_s).tick, tick);
    ++tick;
    return true;
  });
  EXPECT_EQ(tick, 20U);
}

TEST(Recording, ASettingThatChangesIsKept) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  Told told(path);
  const Setting first = test::sample_setting();
  Setting second = first;
  second.obstacles[0] = world::Disc{{-1.0, 0.5}, 0.25};
  second.line_of_sight = false;
  for (int t = 0; t < 10; ++t) told.next(t < 6 ? first : second, chain());
  EXPECT_EQ(told.events(), (std::vector<std::string>{"line_of_sight -1: links need no line of sight from now on",
                                                     "obstacle_moved -1: obstacle 0 has moved to (-1.00, 0.50) m"}));
  Recording recording(path);
  EXPECT_TRUE(recording.setting() == first);
  EXPECT_TRUE(recording.setting_at(-1.0) == first);
  EXPECT_TRUE(recording.setting_at(0.55) == first);
  EXPECT_TRUE(recording.setting_at(0.6) == second);
  EXPECT_TRUE(recording.setting_at(1e9) == second);
  PictureOptions options;
  options.legend = false;
  EXPECT_NE(draw_svg(recording, 0.5, options).find("occlusion"), std::string::npos);
  EXPECT_EQ(draw_svg(recording, 0.6, options).find("occlusion"), std::string::npos);
  mcap::Reader reader(path);
  EXPECT_EQ(reader.message_count(reader.find_channel("/banyan/setting")->id), 2U);
}

TEST(Recording, ObstaclesThatComeAndGoAreTold) {
  const test::TemporaryDirectory directory;
  Told told(directory.file("a.mcap"));
  Setting setting = test::sample_setting();
  const world::Obstacle a = world::Disc{{1.0, 1.0}, 0.25}, b = world::Wall{{2.0, 2.0}, {3.0, 2.0}},
                        c = world::Disc{{4.0, 4.0}, 0.5}, d = world::Disc{{-1.0, 0.5}, 0.5};
  for (const auto& there :
       std::vector<std::vector<world::Obstacle>>{{a, b}, {a, b, c}, {b, c}, {b, d}, {b, d}, {}, {a}}) {
    setting.obstacles = there;
    told.next(setting, chain());
  }
  EXPECT_EQ(told.events(),
            (std::vector<std::string>{
                "obstacle_added -1: obstacle 2 is new, at (4.00, 4.00) m", "obstacle_removed -1: obstacle 0 is gone",
                "obstacle_moved -1: obstacle 1 has moved to (-1.00, 0.50) m", "obstacle_removed -1: obstacle 0 is gone",
                "obstacle_removed -1: obstacle 1 is gone", "obstacle_added -1: obstacle 0 is new, at (1.00, 1.00) m"}));
}

TEST(Recording, AnotherFormatVersionIsRefused) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  test::record_sample(path, 5, 30);
  std::string bytes = without_checksums(test::contents(path));
  const std::string key = "format_version";
  const std::size_t version = bytes.find(key) + key.size() + 4;  // behind the length of the value
  ASSERT_EQ(bytes.at(version), '1');
  bytes[version] = '2';
  { std::ofstream(path, std::ios::binary) << bytes; }
  try {
    Recording recording(path);
    ADD_FAILURE() << "it was opened";
  } catch (const FileError& refused) {
    EXPECT_NE(std::string(refused.what()).find("a.mcap"), std::string::npos) << refused.what();
    EXPECT_NE(std::string(refused.what()).find("format version '2', and this program reads 1: open it with"),
              std::string::npos)
        << refused.what();
  }
}

TEST(Recording, AnUnfinishedRecorderLeavesAReadablePart) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  {
    Recorder recorder(path, test::sample_provenance());
    for (std::uint64_t t = 0; t < 25; ++t) {
      const Frame frame = test::sample_frame(9, 3.0, t);
      recorder.frame(test::sample_setting(), frame, test::sample_tick(frame));
    }
  }
  EXPECT_FALSE(fs::exists(path));
  Recording recording(path + ".part");
  EXPECT_EQ(recording.frames(), 25U);
  EXPECT_EQ(recording.provenance().seed, 42U);
  EXPECT_EQ(recording.setting().algorithm, "outwards");
  EXPECT_TRUE(recording.result().empty());
  ASSERT_FALSE(recording.warnings().empty());
  EXPECT_NE(recording.warnings()[0].find("cut short"), std::string::npos);
}

TEST(Recording, ARunWithoutAnyTickIsAValidFile) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  {
    Recorder recorder(path, test::sample_provenance());
    recorder.finish(test::sample_run(0), true);
  }
  Recording recording(path);
  EXPECT_EQ(recording.frames(), 0U);
  EXPECT_THROW((void)recording.frame_at(0.0), FileError);
  EXPECT_EQ(export_csv(recording, [](std::string_view) {}), 0U);
}

TEST(Recording, AnExistingRecordingStays) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  test::record_sample(path, 9, 5);
  const std::string before = test::contents(path);
  EXPECT_THROW(test::record_sample(path, 9, 6), FileError);
  EXPECT_EQ(test::contents(path), before);
  RecorderOptions options;
  options.existing = Existing::replace;
  test::record_sample(path, 9, 6, options);
  EXPECT_EQ(Recording(path).frames(), 6U);
}

// What a page that watches would find.
std::size_t frames_so_far(const std::string& path) { return Recording(path + ".part").frames(); }

TEST(Recording, ALiveOneCanBeReadWhileItIsWritten) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  for (const bool live : {false, true}) {
    RecorderOptions options;
    options.live = live;
    Recorder recorder(path, test::sample_provenance(), options);
    const auto add = [&](std::uint64_t tick) {
      const Frame frame = test::sample_frame(9, 3.0, tick);
      recorder.frame(test::sample_setting(), frame, test::sample_tick(frame));
    };
    add(0);
    add(1);
    if (!live) {
      EXPECT_LT(frames_so_far(path), 2U);  // the rest is still with the writer
      continue;
    }
    EXPECT_EQ(frames_so_far(path), 1U);  // the start is there at once
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    add(2);
    EXPECT_EQ(frames_so_far(path), 3U);  // then all, every second
    Recording watched(path + ".part");
    EXPECT_EQ(watched.metrics().size(), 3U);
    EXPECT_TRUE(InputFile(path + ".part").is_being_written());
    recorder.finish(test::sample_run(3));
    EXPECT_FALSE(InputFile(path).is_being_written());
    EXPECT_EQ(Recording(path).frames(), 3U);
  }
}

TEST(Recording, SameRunSameBytes) {
  const test::TemporaryDirectory directory;
  test::record_sample(directory.file("a.mcap"), 20, 60);
  test::record_sample(directory.file("b.mcap"), 20, 60);
  EXPECT_EQ(test::contents(directory.file("a.mcap")), test::contents(directory.file("b.mcap")));
}

TEST(Recording, AForeignMcapFileIsRefusedInWords) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  {
    OutputFile file(path);
    mcap::Writer writer(file, {});
    writer.message(writer.add_channel(0, "/chatter", "json"), 0, "{}");
    writer.finish();
    file.commit();
  }
  try {
    Recording recording(path);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("not a recording of Banyan"), std::string::npos);
  }
}

TEST(Recording, MalformedFramesAreSkippedWithAWarning) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  test::record_sample(directory.file("good.mcap"), 3, 1);
  std::string good;
  {
    mcap::Reader reader(directory.file("good.mcap"));
    reader.messages(reader.find_channel("/banyan/frame")->id, [&](const mcap::LoggedMessage& m) {
      good = m.data;
      return true;
    });
  }
  const auto without = [&](const char* key, nlohmann::json value) {
    auto object = nlohmann::json::parse(good);
    value.is_null() ? (void)object.erase(key) : (void)(object[key] = std::move(value));
    return object.dump();
  };
  // clang-format off
  const std::vector<std::string> bad = {
      "", "{", "[]", "null", "\xFF", std::string(100000, '['), good.substr(0, good.size() / 2),
      without("x_m", nullptr), without("x_m", 3), without("y_m", {1, 2}), without("role", {0, 1, 4}),
      without("role", {0, 1, -1}), without("parent", {0, 1, 1e300}), without("phase", {0, "1", 2}),
      without("time_s", -1), without("tick", 1.5e300), without("heading_rad", {nullptr, 0, 0})};
  // clang-format on
  {
    OutputFile file(path);
    mcap::Writer writer(file, {});
    const auto channel = writer.add_channel(0, "/banyan/frame", "json");
    for (std::size_t k = 0; k < bad.size(); ++k) writer.message(channel, k, bad[k]);
    writer.message(channel, bad.size(), good);
    writer.finish();
    file.commit();
  }
  Recording recording(path);
  std::size_t frames = 0;
  recording.for_each([&](const Frame&) {
    ++frames;
    return true;
  });
  EXPECT_EQ(frames, 1U);
  EXPECT_GE(recording.warnings().size(), bad.size());
  EXPECT_THROW((void)recording.frame_at(0.0), FileError);
}

// A recording with bytes changed anywhere: an error or a shorter run, and whatever comes out can
// be exported and drawn.
TEST(Recording, SurvivesMutations) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  RecorderOptions options;
  options.chunk_bytes = 6000;
  options.compression_level = 0;
  test::record_sample(path, 5, 30, options);
  const std::string whole = test::contents(path);
  std::uint64_t seed = 9;
  const auto draw = [&](std::size_t below) { return static_cast<std::size_t>(world::mix(++seed) % below); };
  std::size_t opened = 0;
  for (int round = 0; round < 400; ++round) {
    // CRCs stop most damage before the JSON is seen: in half of the rounds there are none.
    std::string bytes = round % 2 == 0 ? whole : without_checksums(whole);
    for (std::size_t k = 0; k < 1 + draw(5); ++k) bytes[draw(bytes.size())] = static_cast<char>(draw(256));
    if (draw(4) == 0) bytes.resize(draw(bytes.size()) + 1);
    fs::remove(path);
    { std::ofstream(path, std::ios::binary) << bytes; }
    try {
      Recording recording(path);
      ++opened;
      (void)recording.metrics();
      (void)recording.events();
      (void)export_csv(recording, [](std::string_view) {});
      EXPECT_FALSE(draw_svg(recording, 1.5).empty());
    } catch (const FileError&) {}
  }
  EXPECT_GT(opened, 100U);
}

}  // namespace
}  // namespace banyan::record
