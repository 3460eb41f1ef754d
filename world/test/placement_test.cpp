// SPDX-License-Identifier: MIT
#include "banyan/world/placement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "banyan/world/obstacles.hpp"
#include "banyan/world/world.hpp"
#include "plain_scenario.hpp"

namespace banyan::world {
namespace {

Scenario with_robots(std::size_t n) {
  Scenario scenario;
  scenario.swarm.robots = n;
  return scenario;
}

double least_distance(const std::vector<Vec2>& p) {
  double least = 1e9;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, distance(p[i], p[j]));
  return least;
}

// Size of the connected part that robot 0 belongs to, by plain search.
std::size_t connected(const std::vector<Vec2>& p, double range) {
  std::vector<std::size_t> found{0};
  std::set<std::size_t> seen{0};
  for (std::size_t k = 0; k < found.size(); ++k)
    for (std::size_t j = 0; j < p.size(); ++j)
      if (distance(p[found[k]], p[j]) < range && seen.insert(j).second) found.push_back(j);
  return found.size();
}

class Layouts : public testing::TestWithParam<Layout> {};
INSTANTIATE_TEST_SUITE_P(Placement, Layouts, testing::Values(Layout::hexagonal, Layout::grid));

TEST_P(Layouts, ClusterIsConnectedAndNobodyOverlaps) {
  for (const std::size_t n : {1U, 2U, 9U, 94U, 500U}) {
    Scenario scenario = with_robots(n);
    scenario.swarm.start.layout = GetParam();
    scenario.swarm.start.center = {3.0, -2.0};
    const Poses poses = place(scenario);
    ASSERT_EQ(poses.position.size(), n);
    ASSERT_EQ(poses.heading.size(), n);
    EXPECT_GE(least_distance(poses.position), 0.32 - 2 * 0.02 - 1e-12);
    EXPECT_EQ(connected(poses.position, 0.32 + 2 * 0.02 + 1e-9), n);
  }
}

TEST_P(Layouts, WithoutJitterTheClusterIsTheNearestLatticePoints) {
  Scenario scenario = with_robots(200);
  scenario.swarm.start.layout = GetParam();
  scenario.swarm.start.jitter_m = 0.0;
  const Poses poses = place(scenario);
  // Brute force: all lattice points of a large patch, by distance.
  std::vector<double> all;
  for (int r = -30; r <= 30; ++r)
    for (int c = -60; c <= 60; ++c)
      all.push_back(0.32 * (GetParam() == Layout::hexagonal ? norm(Vec2{c + 0.5 * r, std::sqrt(0.75) * r})
                                                            : norm(Vec2{double(c), double(r)})));
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i < 200; ++i) EXPECT_NEAR(norm(poses.position[i]), all[i], 1e-9) << i;
}

TEST(Placement, IsAFunctionOfTheSeed) {
  Scenario scenario = with_robots(50);
  const Poses a = place(scenario);
  const Poses b = place(scenario);
  scenario.seed = 2;
  const Poses c = place(scenario);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.heading, b.heading);
  EXPECT_NE(a.position, c.position);
  EXPECT_NE(a.heading, c.heading);
}

TEST(Placement, HeadingsAreUnitVectorsInAllDirections) {
  const Poses poses = place(with_robots(2000));
  Vec2 sum{};
  for (const Vec2 h : poses.heading) {
    EXPECT_NEAR(norm(h), 1.0, 1e-9);
    sum += h;
  }
  EXPECT_LT(norm(sum), 200.0);  // 4.5 sigma; all alike would give 2000
}

TEST(Placement, JitterFillsItsDiscEvenly) {
  Scenario exact = with_robots(4000);
  exact.swarm.start.jitter_m = 0.0;
  const Poses lattice = place(exact);
  const Poses jittered = place(with_robots(4000));
  int inner = 0;
  for (std::size_t i = 0; i < 4000; ++i) {
    const double r = distance(lattice.position[i], jittered.position[i]);
    ASSERT_LE(r, 0.02 + 1e-12);
    inner += r < 0.01;
  }
  EXPECT_NEAR(inner, 1000, 140);  // a quarter of the area
}

TEST(Placement, ListIsTakenAsGiven) {
  Scenario scenario;
  scenario.swarm.start.layout = Layout::list;
  scenario.swarm.start.positions = {{0, 0}, {0.5, 0}, {0.5, 0.5}};
  scenario.swarm.start.headings_rad = {0.0, 1.0, -2.0};
  const Poses poses = place(scenario);
  EXPECT_EQ(poses.position, scenario.swarm.start.positions);
  EXPECT_NEAR(poses.heading[1].x, std::cos(1.0), 1e-9);
  EXPECT_NEAR(poses.heading[2].y, std::sin(-2.0), 1e-9);
  scenario.swarm.start.headings_rad.clear();
  EXPECT_NEAR(norm(place(scenario).heading[2]), 1.0, 1e-9);
}

