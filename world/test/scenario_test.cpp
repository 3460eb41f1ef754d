// SPDX-License-Identifier: MIT
// A scenario without faults has none; each fault is found, once, where it is, in words.
#include "banyan/world/scenario.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/world/names.hpp"
#include "banyan/world/obstacles.hpp"

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
Event event(Event::Kind kind, std::size_t index, double time_s = 1.0) {
  Event e;
  e.kind = kind;
  e.index = index;
  e.time_s = time_s;
  return e;
}

const std::vector<Case>& cases() {
  using Kind = Event::Kind;
  static const std::vector<Case> list{
      {"tick_s", "not 0", [](Scenario& s) { s.tick_s = 0; }},
      {"tick_s", "nan", [](Scenario& s) { s.tick_s = nan; }},
      {"mission.algorithm", "did you mean inwards?", [](Scenario& s) { s.mission.algorithm = "inward"; }},
      {"mission.algorithm", "must be outwards", [](Scenario& s) { s.mission.algorithm = ""; }},
      {"mission.reading", "did you mean literal?", [](Scenario& s) { s.mission.reading = "literl"; }},
      {"mission.target_tolerance_m", "-1", [](Scenario& s) { s.mission.target_tolerance_m = -1; }},
      {"mission.time_limit_s", "inf", [](Scenario& s) { s.mission.time_limit_s = infinity; }},
      {"mission.settle_s", "-1", [](Scenario& s) { s.mission.settle_s = -1; }},
      {"mission.time_limit_s", "must be given",
       [](Scenario& s) { s.swarm.robots = 9, s.targets = RingTargets{3, 0.0, 0, {}}; }},
      {"mission.parameters.target_gian", "did you mean target_gain?",
       [](Scenario& s) { s.mission.parameters = {{"target_gian", 0.4}}; }},
      {"mission.parameters.target_gain", "-1", [](Scenario& s) { s.mission.parameters = {{"target_gain", -1}}; }},
      {"mission.parameters.target_gain", "nan", [](Scenario& s) { s.mission.parameters = {{"target_gain", nan}}; }},
      {"mission.parameters.target_gain", "1e+300",
       [](Scenario& s) { s.mission.parameters = {{"target_gain", 1e300}}; }},
      {"mission.parameters.tick_s", "is set by tick_s", [](Scenario& s) { s.mission.parameters = {{"tick_s", 0.1}}; }},
      {"mission.parameters.communication_range_m", "radio.range_m",
       [](Scenario& s) { s.mission.parameters = {{"communication_range_m", 2}}; }},
      {"mission.parameters", "delta", [](Scenario& s) { s.mission.algorithm = "outwards", s.radio.range_m = 1.0; }},
      {"swarm.redundancy", "not 0", [](Scenario& s) { s.swarm.redundancy = 0; }},
      {"swarm.redundancy", "robots; at most",
       [](Scenario& s) { s.swarm.redundancy = 1000, s.targets = RingTargets{60, 6000, 0, {}}; }},
      {"swarm.robots", "not 1", [](Scenario& s) { s.swarm.robots = 1; }},
      {"swarm.robots", "not 65536", [](Scenario& s) { s.swarm.robots = 65536; }},
      {"swarm.robots", "3 robots cannot serve 3 targets", [](Scenario& s) { s.swarm.robots = 3; }},
      {"swarm.root", "there is no robot 9", [](Scenario& s) { s.swarm.robots = 9, s.swarm.root = 9; }},
      {"swarm.start.center", "must lie within", [](Scenario& s) { s.swarm.start.center.x = nan; }},
      {"swarm.start.pitch_m", "robots do not fit", [](Scenario& s) { s.swarm.start.pitch_m = 0.15; }},
      {"swarm.start.pitch_m", "not be connected", [](Scenario& s) { s.swarm.start.pitch_m = 1.97; }},
      {"swarm.start.positions", "needs swarm.start.layout", [](Scenario& s) { s.swarm.start.positions = {{0, 0}}; }},
      {"swarm.start.positions", "not 0", [](Scenario& s) { use_list(s, {}); }},
      {"swarm.start.positions", "2 groups", [](Scenario& s) { use_list(s, {{0, 0}, {1, 0}, {3.1, 0}}); }},
      {"swarm.start.positions[2]", "overlaps position 0", [](Scenario& s) { use_list(s, {{0, 0}, {1, 0}, {0.1, 0}}); }},
      {"swarm.start.positions[1]", "must lie within", [](Scenario& s) { use_list(s, {{0, 0}, {infinity, 0}}); }},
      {"swarm.start.positions[1]", "touches an obstacle",
       [](Scenario& s) { use_list(s, {{0, 0}, {0.5, 0}}), s.obstacles = {Disc{{0.6, 0}, 0.05}}; }},
      {"swarm.start.headings_rad", "one entry per position",
       [](Scenario& s) { use_list(s, {{0, 0}, {0.5, 0}}), s.swarm.start.headings_rad = {0}; }},
      {"swarm.robots", "is 5, but", [](Scenario& s) { use_list(s, {{0, 0}, {0.5, 0}}), s.swarm.robots = 5; }},
      {"swarm.robots", "1 robots cannot", [](Scenario& s) { use_list(s, {{0, 0}}); }},
      {"swarm.start.center", "no room", [](Scenario& s) { s.obstacles = {Disc{{0.1, 0}, 0.05}}; }},
      {"swarm.start", "robots fit",
       [](Scenario& s) {
         s.swarm.robots = 94;
         s.obstacles = {Wall{{-1, -1}, {1, -1}}, Wall{{1, -1}, {1, 1}}, Wall{{1, 1}, {-1, 1}}, Wall{{-1, 1}, {-1, -1}}};
       }},
      {"robot.radius_m", "-0.1", [](Scenario& s) { s.robot.radius_m = -0.1; }},
      {"robot.wheel_distance_m", "not 0", [](Scenario& s) { s.robot.wheel_distance_m = 0; }},
      {"robot.wheel_limit_m_s", "inf", [](Scenario& s) { s.robot.wheel_limit_m_s = infinity; }},
      {"robot.wheel_noise", "2", [](Scenario& s) { s.robot.wheel_noise = 2; }},
      {"robot.wheel_bias", "-1", [](Scenario& s) { s.robot.wheel_bias = -1; }},
      {"robot.odometry_noise", "nan", [](Scenario& s) { s.robot.odometry_noise = nan; }},
      {"robot.mass_kg", "not 0", [](Scenario& s) { s.robot.mass_kg = 0; }},
      {"robot.max_force_n", "not 0", [](Scenario& s) { s.robot.max_force_n = 0; }},
      {"robot.max_torque_nm", "not 0", [](Scenario& s) { s.robot.max_torque_nm = 0; }},
      {"robot.max_acceleration_m_s2", "not 0", [](Scenario& s) { s.robot.max_acceleration_m_s2 = 0; }},
      {"radio.range_m", "not 0", [](Scenario& s) { s.radio.range_m = 0; }},
      {"radio.range_m", "two robot radii", [](Scenario& s) { s.robot.radius_m = 1.0; }},
      {"radio.loss", "1.5", [](Scenario& s) { s.radio.loss = 1.5; }},
      {"radio.range_noise_m", "-1", [](Scenario& s) { s.radio.range_noise_m = -1; }},
      {"radio.bearing_noise_rad", "4", [](Scenario& s) { s.radio.bearing_noise_rad = 4; }},
      {"radio.latency_ticks", "not 0", [](Scenario& s) { s.radio.latency_ticks = 0; }},
      {"radio.slots", "-1", [](Scenario& s) { s.radio.slots = -1; }},
      {"targets.positions", "not 0", [](Scenario& s) { s.targets = std::vector<Vec2>{}; }},
      {"targets.positions[1]", "must lie within",
       [](Scenario& s) { s.targets = std::vector<Vec2>{{1, 1}, {1, -infinity}}; }},
      {"targets.positions[1]", "inside an obstacle",
       [](Scenario& s) { s.targets = std::vector<Vec2>{{3, 0}, {0, 3}}, s.obstacles = {Box{{0, 3}, {1, 1}, 0.3}}; }},
      {"targets.positions[0]", "no robot of radius",
       [](Scenario& s) {
         s.targets = std::vector<Vec2>{{3, 0}, {0, 3}};
         s.mission.target_tolerance_m = 0.05;
         s.obstacles = {Wall{{3.01, -1}, {3.01, 1}}};
       }},
      {"targets", "target 0 at (3, 0) lies inside", [](Scenario& s) { s.obstacles = {Disc{{3, 0}, 0.5}}; }},
      {"targets", "inside an obstacle",
       [](Scenario& s) { s.targets = RandomTargets{1, 1, {5, 0}}, s.obstacles = {Disc{{5, 0}, 1.5}}; }},
      {"targets.count", "not 0", [](Scenario& s) { s.targets = RingTargets{0, 3, 0, {}}; }},
      {"targets.count", "1000000000", [](Scenario& s) { s.targets = RingTargets{1000000000, 3, 0, {}}; }},
      {"targets.radius_m", "nan", [](Scenario& s) { s.targets = RingTargets{3, nan, 0, {}}; }},
      {"targets.phase_rad", "inf", [](Scenario& s) { s.targets = RingTargets{3, 3, infinity, {}}; }},
      {"targets.center", "must lie within", [](Scenario& s) { s.targets = RandomTargets{3, 3, {nan, 0}}; }},
      {"obstacles[0].radius_m", "not 0", [](Scenario& s) { s.obstacles = {Disc{{5, 5}, 0}}; }},
      {"obstacles[1].size", "-1", [](Scenario& s) { s.obstacles = {Disc{{5, 5}, 1}, Box{{5, 5}, {1, -1}, 0}}; }},
      {"obstacles[0].angle_rad", "nan", [](Scenario& s) { s.obstacles = {Box{{5, 5}, {1, 1}, nan}}; }},
      {"obstacles[0].to", "must differ", [](Scenario& s) { s.obstacles = {Wall{{5, 5}, {5, 5}}}; }},
      {"obstacles[0].from", "must lie within", [](Scenario& s) { s.obstacles = {Wall{{nan, 5}, {5, 5}}}; }},
      {"tick_s", "pass through an obstacle", [](Scenario& s) { s.obstacles = {Disc{{5, 5}, 1}}, s.tick_s = 0.5; }},
      {"events[0].time_s", "-1", [](Scenario& s) { s.events = {event(Kind::die, 0, -1)}; }},
      {"events[0].robot", "there is no robot 99", [](Scenario& s) { s.events = {event(Kind::die, 99)}; }},
      {"events[1].robot", "there is no robot 12",
       [](Scenario& s) { s.swarm.robots = 12, s.events = {event(Kind::die, 11), event(Kind::freeze, 12)}; }},
      {"events[0].target", "there is no target 3", [](Scenario& s) { s.events = {event(Kind::move_target, 3)}; }},
      {"events[0].target", "at that time",
       [](Scenario& s) { s.events = {event(Kind::move_target, 3, 1), event(Kind::add_target, 0, 2)}; }},
      {"events[0].loss", "7", [](Scenario& s) { s.events = {event(Kind::set_loss, 0)}, s.events[0].value = 7; }},
      {"events[0].seconds", "-1", [](Scenario& s) { s.events = {event(Kind::freeze, 0)}, s.events[0].value = -1; }},
      {"events[0].target", "there is no target 3", [](Scenario& s) { s.events = {event(Kind::remove_target, 3)}; }},
      {"events[0].obstacle", "there is no obstacle 0", [](Scenario& s) { s.events = {event(Kind::move_obstacle, 0)}; }},
      {"events[0].obstacle", "there is no obstacle 2; the last one is 1",
       [](Scenario& s) {
         s.events = {event(Kind::move_obstacle, 2)};
         s.obstacles = {Disc{{5, 5}, 1}, Disc{{-5, 5}, 1}};
       }},
      {"events[0].position", "must lie within",
       [](Scenario& s) {
         s.events = {event(Kind::move_obstacle, 0)};
         s.events[0].position = {0, infinity};
         s.obstacles = {Disc{{5, 5}, 1}};
       }},
      {"events[1].position", "inside an obstacle",
       [](Scenario& s) {
         s.events = {event(Kind::move_obstacle, 0, 1), event(Kind::add_target, 0, 2)};
         s.events[0].position = s.events[1].position = {4, -4};
         s.obstacles = {Disc{{5, 5}, 1}};
       }},
      {"events[0].line_of_sight", "must be 0 or 1",
       [](Scenario& s) { s.events = {event(Kind::set_line_of_sight, 0)}, s.events[0].value = 0.5; }},
      {"events[0].kind", "no such kind", [](Scenario& s) { s.events = {event(static_cast<Kind>(99), 0)}; }},
      {"events[0].speed_m_s", "-1", [](Scenario& s) { s.events = {event(Kind::move_target, 0)}, s.events[0].value = -1; }},
      {"events[0].duration_s", "above 0", [](Scenario& s) { s.events = {event(Kind::blackout, 0)}; }},
      {"events[0].share", "not both",
       [](Scenario& s) { s.events = {event(Kind::kill, 0)}, s.events[0].share = 0.5, s.events[0].count = 2; }},
      {"events[0].share", "1.1", [](Scenario& s) { s.events = {event(Kind::kill, 0)}, s.events[0].share = 1.1; }},
      {"events[0].count", "not 0", [](Scenario& s) { s.events = {event(Kind::kill, 0)}, s.events[0].count = 0; }},
      {"events[0].every_s", "nan", [](Scenario& s) { s.events = {event(Kind::kill, 0)}, s.events[0].every_s = nan; }},
      {"events[0].position", "must lie within",
       [](Scenario& s) { s.events = {event(Kind::add_target, 0)}, s.events[0].position = {nan, 0}; }},
      {"events[0].position", "inside an obstacle",
       [](Scenario& s) {
         s.events = {event(Kind::add_target, 0)};
         s.events[0].position = {5, 5};
         s.obstacles = {Disc{{5, 5}, 1}};
       }},
      {"swarm.robots", "4 robots cannot serve 4 targets",
       [](Scenario& s) { s.swarm.robots = 4, s.events = {event(Kind::add_target, 0)}; }},
      {"swarm.robots", "4 robots cannot serve 4 targets",
       [](Scenario& s) {
         s.swarm.robots = 4, s.events = {event(Kind::add_target, 0), event(Kind::remove_target, 0)};
         s.events[0].when = Event::When::half_way;
       }},
      {"events[0].time_s", "the run ends before", [](Scenario& s) { s.events = {event(Kind::die, 0, 1e6)}; }, true},
      {"targets", "out of reach",
       [](Scenario& s) { s.swarm.robots = 5, s.targets = std::vector<Vec2>{{-9, 0}, {9, 0}}; }, true},
  };
  return list;
}

