// SPDX-License-Identifier: MIT
// The strict configuration: what is accepted means what it says, what is wrong is said at once with
// its place, and what is written reads back as the same.
#include "banyan/config/config.hpp"
#include "banyan/world/bodies.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "loading.hpp"

namespace banyan::config {
namespace {

TEST(Config, ReadsEveryKindOfValue) {
  if (!world::has_box2d()) GTEST_SKIP() << "this build has no Box2D";
  const auto loaded = parse(R"(
name = "a-1"
seed = 7
tick_s = 0.05
[mission]
algorithm = "inwards"
reading = "literal"
stop_when_complete = false
[mission.parameters]
target_gain = 0.25
[swarm]
root = 2
[swarm.start]
layout = "list"
positions_m = [[0, 0], [0.5, 0.0], [0, 0.5], [0.5, 0.5]]
headings_deg = [0, 90.0, 180, -90]
[robot]
body = "box2d"
[radio]
bearing_noise_deg = 180
latency_ticks = 2
[targets]
layout = "list"
positions_m = [[3.0, 4.0]]
[[obstacles]]
kind = "box"
center_m = [9, 9]
size_m = [1, 2]
angle_deg = 45
[[obstacles]]
kind = "wall"
from_m = [8, 8]
to_m = [9, 8]
[[events]]
time_s = 1.5
kind = "freeze"
robot = 3
duration_s = 2
[output]
series = true
)");
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  const auto& s = loaded.configuration.scenario;
  EXPECT_EQ(s.name, "a-1");
  EXPECT_EQ(s.seed, 7U);
  EXPECT_EQ(s.tick_s, 0.05);
  EXPECT_EQ(s.mission.algorithm, "inwards");
  EXPECT_EQ(s.mission.reading, "literal");
  EXPECT_FALSE(s.mission.stop_when_complete);
  ASSERT_EQ(s.mission.parameters.size(), 1U);
  EXPECT_EQ(s.mission.parameters[0], (std::pair<std::string, double>{"target_gain", 0.25}));
  EXPECT_EQ(s.swarm.root, std::size_t{2});
  EXPECT_EQ(s.swarm.start.layout, world::Layout::list);
  ASSERT_EQ(s.swarm.start.positions.size(), 4U);
  EXPECT_EQ(s.swarm.start.positions[3], (world::Vec2{0.5, 0.5}));
  EXPECT_DOUBLE_EQ(s.swarm.start.headings_rad[1], 1.5707963267948966);
  EXPECT_DOUBLE_EQ(s.swarm.start.headings_rad[3], -1.5707963267948966);
  EXPECT_EQ(s.robot.body, world::BodyModel::box2d);
  EXPECT_DOUBLE_EQ(s.radio.bearing_noise_rad, 3.14159265358979323846);
  EXPECT_EQ(s.radio.latency_ticks, 2);
  EXPECT_EQ(std::get<std::vector<world::Vec2>>(s.targets).at(0), (world::Vec2{3.0, 4.0}));
  const auto& box = std::get<world::Box>(s.obstacles.at(0));
  EXPECT_EQ(box.size, (world::Vec2{1.0, 2.0}));
  EXPECT_DOUBLE_EQ(box.angle_rad, 0.78539816339744831);
  EXPECT_EQ(std::get<world::Wall>(s.obstacles.at(1)).from, (world::Vec2{8.0, 8.0}));
  const auto& freeze = std::get<world::Freeze>(s.events.at(0).action);
  EXPECT_EQ(freeze.robot, 3U);
  EXPECT_EQ(freeze.duration_s, 2.0);
  EXPECT_TRUE(loaded.configuration.output["series"]);
}

TEST(Config, AFileOfAnotherKindIsCalledByItsName) {
  for (const char* study : {"scenario = \"a.toml\"\nseeds = \"1-3\"\n", "[[axes]]\nkey = \"seed\"\n", "[[parts]]\n"}) {
    const auto loaded = parse(study);
    ASSERT_EQ(loaded.problems.size(), 1U) << all_problems(loaded);
    EXPECT_TRUE(says(loaded, "w.toml:1: error: ")) << all_problems(loaded);
    EXPECT_TRUE(says(loaded, "no scenario has this key: this is a study, which banyan study reads"));
  }
  for (const char* tuning : {"[[worlds]]\nscenario = \"a.toml\"\n", "[bounds]\ntarget_gain = [0.1, 1.9]\n"})
    EXPECT_TRUE(says(parse(tuning), "no scenario has this key: this is a file for tuning, which banyan tune reads"));
  EXPECT_TRUE(says(parse(small + "[[worlds]]\n"), "worlds: there is no such key")) << "a scenario after all";
}

TEST(Config, DefaultsAreTheScenariosOwn) {
  const auto loaded = parse(small);
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  const world::Scenario standard = world::plain_scenario(algorithms());
  const auto& s = loaded.configuration.scenario;
  EXPECT_EQ(s.name, "w");  // from w.toml
  EXPECT_EQ(s.tick_s, standard.tick_s);
  EXPECT_EQ(s.mission.algorithm, standard.mission.algorithm);
  EXPECT_EQ(s.swarm.redundancy, standard.swarm.redundancy);
  EXPECT_EQ(s.robot.radius_m, standard.robot.radius_m);
  EXPECT_EQ(s.radio.range_m, standard.radio.range_m);
  EXPECT_EQ(std::get<world::RingTargets>(s.targets).count, 2U);
}

TEST(Config, AKeyThatWasSaysWhatIsWrittenInItsPlace) {
  const auto loaded =
      parse_configuration("w.toml", "[mission]\nscale = 0.5\n[targets]\nlayout = \"ring\"\n", algorithms());
  EXPECT_TRUE(says(loaded, "w.toml:2: error: mission.scale: there is no such key any more: radio.range_m scales"));
}

TEST(Config, EveryFaultIsReportedAtOnceWithItsLine) {
  const auto loaded = parse(R"(nme = "x"
seed = -1
tick_s = nan
[mission]
algorithm = "outward"
target_tolerance_m = "near"
[mission.parameters]
target_gian = 0.3
tick_s = 0.2
[swarm]
robots = 0
[radio]
range_m = -inf
loss = 1.5
line_of_sight = 1
latency_ticks = 1.5
[targets]
layout = "ring"
radius = 3
positions_m = [[1, 2]]
[[obstacles]]
kind = "disc"
center_m = [1]
[[events]]
kind = "die"
)");
  EXPECT_TRUE(says(loaded, "w.toml:1: error: nme: there is no such key; did you mean name?"));
  EXPECT_TRUE(says(loaded, "w.toml:2: error: seed: is -1; allowed: 0 to"));
  EXPECT_TRUE(says(loaded, "w.toml:3: error: tick_s: is nan; allowed: 0.001 to 10 s"));
  EXPECT_TRUE(says(loaded, "w.toml:5: error: mission.algorithm: must be \"outwards\""));
  EXPECT_TRUE(says(loaded, "did you mean \"outwards\"?"));
  EXPECT_TRUE(
      says(loaded,
           "w.toml:6: error: mission.target_tolerance_m: must be a number (above 0, at most 100000000 m), not the "
           "text \"near\""));
  EXPECT_TRUE(says(loaded,
                   "w.toml:8: error: mission.parameters.target_gian: there is no such key; did you mean "
                   "mission.parameters.target_gain?"));
  EXPECT_TRUE(says(loaded, "w.toml:9: error: mission.parameters.tick_s: there is no such key; did you mean tick_s?"));
  EXPECT_TRUE(says(loaded, "w.toml:11: error: swarm.robots: is 0; allowed: 2 to 65535"));
  EXPECT_TRUE(says(loaded, "w.toml:13: error: radio.range_m: is -inf; allowed: 0.01 to 100000 m"));
  EXPECT_TRUE(says(loaded, "w.toml:14: error: radio.loss: is 1.5; allowed: 0 to 1"));
  EXPECT_TRUE(says(loaded, "w.toml:15: error: radio.line_of_sight: must be true or false, not the number 1"));
  EXPECT_TRUE(says(loaded, "w.toml:16: error: radio.latency_ticks: must be a whole number"));
  EXPECT_TRUE(says(loaded, "w.toml:19: error: targets.radius: there is no such key; did you mean targets.radius_m?"));
  EXPECT_TRUE(says(loaded, "w.toml:20: error: targets.positions_m: has no meaning with layout = \"ring\""));
  EXPECT_TRUE(says(loaded, "w.toml:21: error: obstacles[0].radius_m: is missing; kind = \"disc\" needs it"));
  EXPECT_TRUE(says(loaded, "w.toml:23: error: obstacles[0].center_m: must be two numbers [x, y]"));
  EXPECT_TRUE(says(loaded, "w.toml:24: error: events[0].time_s: is missing"));
  EXPECT_TRUE(says(loaded, "w.toml:24: error: events[0].robot: is missing; kind = \"die\" needs it"));
  EXPECT_EQ(loaded.errors(), 18U) << all_problems(loaded);
}

TEST(Config, WhatDoesNotFitTogetherHasALineToo) {
  const auto loaded = parse(R"([swarm]
robots = 2
[swarm.start]
pitch_m = 0.1
[targets]
layout = "list"
positions_m = [[1, 0], [2, 0],
  [3, 3]]
[mission.parameters]
safe_range = 0.99
[[obstacles]]
kind = "disc"
radius_m = 1
center_m = [2, 0]
[[events]]
time_s = 1
kind = "die"
robot = 40
)");
  EXPECT_TRUE(says(loaded, "w.toml:2: error: swarm.robots: 2 robots cannot serve 3 targets"));
  EXPECT_TRUE(says(loaded, "w.toml:4: error: swarm.start.pitch_m: robots do not fit"));
  EXPECT_TRUE(says(loaded, "w.toml:7: error: targets.positions_m[1]: target 1 at (2, 0) lies inside an obstacle"));
  EXPECT_TRUE(says(loaded,
                   "w.toml:9: error: mission.parameters: safe_range (S) must be below ideal_distance (delta), else a "
                   "robot would still move away from its parent where the edge is in danger; here safe_range = "
                   "0.99 C, ideal_distance = 0.95 C by default"));
  EXPECT_TRUE(says(loaded, "w.toml:18: error: events[0].robot: there is no robot 40"));
}

TEST(Config, TargetsOutOfReachAreAWarningWithTheBound) {
  const auto loaded = parse("[swarm]\nrobots = 5\n[targets]\ncount = 2\nradius_m = 50.0\n");
  EXPECT_TRUE(loaded.ok());
  EXPECT_TRUE(says(loaded, "w.toml:3: warning: targets: out of reach: no connected network of fewer than 51 robots"));
}

TEST(Config, ReadsEventsOfEveryKind) {
  const auto loaded = parse(small + R"([[events]]
time_s = 5
when = "half-way"
kind = "kill"
of = "connectors"
share = 0.33
[[events]]
time_s = 6.0
when = "complete"
kind = "kill"
of = "worker_and_parent"
count = 2
every_s = 10
[[events]]
time_s = 7
kind = "blackout"
duration_s = 1.5
[[events]]
time_s = 8
kind = "remove_target"
target = 1
[[events]]
time_s = 9
kind = "move_target"
target = 0
position_m = [1, -1]
speed_m_s = 0.05
[[events]]
time_s = 10
kind = "set_line_of_sight"
line_of_sight = true
[[events]]
time_s = 11
kind = "move_obstacle"
obstacle = 1
position_m = [-3, 4.5]
[[events]]
time_s = 12
kind = "add_obstacle"
position_m = [4, -4]
radius_m = 0.4
[[events]]
time_s = 13
kind = "remove_obstacle"
obstacle = 2
[[obstacles]]
kind = "disc"
center_m = [9, 9]
radius_m = 1
[[obstacles]]
kind = "wall"
from_m = [9, -9]
to_m = [9, -8]
)");
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  using world::Event;
  using world::Kill;
  const auto& events = loaded.configuration.scenario.events;
  ASSERT_EQ(events.size(), 9U);
  EXPECT_EQ(std::get<world::AddObstacle>(events[7].action).position, (world::Vec2{4.0, -4.0}));
  EXPECT_EQ(std::get<world::AddObstacle>(events[7].action).radius_m, 0.4);
  EXPECT_EQ(std::get<world::RemoveObstacle>(events[8].action).obstacle, 2U) << "that of the event before";
  const auto& some = std::get<Kill>(events[0].action);
  EXPECT_EQ(events[0].time_s, 5.0);
  EXPECT_EQ(events[0].when, Event::When::half_way);
  EXPECT_EQ(some.of, Kill::Of::connectors);
  EXPECT_EQ(some.share, 0.33);
  EXPECT_FALSE(some.count);
  EXPECT_EQ(some.every_s, 0.0);
  const auto& two = std::get<Kill>(events[1].action);
  EXPECT_EQ(events[1].when, Event::When::complete);
  EXPECT_EQ(two.of, Kill::Of::worker_and_parent);
  EXPECT_EQ(two.count, std::size_t{2});
  EXPECT_EQ(two.every_s, 10.0);
  EXPECT_FALSE(two.share);
  EXPECT_EQ(std::get<world::Blackout>(events[2].action).duration_s, 1.5);
  EXPECT_EQ(events[2].when, Event::When::time);
  EXPECT_EQ(std::get<world::RemoveTarget>(events[3].action).target, 1U);
  const auto& drive = std::get<world::MoveTarget>(events[4].action);
  EXPECT_EQ(drive.speed_m_s, 0.05);
  EXPECT_EQ(drive.position, (world::Vec2{1.0, -1.0}));
  EXPECT_TRUE(std::get<world::SetLineOfSight>(events[5].action).line_of_sight);
  const auto& shift = std::get<world::MoveObstacle>(events[6].action);
  EXPECT_EQ(shift.obstacle, 1U);
  EXPECT_EQ(shift.position, (world::Vec2{-3.0, 4.5}));
  // And back, and read again.
  const auto again = parse(config_toml(loaded.configuration));
  ASSERT_TRUE(again.ok()) << all_problems(again);
  EXPECT_EQ(config_json(again.configuration), config_json(loaded.configuration));
}

TEST(Config, FaultsOfEventsHaveTheirLine) {
  const auto loaded = parse(small + R"([[events]]
kind = "kill"
time_s = 1
share = 1.5
[[events]]
kind = "kill"
time_s = 1
count = 0
of = "worker_and_parents"
[[events]]
kind = "die"
time_s = 1
robot = 1
every_s = 2
when = "halfway"
[[events]]
kind = "move_target"
time_s = 1
target = 0
position_m = [1, 1]
speed_m_s = -0.1
)");
  EXPECT_TRUE(says(loaded, "w.toml:7: error: events[0].share: is 1.5; allowed: 0 to 1"));
  EXPECT_TRUE(says(loaded, "w.toml:11: error: events[1].count: is 0; allowed: 1 to 65535"));
  EXPECT_TRUE(says(loaded, "w.toml:12: error: events[1].of: must be \"robots\", \"connectors\""));
  EXPECT_TRUE(says(loaded, "did you mean \"worker_and_parent\"?"));
  EXPECT_TRUE(
      says(loaded, "w.toml:17: error: events[2].every_s: has no meaning with kind = \"die\", only with \"kill\""));
  EXPECT_TRUE(says(loaded, "w.toml:18: error: events[2].when: must be \"time\", \"half-way\" or \"complete\""));
  EXPECT_TRUE(says(loaded, "w.toml:24: error: events[3].speed_m_s: is -0.1; allowed: 0 to 100"));
  EXPECT_EQ(loaded.errors(), 6U) << all_problems(loaded);
}

TEST(Config, EventsThatContradictThemselvesHaveTheirLine) {
  const auto loaded = parse(small + R"([[events]]
kind = "kill"
time_s = 1
share = 0.5
count = 3
[[events]]
kind = "remove_target"
time_s = 1
target = 2
[[events]]
kind = "blackout"
time_s = 1
)");
  EXPECT_TRUE(says(loaded, "w.toml:7: error: events[0].share: give share or count, not both"));
  EXPECT_TRUE(says(loaded, "w.toml:13: error: events[2].duration_s: must be above 0"));
  EXPECT_TRUE(says(parse(small + "[[events]]\nkind = \"move_obstacle\"\ntime_s = 1\nobstacle = 2\n"
                                 "position_m = [1, 1]\n"),
                   "w.toml:7: error: events[0].obstacle: there is no obstacle 2"));
  EXPECT_TRUE(says(parse(small + "[[events]]\nkind = \"set_line_of_sight\"\ntime_s = 1\nline_of_sight = 1\n"),
                   "w.toml:7: error: events[0].line_of_sight: must be true or false, not the number 1"));
  EXPECT_TRUE(says(parse(small + "[[events]]\nkind = \"remove_target\"\ntime_s = 1\ntarget = 2\n"),
                   "w.toml:7: error: events[0].target: there is no target 2 at that time; the last one is 1"));
}

TEST(Config, TheSameKeyElsewhereIsNamed) {
  EXPECT_TRUE(says(parse(small + "[robot]\nrange_m = 3\n"),
                   "robot.range_m: there is no such key; did you mean radio.range_m?"));
  EXPECT_TRUE(says(parse(small + "[raido]\nloss = 0.3\n"), "raido: there is no such key; did you mean radio?"));
}

TEST(Config, AQuotedNameWithADotIsNoPath) {
  EXPECT_TRUE(says(parse(small, {"\"radio.loss\"=0.5"}), "there is no such key"));
  EXPECT_TRUE(says(parse("\"radio.loss\" = 0.5\n" + small), "w.toml:1: error: radio.loss: there is no such key"));
  EXPECT_TRUE(says(parse("\"swarm.start\" = { pitch_m = 0.5 }\n" + small),
                   "w.toml:1: error: swarm.start: there is no such key"));
}

TEST(Config, SectionsAndListsMustBeSuch) {
  EXPECT_TRUE(says(parse("targets = 3\n"), "targets: is a section, [targets], not the number 3"));
  EXPECT_TRUE(says(parse(small + "[obstacles]\nkind = \"disc\"\n"), "obstacles: is a list of tables, [[obstacles]]"));
  EXPECT_TRUE(says(parse(small, {"events=[1]"}), "events[0]: must be a table, not the number 1"));
  EXPECT_TRUE(says(parse("seed = 1\n"), "targets: the section [targets] is missing"));
  EXPECT_TRUE(
      says(parse("[targets]\nlayout = \"list\"\n"), "targets.positions_m: is missing; layout = \"list\" needs it"));
}

TEST(Config, NamesAreSafeAsDirectories) {
  for (const char* bad : {"", "..", ".hidden", "a/b", "a b", "a\\nb"}) {
    EXPECT_TRUE(says(parse(small, {"name=\"" + std::string(bad) + "\""}), "name: is")) << bad;
  }
  EXPECT_TRUE(parse(small, {"name=A-1_b.c"}).ok());
}

TEST(Config, OptionsBeatTheFile) {
  const auto text = small + "[swarm]\nrobots = 12\n[radio]\nloss = 0.1\n";

  const auto loaded =
      parse(text, {"radio.loss=0.3", "mission.algorithm=inwards", "mission.parameters.target_gain=0.4"});
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  EXPECT_EQ(loaded.configuration.scenario.radio.loss, 0.3);
  EXPECT_EQ(loaded.configuration.scenario.mission.algorithm, "inwards");
  EXPECT_EQ(loaded.configuration.scenario.mission.parameters.at(0).second, 0.4);

  EXPECT_EQ(world::robot_count(parse(text, {"swarm.redundancy=4"}).configuration.scenario),
            world::robot_count(parse(small + "[swarm]\nredundancy = 4\n").configuration.scenario));
  EXPECT_EQ(world::robot_count(parse(small + "[swarm]\nredundancy = 4\n", {"swarm.robots=20"}).configuration.scenario),
            20U);
  EXPECT_TRUE(says(parse(text + "redundancy = 1\n"), "redundancy"));  // under [radio]: unknown there
  EXPECT_TRUE(says(parse("[swarm]\nrobots = 12\nredundancy = 2\n" + small),
                   "w.toml:3: error: swarm.redundancy: give robots or redundancy, not both"));
}

TEST(Config, AnotherLayoutByOptionLeavesTheOldKeysBehind) {
  const std::string listed = "[targets]\nlayout = \"list\"\npositions_m = [[1, 1]]\n";
  const auto loaded = parse(listed, {"targets.layout=ring", "targets.count=2"});
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  EXPECT_EQ(std::get<world::RingTargets>(loaded.configuration.scenario.targets).count, 2U);
}

TEST(Config, OfTwoKeysThatExcludeEachOtherAnOptionBeatsTheFile) {
  const std::string half = small + "[[events]]\nkind = \"kill\"\ntime_s = 1\nshare = 0.5\n";
  const auto loaded = parse(half, {"events[0].count=2"});
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  const auto& kill = std::get<world::Kill>(loaded.configuration.scenario.events[0].action);
  EXPECT_EQ(kill.count, std::size_t{2});
  EXPECT_FALSE(kill.share);
  EXPECT_TRUE(says(parse(small, {"swarm.robots=9", "swarm.redundancy=2"}),
                   "--set swarm.redundancy=2: error: swarm.redundancy: give robots or redundancy, not both"));
  EXPECT_TRUE(says(parse(small + "[swarm]\nrobots = \"many\"\n", {"swarm.redundancy=2"}),
                   "w.toml:5: error: swarm.robots: must be a whole number"))
      << "it does not count, but it is no number";
}

TEST(Config, AListOfRobotsNeedsNoRedundancy) {
  const std::string listed = "layout = \"list\"\npositions_m = [[0, 0], [0.5, 0], [0, 0.5]]\n";
  EXPECT_TRUE(says(parse(small + "[swarm]\nredundancy = 2\n[swarm.start]\n" + listed),
                   "w.toml:5: error: swarm.redundancy: has no meaning with start.layout = \"list\", only with "
                   "\"hexagonal\", \"grid\", \"line\", \"ring\", \"cross\", \"bridge\" or \"random\""));
  EXPECT_TRUE(parse(small + "[swarm.start]\n" + listed).ok());
}

TEST(Config, WrongOptionsAreNamedAsGiven) {
  const auto loaded = parse(small, {"radio.los=true", "radio.loss=2", "x.y.z=1", "radio"});
  EXPECT_TRUE(says(loaded, "--set radio.los=true: error: radio.los: there is no such key; did you mean radio.loss?"));
  EXPECT_TRUE(says(loaded, "--set radio.loss=2: error: radio.loss: is 2; allowed: 0 to 1"));
  EXPECT_TRUE(says(loaded, "--set x.y.z=1: error: x: there is no such key"));
  EXPECT_TRUE(says(loaded, "--set radio: error: expects key=value"));
  EXPECT_EQ(loaded.errors(), 4U);
}

TEST(Config, RunsTheResultOfAnEarlierRunAgain) {
  const auto first = parse(small, {"radio.loss=0.25"});
  const auto again =
      parse_configuration("run.json",
                          R"({"format": "banyan.run", "format_version": 1, "result": {"name": "w"}, "config": )" +
                              config_json(first.configuration, 2) + "}",
                          algorithms());
  ASSERT_TRUE(again.ok()) << all_problems(again);
  EXPECT_EQ(config_json(again.configuration), config_json(first.configuration));
  const auto later =
      parse_configuration("run.json", R"({"format": "banyan.run", "format_version": 2, "config": {}})", algorithms());
  EXPECT_TRUE(
      says(later, "run.json:1: error: format_version: must be 1: run it with the version of banyan that wrote it"));
}

RC_GTEST_PROP(ConfigProperty, NoTextWhateverIsTooMuch, ()) {
  const auto text = *rc::gen::container<std::string>(rc::gen::elementOf(std::string("[]{}=.,\"'#\n \\axt_0-9ne+:")));
  (void)parse_configuration("w.toml", text, algorithms());
  (void)parse_configuration("w.json", text, algorithms());
  (void)parse_configuration("w.toml", small, algorithms(), {{text, "--set"}});
}

TEST(Scenarios, AllAreValidWithoutAWarning) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(BANYAN_SCENARIOS)) {
    if (entry.path().extension() != ".toml") continue;  // a map
    ++count;
    const auto loaded = load_configuration(entry.path().string(), algorithms());
    EXPECT_TRUE(loaded.problems.empty()) << all_problems(loaded);
    EXPECT_EQ(loaded.configuration.scenario.name, entry.path().stem().string());
    EXPECT_FALSE(loaded.configuration.scenario.description.empty());
  }
  EXPECT_GE(count, 11U);
}

