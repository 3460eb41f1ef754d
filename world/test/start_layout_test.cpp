// SPDX-License-Identifier: MIT
// The layouts of a start against what their names promise, by brute force over all pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "banyan/world/faults.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/placement.hpp"
#include "plain_scenario.hpp"

namespace banyan::world {
namespace {

Scenario laid_out(Layout layout, std::size_t robots) {
  Scenario scenario = plain_scenario();
  scenario.swarm.robots = robots;
  scenario.swarm.start.layout = layout;
  scenario.swarm.start.center = {3.0, -2.0};
  scenario.swarm.start.jitter_m = 0.0;
  scenario.targets = std::vector<Vec2>{{200.0, 200.0}};  // away from every obstacle of these tests
  return scenario;
}

double closest_pair(const std::vector<Vec2>& p) {
  double least = 1e9;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, distance(p[i], p[j]));
  return least;
}

// How many robots each has nearer than `range`.
std::vector<std::size_t> degrees(const std::vector<Vec2>& p, double range) {
  std::vector<std::size_t> degree(p.size(), 0);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < p.size(); ++j) degree[i] += i != j && distance(p[i], p[j]) < range;
  return degree;
}

// Size of the part that the first robot belongs to; `linked` decides pair by pair.
template <class Linked> std::size_t reached(const std::vector<Vec2>& p, const Linked& linked) {
  std::vector<std::size_t> found{0};
  std::vector<bool> seen(p.size(), false);
  seen[0] = true;
  for (std::size_t k = 0; k < found.size(); ++k)
    for (std::size_t j = 0; j < p.size(); ++j)
      if (!seen[j] && linked(p[found[k]], p[j])) {
        seen[j] = true;
        found.push_back(j);
      }
  return found.size();
}
bool connected_within(const std::vector<Vec2>& p, double range) {
  return reached(p, [range](Vec2 a, Vec2 b) { return distance(a, b) < range; }) == p.size();
}

std::string first_error(const Scenario& scenario) {
  for (const Fault& fault : faults(scenario))
    if (!fault.warning) return fault.key + ": " + fault.text;
  return {};
}

TEST(StartLayout, ALineIsALineOfNeighboursApartByThePitch) {
  const std::vector<Vec2> p = place(laid_out(Layout::line, 21)).position;
  ASSERT_EQ(p.size(), 21U);
  std::vector<double> x;
  for (const Vec2 q : p) {
    EXPECT_EQ(q.y, -2.0);
    x.push_back(q.x);
  }
  EXPECT_EQ(p.front().x, 3.0) << "robot 0 is in the middle";
  std::sort(x.begin(), x.end());
  for (std::size_t i = 1; i < x.size(); ++i) EXPECT_NEAR(x[i] - x[i - 1], 0.32, 1e-12);
  EXPECT_NEAR(x.front() + x.back(), 6.0, 1e-9);
}

TEST(StartLayout, ARingClosesAndHasNoChords) {
  Scenario scenario = laid_out(Layout::ring, 17);
  scenario.swarm.start.pitch_share = 0.9;
  const std::vector<Vec2> p = place(scenario).position;
  EXPECT_NEAR(closest_pair(p), 1.8, 1e-9);
  for (const std::size_t degree : degrees(p, 2.0)) EXPECT_EQ(degree, 2U);
  EXPECT_TRUE(connected_within(p, 1.8 + 1e-9));
}

TEST(StartLayout, ACrossHasFourArms) {
  Scenario scenario = laid_out(Layout::cross, 21);
  scenario.swarm.start.pitch_share = 0.9;
  const std::vector<Vec2> p = place(scenario).position;
  std::vector<std::size_t> degree = degrees(p, 2.0);
  EXPECT_EQ(degree[0], 4U) << "the centre";
  EXPECT_EQ(std::count(degree.begin(), degree.end(), 1U), 4) << "the ends";
  EXPECT_EQ(std::count(degree.begin(), degree.end(), 2U), 16);
  EXPECT_TRUE(connected_within(p, 1.8 + 1e-9));
  for (const Vec2 q : p) EXPECT_LE(distance(q, {3.0, -2.0}), 5 * 1.8 + 1e-9) << "arms of five";
}

