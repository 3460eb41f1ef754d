// SPDX-License-Identifier: MIT
// Stations are where their course says, whatever else happens; the swarm takes them as nodes of its network.
#include "banyan/world/stations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "banyan/world/faults.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

Station base(Vec2 at = {0.0, -0.6}) { return {.name = "base", .position = at}; }
Station vehicle() {
  return {.name = "vehicle",
          .position = {0.9, 0.0},
          .course = {{4.0, 0.0}, {4.0, 3.0}, {0.9, 3.0}},
          .speed_m_s = 0.1,
          .pause_s = 3.0,
          .start_s = 5.0};
}
// A swarm between a base and a vehicle.
Scenario between(const std::string& algorithm = "convoy", std::uint64_t seed = 1) {
  Scenario s = plain_scenario();
  s.mission.algorithm = algorithm;
  s.mission.stop_when_complete = false;
  s.swarm.robots = 9;
  s.targets = std::vector<Vec2>{};
  s.stations = {base(), vehicle()};
  s.seed = seed;
  return s;
}
std::string words(const std::vector<Fault>& list) {
  std::string text;
  for (const Fault& f : list)
    if (!f.warning) text += f.key + ": " + f.text + "\n";
  return text;
}

// A second way to be there: small steps.
Vec2 walked(const Station& station, double until_s) {
  constexpr double h = 1e-4;
  std::vector<Vec2> points = station.course;
  Vec2 at = station.position;
  std::size_t next = 0;
  double waits_s = 0.0;
  for (double t = station.start_s; t < until_s - h / 2; t += h) {
    if (waits_s > h / 2) {
      waits_s -= h;
      continue;
    }
    if (next == points.size()) {
      if (!station.loop) break;
      points.push_back(points.size() % (station.course.size() + 1) == station.course.size()
                           ? station.position
                           : station.course[points.size() % (station.course.size() + 1)]);
    }
    const Vec2 way = points[next] - at;
    const double step = station.speed_m_s * h;
    if (norm(way) > step) {
      at += way * (step / norm(way));
    } else {
      at = points[next++];
      waits_s = station.pause_s;
    }
  }
  return at;
}

TEST(Stations, AreWhereSmallStepsWouldBringThem) {
  for (const bool loop : {false, true}) {
    Station s = vehicle();
    s.loop = loop;
    for (const double t : {0.0, 4.9, 5.0, 6.0, 36.0, 37.5, 38.9, 39.5, 60.0, 72.5, 110.0, 140.0, 171.0, 260.0})
      EXPECT_LT(distance(station_at(s, t), walked(s, t)), 1e-3) << t << loop;
  }
}

TEST(Stations, ByTheClockTheyAreAtTheirWayPointsInTime) {
  Station s = vehicle();
  s.speed_m_s = s.pause_s = 0.0;
  s.start_s = 10.0;
  s.times = {20.0, 22.0, 50.0};
  EXPECT_EQ(station_at(s, 3.0), s.position);
  EXPECT_EQ(station_at(s, 10.0), s.position);
  EXPECT_LT(distance(station_at(s, 15.0), {2.45, 0.0}), 1e-12);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(distance(station_at(s, s.times[k]), s.course[k]), 1e-12);
  EXPECT_EQ(station_at(s, 1000.0), s.course.back());
}

TEST(Stations, NothingMovesThemFromTheirCourse) {
  for (const BodyModel body : {BodyModel::disks, BodyModel::box2d, BodyModel::linear})
    for (const bool clocks : {false, true}) {
      if (body == BodyModel::box2d && !has_box2d()) continue;
      Scenario s = between();
      s.robot.body = body;
      s.clocks.asynchronous = clocks;
      s.clocks.drift = clocks ? 0.01 : 0.0;
      s.stations[1].position = {0.5, 0.0};
      s.stations[1].course = {{-0.9, 0.0}, {3.0, 0.5}};  // through the swarm
      World world(s);
      for (int t = 0; t < 400; ++t) {
        world.step();
        ASSERT_EQ(world.positions()[9], s.stations[0].position);
        ASSERT_LT(distance(world.positions()[10], station_at(s.stations[1], world.time_s())), 1e-9) << t;
        ASSERT_EQ(world.targets()[1].position, world.positions()[10]);
      }
      EXPECT_STREQ(world.station(10)->name.c_str(), "vehicle");
      EXPECT_EQ(world.station(8), nullptr);
    }
}

