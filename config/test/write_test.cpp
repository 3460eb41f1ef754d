// SPDX-License-Identifier: MIT
// What is written reads back as the same, to the bit, and stays as it was: runs are named by it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "banyan/config/config.hpp"
#include "banyan/controller/core/algorithm.hpp"
#include "loading.hpp"

namespace banyan::config {
namespace {

using nlohmann::json;

json* member(json& root, const std::string& path) {
  json* at = &root;
  for (std::size_t from = 0; from <= path.size();) {
    const auto dot = std::min(path.find('.', from), path.size());
    at = &(*at)[path.substr(from, dot - from)];
    from = dot + 1;
  }
  return at;
}

// With the algorithms that a scenario may name.
template <class Owner> Owner blank() {
  Owner owner{};
  if constexpr (std::is_same_v<Owner, world::Scenario>) owner = world::plain_scenario(algorithms());
  return owner;
}

// A value within the range of the key, as its type is written.
template <class Owner> rc::Gen<json> value_of(const world::Key<Owner>& key) {
  using world::Type;
  const auto low = std::isfinite(key.range.minimum) ? key.range.minimum : -100.0;
  const auto high = std::isfinite(key.range.maximum) ? key.range.maximum : 100.0;
  auto real = rc::gen::map(rc::gen::inRange<std::int64_t>(1, 1'000'000'000), [low, high](std::int64_t k) {
    return json(low + (high - low) * (static_cast<double>(k) / 1e9));
  });
  auto point = rc::gen::map(rc::gen::pair(real, real), [](auto p) { return json::array({p.first, p.second}); });
  const auto list = [](const rc::Gen<json>& item) {
    return rc::gen::map(rc::gen::nonEmpty(rc::gen::container<std::vector<json>>(item)),
                        [](const std::vector<json>& v) { return json(v); });
  };
  switch (key.access.type) {
    case Type::truth: return rc::gen::map(rc::gen::arbitrary<bool>(), [](bool b) { return json(b); });
    case Type::whole:
      return rc::gen::map(real,
                          [](const json& v) { return json(static_cast<std::int64_t>(std::ceil(v.get<double>()))); });
    case Type::number: return real;
    case Type::point: return point;
    case Type::points: return list(point);
    case Type::numbers: return list(real);
    case Type::pairs: return rc::gen::just(json::array({json::array({"a", "b"})}));
    case Type::name:
      return rc::gen::map(rc::gen::inRange<std::size_t>(0, key.access.names(blank<Owner>()).size()),
                          [names = key.access.names(blank<Owner>())](std::size_t i) { return json(names[i]); });
    case Type::text: break;
  }
  if (key.path == "name" || key.path == "stations.name")
    return rc::gen::map(rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::inRange('a', 'z'))),
                        [](const std::string& s) { return json(s.substr(0, 100)); });
  if (key.path == "obstacles.cells")
    return rc::gen::map(
        rc::gen::nonEmpty(rc::gen::container<std::vector<std::uint8_t>>(rc::gen::inRange(0, 2))),
        [](const std::vector<std::uint8_t>& cells) { return json(world::CellGrid(cells.size(), 1, cells).text()); });
  return rc::gen::map(rc::gen::container<std::string>(rc::gen::inRange(' ', '\x7f')),
                      [](const std::string& s) { return json(s + "\t\"\\"); });
}

// What is written is what the file has.
bool names_a_file(std::string_view path) { return path == "map" || path == "obstacles.file"; }

// The keys of a section that have a meaning together, with random values.
template <class Owner> json random_section(const world::Section& section, std::span<const world::Key<Owner>> keys) {
  json table = json::object();
  std::string choice;
  for (const auto& key : keys) {
    if (key.section() == section.path && key.name() == section.selector)
      choice = (table[std::string(key.name())] = *value_of(key)).template get<std::string>();
  }
  for (const auto& key : keys) {
    if (key.section() != section.path || key.name() == section.selector || names_a_file(key.path)) continue;
    const auto with = applies_with(key, keys);
    const bool conditional = !with.empty() && key.terms.selector.empty();
    if (!conditional || std::find(with.begin(), with.end(), choice) != with.end())
      table[std::string(key.name())] = *value_of(key);
  }
  for (const auto& key : keys) {
    const std::string name(key.name());
    const std::string other(key.terms.not_beside);
    if (key.section() == section.path && table.contains(name) && table.contains(other))
      table.erase(*rc::gen::arbitrary<bool>() ? name : other);
  }
  return table;
}