TEST(StartLayout, ABridgeIsTheOnlyWayBetweenItsClusters) {
  for (const std::size_t robots : {5U, 20U, 61U, 200U}) {
    const std::vector<Vec2> p = place(laid_out(Layout::bridge, robots)).position;
    ASSERT_EQ(p.size(), robots);
    EXPECT_GE(closest_pair(p), 0.32 - 1e-9) << robots;
    EXPECT_TRUE(connected_within(p, 1.8 + 1e-9)) << robots;
    EXPECT_EQ(p.front(), (Vec2{3.0, -2.0})) << "the middle of three";
    std::vector<Vec2> without(p.begin() + 1, p.end());
    const std::size_t side = reached(without, [](Vec2 a, Vec2 b) { return distance(a, b) < 2.0; });
    EXPECT_LE(side, (robots + 1) / 2) << "without its middle the bridge is broken";
    EXPECT_GE(side, robots / 2 - 1);
  }
}

// Also where the cluster on the right is smaller by the robot at the end of the row that the bridge continues.
TEST(StartLayout, ABridgeOfAnySizeIsConnected) {
  for (std::size_t robots = 3; robots <= 120; ++robots)
    for (std::size_t between = 1; between <= std::min<std::size_t>(6, robots - 2); ++between) {
      Scenario scenario = laid_out(Layout::bridge, robots);
      scenario.swarm.start.bridge_robots = between;
      EXPECT_TRUE(connected_within(place(scenario).position, 1.8 + 1e-9)) << robots << " " << between;
    }
}

TEST(StartLayout, ABridgeOfOneKeepsItsClustersApart) {
  Scenario scenario = laid_out(Layout::bridge, 40);
  scenario.swarm.start.bridge_robots = 1;
  for (double pitch_m = 0.3; pitch_m < 1.8; pitch_m += 0.3) {
    scenario.swarm.start.pitch_m = pitch_m;
    scenario.swarm.start.link_share = pitch_m / 2.0;
    const std::vector<Vec2> p = place(scenario).position;
    EXPECT_GE(closest_pair(p), pitch_m - 1e-9);
    EXPECT_TRUE(connected_within(p, pitch_m + 1e-9));
  }
}

TEST(StartLayout, ARandomStartIsConnectedOverShortLinks) {
  for (const double share : {0.5, 0.75, 0.95})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Scenario scenario = laid_out(Layout::random, 10 * seed);
      scenario.seed = seed;
      scenario.swarm.start.link_share = share;
      const std::vector<Vec2> p = place(scenario).position;
      ASSERT_EQ(p.size(), 10 * seed);
      EXPECT_GE(closest_pair(p), 0.32);
      EXPECT_TRUE(connected_within(p, share * 2.0 + 1e-12)) << share << " " << seed;
      EXPECT_EQ(first_error(scenario), "");
    }
}

TEST(StartLayout, RandomStartsDifferBySeedAndSpreadInAllDirections) {
  Scenario scenario = laid_out(Layout::random, 300);
  const std::vector<Vec2> p = place(scenario).position;
  EXPECT_EQ(p, place(scenario).position);
  scenario.seed = 2;
  EXPECT_NE(p, place(scenario).position);
  Vec2 sum{};
  for (scenario.seed = 1; scenario.seed <= 100; ++scenario.seed)
    sum += place(scenario).position[1] - scenario.swarm.start.center;
  EXPECT_LT(norm(sum), 40.0);  // steps of about 1.2 m: 12 m is one sigma; all alike would give 120 m
}

TEST(StartLayout, ALooseRandomStartIsATree) {
  Scenario scenario = laid_out(Layout::random, 60);
  scenario.swarm.start.pitch_share = 0.9;
  scenario.swarm.start.link_share = 0.95;
  const std::vector<Vec2> p = place(scenario).position;
  ASSERT_EQ(p.size(), 60U);
  EXPECT_GE(closest_pair(p), 1.8);
  EXPECT_TRUE(connected_within(p, 1.9 + 1e-12));
}

