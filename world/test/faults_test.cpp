// SPDX-License-Identifier: MIT
// A scenario without faults has none; each fault is found, once, where it is, in words.
#include "banyan/world/faults.hpp"

#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/world/bodies.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/schema.hpp"
#include "plain_scenario.hpp"

namespace banyan::world {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string shown(const std::vector<Fault>& list) {
  std::string text;
  for (const Fault& f : list) text += (f.warning ? "warning " : "") + f.key + ": " + f.text + "\n";
  return text;
}

struct Case {
  const char* key;
  const char* words;  // part of the text
  std::function<void(Scenario&)> change;
  bool warning = false;
};

void use_list(Scenario& s, std::vector<Vec2> positions) {
  s.swarm.start.layout = Layout::list;
  s.swarm.start.positions = std::move(positions);
  s.targets = std::vector<Vec2>{{1, 0}};
}
Event event(const Action& action, double time_s = 1.0) { return {.time_s = time_s, .action = action}; }

const std::vector<Case>& cases() {
  static const std::vector<Case> list{
      {"tick_s", "is 0; allowed: 0.001 to 10 s", [](Scenario& s) { s.tick_s = 0; }},
      {"tick_s", "nan", [](Scenario& s) { s.tick_s = nan; }},
      {"mission.algorithm", "did you mean \"inwards\"?", [](Scenario& s) { s.mission.algorithm = "inward"; }},
      {"mission.algorithm", "must be \"outwards\"", [](Scenario& s) { s.mission.algorithm = ""; }},
      {"mission.reading", "did you mean \"literal\"?", [](Scenario& s) { s.mission.reading = "literl"; }},
      {"mission.target_tolerance_m", "-1", [](Scenario& s) { s.mission.target_tolerance_m = -1; }},
      {"mission.time_limit_s", "inf", [](Scenario& s) { s.mission.time_limit_s = infinity; }},
      {"mission.settle_s", "-1", [](Scenario& s) { s.mission.settle_s = -1; }},
      {"mission.link_redundancy", "is 2, but inwards keeps one path; of those here, more are kept by convoy",
       [](Scenario& s) { s.mission.algorithm = "inwards", s.mission.link_redundancy = 2; }},
      {"mission.time_limit_s", "is not given, and no target is away from swarm.start.center_m",
       [](Scenario& s) {
         s.swarm.robots = 9, s.targets = RingTargets{3, 0.0, 0, {}};
       }},
      {"mission.parameters.target_gian", "did you mean target_gain?",
       [](Scenario& s) {
         s.mission.parameters = {{"target_gian", 0.4}};
       }},
      {"mission.parameters.target_gain", "-1",
       [](Scenario& s) {
         s.mission.parameters = {{"target_gain", -1}};
       }},
      {"mission.parameters.target_gain", "nan",
       [](Scenario& s) {
         s.mission.parameters = {{"target_gain", nan}};
       }},
      {"mission.parameters.target_gain", "1e+300",
       [](Scenario& s) {
         s.mission.parameters = {{"target_gain", 1e300}};
       }},
      {"mission.parameters.tick_s", "there is no such parameter",
       [](Scenario& s) {
         s.mission.parameters = {{"tick_s", 0.1}};
       }},
      {"mission.parameters.communication_range_m", "there is no such parameter",
       [](Scenario& s) {
         s.mission.parameters = {{"communication_range_m", 2}};
       }},
      {"mission.parameters", "delta",
       [](Scenario& s) {
         s.mission.parameters = {{"ideal_distance", 0.6}};
       }},
      {"swarm.redundancy", "is 0; allowed: above 0", [](Scenario& s) { s.swarm.redundancy = 0; }},
      {"swarm.redundancy", "robots; at most 65535 are possible",
       [](Scenario& s) {
         s.swarm.redundancy = 1000, s.targets = RingTargets{60, 6000, 0, {}};
       }},
      {"swarm.robots", "is 1; allowed: 2 to 65535", [](Scenario& s) { s.swarm.robots = 1; }},
      {"swarm.robots", "is 65536; allowed: 2 to 65535", [](Scenario& s) { s.swarm.robots = 65536; }},
      {"swarm.robots", "3 robots cannot serve 3 targets", [](Scenario& s) { s.swarm.robots = 3; }},
      {"swarm.root", "there is no robot 9", [](Scenario& s) { s.swarm.robots = 9, s.swarm.root = 9; }},
      {"swarm.start.center_m[0]", "is nan; allowed: -100000000 to 100000000 m",
       [](Scenario& s) { s.swarm.start.center.x = nan; }},
      {"swarm.start.pitch_m", "robots do not fit", [](Scenario& s) { s.swarm.start.pitch_m = 0.15; }},
      {"swarm.start.pitch_m", "not be connected", [](Scenario& s) { s.swarm.start.pitch_m = 1.97; }},
      {"swarm.start.positions_m", "needs swarm.start.layout",
       [](Scenario& s) {
         s.swarm.start.positions = {{0, 0}};
       }},
      {"swarm.start.positions_m", "must have 1 to 65535 entries, not 0", [](Scenario& s) { use_list(s, {}); }},
      {"swarm.start.positions_m", "2 groups",
       [](Scenario& s) {
         use_list(s, {{0, 0}, {1, 0}, {3.1, 0}});
       }},
      {"swarm.start.positions_m[2]", "overlaps position 0",
       [](Scenario& s) {
         use_list(s, {{0, 0}, {1, 0}, {0.1, 0}});
       }},
      {"swarm.start.positions_m[1][0]", "is inf",
       [](Scenario& s) {
         use_list(s, {{0, 0}, {infinity, 0}});
       }},
      {"swarm.start.positions_m[1]", "touches an obstacle",
       [](Scenario& s) {
         use_list(s, {{0, 0}, {0.5, 0}}), s.obstacles = {Disc{{0.6, 0}, 0.05}};
       }},
      {"swarm.start.headings_deg", "one entry per position",
       [](Scenario& s) {
         use_list(s, {{0, 0}, {0.5, 0}}), s.swarm.start.headings_rad = {0};
       }},
      {"swarm.robots", "is 5, but",
       [](Scenario& s) {
         use_list(s, {{0, 0}, {0.5, 0}}), s.swarm.robots = 5;
       }},
      {"swarm.robots", "1 robots cannot",
       [](Scenario& s) {
         use_list(s, {{0, 0}});
       }},
      {"swarm.start.center_m", "no room",
       [](Scenario& s) {
         s.obstacles = {Disc{{0.1, 0}, 0.05}};
       }},
      {"swarm.start", "robots fit",
       [](Scenario& s) {
         s.swarm.robots = 94;
         s.obstacles = {Wall{{-1, -1}, {1, -1}}, Wall{{1, -1}, {1, 1}}, Wall{{1, 1}, {-1, 1}}, Wall{{-1, 1}, {-1, -1}}};
       }},
      {"robot.radius_m", "-0.1", [](Scenario& s) { s.robot.radius_m = -0.1; }},
      {"robot.wheel_distance_m", "is 0", [](Scenario& s) { s.robot.wheel_distance_m = 0; }},
      {"robot.wheel_limit_m_s", "inf", [](Scenario& s) { s.robot.wheel_limit_m_s = infinity; }},
      {"robot.wheel_noise", "2", [](Scenario& s) { s.robot.wheel_noise = 2; }},
      {"robot.wheel_bias", "-1", [](Scenario& s) { s.robot.wheel_bias = -1; }},
      {"robot.odometry_noise", "nan", [](Scenario& s) { s.robot.odometry_noise = nan; }},
      {"robot.mass_kg", "is 0", [](Scenario& s) { s.robot.mass_kg = 0; }},
      {"robot.max_force_n", "is 0", [](Scenario& s) { s.robot.max_force_n = 0; }},
      {"robot.max_torque_nm", "is 0", [](Scenario& s) { s.robot.max_torque_nm = 0; }},
      {"robot.max_acceleration_m_s2", "is 0", [](Scenario& s) { s.robot.max_acceleration_m_s2 = 0; }},
      {"radio.range_m", "is 0", [](Scenario& s) { s.radio.range_m = 0; }},
      {"robot.radius_m", "is 1 m, 0.5 of radio.range_m = 2 m; must be 0.001 to 0.17 of it, here 0.002 to 0.34 m",
       [](Scenario& s) { s.robot.radius_m = 1.0; }},
      {"robot.radius_m", "0.0009 of radio.range_m", [](Scenario& s) { s.robot.radius_m = 0.0018; }},
      {"tick_s", "2 / (0.2 * 0.5) = 20 ticks, which must be 25 to 2000; set tick_s to 0.005 to 0.4 s",
       [](Scenario& s) { s.tick_s = 0.5; }},
      {"tick_s", "2 / (0.2 * 0.004) = 2500 ticks", [](Scenario& s) { s.tick_s = 0.004; }},
      {"tick_s", "set radio.range_m or robot.wheel_limit_m_s, no tick_s fits these",
       [](Scenario& s) { s.robot.wheel_limit_m_s = 100.0; }},
      {"mission.time_limit_s", "is 0.04 s, shorter than a tick: give at least tick_s = 0.1 s",
       [](Scenario& s) { s.mission.time_limit_s = 0.04; }},
      {"mission.time_limit_s",
       "is not given, and ten times a straight drive to the farthest target is 0.05 s, shorter than a tick: give at "
       "least tick_s = 0.1 s",
       [](Scenario& s) {
         s.targets = std::vector<Vec2>{{0.001, 0}};
       }},
      {"targets.positions_m[1]",
       "target 1 at (0, 401) is 401 m from swarm.start.center_m, farther than 200 * radio.range_m = 400 m",
       [](Scenario& s) {
         s.swarm.robots = 400, s.targets = std::vector<Vec2>{{0, 399}, {0, 401}};
       }},
      {"battery.places_m[0]", "is 401 m from swarm.start.center_m",
       [](Scenario& s) {
         s.swarm.robots = 400, s.battery.model = Battery::Model::power, s.battery.places = {{401, 0}};
       }},
      {"events[0].position_m", "the target at (500, 0) is 500 m from swarm.start.center_m",
       [](Scenario& s) {
         s.events = {event(MoveTarget{0, {500, 0}})};
       }},
      {"events[0].position_m", "the target at (0, 500) is 500 m from swarm.start.center_m",
       [](Scenario& s) {
         s.swarm.robots = 20, s.events = {event(AddTarget{{0, 500}})};
       }},
      {"swarm.start.positions_m[1]", "is 401 m from swarm.start.center_m",
       [](Scenario& s) {
         use_list(s, {{400, 0}, {401, 0}}), s.targets = std::vector<Vec2>{{399, 0}};
       }},
      {"swarm.start", "reaches to (",
       [](Scenario& s) { s.swarm.robots = 600, s.swarm.start.layout = Layout::line, s.swarm.start.pitch_share = 0.9; }},
      {"radio.loss", "1.5", [](Scenario& s) { s.radio.loss = 1.5; }},
      {"radio.range_noise_m", "-1", [](Scenario& s) { s.radio.range_noise_m = -1; }},
      {"radio.bearing_noise_deg", "is 229.18", [](Scenario& s) { s.radio.bearing_noise_rad = 4; }},
      {"radio.latency_ticks", "is 0", [](Scenario& s) { s.radio.latency_ticks = 0; }},
      {"radio.slots", "-1", [](Scenario& s) { s.radio.slots = -1; }},
      {"targets.positions_m", "must have 1 to 10000 entries, not 0",
       [](Scenario& s) { s.targets = std::vector<Vec2>{}; }},
      {"targets.positions_m[1][1]", "is -inf",
       [](Scenario& s) {
         s.targets = std::vector<Vec2>{{1, 1}, {1, -infinity}};
       }},
      {"targets.positions_m[1]", "inside an obstacle",
       [](Scenario& s) {
         s.targets = std::vector<Vec2>{{3, 0}, {0, 3}}, s.obstacles = {Box{{0, 3}, {1, 1}, 0.3}};
       }},
      {"targets.positions_m[0]", "no robot of radius",
       [](Scenario& s) {
         s.targets = std::vector<Vec2>{{3, 0}, {0, 3}};
         s.mission.target_tolerance_m = 0.05;
         s.obstacles = {Wall{{3.01, -1}, {3.01, 1}}};
       }},
      {"targets", "target 0 at (3, 0) lies inside",
       [](Scenario& s) {
         s.obstacles = {Disc{{3, 0}, 0.5}};
       }},
      {"targets", "inside an obstacle",
       [](Scenario& s) {
         s.targets = RandomTargets{1, 1, {5, 0}}, s.obstacles = {Disc{{5, 0}, 1.5}};
       }},
      {"targets.count", "is 0",
       [](Scenario& s) {
         s.targets = RingTargets{0, 3, 0, {}};
       }},
      {"targets.count", "1000000000",
       [](Scenario& s) {
         s.targets = RingTargets{1000000000, 3, 0, {}};
       }},
      {"targets.radius_m", "nan",
       [](Scenario& s) {
         s.targets = RingTargets{3, nan, 0, {}};
       }},
      {"targets.phase_deg", "inf",
       [](Scenario& s) {
         s.targets = RingTargets{3, 3, infinity, {}};
       }},
      {"targets.center_m[0]", "is nan",
       [](Scenario& s) {
         s.targets = RandomTargets{3, 3, {nan, 0}};
       }},
      {"obstacles[0].radius_m", "is 0",
       [](Scenario& s) {
         s.obstacles = {Disc{{5, 5}, 0}};
       }},
      {"obstacles[1].size_m[1]", "is -1",
       [](Scenario& s) {
         s.obstacles = {Disc{{5, 5}, 1}, Box{{5, 5}, {1, -1}, 0}};
       }},
      {"obstacles[0].angle_deg", "nan",
       [](Scenario& s) {
         s.obstacles = {Box{{5, 5}, {1, 1}, nan}};
       }},
      {"obstacles[0].to_m", "must differ",
       [](Scenario& s) {
         s.obstacles = {Wall{{5, 5}, {5, 5}}};
       }},
      {"obstacles[0].from_m[0]", "is nan",
       [](Scenario& s) {
         s.obstacles = {Wall{{nan, 5}, {5, 5}}};
       }},
      {"obstacles[1].size_m", "too thin for robot.body = \"box2d\": at (5, 5) both sides must be at least 0.000406",
       [](Scenario& s) {
         s.robot.body = BodyModel::box2d;
         s.obstacles = {Disc{{-5, 5}, 1}, Box{{5, 5}, {0.0003, 2}, 0}};
       }},
      {"events[0].position_m", "too thin for robot.body",
       [](Scenario& s) {
         s.robot.body = BodyModel::box2d;
         s.obstacles = {Box{{5, 5}, {2, 0.005}, 0}};
         s.events = {event(MoveObstacle{0, {9000, 9000}})};
       }},
      {"tick_s", "pass through an obstacle",
       [](Scenario& s) {
         s.obstacles = {Disc{{5, 5}, 1}}, s.robot.radius_m = 0.05, s.tick_s = 0.3;
       }},
      {"events[0].time_s", "-1", [](Scenario& s) { s.events = {event(Die{0}, -1)}; }},
      {"events[0].robot", "there is no robot 99", [](Scenario& s) { s.events = {event(Die{99})}; }},
      {"events[1].robot", "there is no robot 12",
       [](Scenario& s) {
         s.swarm.robots = 12, s.events = {event(Die{11}), event(Freeze{12})};
       }},
      {"events[0].robot", "the next robot to join at that time is 12; robots join in the order of their indices",
       [](Scenario& s) {
         s.swarm.robots = 12, s.events = {event(Join{13}, 1), event(Join{12}, 2)};
       }},
      {"events[0].position_m", "the robot that joins at (5, 5) lies inside an obstacle",
       [](Scenario& s) {
         s.swarm.robots = 12, s.obstacles = {Disc{{5, 5}, 1}}, s.events = {event(Join{12, {5, 5}})};
       }},
      {"events[0].target", "there is no target 3", [](Scenario& s) { s.events = {event(MoveTarget{3})}; }},
      {"events[0].target", "at that time",
       [](Scenario& s) {
         s.events = {event(MoveTarget{3}, 1), event(AddTarget{}, 2)};
       }},
      {"events[0].loss", "7", [](Scenario& s) { s.events = {event(SetLoss{7})}; }},
      {"events[0].duration_s", "-1",
       [](Scenario& s) {
         s.events = {event(Freeze{0, -1})};
       }},
      {"events[0].target", "there is no target 3", [](Scenario& s) { s.events = {event(RemoveTarget{3})}; }},
      {"events[0].obstacle", "there is no obstacle 0", [](Scenario& s) { s.events = {event(MoveObstacle{0})}; }},
      {"events[0].obstacle", "there is no obstacle 2; the last one is 1",
       [](Scenario& s) {
         s.events = {event(MoveObstacle{2})};
         s.obstacles = {Disc{{5, 5}, 1}, Disc{{-5, 5}, 1}};
       }},
      {"events[0].position_m[1]", "is inf",
       [](Scenario& s) {
         s.events = {event(MoveObstacle{0, {0, infinity}})};
         s.obstacles = {Disc{{5, 5}, 1}};
       }},
      {"events[1].position_m", "inside an obstacle",
       [](Scenario& s) {
         s.events = {event(MoveObstacle{0, {4, -4}}, 1), event(AddTarget{{4, -4}}, 2)};
         s.obstacles = {Disc{{5, 5}, 1}};
       }},
      {"events[0].when", "not the text \"\"",
       [](Scenario& s) {
         s.events = {{1.0, static_cast<Event::When>(99), Die{}}};
       }},
      {"events[0].speed_m_s", "-1",
       [](Scenario& s) {
         s.events = {event(MoveTarget{0, {}, -1})};
       }},
      {"events[0].duration_s", "above 0", [](Scenario& s) { s.events = {event(Blackout{})}; }},
      {"events[0].share", "not both", [](Scenario& s) { s.events = {event(Kill{.share = 0.5, .count = 2})}; }},
      {"events[0].share", "1.1", [](Scenario& s) { s.events = {event(Kill{.share = 1.1})}; }},
      {"events[0].count", "is 0", [](Scenario& s) { s.events = {event(Kill{.count = 0})}; }},
      {"events[0].every_s", "nan", [](Scenario& s) { s.events = {event(Kill{.every_s = nan})}; }},
      {"events[0].position_m[0]", "is nan",
       [](Scenario& s) {
         s.events = {event(AddTarget{{nan, 0}})};
       }},
      {"events[0].position_m", "inside an obstacle",
       [](Scenario& s) {
         s.events = {event(AddTarget{{5, 5}})};
         s.obstacles = {Disc{{5, 5}, 1}};
       }},
      {"swarm.robots", "4 robots cannot serve 4 targets",
       [](Scenario& s) { s.swarm.robots = 4, s.events = {event(AddTarget{})}; }},
      {"swarm.robots", "4 robots cannot serve 4 targets",
       [](Scenario& s) {
         s.swarm.robots = 4, s.events = {{1.0, Event::When::half_way, AddTarget{}}, event(RemoveTarget{0})};
       }},
      {"events[0].time_s", "the run ends before", [](Scenario& s) { s.events = {event(AddTarget{}, 1e6)}; }, true},
      {"events[0].time_s", "the run ends before",
       [](Scenario& s) { s.mission.stop_when_complete = false, s.events = {event(Die{0}, 1e6)}; }, true},
      {"events[0].time_s", "happens only if the run goes on after its limit of 150 s",
       [](Scenario& s) { s.events = {event(Die{0}, 1e6)}; }, true},  // a complete run waits for it
      {"events[0].time_s", "happens only if the run goes on",
       [](Scenario& s) {
         s.events = {event(AddTarget{}, 200), event(Die{0}, 1)};
       },
       true},  // recovers until then
      {"events[0].time_s", "happens only if the run goes on",
       [](Scenario& s) { s.mission.settle_s = 100, s.events = {event(AddTarget{}, 200)}; }, true},
      {"targets", "out of reach",
       [](Scenario& s) {
         s.swarm.robots = 5, s.targets = std::vector<Vec2>{{-9, 0}, {9, 0}};
       },
       true},
  };
  return list;
}

TEST(Faults, TheDefaultsAndTheirVariationsHaveNone) {
  Scenario scenario = plain_scenario();
  EXPECT_EQ(shown(faults(scenario)), "");
  for (const Algorithm* algorithm : algorithms())
    for (const std::string_view reading : {"corrected", "literal"}) {
      if (reading == "literal" && !algorithm->knows_readings()) continue;
      scenario.mission.algorithm = algorithm->name();
      scenario.mission.reading = reading;
      EXPECT_EQ(shown(faults(scenario)), "") << algorithm->name() << reading;
    }
  scenario.targets = RandomTargets{4, 9.0, {}};
  scenario.obstacles = {Disc{{4, 4}, 1.0}, Box{{-4, 0}, {1, 2}, 0.5}, Wall{{2, 2}, {3, 2}}};
  scenario.events = {event(AddTarget{}, 1), event(MoveTarget{4, {1, 1}}, 2)};
  scenario.mission.parameters = {{"target_gain", 1.9}, {"avoidance_gain", 0.0}};  // both bounds are allowed
  EXPECT_EQ(shown(faults(scenario)), "");
}

TEST(Faults, AProgramMayHaveASeedThatNoFileCanHold) {
  Scenario scenario = plain_scenario();
  scenario.seed = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(shown(faults(scenario)), "");
}

// 5,000 targets among 300 obstacles of all kinds, against each pair of them looked at.
TEST(Faults, ATargetInOrAtAnObstacleIsFoundAsByLookingAtEachPair) {
  Scenario s = plain_scenario();
  std::mt19937_64 generator(7);
  const auto number = [&](double least, double most) {
    return least + (most - least) * 0x1p-53 * static_cast<double>(generator() >> 11U);
  };
  const auto point = [&] { return Vec2{number(-40, 40), number(-40, 40)}; };
  for (int k = 0; k < 100; ++k) {
    s.obstacles.emplace_back(Disc{point(), number(0.1, 1.0)});
    s.obstacles.emplace_back(Box{point(), {number(0.1, 3.0), number(0.1, 1.0)}, number(-3, 3)});
    const Vec2 from = point();
    s.obstacles.emplace_back(Wall{from, from + Vec2{number(-9, 9), number(0.1, 2.0)}});
  }
  std::vector<Vec2> targets;
  for (int k = 0; k < 5000; ++k) targets.push_back(point());
  s.targets = targets;
  s.swarm.robots = 6000;
  s.swarm.start.center = {200, 0};
  s.mission.target_tolerance_m = 0.02;
  std::string expected;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const double room = clearance(s.obstacles, targets[i]);
    const std::string key = "targets.positions_m[" + std::to_string(i) + "]";
    if (room <= 0.0) expected += key + " lies inside\n";
    else if (room + 0.02 < s.robot.radius_m) expected += key + " is so close\n";
  }
  std::string found;
  for (const Fault& fault : faults(s)) {
    if (!fault.key.starts_with("targets.positions_m")) continue;
    found += fault.key + (fault.text.find("lies inside") != std::string::npos ? " lies inside\n" : " is so close\n");
  }
  EXPECT_EQ(found, expected);
  EXPECT_GT(std::count(expected.begin(), expected.end(), '\n'), 200);
}