TEST(Stations, AreCalledByTheirNames) {
  const World world(between());
  ASSERT_EQ(world.names().size(), 11U);
  EXPECT_EQ(world.names()[0], "");
  EXPECT_EQ(world.names()[9], "base");
  EXPECT_EQ(world.names()[10], "vehicle");
}

TEST(Stations, AllAlgorithmsKeepThemJoinedOnASlowCourse) {
  for (const char* algorithm : {"convoy", "caravan", "outwards", "inwards"}) {
    Scenario s = between(algorithm);
    s.stations[1].speed_m_s = 0.05;
    World world(s);
    for (int t = 0; t < 1500; ++t) {
      world.step();
      const auto at = [&](std::size_t i) { return world.positions()[i]; };
      // By a search of its own.
      std::vector<std::size_t> reached{9};
      std::vector<char> seen(world.size(), 0);
      seen[9] = 1;
      for (std::size_t k = 0; k < reached.size(); ++k)
        for (std::size_t j = 0; j < world.size(); ++j)
          if (!seen[j] && distance(at(reached[k]), at(j)) < s.radio.range_m) seen[j] = 1, reached.push_back(j);
      ASSERT_TRUE(seen[10]) << algorithm << " at " << world.time_s();
    }
  }
}

TEST(Stations, HoldTheirPlacesAndNobodyElseServesThem) {
  for (const char* algorithm : {"convoy", "caravan", "outwards", "inwards"}) {
    World world(between(algorithm));
    for (int t = 0; t < 600; ++t) {
      world.step();
      for (const std::size_t i : {std::size_t{9}, std::size_t{10}}) {
        ASSERT_EQ(world.holder(i - 9), i) << algorithm;
        ASSERT_EQ(world.reports()[i].serves, i);
      }
      for (std::size_t i = 0; i < 9; ++i) ASSERT_NE(world.reports()[i].role, Role::worker) << algorithm;
    }
  }
}

TEST(Stations, TakeTheirPlacesBackFromRobotsThatThoughtThemLost) {
  for (const char* algorithm : {"convoy", "caravan"}) {
    Scenario s = between(algorithm);
    s.stations[1].course = {{12.0, 0.0}, {0.9, 0.0}};  // too fast for anybody, and back after a while
    s.stations[1].speed_m_s = 1.0;
    s.stations[1].pause_s = 60.0;
    World world(s);
    bool replaced = false;
    for (int t = 0; t < 2000; ++t) {
      world.step();
      ASSERT_EQ(world.reports()[9].serves, 9U);
      ASSERT_EQ(world.reports()[10].serves, 10U);
      for (std::size_t i = 0; i < 9; ++i) replaced |= world.reports()[i].role == Role::worker;
    }
    EXPECT_TRUE(replaced) << "nobody thought it lost: the test shows nothing";
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NE(world.reports()[i].role, Role::worker) << algorithm << i;
  }
}

// Nobody reaches what it announces, as long as it stands; a worker would give up.
TEST(Stations, KeepTheirPlacesHoweverLongTheyAnnounceAnother) {
  for (const char* algorithm : {"convoy", "caravan"}) {
    Scenario s = between(algorithm);
    s.stations[1].start_s = 500.0;
    s.stations[1].announce_s = 600.0;
    World world(s);
    for (int t = 0; t < 4900; ++t) {
      world.step();
      ASSERT_EQ(world.reports()[10].serves, 10U) << algorithm << " at " << world.time_s();
    }
  }
}

// The root gives targets up for which there are not robots enough.
TEST(Stations, KeepTheirPlacesWhereRobotsAreTooFew) {
  for (const char* algorithm : {"convoy", "caravan"}) {
    Scenario s = between(algorithm, 3);
    s.swarm.robots = 5;
    s.targets = std::vector<Vec2>{{-4.0, 0.0}, {0.0, -3.0}};
    s.stations[1].course = {{3.4, 0.5}};
    s.stations[1].speed_m_s = 0.02;
    World world(s);
    for (int t = 0; t < 2000; ++t) {
      world.step();
      ASSERT_EQ(world.reports()[5].serves, 5U) << algorithm << " at " << world.time_s();
      ASSERT_EQ(world.reports()[6].serves, 6U) << algorithm << " at " << world.time_s();
    }
  }
}