TEST(StartLayout, GrowsAroundObstaclesAndNeverThroughOne) {
  for (const Layout layout : {Layout::random, Layout::line, Layout::cross}) {
    Scenario scenario = laid_out(layout, 40);
    scenario.obstacles = {Wall{{4.0, -30.0}, {4.0, 30.0}}};
    const std::vector<Vec2> p = place(scenario).position;
    ASSERT_EQ(p.size(), 40U);
    for (const Vec2 q : p) EXPECT_LE(q.x, 4.0 - scenario.robot.radius_m + 1e-12);
    EXPECT_EQ(first_error(scenario), "");
  }
}

TEST(StartLayout, PitchAsAShareFollowsTheRange) {
  Scenario scenario = laid_out(Layout::hexagonal, 50);
  scenario.swarm.start.pitch_share = 0.93;
  scenario.radio.range_m = 3.0;
  EXPECT_DOUBLE_EQ(start_pitch_m(scenario), 2.79);
  EXPECT_NEAR(closest_pair(place(scenario).position), 2.79, 1e-9);
}

TEST(StartLayout, WhatDoesNotFitOrHoldTogetherIsRefused) {
  struct Case {
    const char* error;
    Layout layout;
    void (*change)(Scenario&);
  };
  const Case cases[] = {
      {"swarm.start.pitch_share: the start would not be connected", Layout::ring,
       [](Scenario& s) { s.swarm.start.pitch_share = 0.999, s.swarm.start.jitter_m = 0.01; }},
      {"swarm.start.pitch_share: robots do not fit", Layout::line,
       [](Scenario& s) { s.swarm.start.pitch_share = 0.07; }},
      {"swarm.start.link_share: the start would not be connected", Layout::bridge,
       [](Scenario& s) { s.swarm.start.link_share = 1.0; }},
      {"swarm.start.link_share: the start would not be connected", Layout::random,
       [](Scenario& s) { s.swarm.start.link_share = 1.0; }},
      {"swarm.start.link_share: link_share * range_m = 0.2 m must be at least", Layout::random,
       [](Scenario& s) { s.swarm.start.link_share = 0.1; }},
      {"swarm.start.bridge_robots: is 19 of 20 robots; at least one must be left", Layout::bridge,
       [](Scenario& s) { s.swarm.start.bridge_robots = 19; }},
      {"swarm.start: only 19 of 20 robots fit", Layout::ring,
       [](Scenario& s) {
         s.obstacles = {Disc{place(s).position[3], 0.1}};
       }},
      {"swarm.start: only 19 of 20 robots fit", Layout::bridge,
       [](Scenario& s) {
         s.obstacles = {Disc{place(s).position[0], 0.1}};
       }},
      {"swarm.start: the start is not connected: obstacles cut it into 2 groups", Layout::bridge,
       [](Scenario& s) {
         s.obstacles = {Wall{{3.5, -10.0}, {3.5, 10.0}}};
       }},
      {"swarm.start: only 3 of 20 robots fit", Layout::line,
       [](Scenario& s) {
         s.obstacles = {Wall{{2.5, -3.0}, {2.5, 0.0}}, Wall{{3.5, -3.0}, {3.5, 0.0}}};
       }},
      {"swarm.start.center_m: there is no room", Layout::random,
       [](Scenario& s) {
         s.obstacles = {Disc{{3.0, -2.0}, 0.1}};
       }},
      {"swarm.start: reaches to", Layout::line,
       [](Scenario& s) { s.swarm.robots = 20000, s.swarm.start.pitch_share = 0.9; }},
  };
  for (const Case& c : cases) {
    Scenario scenario = laid_out(c.layout, 20);
    EXPECT_EQ(first_error(scenario), "");
    c.change(scenario);
    EXPECT_TRUE(first_error(scenario).starts_with(c.error)) << c.error << "\n" << first_error(scenario);
  }
}

}  // namespace
}  // namespace banyan::world