TEST(Faults, TheDefaultsAndTheirVariationsHaveNone) {
  Scenario scenario;
  EXPECT_EQ(shown(faults(scenario)), "");
  for (const Algorithm* algorithm : algorithms())
    for (const char* reading : {"corrected", "literal"}) {
      scenario.mission.algorithm = algorithm->name();
      scenario.mission.reading = reading;
      EXPECT_EQ(shown(faults(scenario)), "") << algorithm->name() << reading;
    }
  scenario.targets = RandomTargets{};
  scenario.obstacles = {Disc{{4, 4}, 1.0}, Box{{-4, 0}, {1, 2}, 0.5}, Wall{{2, 2}, {3, 2}}};
  scenario.events = {event(Event::Kind::add_target, 0, 1), event(Event::Kind::move_target, 4, 2)};
  scenario.events[1].position = {1, 1};
  scenario.mission.parameters = {{"target_gain", 1.9}, {"avoidance_gain", 0.0}};  // both bounds are allowed
  EXPECT_EQ(shown(faults(scenario)), "");
}

TEST(Faults, EachIsFoundOnceWhereItIs) {
  for (const Case& c : cases()) {
    Scenario scenario;
    c.change(scenario);
    const std::vector<Fault> found = faults(scenario);
    int hits = 0;
    for (const Fault& f : found)
      hits += f.key == c.key && f.text.find(c.words) != std::string::npos && f.warning == c.warning;
    EXPECT_GE(hits, 1) << c.key << " (" << c.words << "), found:\n" << shown(found);
    EXPECT_LE(hits, 2) << c.key << " (" << c.words << "), found:\n" << shown(found);  // two targets in one obstacle
  }
}