TEST(Stations, ARootStaysTheRootThoughItIsFarFromTheCentroid) {
  for (const char* algorithm : {"convoy", "caravan", "outwards", "inwards"}) {
    Scenario s = between(algorithm);
    s.stations[0].root = true;
    s.targets = std::vector<Vec2>{{3.5, 0.0}, {2.5, 2.5}};
    World world(s);
    EXPECT_EQ(world.targets().size(), 3U);
    for (int t = 0; t < 1000; ++t) {
      world.step();
      ASSERT_EQ(world.reports()[9].role, Role::root) << algorithm << t;
      for (std::size_t i = 0; i < world.size(); ++i) {
        if (i != 9) { ASSERT_NE(world.reports()[i].role, Role::root) << algorithm << t; }
      }
    }
  }
}

TEST(Stations, WhereOneDiesARobotTakesItsPlace) {
  Scenario s = between();
  s.stations[1].course.clear();
  s.stations[1].speed_m_s = s.stations[1].pause_s = s.stations[1].start_s = 0.0;
  s.events = {{.time_s = 5.0, .action = Die{10}}};
  World world(s);
  for (int t = 0; t < 600; ++t) world.step();
  ASSERT_TRUE(world.holder(1).has_value());
  EXPECT_LT(*world.holder(1), 9U);
}

TEST(Stations, ThoseThatAreDrawnToDieAreRobots) {
  Scenario s = between();
  s.events = {{.time_s = 1.0, .action = Kill{.of = Kill::Of::robots, .share = 1.0}}};
  World world(s);
  for (int t = 0; t < 20; ++t) world.step();
  EXPECT_EQ(world.deaths(), 9U);
  EXPECT_EQ(world.alive()[9] + world.alive()[10], 2);
}

TEST(Stations, AWorkerThatDiesWithItsParentLeavesAStationThatIsIt) {
  Scenario s = between();
  s.stations.resize(1);
  s.stations[0].root = true;
  s.targets = std::vector<Vec2>{{0.9, -0.6}};
  World world(s);
  for (int t = 0; t < 100; ++t) world.step();
  ASSERT_TRUE(world.holder(0).has_value());
  ASSERT_EQ(up_of(world.reports()[*world.holder(0)]), 9U) << "its parent is another: the test shows nothing";
  world.intervene({.action = Kill{.of = Kill::Of::worker_and_parent}});
  world.step();
  EXPECT_EQ(world.deaths(), 1U);
  EXPECT_EQ(world.alive()[9], 1);
}

TEST(Stations, ABaseThatChargesCostsNoRobot) {
  Scenario s = between();
  s.stations.resize(1);
  s.battery.model = Battery::Model::time;
  s.battery.charge_per_s = 0.01;  // empty after 100 s
  s.battery.capacity_j = 1000.0;
  s.battery.charge_w = 100.0;
  s.battery.slots = 1;
  s.battery.start_charge = 0.6;
  s.battery.places = {s.stations[0].position};
  World world(s);
  EXPECT_EQ(world.targets().size(), 1U);
  for (int t = 0; t < 3000; ++t) {
    world.step();
    ASSERT_EQ(world.charged_at()[9], -1) << "it took the slot of a robot at " << world.time_s();
  }
  EXPECT_EQ(world.deaths(), 0U);
  EXPECT_EQ(world.holder(0), 9U);
}

TEST(Stations, TheSameOnAnyNumberOfThreadsAndInACopy) {
  const Scenario s = between("convoy", 7);
  expect_the_same_on_any_number_of_threads(s, 200, "stations");
  World one(s);
  for (int t = 0; t < 200; ++t) one.step();
  World copy = one;
  for (int t = 0; t < 100; ++t) one.step(), copy.step();
  EXPECT_EQ(one.hash(), copy.hash());
}

