// SPDX-License-Identifier: MIT
// The strict configuration: what is accepted means what it says, what is wrong is said at once with
// its place, and what is written reads back as the same.
#include "banyan/config/config.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "banyan/controller/core/algorithm.hpp"

namespace banyan::config {
namespace {

using nlohmann::json;

std::string all_problems(const Loaded& loaded) {
  std::string text;
  for (const auto& p : loaded.problems) text += to_string(p) + "\n";
  return text;
}

Loaded parse(const std::string& text, const std::vector<std::string>& sets = {}) {
  std::vector<Override> overrides;
  overrides.reserve(sets.size());
  for (const auto& s : sets) overrides.push_back({s, "--set " + s});
  return parse_configuration("w.toml", text, overrides);
}

::testing::AssertionResult says(const Loaded& loaded, const std::string& part) {
  const auto text = all_problems(loaded);
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\"" << part << "\" is not in:\n" << text;
}

const std::string small = "[targets]\ncount = 2\nradius_m = 2.0\n";  // line 1 to 3

TEST(Config, ReadsEveryKindOfValue) {
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
  EXPECT_EQ(s.events.at(0).kind, world::Event::Kind::freeze);
  EXPECT_EQ(s.events.at(0).index, 3U);
  EXPECT_EQ(s.events.at(0).value, 2.0);
  EXPECT_TRUE(loaded.configuration.output["series"]);
}

TEST(Config, DefaultsAreTheScenariosOwn) {
  const auto loaded = parse(small);
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  const world::Scenario standard;
  const auto& s = loaded.configuration.scenario;
  EXPECT_EQ(s.name, "w");  // from w.toml
  EXPECT_EQ(s.tick_s, standard.tick_s);
  EXPECT_EQ(s.mission.algorithm, standard.mission.algorithm);
  EXPECT_EQ(s.swarm.redundancy, standard.swarm.redundancy);
  EXPECT_EQ(s.robot.radius_m, standard.robot.radius_m);
  EXPECT_EQ(s.radio.range_m, standard.radio.range_m);
  EXPECT_EQ(std::get<world::RingTargets>(s.targets).count, 2U);
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
  EXPECT_TRUE(says(loaded, "w.toml:3: error: tick_s: is nan; allowed: above 0, at most 1 s"));
  EXPECT_TRUE(says(loaded, "w.toml:5: error: mission.algorithm: must be \"outwards\""));
  EXPECT_TRUE(says(loaded, "did you mean \"outwards\"?"));
  EXPECT_TRUE(says(loaded,
                   "w.toml:6: error: mission.target_tolerance_m: must be a number (above 0, at most 10000 m), not the "
                   "text \"near\""));
  EXPECT_TRUE(says(loaded,
                   "w.toml:8: error: mission.parameters.target_gian: there is no such key; did you mean "
                   "mission.parameters.target_gain?"));
  EXPECT_TRUE(says(loaded, "w.toml:9: error: mission.parameters.tick_s: follows from the key tick_s"));
  EXPECT_TRUE(says(loaded, "w.toml:11: error: swarm.robots: is 0; allowed: 2 to 65535"));
  EXPECT_TRUE(says(loaded, "w.toml:13: error: radio.range_m: is -inf; allowed: above 0"));
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
safe_range_m = 3
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
  EXPECT_TRUE(says(loaded, "w.toml:9: error: mission.parameters: safe_range_m (S) must be below"));
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
  using Event = world::Event;
  const auto& events = loaded.configuration.scenario.events;
  ASSERT_EQ(events.size(), 7U);
  EXPECT_EQ(events[0].kind, Event::Kind::kill);
  EXPECT_EQ(events[0].when, Event::When::half_way);
  EXPECT_EQ(events[0].of, Event::Of::connectors);
  EXPECT_EQ(events[0].share, 0.33);
  EXPECT_FALSE(events[0].count);
  EXPECT_EQ(events[0].every_s, 0.0);
  EXPECT_EQ(events[1].when, Event::When::complete);
  EXPECT_EQ(events[1].of, Event::Of::worker_and_parent);
  EXPECT_EQ(events[1].count, std::size_t{2});
  EXPECT_EQ(events[1].every_s, 10.0);
  EXPECT_FALSE(events[1].share);
  EXPECT_EQ(events[2].kind, Event::Kind::blackout);
  EXPECT_EQ(events[2].value, 1.5);
  EXPECT_EQ(events[2].when, Event::When::time);
  EXPECT_EQ(events[3].kind, Event::Kind::remove_target);
  EXPECT_EQ(events[3].index, 1U);
  EXPECT_EQ(events[4].value, 0.05);
  EXPECT_EQ(events[4].position, (world::Vec2{1.0, -1.0}));
  EXPECT_EQ(events[5].kind, Event::Kind::set_line_of_sight);
  EXPECT_EQ(events[5].value, 1.0);
  EXPECT_EQ(events[6].kind, Event::Kind::move_obstacle);
  EXPECT_EQ(events[6].index, 1U);
  EXPECT_EQ(events[6].position, (world::Vec2{-3.0, 4.5}));
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
  EXPECT_TRUE(says(loaded, "w.toml:13: error: events[2].duration_s: must be a number above 0"));
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
  const auto again = parse_configuration("run.json", R"({"format": "banyan.run", "result": {"name": "w"}, "config": )" +
                                                         config_json(first.configuration, 2) + "}");
  ASSERT_TRUE(again.ok()) << all_problems(again);
  EXPECT_EQ(config_json(again.configuration), config_json(first.configuration));
}

// ------------------------------------------------------------------------------- every key, both ways

json* member(json& root, const std::string& path) {
  json* at = &root;
  for (std::size_t from = 0; from <= path.size();) {
    const auto dot = std::min(path.find('.', from), path.size());
    at = &(*at)[path.substr(from, dot - from)];
    from = dot + 1;
  }
  return at;
}

// A value within the range of the key that is not its default. Types come from the table's row.
template <class Owner> rc::Gen<json> value_of(const Key<Owner>& key) {
  const auto low = std::isfinite(key.range.minimum) ? key.range.minimum : -100.0;
  const auto high = std::isfinite(key.range.maximum) ? key.range.maximum : 100.0;
  const auto real = rc::gen::map(rc::gen::inRange<std::int64_t>(1, 1'000'000'000), [low, high](std::int64_t k) {
    return low + (high - low) * (static_cast<double>(k) / 1e9);
  });
  const auto whole = rc::gen::map(real, [](double v) { return static_cast<std::int64_t>(std::ceil(v)); });
  const auto point = rc::gen::map(rc::gen::pair(real, real), [](auto p) { return json::array({p.first, p.second}); });
  struct Pick {
    rc::Gen<json> real, whole, point;
    const Key<Owner>& key;
    rc::Gen<json> operator()(bool& (*)(Owner&)) const {
      return rc::gen::map(rc::gen::arbitrary<bool>(), [](bool b) { return json(b); });
    }
    rc::Gen<json> operator()(double& (*)(Owner&)) const { return real; }
    rc::Gen<json> operator()(int& (*)(Owner&)) const { return whole; }
    rc::Gen<json> operator()(std::uint32_t& (*)(Owner&)) const { return whole; }
    rc::Gen<json> operator()(std::size_t& (*)(Owner&)) const { return whole; }
    rc::Gen<json> operator()(const SeedAccess<Owner>&) const { return whole; }
    rc::Gen<json> operator()(std::optional<std::size_t>& (*)(Owner&)) const { return whole; }
    rc::Gen<json> operator()(std::optional<double>& (*)(Owner&)) const { return real; }
    rc::Gen<json> operator()(std::string& (*)(Owner&)) const {
      const auto text = rc::gen::nonEmpty(rc::gen::string<std::string>());
      if (key.name != "name") {
        return rc::gen::map(rc::gen::container<std::string>(rc::gen::inRange(' ', '\x7f')),
                            [](const std::string& s) { return json(s + "\t\"\\"); });
      }
      return rc::gen::map(rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::inRange('a', 'z'))),
                          [](const std::string& s) { return json(s.substr(0, 100)); });
    }
    rc::Gen<json> operator()(world::Vec2& (*)(Owner&)) const { return point; }
    rc::Gen<json> operator()(std::vector<world::Vec2>& (*)(Owner&)) const { return list(point); }
    rc::Gen<json> operator()(std::vector<double>& (*)(Owner&)) const { return list(real); }
    rc::Gen<json> operator()(const ChoiceAccess<Owner>& choice) const {
      const auto names = choice.names();
      return rc::gen::map(rc::gen::inRange<std::size_t>(0, names.size()),
                          [names](std::size_t i) { return json(names[i]); });
    }
    static rc::Gen<json> list(const rc::Gen<json>& item) {
      return rc::gen::map(rc::gen::nonEmpty(rc::gen::container<std::vector<json>>(item)),
                          [](const std::vector<json>& v) { return json(v); });
    }
  };
  const auto as_json = [](const auto& gen) { return rc::gen::map(gen, [](auto v) { return json(v); }); };
  return std::visit(Pick{as_json(real), as_json(whole), as_json(point), key}, key.access);
}