TEST(Faults, AllWrongNumbersAreReportedAtOnce) {
  Scenario scenario;
  scenario.tick_s = nan;
  scenario.radio.loss = 2.0;
  scenario.mission.algorithm = "sideways";
  scenario.targets = RingTargets{3, -1.0, 0, {}};
  EXPECT_EQ(faults(scenario).size(), 4U) << shown(faults(scenario));
}

TEST(Scenario, RedundancyGivesThePapersNinetyFour) {
  Scenario scenario;
  scenario.swarm.redundancy = 4;
  scenario.targets = RingTargets{4, 9.0, 0.7, {}};
  EXPECT_EQ(robot_count(scenario), 94U);  // protocol 2, row 10
  scenario.swarm.start.center = {2, 3};
  scenario.targets = RingTargets{4, 9.0, 0.7, {2, 3}};
  EXPECT_EQ(robot_count(scenario), 94U) << "distances count from the start";
  // An exact multiple stays exact although the sum of the distances is rounded up.
  scenario.swarm.start.center = {0, 0};
  scenario.targets = std::vector<Vec2>(6, Vec2{1.540841 * 4, 0});
  EXPECT_EQ(robot_count(scenario), 96U);
  scenario.targets = RingTargets{4, 0.1, 0.3, {}};
  EXPECT_EQ(robot_count(scenario), 5U) << "never less than a worker each and a root";
  scenario.swarm.robots = 33;
  EXPECT_EQ(robot_count(scenario), 33U);
}