// Ten thousand targets and robots with as many obstacles or events and more are hundreds of millions of pairs: what is
// counted is the time of this thread, generously.
TEST(Faults, TenThousandTargetsObstaclesAndEventsAreCheckedFast) {
  const auto seconds = [] {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  };
  Scenario ring = plain_scenario();
  std::vector<Vec2> stand;
  for (int k = 0; k < 10'100; ++k) stand.push_back({0.5 * (k / 100) - 25.0, 0.5 * (k % 100) - 25.0});
  use_list(ring, stand);
  ring.targets = RingTargets{10'000, 100.0, 0.0, {}};
  Scenario walled = ring, busy = ring, heap = ring;
  for (int k = 0; k < 50'000; ++k) walled.obstacles.emplace_back(Disc{{-300.0 + 0.002 * k, 150.0}, 0.0009});
  for (int k = 0; k < 40'000; ++k)
    busy.events.push_back(event(MoveTarget{static_cast<std::size_t>(k % 10'000), {1.0, 1.0}}));
  heap.targets = std::vector<Vec2>(10'000, Vec2{5.0, 0.0});
  for (const Scenario& s : {walled, busy, heap}) {
    const double begin_s = seconds();
    EXPECT_EQ(shown(faults(s)), "");
    EXPECT_LT(seconds() - begin_s, 3.0);
  }
}

// 5,000 robots at one point are 12 million pairs.
TEST(Faults, OfOverlapsAHundredAreNamed) {
  Scenario s = plain_scenario();
  use_list(s, std::vector<Vec2>(5'000));
  int overlaps = 0;
  for (const Fault& fault : faults(s)) {
    EXPECT_EQ(fault.text.find("not connected"), std::string::npos) << fault.text;
    overlaps += fault.text.find("overlaps") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(overlaps, 100);
}

// 2^53 + 1 is not a number that a file's reader in another language would see: it becomes 2^53.
TEST(Faults, AWholeNumberIsCheckedToItsLastDigit) {
  const Range seeds{0, 0x1p53};
  constexpr std::int64_t most = std::int64_t{1} << 53;
  EXPECT_EQ(whole_range_fault(most, seeds, ""), std::nullopt);
  EXPECT_EQ(whole_range_fault(most + 1, seeds, ""), "is 9007199254740993; allowed: 0 to 9007199254740992");
  EXPECT_NE(whole_range_fault(-1, seeds, ""), std::nullopt);
  EXPECT_EQ(whole_range_fault(std::numeric_limits<std::int64_t>::max(), Range{}, ""), std::nullopt);
  EXPECT_EQ(whole_range_fault(std::numeric_limits<std::int64_t>::min(), Range{}, ""), std::nullopt);
}

TEST(Faults, EachIsFoundOnceWhereItIs) {
  for (const Case& c : cases()) {
    Scenario scenario = plain_scenario();
    c.change(scenario);
    const std::vector<Fault> found = faults(scenario);
    if (scenario.robot.body == BodyModel::box2d && !has_box2d()) continue;
    int hits = 0;
    for (const Fault& f : found)
      hits += f.key == c.key && f.text.find(c.words) != std::string::npos && f.warning == c.warning;
    EXPECT_GE(hits, 1) << c.key << " (" << c.words << "), found:\n" << shown(found);
    EXPECT_LE(hits, 2) << c.key << " (" << c.words << "), found:\n" << shown(found);  // two targets in one obstacle
  }
}

// "events[2].loss" is a key of events, "targets" a section.
bool is_known(std::string key) {
  for (auto open = key.find('['); open != std::string::npos; open = key.find('['))
    key.erase(open, key.find(']') - open + 1);
  const auto has = [&](auto keys) { return find_key(keys, key) != nullptr; };
  const auto sections = scenario_sections();
  return has(scenario_keys()) || has(obstacle_keys()) || has(event_keys()) || key.starts_with("mission.parameters.") ||
         std::any_of(sections.begin(), sections.end(), [&](const Section& s) { return !key.empty() && s.path == key; });
}

TEST(Faults, ABodyThatWasNotBuiltIsAskedFor) {
  Scenario scenario = plain_scenario();
  scenario.robot.body = BodyModel::box2d;
  const std::vector<Fault> found = faults(scenario);
  if (has_box2d()) {
    EXPECT_TRUE(found.empty()) << shown(found);
  } else {
    ASSERT_EQ(found.size(), 1U) << shown(found);
    EXPECT_EQ(found[0].key, "robot.body");
    EXPECT_NE(found[0].text.find("install libbox2d-dev and build again"), std::string::npos) << found[0].text;
  }
}

TEST(Faults, NameKeysAsUsersWriteThem) {
  for (const Case& c : cases()) {
    Scenario scenario = plain_scenario();
    c.change(scenario);
    for (const Fault& f : faults(scenario)) EXPECT_TRUE(is_known(f.key)) << f.key << ": " << f.text;
  }
  EXPECT_FALSE(is_known("swarm.start.positions"));
}

TEST(Faults, AllWrongNumbersAreReportedAtOnce) {
  Scenario scenario = plain_scenario();
  scenario.tick_s = nan;
  scenario.radio.loss = 2.0;
  scenario.mission.algorithm = "sideways";
  scenario.targets = RingTargets{3, -1.0, 0, {}};
  EXPECT_EQ(faults(scenario).size(), 4U) << shown(faults(scenario));
}

TEST(Faults, AReadingNeedsAnAlgorithmThatKnowsIt) {
  for (const char* algorithm : {"convoy", "mst"}) {
    Scenario s = plain_scenario();
    s.mission.algorithm = algorithm;
    EXPECT_TRUE(faults(s).empty()) << shown(faults(s));
    s.mission.reading = "literal";
    ASSERT_EQ(faults(s).size(), 1U) << algorithm;
    EXPECT_TRUE(faults(s)[0].warning);
    EXPECT_EQ(faults(s)[0].key, "mission.reading");
    EXPECT_NE(faults(s)[0].text.find("has no effect with " + s.mission.algorithm), std::string::npos);
    EXPECT_NE(faults(s)[0].text.find("known to outwards, inwards"), std::string::npos) << faults(s)[0].text;
  }
  for (const char* algorithm : {"outwards", "inwards"}) {
    Scenario s = plain_scenario();
    s.mission.algorithm = algorithm;
    s.mission.reading = "literal";
    EXPECT_TRUE(faults(s).empty()) << shown(faults(s));
  }
}

TEST(Faults, LeakySightIsAShareAndNeedsLinesOfSight) {
  Scenario s = plain_scenario();
  s.radio.sight_leak = 1.5;
  ASSERT_EQ(faults(s).size(), 2U) << shown(faults(s));
  EXPECT_EQ(faults(s)[0].key, "radio.sight_leak");
  EXPECT_FALSE(faults(s)[0].warning);
  s.radio.sight_leak = 0.2;
  ASSERT_EQ(faults(s).size(), 1U) << shown(faults(s));
  EXPECT_TRUE(faults(s)[0].warning);
  Scenario switched = s;
  switched.events = {event(SetLineOfSight{true}, 5.0)};
  EXPECT_TRUE(faults(switched).empty()) << shown(faults(switched));
  s.radio.line_of_sight = true;
  EXPECT_TRUE(faults(s).empty()) << shown(faults(s));
}

bool possible(const Scenario& s) {
  const auto list = faults(s);
  return std::all_of(list.begin(), list.end(), [](const Fault& f) { return f.warning; });
}

TEST(Faults, WhoeverServedATargetThatIsGivenUpIsFreeForAnother) {
  Scenario s = plain_scenario();
  s.swarm.robots = 4;  // three workers and the root
  s.events = {event(RemoveTarget{0}, 1.0), event(AddTarget{}, 2.0)};
  EXPECT_TRUE(possible(s));
  s.events[0].time_s = 3.0;  // too late
  EXPECT_FALSE(possible(s));
}

TEST(Faults, ATargetThatIsAddedAtSomeMomentMayBeNamed) {
  Scenario s = plain_scenario();
  s.swarm.robots = 9;
  s.events = {{0.0, Event::When::half_way, AddTarget{}}, event(MoveTarget{3})};
  EXPECT_TRUE(possible(s));
  s.events[1].action = MoveTarget{4};
  EXPECT_FALSE(possible(s));
}

}  // namespace
}  // namespace banyan::world