// The keys of a section that have a meaning together, with random values.
template <class Owner> json random_section(const Section& section, std::span<const Key<Owner>> keys) {
  json table = json::object();
  std::string choice;
  for (const auto& key : keys) {
    if (key.section == section.path && key.name == section.selector)
      choice = (table[std::string(key.name)] = *value_of(key)).template get<std::string>();
  }
  for (const auto& key : keys) {
    if (key.section != section.path || key.name == section.selector) continue;
    if (key.when.empty() || applies(key.when, choice)) table[std::string(key.name)] = *value_of(key);
  }
  return table;
}

json random_tree() {
  json root = json::object();
  for (const auto& section : sections()) {
    const std::string path(section.path);
    if (path == "obstacles" || path == "events") {
      const auto n = *rc::gen::inRange(0, 4);
      root[path] = json::array();
      for (int i = 0; i < n; ++i) {
        root[path].push_back(path == "obstacles" ? random_section(section, obstacle_keys())
                                                 : random_section(section, event_keys()));
      }
    } else if (path == "mission.parameters") {
      for (const auto& info : parameter_table()) {
        if (!platform_key(info.key).empty() || *rc::gen::arbitrary<bool>()) continue;
        root["mission"]["parameters"][std::string(info.key)] =
            0.5 * (static_cast<double>(info.minimum) + static_cast<double>(info.maximum));
      }
    } else {
      const auto table = random_section(section, scenario_keys());
      json& place = path.empty() ? root : *member(root, path);
      for (const auto& [key, value] : table.items()) place[key] = value;
    }
  }
  const bool listed = root["swarm"]["start"]["layout"] == "list";
  root["swarm"].erase(*rc::gen::arbitrary<bool>() || listed ? "redundancy" : "robots");
  return root;
}

