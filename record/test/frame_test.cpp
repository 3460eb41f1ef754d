// SPDX-License-Identifier: MIT
// What is captured from a real world, and that it costs less than the world itself.
#include "banyan/record/frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "banyan/measure/observer.hpp"
#include "banyan/record/draw.hpp"
#include "banyan/record/export.hpp"
#include "banyan/world/world.hpp"
#include "plain_scenario.hpp"
#include "sample.hpp"

namespace banyan::record {
namespace {

world::Scenario scenario(std::size_t robots, bool line_of_sight) {
  world::Scenario s = world::plain_scenario();
  s.name = "frame test";
  s.swarm.robots = robots;
  s.targets = world::RingTargets{3, 3.0, 0.0, {}};
  s.radio.line_of_sight = line_of_sight;
  s.obstacles = {world::Disc{{1.5, 0.8}, 0.2}};
  s.events = {{.time_s = 5.0, .action = world::Die{3}}, {.time_s = 6.0, .action = world::MoveTarget{1, {-2.0, 2.0}}}};
  return s;
}

TEST(Between, PositionsOnALineAndHeadingsByTheShorterWay) {
  Frame a = test::sample_frame(3, 1.0, 10);
  Frame b = a;
  b.time_s += 0.4;
  ++b.tick;
  a.robots[0].position = {1.0, -1.0};
  b.robots[0].position = {2.0, 1.0};
  a.robots[0].heading_rad = 3.0;
  b.robots[0].heading_rad = -3.0;
  a.robots[1].heading_rad = 0.2;
  b.robots[1].heading_rad = -0.2;
  b.robots[1].role = Role::root;
  b.targets[0].position = a.targets[0].position + Vec2{0.4, 0.0};
  b.targets.push_back({});
  const Frame middle = between(a, b, a.time_s + 0.1);
  EXPECT_EQ(middle.tick, a.tick);
  EXPECT_DOUBLE_EQ(middle.time_s, a.time_s + 0.1);
  EXPECT_LT(distance(middle.robots[0].position, {1.25, -0.5}), 1e-12);
  EXPECT_NEAR(middle.robots[0].heading_rad, 3.0 + 0.25 * (2.0 * 3.14159265358979 - 6.0), 1e-9);
  EXPECT_NEAR(middle.robots[1].heading_rad, 0.1, 1e-12);
  EXPECT_EQ(middle.robots[1].role, a.robots[1].role);
  EXPECT_EQ(middle.targets.size(), a.targets.size());
  EXPECT_LT(distance(middle.targets[0].position, a.targets[0].position + Vec2{0.1, 0.0}), 1e-12);
  EXPECT_NEAR(between(a, b, a.time_s + 0.3).robots[0].heading_rad, -3.0 - 0.25 * (2.0 * 3.14159265358979 - 6.0), 1e-9);
  EXPECT_TRUE(between(a, b, a.time_s) == a);
  EXPECT_TRUE(between(a, b, 0.0) == a);
  EXPECT_TRUE(between(a, b, b.time_s) == b);
  EXPECT_TRUE(between(a, a, a.time_s) == a);
}

TEST(Capture, TheSettingIsTheWorldsOfNow) {
  world::World world(scenario(10, true));
  const Setting before = setting_of(world);
  EXPECT_TRUE(still_holds(before, world));
  world.intervene({.action = world::MoveObstacle{0, {-7.0, 2.0}}});
  EXPECT_TRUE(still_holds(before, world)) << "in the next step";
  world.step();
  EXPECT_FALSE(still_holds(before, world));
  const Setting moved = setting_of(world);
  EXPECT_EQ(std::get<world::Disc>(moved.obstacles[0]).center, (Vec2{-7.0, 2.0}));
  EXPECT_TRUE(moved.line_of_sight);
  world.intervene({.action = world::SetLineOfSight{false}});
  world.step();
  EXPECT_FALSE(still_holds(moved, world));
  EXPECT_FALSE(setting_of(world).line_of_sight);
}

TEST(Capture, ShowsTheWorldAsItIs) {
  world::World world(scenario(30, true));
  Frame frame;
  for (int t = 0; t < 120; ++t) {
    capture(world, frame);
    ASSERT_EQ(frame.robots.size(), world.size());
    EXPECT_EQ(frame.tick, world.tick());
    EXPECT_EQ(frame.time_s, world.time_s());
    std::size_t connected = 0;
    for (std::size_t i = 0; i < world.size(); ++i) {
      const RobotFrame& robot = frame.robots[i];
      const Report& state = world.reports()[i];
      EXPECT_EQ(robot.position, world.positions()[i]);
      EXPECT_LT(distance(unit_vector(robot.heading_rad), world.headings()[i]), 1e-9);
      EXPECT_EQ(robot.role, state.role);
      EXPECT_EQ(robot.phase, state.phase);
      EXPECT_EQ(robot.parent, state.parent == nobody ? -1 : static_cast<int>(state.parent));
      EXPECT_EQ(robot.label_m, state.label < 0.0F ? -1.0 : 2.0 * static_cast<double>(state.label)) << "C is 2 m";
      EXPECT_EQ(robot.alive, world.alive()[i] != 0);
      EXPECT_TRUE(robot.alive || !robot.connected);
      connected += robot.connected ? 1 : 0;
      // Neighbours are in one component: both connected or neither.
      for (const std::uint32_t j : world.links(i)) EXPECT_EQ(robot.connected, frame.robots[j].connected);
    }
    EXPECT_GE(connected, 1U);
    ASSERT_EQ(frame.targets.size(), world.targets().size());
    for (std::size_t k = 0; k < frame.targets.size(); ++k) {
      EXPECT_EQ(frame.targets[k].position, world.targets()[k].position);
      EXPECT_EQ(frame.robots[world.targets()[k].worker].target, static_cast<std::int32_t>(k));
    }
    world.step();
  }
  EXPECT_FALSE(frame.robots[3].alive);
}

// A worker dies on its way to its target, which another takes over, and one target is given up.
TEST(Capture, WhoServesATargetIsWhoHoldsItNow) {
  world::Scenario s = scenario(40, false);
  s.obstacles.clear();
  s.robot.dead_bodies = false;
  s.events = {{.time_s = 15.0, .action = world::RemoveTarget{2}}};
  world::World world(s);
  measure::Observer observer(world);
  const test::TemporaryDirectory directory;
  Recorder recorder(directory.file("a.mcap"), {});
  recorder.frame(world, observer.last());
  Frame frame;
  std::int32_t successor = -1;
  while (world.tick() < 900) {
    if (world.tick() == 60) world.intervene({.action = world::Die{world.targets()[0].worker}});
    world.step();
    recorder.frame(world, observer.observe(world));
    capture(world, frame);
    EXPECT_EQ(frame.targets[2].active, world.targets()[2].active);
    for (std::size_t k = 0; k < frame.targets.size(); ++k) {
      const auto holder = world.holder(k);
      if (!holder) continue;
      EXPECT_EQ(frame.robots[*holder].target, static_cast<std::int32_t>(k));
      if (k == 0) successor = static_cast<std::int32_t>(*holder);
    }
  }
  recorder.finish(observer.result(world));
  ASSERT_GE(successor, 0);
  EXPECT_NE(successor, frame.targets[0].worker);
  EXPECT_TRUE(std::ranges::none_of(frame.robots, [](const RobotFrame& r) { return r.target == 2; }))
      << "it is given up";
  std::size_t arrivals = 0, removals = 0, completions = 0;
  for (const RecordedEvent& e : Recording(directory.file("a.mcap")).events()) {
    arrivals += e.kind == "arrival" && e.target == 0 && e.robot == successor;
    removals += e.kind == "target_removed" && e.target == 2;
    completions += e.kind == "complete";
  }
  EXPECT_EQ(arrivals, 1U);
  EXPECT_EQ(removals, 1U);
  EXPECT_GE(completions, 1U);
}

// The picture's links against the radio's own.
TEST(Capture, LinksOfAPictureAreTheRadios) {
  struct Case {
    bool line_of_sight, dead_bodies;
    double sight_leak;
  };
  for (const auto& [line_of_sight, dead_bodies, sight_leak] :
       {Case{false, true, 0.0}, {true, true, 0.0}, {true, false, 0.0}, {true, true, 0.3}}) {
    world::Scenario s = scenario(60, line_of_sight);
    s.robot.dead_bodies = dead_bodies;
    s.radio.sight_leak = sight_leak;
    for (std::size_t robot = 5; robot < 20; ++robot) s.events.push_back({.time_s = 1.0, .action = world::Die{robot}});
    world::World world(s);
    const Setting setting = setting_of(world);
    Frame frame;
    for (int t = 0; t < 100; ++t) {
      world.step();
      if (t % 10 != 9) continue;
      capture(world, frame);
      std::vector<std::pair<std::uint32_t, std::uint32_t>> open, blocked;
      for (std::uint32_t i = 0; i < world.size(); ++i) {
        for (const std::uint32_t j : world.links(i)) {
          if (i < j) open.emplace_back(i, j);
        }
      }
      for (const auto& pair : world.blocked()) blocked.emplace_back(pair.first, pair.second);
      std::sort(blocked.begin(), blocked.end());
      const RadioLinks links = radio_links(setting, frame);
      EXPECT_EQ(links.open, open);
      EXPECT_EQ(links.blocked, blocked);
    }
  }
}

TEST(Capture, ARealRunCanBeRecordedExportedAndDrawn) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("run.mcap");
  world::World world(scenario(30, true));
  measure::Observer observer(world);
  {
    Recorder recorder(path, test::sample_provenance());
    recorder.frame(world, observer.last());
    for (int t = 0; t < 200; ++t) {
      world.step();
      recorder.frame(world, observer.observe(world));
    }
    recorder.finish(observer.result(world));
  }
  Recording recording(path);
  EXPECT_TRUE(recording.warnings().empty());
  EXPECT_EQ(recording.frames(), 201U);
  EXPECT_EQ(recording.setting().name, "frame test");
  Frame frame;
  capture(world, frame);
  const Frame last = recording.frame_at(20.0);
  for (std::size_t i = 0; i < frame.robots.size(); ++i) {
    EXPECT_LT(distance(last.robots[i].position, frame.robots[i].position), 1e-4);
    EXPECT_EQ(last.robots[i].parent, frame.robots[i].parent);
  }
  const auto events = recording.events();
  const auto happened = [&](std::string_view kind, double from_s, double to_s) {
    return std::any_of(events.begin(), events.end(), [&](const RecordedEvent& e) {
      return e.kind == kind && e.time_s >= from_s && e.time_s <= to_s;
    });
  };
  EXPECT_TRUE(happened("death", 4.9, 5.2));
  EXPECT_TRUE(happened("target_moved", 5.9, 6.2));
  EXPECT_EQ(export_csv(recording, [](std::string_view) {}), 201U * 30U);
  EXPECT_NE(draw_svg(recording, 10.0).find("frame test"), std::string::npos);
}

TEST(Capture, RobotsThatJoinAreInARecordingFromThenOn) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("run.mcap");
  world::Scenario s = scenario(30, true);
  s.events = {{.time_s = 2.0, .action = world::Join{30, {0.0, -2.0}}},
              {.time_s = 3.0, .action = world::Die{7}},
              {.time_s = 4.0, .action = world::Join{7, {0.0, -2.5}}}};
  world::World world(s);
  measure::Observer observer(world);
  {
    Recorder recorder(path, test::sample_provenance());
    recorder.frame(world, observer.last());
    for (int t = 0; t < 60; ++t) {
      world.step();
      recorder.frame(world, observer.observe(world));
    }
    recorder.finish(observer.result(world));
  }
  Recording recording(path);
  EXPECT_TRUE(recording.warnings().empty());
  EXPECT_EQ(recording.frame_at(1.9).robots.size(), 30U);
  EXPECT_EQ(recording.frame_at(2.2).robots.size(), 31U);
  EXPECT_TRUE(recording.frame_at(2.2).robots[30].alive);
  EXPECT_FALSE(recording.frame_at(3.5).robots[7].alive);
  EXPECT_TRUE(recording.frame_at(4.5).robots[7].alive);
  std::vector<std::string> joins;
  for (const RecordedEvent& event : recording.events())
    if (event.kind == "join") joins.push_back(event.text);
  ASSERT_EQ(joins.size(), 2U);
  EXPECT_TRUE(joins[0].starts_with("robot 30 has joined at (")) << joins[0];
  EXPECT_EQ(joins[1], "robot 7 is back");
  const auto result = observer.result(world);
  EXPECT_EQ(result.robots, 30U);
  EXPECT_EQ(result.survivors, 31U);
  EXPECT_EQ(result.deaths, 1U);
  EXPECT_LT(result.driven_m, 0.2 * 6.0);  // no robot drives faster, and being put somewhere is no driving
  EXPECT_NE(draw_svg(recording, 1.0).find("frame test"), std::string::npos);
}

}  // namespace
}  // namespace banyan::record