TEST(Scenario, RingTargetsStandAtEqualAngles) {
  Scenario scenario;
  std::get<RingTargets>(scenario.targets) = {5, 6.0, 0.25, {1, 2}};
  const std::vector<Vec2> ring = target_positions(scenario);
  ASSERT_EQ(ring.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(ring[i].x, 1 + 6 * std::cos(0.25 + i * 2 * M_PI / 5), 1e-9);
    EXPECT_NEAR(ring[i].y, 2 + 6 * std::sin(0.25 + i * 2 * M_PI / 5), 1e-9);
  }
}

TEST(Scenario, RandomTargetsFillAnAnnulusEvenly) {
  Scenario scenario;
  scenario.targets = RandomTargets{2000, 9.0, {1, 2}};
  const std::vector<Vec2> random = target_positions(scenario);
  EXPECT_EQ(random, target_positions(scenario));
  int inner = 0;
  for (const Vec2 p : random) {
    const double r = distance(p, Vec2{1, 2});
    EXPECT_GE(r, 9 * std::sqrt(0.1) - 1e-9);
    EXPECT_LE(r, 9.0 + 1e-9);
    inner += r < 9 * std::sqrt(0.55);  // half of the annulus' area
  }
  EXPECT_NEAR(inner, 1000, 110);
  scenario.seed = 2;
  EXPECT_NE(random, target_positions(scenario));
}