TEST(Placement, KeepsClearOfObstaclesAndStaysInACorridor) {
  Scenario scenario = with_robots(60);
  scenario.obstacles = {Wall{{-50, 0.5}, {50, 0.5}}, Wall{{-50, -0.5}, {50, -0.5}}, Disc{{1.0, 0.0}, 0.2}};
  const Poses poses = place(scenario);
  ASSERT_EQ(poses.position.size(), 60U);
  for (const Vec2 p : poses.position) {
    EXPECT_LT(std::abs(p.y), 0.5) << "behind a wall";
    for (const Obstacle& o : scenario.obstacles) EXPECT_GE(clearance(o, p), scenario.robot.radius_m - 1e-12);
  }
  EXPECT_EQ(connected(poses.position, scenario.radio.range_m), 60U);
}

TEST(Placement, ARoomHoldsOnlySoMany) {
  Scenario scenario = with_robots(60);
  scenario.obstacles = {Wall{{-1, -1}, {1, -1}}, Wall{{1, -1}, {1, 1}}, Wall{{1, 1}, {-1, 1}}, Wall{{-1, 1}, {-1, -1}}};
  const std::size_t placed = place(scenario).position.size();
  EXPECT_GT(placed, 20U);
  EXPECT_LT(placed, 60U);
}

TEST(Placement, TenThousandRobotsTakeMilliseconds) {
  const Scenario scenario = with_robots(10000);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(place(scenario).position.size(), 10000U);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_LT(took.count(), 0.5);  // 5 ms in release mode; room for sanitizers
}

TEST(Assignment, WorkersAreTheNearestAndDistinct) {
  const Scenario scenario = with_robots(50);
  const Poses poses = place(scenario);
  const std::vector<Vec2> targets{{3, 0}, {3, 0}, {0, -3}};
  const Assignment assignment = assign(scenario, poses, targets);
  ASSERT_EQ(assignment.worker.size(), 3U);
  std::vector<std::size_t> order(50);
  for (std::size_t i = 0; i < 50; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](auto a, auto b) {
    return distance(poses.position[a], targets[0]) < distance(poses.position[b], targets[0]);
  });
  EXPECT_EQ(assignment.worker[0], order[0]);
  EXPECT_EQ(assignment.worker[1], order[1]) << "the second target at the same place gets the second nearest";
}

TEST(Assignment, RootIsAnyRobotButAWorker) {
  Scenario scenario = with_robots(12);
  std::set<std::size_t> roots;
  for (scenario.seed = 1; scenario.seed <= 400; ++scenario.seed) {
    const Poses poses = place(scenario);
    const Assignment a = assign(scenario, poses, {{3, 0}, {-3, 0}});
    EXPECT_EQ(std::count(a.worker.begin(), a.worker.end(), a.root), 0);
    roots.insert(a.root);
  }
  EXPECT_GE(roots.size(), 10U);
}

TEST(Assignment, AGivenRootIsKeptAndIsNoWorker) {
  Scenario scenario = with_robots(12);
  const Poses poses = place(scenario);
  const std::size_t nearest = assign(scenario, poses, {{3, 0}}).worker[0];
  scenario.swarm.root = nearest;
  const Assignment assignment = assign(scenario, poses, {{3, 0}});
  EXPECT_EQ(assignment.root, nearest);
  EXPECT_NE(assignment.worker[0], nearest);
}

TEST(Assignment, TheLastRobotIsTheRoot) {
  const Scenario scenario = with_robots(3);
  const Assignment a = assign(scenario, place(scenario), {{3, 0}, {-3, 0}});
  EXPECT_EQ(a.worker[0] + a.worker[1] + a.root, 0U + 1U + 2U);
}

TEST(FreePlace, IsBesideALivingRobotAndClearOfAllOthersAndOfObstacles) {
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    Scenario s = plain_scenario();
    s.seed = seed;
    s.swarm.robots = 20;
    s.swarm.room = 12;
    s.radio.line_of_sight = true;
    s.targets = RingTargets{3, 4.0};
    s.obstacles = {Disc{{1.2, 0.0}, 0.4}, Wall{{-1.5, -1.0}, {1.5, -1.0}}};
    s.events = {{.time_s = 0.5, .action = Die{2}}};
    World world(s);
    world.step();
    for (std::size_t robot = 20; robot < 32; ++robot) {
      const auto place = free_place(world);
      ASSERT_TRUE(place);
      double nearest_m = 1e9;
      for (std::size_t i = 0; i < world.arrived(); ++i)
        nearest_m = std::min(nearest_m, distance(world.positions()[i], *place));
      EXPECT_GT(nearest_m, 0.9 * start_pitch_m(s));
      EXPECT_GT(clearance(world.obstacles(), *place), s.robot.radius_m);
      world.intervene({.action = Join{robot, *place}});
      world.step();
      EXPECT_FALSE(world.links(robot).empty()) << "seed " << seed;
    }
    EXPECT_EQ(world.arrived(), 32U);
  }
}

TEST(FreePlace, IsNowhereIfNobodyLives) {
  Scenario s = plain_scenario();
  s.swarm.robots = 5;
  s.events = {{.time_s = 0.0, .action = Kill{.count = 5}}};
  World world(s);
  world.step();
  EXPECT_FALSE(free_place(world));
}

}  // namespace
}  // namespace banyan::world