TEST(Scenarios, AreTheWorldsTheyAreNamedAfter) {
  const auto robots = [](const std::string& name) {
    return world::robot_count(
        load_configuration(std::string(BANYAN_SCENARIOS) + "/" + name + ".toml", algorithms()).configuration.scenario);
  };
  EXPECT_EQ(robots("khepera-two-targets"), 9U);
  EXPECT_EQ(robots("khepera-three-targets"), 9U);
  EXPECT_EQ(robots("paper-large"), 94U);  // the paper's largest swarm
  EXPECT_EQ(robots("swarm-500"), 500U);
  EXPECT_EQ(robots("benchmark-1000"), 1000U);
  EXPECT_EQ(robots("benchmark-10000"), 10000U);
  EXPECT_EQ(robots("swarm-1000"), 1000U);
  EXPECT_EQ(robots("swarm-10000"), 10000U);
}

// ------------------------------------------------------------------ files laid over, and trees

class Laid : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() / ("banyan-laid-" + std::to_string(::getpid()) + ".toml");
    std::ofstream(file_) << "# tuned\nradio.range_m = 3.0\n[targets]\nradius_m = 2.5\n";
  }
  void TearDown() override { std::filesystem::remove(file_); }
  [[nodiscard]] Override laid() const { return {"", "--with " + file_.string(), file_.string()}; }
  std::filesystem::path file_;
};