TEST(Scenario, RandomTargetsKeepClearOfObstacles) {
  Scenario scenario;
  scenario.targets = RandomTargets{500, 9.0, {}};
  scenario.obstacles = {Box{{6, 0}, {12, 30}, 0.0}, Disc{{-5, 0}, 2}};  // the box takes all of x > 0
  for (const Vec2 p : target_positions(scenario))
    for (const Obstacle& o : scenario.obstacles) EXPECT_GE(clearance(o, p), scenario.robot.radius_m);
}

TEST(Scenario, TimeLimitIsTenTimesTheDriveToTheFarthestTarget) {
  Scenario scenario;
  scenario.targets = std::vector<Vec2>{{3, 4}, {1, 0}};
  EXPECT_DOUBLE_EQ(time_limit_s(scenario), 250.0);
  scenario.mission.time_limit_s = 77;
  EXPECT_DOUBLE_EQ(time_limit_s(scenario), 77.0);
}

TEST(Scenario, AlgorithmsAreSetUpFromMissionAndPlatform) {
  Scenario scenario;
  scenario.mission.algorithm = "inwards";
  scenario.mission.reading = "literal";
  scenario.mission.scale = 0.5;
  scenario.mission.target_tolerance_m = 0.15;
  scenario.mission.parameters = {{"target_gain", 0.125}};
  scenario.radio.range_m = 2.5;
  scenario.radio.line_of_sight = true;
  scenario.tick_s = 0.05;
  scenario.robot.wheel_limit_m_s = 0.3;
  scenario.robot.wheel_distance_m = 0.2;
  const banyan::Setup setup = setup_of(scenario);
  EXPECT_EQ(setup.reading, "literal");
  EXPECT_EQ(setup.scale, 0.5);
  EXPECT_EQ(setup.arrival_distance_m, 0.15);
  EXPECT_EQ(setup.parameters, scenario.mission.parameters);
  EXPECT_EQ(setup.platform.communication_range_m, 2.5F);
  EXPECT_TRUE(setup.platform.line_of_sight);
  EXPECT_EQ(setup.platform.tick_s, 0.05F);
  EXPECT_EQ(setup.platform.wheel_limit_m_s, 0.3F);
  EXPECT_EQ(setup.platform.wheel_distance_m, 0.2F);
  EXPECT_EQ(setup.platform.drive, Drive::differential);
  scenario.robot.body = BodyModel::linear;
  EXPECT_EQ(setup_of(scenario).platform.drive, Drive::holonomic);
}