// Only complaints about single keys; whether random values fit together is another matter.
std::string complaints_about_keys(const Loaded& loaded) {
  std::string text;
  for (const auto& p : loaded.problems) {
    for (const char* part :
         {"there is no such key", "has no meaning", "; allowed: ", "is missing", "not the ", "not a "}) {
      if (p.text.find(part) != std::string::npos && p.text.find("must be a number") == std::string::npos)
        text += to_string(p) + "\n";
    }
  }
  return text;
}

RC_GTEST_PROP(ConfigProperty, EveryKeyComesBackFromTheDump, ()) {
  const json tree = random_tree();

  const auto loaded = parse_configuration("w.json", tree.dump());
  RC_ASSERT(complaints_about_keys(loaded) == "");
  const auto dump = json::parse(config_json(loaded.configuration));

  // Whatever was given is in the dump with the same value, angles up to rounding.
  const auto flat_tree = tree.flatten();
  const auto flat_dump = dump.flatten();
  for (const auto& [path, value] : flat_tree.items()) {
    if (value.is_null() || (value.is_structured() && value.empty())) continue;
    RC_ASSERT(flat_dump.contains(path));
    const json& back = flat_dump[path];
    if (value.is_number_float() && path.find("_deg") != std::string::npos) {
      RC_ASSERT(std::abs(back.get<double>() - value.get<double>()) <= 1e-13 * std::abs(value.get<double>()));
    } else if (value.is_number()) {
      RC_ASSERT(back.get<double>() == value.get<double>());
    } else {
      RC_ASSERT(back == value);
    }
  }
}

RC_GTEST_PROP(ConfigProperty, TheDumpReadsBackAsTheSameScenarioToTheBit, ()) {
  const auto loaded = parse_configuration("w.json", random_tree().dump());

  const auto from_json = parse_configuration("w.json", config_json(loaded.configuration));
  const auto from_toml = parse_configuration("w.toml", config_toml(loaded.configuration));

  RC_ASSERT(complaints_about_keys(from_json) == "");
  RC_ASSERT(complaints_about_keys(from_toml) == "");
  for (const auto* back : {&from_json, &from_toml}) {
    RC_ASSERT(config_json(back->configuration) == config_json(loaded.configuration));
    const auto& a = loaded.configuration.scenario;
    const auto& b = back->configuration.scenario;
    RC_ASSERT(a.swarm.start.headings_rad == b.swarm.start.headings_rad);  // angles: the same radians
    RC_ASSERT(a.radio.bearing_noise_rad == b.radio.bearing_noise_rad);
    RC_ASSERT(a.robot.wheel_limit_m_s == b.robot.wheel_limit_m_s);
    if (const auto* ring = std::get_if<world::RingTargets>(&a.targets))
      RC_ASSERT(ring->phase_rad == std::get<world::RingTargets>(b.targets).phase_rad);
    for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
      if (const auto* box = std::get_if<world::Box>(&a.obstacles[i]))
        RC_ASSERT(box->angle_rad == std::get<world::Box>(b.obstacles[i]).angle_rad);
    }
  }
}