TEST_F(Laid, ItsKeysWinOverTheScenarioAndTheRestStays) {
  const auto loaded =
      parse_configuration("w.toml", small + "[radio]\nrange_m = 2.0\nloss = 0.1\n", algorithms(), {laid()});
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  EXPECT_EQ(loaded.configuration.scenario.radio.range_m, 3.0);
  EXPECT_EQ(loaded.configuration.scenario.radio.loss, 0.1);
  EXPECT_EQ(std::get<world::RingTargets>(loaded.configuration.scenario.targets).radius_m, 2.5);
  EXPECT_EQ(std::get<world::RingTargets>(loaded.configuration.scenario.targets).count, 2U);
  EXPECT_TRUE(loaded.problems.empty());
}

TEST_F(Laid, TheLaterOptionWins) {
  const Override set{"radio.range_m=4", "--set"};
  EXPECT_EQ(parse_configuration("w.toml", small, algorithms(), {laid(), set}).configuration.scenario.radio.range_m,
            4.0);
  EXPECT_EQ(parse_configuration("w.toml", small, algorithms(), {set, laid()}).configuration.scenario.radio.range_m,
            3.0);
}

TEST_F(Laid, ItsFaultsNameItsLine) {
  std::ofstream(file_) << "\nradio.rnage_m = 3.0\n[radio.x]\n";
  EXPECT_TRUE(says(parse_configuration("w.toml", small, algorithms(), {laid()}),
                   file_.string() + ":2: error: radio.rnage_m: "));
  std::ofstream(file_) << "x = = 1\n";
  EXPECT_TRUE(says(parse_configuration("w.toml", small, algorithms(), {laid()}),
                   file_.string() + ":1: error: this is not TOML"));
  const Override missing{"", "--with", file_.string() + "-none"};
  EXPECT_TRUE(
      says(parse_configuration("w.toml", small, algorithms(), {missing}), "-none: error: there is no such file"));
}

TEST(Trees, OfAnEarlierRunAreItsConfiguration) {
  const auto loaded = parse(small);
  const auto document =
      R"({"format": "banyan.run", "format_version": 1, "config": )" + config_json(loaded.configuration) + "}";
  const auto again = configure(parse_scenario("run.json", document), "run.json", algorithms());
  ASSERT_TRUE(again.ok()) << all_problems(again);
  EXPECT_EQ(config_json(again.configuration), config_json(loaded.configuration));
}

TEST(Trees, KeepProblemsFoundBefore) {
  const auto loaded = configure(parse_scenario("w.toml", small), "w.toml", algorithms(), {{{}, "key", "was wrong"}});
  EXPECT_FALSE(loaded.ok());
  EXPECT_TRUE(says(loaded, "key: was wrong"));
}

}  // namespace
}  // namespace banyan::config
