// SPDX-License-Identifier: MIT
// Geometry that people write by accident: every number stays finite, and the run is the same on 1, 2 and 4 threads.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "banyan/world/faults.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

struct Degenerate {
  const char* what;
  std::function<void(Scenario&)> change;
};

const Degenerate kinds[] = {
    {"the same wall twice",
     [](Scenario& s) {
       s.obstacles = {Wall{{1.5, -1.0}, {1.5, 1.0}}, Wall{{1.5, -1.0}, {1.5, 1.0}}};
     }},
    {"a wall and its reverse",
     [](Scenario& s) {
       s.obstacles = {Wall{{1.5, -1.0}, {1.5, 1.0}}, Wall{{1.5, 1.0}, {1.5, -1.0}}};
     }},
    {"ends that touch",
     [](Scenario& s) {
       s.obstacles = {Wall{{1.5, -1.0}, {1.5, 0.5}}, Wall{{1.5, 0.5}, {2.5, 0.5}}};
     }},
    {"walls on one line that overlap",
     [](Scenario& s) {
       s.obstacles = {Wall{{1.5, -1.0}, {1.5, 0.5}}, Wall{{1.5, 0.0}, {1.5, 1.5}}};
     }},
    {"walls that cross",
     [](Scenario& s) {
       s.obstacles = {Wall{{1.2, -1.0}, {2.0, 1.0}}, Wall{{1.2, 1.0}, {2.0, -1.0}}};
     }},
    {"doubled walls two centimetres apart",
     [](Scenario& s) {
       s.obstacles = {Wall{{1.5, -1.0}, {1.5, 1.0}}, Wall{{1.52, -1.0}, {1.52, 1.0}}};
     }},
    {"a wall's end on a line of sight",
     [](Scenario& s) {
       s.swarm.start.layout = Layout::list;
       s.swarm.robots.reset();
       s.swarm.start.positions = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0.5, 1.5}, {-0.5, 0.5}, {-1, 0}, {0, -1}};
       s.obstacles = {Wall{{0.5, 0.0}, {0.5, -3.0}}};  // between robots 0 and 1
     }},
    {"two targets in one place",
     [](Scenario& s) {
       s.targets = std::vector<Vec2>{{3.0, 0.0}, {3.0, 0.0}, {0.0, 3.0}};
     }},
    {"a target on a wall's end",
     [](Scenario& s) {
       s.targets = std::vector<Vec2>{{3.0, 0.0}, {-2.0, 2.0}};
       s.obstacles = {Wall{{3.0, 0.05}, {3.0, 2.0}}};
     }},
    {"two robots in one place, later",
     [](Scenario& s) {
       s.robot.body = BodyModel::linear;  // they do not collide
       s.targets = std::vector<Vec2>{{3.0, 0.0}, {3.0, 0.0}};
     }},
    {"a target where a robot stands",
     [](Scenario& s) {
       s.targets = std::vector<Vec2>{{0.0, 0.0}, {3.0, 1.0}};
     }},
    {"a station where a target is",
     [](Scenario& s) {
       s.targets = std::vector<Vec2>{{0.0, -0.9}, {3.0, 1.0}};
       s.stations = {{.name = "base", .position = {0.0, -0.9}}};
     }},
};

TEST(Degenerate, IsFiniteAndTheSameOnAnyNumberOfThreads) {
  for (const Degenerate& kind : kinds)
    for (const bool sight : {false, true}) {
      Scenario s = ring("convoy", 14, 3, 3.0, 5);
      s.radio.line_of_sight = sight;
      kind.change(s);
      for (const Fault& fault : faults(s)) ASSERT_TRUE(fault.warning) << kind.what << ": " << fault.text;
      expect_the_same_on_any_number_of_threads(s, 400, kind.what);
    }
}

TEST(Degenerate, RobotsThatStartInOnePlaceAreRefusedAndSeparateWhenSomebodyPutsThemThere) {
  Scenario s = ring("convoy", 8, 2, 3.0, 1);
  s.swarm.robots.reset();
  s.swarm.start.layout = Layout::list;
  s.swarm.start.positions = {{0, 0}, {0, 0}, {0.5, 0}, {0, 0.5}, {0.5, 0.5}};
  bool refused = false;
  for (const Fault& fault : faults(s)) refused |= !fault.warning;
  EXPECT_TRUE(refused);
  s.swarm.start.positions[1] = {-0.5, 0.0};
  s.events = {{.time_s = 1.0, .action = Join{5, {0.25, 0.25}}}, {.time_s = 1.0, .action = Join{6, {0.25, 0.25}}}};
  World world(s);
  for (int t = 0; t < 60; ++t) world.step();
  for (const Vec2 p : world.positions()) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
  EXPECT_GT(distance(world.positions()[5], world.positions()[6]), 1.9 * s.robot.radius_m);
}

}  // namespace
}  // namespace banyan::world