json random_tree() {
  json root = json::object();
  for (const auto& section : sections()) {
    const std::string path(section.path);
    if (section.repeated) {
      root[path] = json::array();
      for (int n = *rc::gen::inRange(0, 4); n > 0; --n) {
        root[path].push_back(path == "obstacles"  ? random_section(section, world::obstacle_keys())
                             : path == "stations" ? random_section(section, world::station_keys())
                                                  : random_section(section, world::event_keys()));
      }
    } else if (path == "mission.parameters") {
      for (const auto& info : algorithms().parameters()) {
        if (*rc::gen::arbitrary<bool>()) continue;
        root["mission"]["parameters"][std::string(info.key)] =
            0.5 * (static_cast<double>(info.minimum) + static_cast<double>(info.maximum));
      }
    } else {
      const auto table =
          path == "output" ? random_section(section, output_keys()) : random_section(section, world::scenario_keys());
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

  const auto loaded = parse_configuration("w.json", tree.dump(), algorithms());
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
  const auto loaded = parse_configuration("w.json", random_tree().dump(), algorithms());

  const auto from_json = parse_configuration("w.json", config_json(loaded.configuration), algorithms());
  const auto from_toml = parse_configuration("w.toml", config_toml(loaded.configuration), algorithms());

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

// A scenario with events and obstacles of every kind.
constexpr const char* everything = R"(name = "everything"
seed = 9007199254740992
tick_s = 0.05
[mission]
algorithm = "inwards"
target_tolerance_m = 0.2
[mission.parameters]
clearance = 0.02
target_gain = 0.25
[swarm]
root = 2
[swarm.start]
layout = "list"
positions_m = [[0, 0], [0.5, 0.0], [0, 0.5], [0.5, 0.5], [1, 1]]
headings_deg = [0, 90.0, 180, -90, 33.3]
[robot]
wheel_distance_m = 0.1054
max_acceleration_m_s2 = 1
proximity_m = 0.3
[radio]
bearing_noise_deg = 1.7
[targets]
layout = "random"
count = 2
radius_m = 3
center_m = [0.1, 0.2]
[[obstacles]]
kind = "disc"
center_m = [9, 9]
radius_m = 0.5
[[obstacles]]
kind = "box"
center_m = [-9, 9]
size_m = [1, 2]
angle_deg = 45
[[obstacles]]
kind = "wall"
from_m = [8, 8]
to_m = [9, 8]
[[events]]
time_s = 1
kind = "die"
robot = 3
[[events]]
time_s = 2
kind = "freeze"
robot = 1
duration_s = 1.5
[[events]]
time_s = 3
kind = "set_loss"
loss = 0.125
[[events]]
time_s = 4
kind = "move_target"
target = 1
position_m = [1, -2]
speed_m_s = 0.05
[[events]]
time_s = 5
kind = "add_target"
position_m = [-1, 2.5]
[[events]]
time_s = 6
kind = "kill"
of = "worker_and_parent"
share = 0.33
every_s = 2
when = "half-way"
[[events]]
time_s = 7
kind = "kill"
count = 2
when = "complete"
[[events]]
time_s = 8
kind = "blackout"
duration_s = 0.7
[[events]]
time_s = 9
kind = "remove_target"
target = 0
[[events]]
time_s = 10
kind = "set_line_of_sight"
line_of_sight = true
[[events]]
time_s = 11
kind = "move_obstacle"
obstacle = 2
position_m = [7, 7]
)";

// As it was written before the rebuilding of the schema. Ids of runs in journals are digests of this text:
// a key that is added here makes every finished run a new one, unless study/src/plan.cpp leaves it out.
constexpr const char* as_written =
    R"({"name":"everything","description":"","tick_s":0.05,"seed":9007199254740992,)"
    R"("mission":{"algorithm":"inwards","reading":"corrected","target_tolerance_m":0.2,)"
    R"("time_limit_s":0.0,"stop_when_complete":true,"settle_s":0.0,"link_redundancy":1,"parameters":{"target_gain":0.25,)"
    R"("clearance":0.02}},)"
    R"("swarm":{"root":2,"start":{"layout":"list","center_m":[0.0,0.0],"positions_m":[[0.0,0.0],[0.5,0.0],[0.0,)"
    R"(0.5],[0.5,0.5],[1.0,1.0]],"headings_deg":[0.0,90.0,180.0,-90.0,33.3]}},)"
    R"("robot":{"body":"disks","radius_m":0.0704,"wheel_distance_m":0.1054,"wheel_limit_m_s":0.2,)"
    R"("wheel_noise":0.0,"wheel_bias":0.0,"odometry_noise":0.0,"mass_kg":0.4,"max_force_n":1.5,)"
    R"("max_torque_nm":1.5,"max_acceleration_m_s2":1.0,"dead_bodies":true,"proximity_m":0.3},)"
    R"("radio":{"model":"disc","range_m":2.0,"line_of_sight":false,"sight_leak":0.0,"loss":0.0,"range_noise_m":0.0,)"
    R"("bearing_noise_deg":1.7,)"
    R"("latency_ticks":1,"slots":0},)"
    R"("clocks":{"asynchronous":false,"drift":0.0,"substeps":5},)"
    R"("battery":{"model":"none"},)"
    R"("targets":{"layout":"random","count":2,"radius_m":3.0,"center_m":[0.1,0.2]},)"
    R"("obstacles":[{"kind":"disc","center_m":[9.0,9.0],"radius_m":0.5},)"
    R"({"kind":"box","center_m":[-9.0,9.0],"size_m":[1.0,2.0],"angle_deg":45.0},)"
    R"({"kind":"wall","from_m":[8.0,8.0],"to_m":[9.0,8.0]}],)"
    R"("events":[{"time_s":1.0,"when":"time","kind":"die",)"
    R"("robot":3},)"
    R"({"time_s":2.0,"when":"time","kind":"freeze",)"
    R"("robot":1,"duration_s":1.5},)"
    R"({"time_s":3.0,"when":"time","kind":"set_loss","loss":0.125},)"
    R"({"time_s":4.0,"when":"time","kind":"move_target","target":1,"position_m":[1.0,-2.0],"speed_m_s":0.05},)"
    R"({"time_s":5.0,"when":"time","kind":"add_target","position_m":[-1.0,2.5]},)"
    R"({"time_s":6.0,"when":"half-way","kind":"kill","of":"worker_and_parent","share":0.33,"every_s":2.0},)"
    R"({"time_s":7.0,"when":"complete","kind":"kill","of":"robots","count":2,"every_s":0.0},)"
    R"({"time_s":8.0,"when":"time","kind":"blackout","duration_s":0.7},)"
    R"({"time_s":9.0,"when":"time","kind":"remove_target","target":0},)"
    R"({"time_s":10.0,"when":"time","kind":"set_line_of_sight","line_of_sight":true},)"
    R"({"time_s":11.0,"when":"time","kind":"move_obstacle","obstacle":2,"position_m":[7.0,7.0]}],)"
    R"("output":{"record":true,"record_every":1,"messages":true,"live":false,"series":false}})";

TEST(Write, TheTextStaysAsItIs) {
  const auto loaded = parse(everything);
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  EXPECT_EQ(config_json(loaded.configuration), as_written);
  const auto again = parse_configuration("run.json", as_written, algorithms());
  ASSERT_TRUE(again.ok()) << all_problems(again);
  EXPECT_EQ(config_json(again.configuration), as_written);
}

TEST(Write, WhatNeedNotBeSaidIsLeftOut) {
  const auto written = [](const std::string& text) { return json::parse(config_json(parse(text).configuration)); };
  EXPECT_FALSE(written(small)["swarm"].contains("robots"));
  EXPECT_EQ(written(small)["swarm"]["redundancy"], 2.0);
  EXPECT_FALSE(written(small + "[swarm]\nrobots = 9\n")["swarm"].contains("redundancy"));
  EXPECT_EQ(written(small)["events"], json::array());
  EXPECT_EQ(written(small)["mission"]["parameters"], json::object());
  EXPECT_FALSE(written(small)["mission"].contains("target_tolerance_m")) << "it follows from C and the body";
}

// As many robots and targets as there may be, with all their digits: read_text_file() takes 8 MiB.
TEST(Write, TheLargestScenarioFitsIntoAFile) {
  Configuration configuration;
  configuration.scenario = blank<world::Scenario>();
  const world::Vec2 long_one{-1234.5678901234567, -1234.5678901234567};
  configuration.scenario.swarm.start.layout = world::Layout::list;
  configuration.scenario.swarm.start.positions.assign(65535, long_one);
  configuration.scenario.swarm.start.headings_rad.assign(65535, -1.2345678901234567);
  configuration.scenario.targets = std::vector<world::Vec2>(10000, long_one);
  for (const std::string& text : {config_toml(configuration), config_json(configuration, 2)}) {
    EXPECT_GT(text.size(), 65535U * 40);
    EXPECT_LT(text.size(), std::size_t{8} << 20);
  }
}

}  // namespace
}  // namespace banyan::config