TEST(Stations, WhatIsWrongWithThemIsSaid) {
  struct Case {
    const char* words;
    void (*change)(Scenario&);
  };
  const Case cases[] = {
      {"stations[1].name: is \"base\", as another station is called", [](Scenario& s) { s.stations[1].name = "base"; }},
      {"stations[0].name: is \"a b\"; allowed", [](Scenario& s) { s.stations[0].name = "a b"; }},
      {"stations[0].name: is \"7\": numbers are targets", [](Scenario& s) { s.stations[0].name = "7"; }},
      {"stations[1].speed_m_s: a station with course_m needs", [](Scenario& s) { s.stations[1].speed_m_s = 0.0; }},
      {"stations[0].loop: needs course_m", [](Scenario& s) { s.stations[0].loop = true; }},
      {"stations[1].times_s: give times_s or speed_m_s",
       [](Scenario& s) {
         s.stations[1].times = {10.0, 20.0, 30.0};
       }},
      {"stations[1].times_s: must have one entry per way point (3), not 1",
       [](Scenario& s) { s.stations[1].times = {10.0}, s.stations[1].speed_m_s = s.stations[1].pause_s = 0.0; }},
      {"stations[1].times_s[1]: must be later",
       [](Scenario& s) {
         s.stations[1].times = {10.0, 9.0, 12.0}, s.stations[1].speed_m_s = s.stations[1].pause_s = 0;
       }},
      {"stations[1].root: there is one first root",
       [](Scenario& s) { s.stations[0].root = s.stations[1].root = true; }},
      {"stations[0].root: there is one first root", [](Scenario& s) { s.swarm.root = 0, s.stations[0].root = true; }},
      {"stations[1].course_m[1]: vehicle at (4, 3000) is", [](Scenario& s) { s.stations[1].course[1].y = 3000.0; }},
      {"stations[1].course_m[0]: vehicle at (4, 0) is nearer to an obstacle",
       [](Scenario& s) {
         s.obstacles = {Disc{{4.0, 0.1}, 0.2}};
       }},
      {"stations[1].course_m[0]: the way from (0.9, 0) to (4, 0) leads through obstacle 0",
       [](Scenario& s) {
         s.obstacles = {Disc{{2.0, 0.0}, 0.1}};
       }},
      {"stations[0].position_m: base at (0, -9) is not in contact with the start",
       [](Scenario& s) { s.stations[0].position.y = -9.0; }},
      {"mission.connect[0]: there is no station \"vehicl\"; did you mean \"vehicle\"?",
       [](Scenario& s) {
         s.mission.connect = {{"base", "vehicl"}};
       }},
      {"mission.connect[0]: there is no station \"3\"",
       [](Scenario& s) {
         s.mission.connect = {{"base", "3"}};
       }},
      {"mission.connect[1]: names \"base\" twice",
       [](Scenario& s) {
         s.mission.connect = {{"base", "vehicle"}, {"base", "base"}};
       }},
      {"mission.connect[0]: there is no station \"00\"",
       [](Scenario& s) {
         s.targets = std::vector<Vec2>{{1.0, 1.0}}, s.mission.connect = {{"base", "00"}};
       }},
      {"stations[1].position_m: vehicle at (0, -0.6) is 0 m from",
       [](Scenario& s) { s.stations[1].position = s.stations[0].position; }},
      {"events[0].robot: robot 9 is the station base",
       [](Scenario& s) {
         s.events = {{.time_s = 1.0, .action = Join{9, {1.0, 1.0}}}};
       }},
      {"swarm.robots: with the stations and the robots that join there are 65537",
       [](Scenario& s) { s.swarm.robots = 65535; }},
      {"events[0].robot: robot 10 is the station vehicle",
       [](Scenario& s) { s.events = {{.time_s = 1.0, .action = Freeze{10}}}; }},
      {"events[0].target: target 1 is where a station is",
       [](Scenario& s) {
         s.events = {{.time_s = 1.0, .action = MoveTarget{1, {1.0, 1.0}}}};
       }},
  };
  EXPECT_EQ(words(faults(between())), "");
  for (const Case& c : cases) {
    Scenario s = between();
    c.change(s);
    EXPECT_NE(words(faults(s)).find(c.words), std::string::npos) << c.words << "\nsaid:\n" << words(faults(s));
  }
}

}  // namespace
}  // namespace banyan::world