TEST(Scenario, TheAlgorithmsValuesAreItsTableScaledAndThenTheScenariosOwn) {
  Scenario scenario;
  scenario.mission.algorithm = "inwards";
  const Algorithm& inwards = *find_algorithm("inwards");
  const auto value = [&](std::string_view key) {
    const auto rows = inwards.parameters();
    const auto values = inwards.values(setup_of(scenario));
    EXPECT_EQ(rows.size(), values.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (rows[k]->key == key) return values[k];
    ADD_FAILURE() << key;
    return 0.0F;
  };
  const float recruitment_m = value("recruitment_distance_m");
  const float patience_s = value("connector_patience_s");
  const float gain = value("target_gain");
  scenario.mission.scale = 0.5;
  scenario.mission.parameters = {{"target_gain", 0.125}};
  EXPECT_NE(gain, 0.125F);
  EXPECT_EQ(value("target_gain"), 0.125F);
  EXPECT_FLOAT_EQ(value("recruitment_distance_m"), 0.5F * recruitment_m);
  EXPECT_EQ(value("connector_patience_s"), patience_s);
}

TEST(Scenario, LeastRobotsHoldsForAStraightLineAndAStar) {
  EXPECT_EQ(least_robots({{0, 0}}, 0.2, 2.0), 1U);
  EXPECT_EQ(least_robots({{-9, 0}, {9, 0}}, 0.2, 2.0), 10U);   // (18 - 0.4) / 2 = 8.8 links
  EXPECT_EQ(least_robots({{-9, 0}, {9, 0}}, 0.0, 2.0), 10U);   // 9 links exactly
  // Four corners: the tree through three sides needs 0.8241 * 30 / 2 links, more than a diagonal's 7.07.
  EXPECT_EQ(least_robots({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 0.0, 2.0), 14U);
}

TEST(Names, TheNearestIsSuggestedAndNonsenseIsNot) {
  const std::string_view known[] = {"outwards", "inwards", "convoy"};
  EXPECT_EQ(nearest_name("outward", known), "outwards");
  EXPECT_EQ(nearest_name("invards", known), "inwards");
  EXPECT_EQ(nearest_name("zzzzzzzzzzzz", known), "");
  EXPECT_EQ(nearest_name("x", {}), "");
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(listed(known), "outwards, inwards or convoy");
}

bool possible(const Scenario& s) {
  const auto list = faults(s);
  return std::all_of(list.begin(), list.end(), [](const Fault& f) { return f.warning; });
}

TEST(Scenario, WhoeverServedATargetThatIsGivenUpIsFreeForAnother) {
  Scenario s;
  s.swarm.robots = 4;  // three workers and the root
  s.events = {event(Event::Kind::remove_target, 0, 1.0), event(Event::Kind::add_target, 0, 2.0)};
  EXPECT_TRUE(possible(s));
  s.events[0].time_s = 3.0;  // too late
  EXPECT_FALSE(possible(s));
}

TEST(Scenario, ATargetThatIsAddedAtSomeMomentMayBeNamed) {
  Scenario s;
  s.swarm.robots = 9;
  s.events = {event(Event::Kind::add_target, 0, 0.0), event(Event::Kind::move_target, 3, 1.0)};
  s.events[0].when = Event::When::half_way;
  EXPECT_TRUE(possible(s));
  s.events[1].index = 4;
  EXPECT_FALSE(possible(s));
}

}  // namespace
}  // namespace banyan::world