RC_GTEST_PROP(ConfigProperty, NoTextWhateverIsTooMuch, ()) {
  const auto text = *rc::gen::container<std::string>(rc::gen::elementOf(std::string("[]{}=.,\"'#\n \\axt_0-9ne+:")));
  (void)parse_configuration("w.toml", text);
  (void)parse_configuration("w.json", text);
  (void)parse_configuration("w.toml", small, {{text, "--set"}});
}

TEST(Config, EveryKeyIsInTheTableOnceAndExplained) {
  std::set<std::string> paths;
  for (const auto& row : key_rows()) {
    EXPECT_TRUE(paths.insert(row.path).second) << row.path;
    EXPECT_FALSE(row.meaning.empty()) << row.path;
    EXPECT_FALSE(row.type.empty()) << row.path;
  }
  EXPECT_TRUE(paths.contains("radio.loss"));
  EXPECT_TRUE(paths.contains("mission.parameters.target_gain"));
  EXPECT_TRUE(paths.contains("events.time_s"));
}

TEST(Config, TheReferenceOfKeysIsUpToDate) {
  std::ifstream in(std::string(BANYAN_DOCS) + "/scenario-keys.md");
  const std::string page((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_EQ(page, key_reference_markdown()) << "renew it: banyan keys --markdown > docs/scenario-keys.md";
}

TEST(Scenarios, AllAreValidWithoutAWarning) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(BANYAN_SCENARIOS)) {
    ++count;
    const auto loaded = load_configuration(entry.path().string());
    EXPECT_TRUE(loaded.problems.empty()) << all_problems(loaded);
    EXPECT_EQ(loaded.configuration.scenario.name, entry.path().stem().string());
    EXPECT_FALSE(loaded.configuration.scenario.description.empty());
  }
  EXPECT_GE(count, 11U);
}

TEST(Scenarios, AreTheWorldsTheyAreNamedAfter) {
  const auto robots = [](const std::string& name) {
    return world::robot_count(
        load_configuration(std::string(BANYAN_SCENARIOS) + "/" + name + ".toml").configuration.scenario);
  };
  EXPECT_EQ(robots("khepera-two-targets"), 9U);
  EXPECT_EQ(robots("khepera-three-targets"), 9U);
  EXPECT_EQ(robots("paper-large"), 94U);  // the paper's largest swarm
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
  const auto loaded = parse_configuration("w.toml", small + "[radio]\nrange_m = 2.0\nloss = 0.1\n", {laid()});
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  EXPECT_EQ(loaded.configuration.scenario.radio.range_m, 3.0);
  EXPECT_EQ(loaded.configuration.scenario.radio.loss, 0.1);
  EXPECT_EQ(std::get<world::RingTargets>(loaded.configuration.scenario.targets).radius_m, 2.5);
  EXPECT_EQ(std::get<world::RingTargets>(loaded.configuration.scenario.targets).count, 2U);
  EXPECT_TRUE(loaded.problems.empty());
}

TEST_F(Laid, TheLaterOptionWins) {
  const Override set{"radio.range_m=4", "--set"};
  EXPECT_EQ(parse_configuration("w.toml", small, {laid(), set}).configuration.scenario.radio.range_m, 4.0);
  EXPECT_EQ(parse_configuration("w.toml", small, {set, laid()}).configuration.scenario.radio.range_m, 3.0);
}

TEST_F(Laid, ItsFaultsNameItsLine) {
  std::ofstream(file_) << "\nradio.rnage_m = 3.0\n[radio.x]\n";
  EXPECT_TRUE(says(parse_configuration("w.toml", small, {laid()}), file_.string() + ":2: error: radio.rnage_m: "));
  std::ofstream(file_) << "x = = 1\n";
  EXPECT_TRUE(says(parse_configuration("w.toml", small, {laid()}), file_.string() + ":1: error: this is not TOML"));
  const Override missing{"", "--with", file_.string() + "-none"};
  EXPECT_TRUE(says(parse_configuration("w.toml", small, {missing}), "-none: error: there is no such file"));
}

TEST(Trees, OfAnEarlierRunAreItsConfiguration) {
  const auto loaded = parse(small);
  const auto document = R"({"format": "banyan.run", "config": )" + config_json(loaded.configuration) + "}";
  const auto again = configure(parse_scenario("run.json", document), "run.json");
  ASSERT_TRUE(again.ok()) << all_problems(again);
  EXPECT_EQ(config_json(again.configuration), config_json(loaded.configuration));
}

TEST(Trees, KeepProblemsFoundBefore) {
  const auto loaded = configure(parse_scenario("w.toml", small), "w.toml", {{{}, "key", "was wrong"}});
  EXPECT_FALSE(loaded.ok());
  EXPECT_TRUE(says(loaded, "key: was wrong"));
}

}  // namespace
}  // namespace banyan::config
