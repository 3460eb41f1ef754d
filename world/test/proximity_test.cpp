// SPDX-License-Identifier: MIT
// What the proximity sensor sees, against brute force; and bodies of the dead that stay or vanish.
#include "../src/proximity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "banyan/world/bodies.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/radio.hpp"
#include "banyan/world/random.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

double draw(std::uint64_t seed, std::uint64_t k, double low, double high) {
  return low + (high - low) * to_uniform(bits(seed, Purpose::placement, k));
}

// Points all along the outline, a millimetre apart.
std::vector<Vec2> outline(const Obstacle& obstacle) {
  std::vector<Vec2> points;
  const auto line = [&](Vec2 a, Vec2 b) {
    const auto n = static_cast<int>(distance(a, b) / 0.001) + 1;
    for (int k = 0; k <= n; ++k) points.push_back(a + (b - a) * (static_cast<double>(k) / n));
  };
  if (const auto* disc = std::get_if<Disc>(&obstacle))
    for (int k = 0; k < 10000; ++k)
      points.push_back(disc->center + unit_vector(2.0 * pi<double> * k / 10000) * disc->radius_m);
  if (const auto* wall = std::get_if<Wall>(&obstacle)) line(wall->from, wall->to);
  if (const auto* box = std::get_if<Box>(&obstacle)) {
    const Vec2 x = unit_vector(box->angle_rad) * (0.5 * box->size.x);
    const Vec2 y = rotate(unit_vector(box->angle_rad), Vec2{0.0, 0.5 * box->size.y});
    const Vec2 c = box->center;
    line(c - x - y, c + x - y);
    line(c + x - y, c + x + y);
    line(c + x + y, c - x + y);
    line(c - x + y, c - x - y);
  }
  return points;
}

TEST(Surface, NearestPointIsThatOfTheOutlineFromInsideAndOutside) {
  const std::vector<Obstacle> shapes{Disc{{0.2, -0.1}, 0.7}, Box{{-0.1, 0.3}, {1.2, 0.6}, 0.5},
                                     Wall{{-0.5, -0.4}, {0.6, 0.1}}};
  for (const Obstacle& shape : shapes) {
    const auto points = outline(shape);
    for (std::uint64_t k = 0; k < 60; ++k) {
      const Vec2 p{draw(1, 2 * k, -1.5, 1.5), draw(1, 2 * k + 1, -1.5, 1.5)};
      double least = 1e9;
      for (const Vec2 q : points) least = std::min(least, distance(p, q));
      const Vec2 found = nearest_surface_point(shape, p);
      EXPECT_NEAR(distance(p, found), least, 2e-3);
      double off = 1e9;
      for (const Vec2 q : points) off = std::min(off, distance(found, q));
      EXPECT_LT(off, 1e-3) << "it lies on the outline";
    }
  }
}

TEST(ProximitySensor, SeesTheNearestEightWithinReachInOrder) {
  Scenario s = plain_scenario();
  s.robot.proximity_m = 0.5;
  for (std::uint64_t k = 0; k < 60; ++k)
    s.obstacles.push_back(Disc{{draw(2, 2 * k, -1, 1), draw(2, 2 * k + 1, -1, 1)}, 0.05});
  Poses poses;
  std::vector<std::uint8_t> alive;
  std::size_t dead = 0;
  for (std::uint64_t k = 0; k < 80; ++k) {
    poses.position.push_back({draw(3, 3 * k, -1, 1), draw(3, 3 * k + 1, -1, 1)});
    poses.heading.push_back(unit_vector(draw(3, 3 * k + 2, 0, 6)));
    alive.push_back(k % 3 == 0 ? 0 : 1);
    dead += k % 3 == 0 ? 1 : 0;
  }
  Proximity sensor(s);
  sensor.update(poses.position, alive, dead);
  std::size_t most = 0;
  for (std::size_t i = 0; i < alive.size(); ++i) {
    if (alive[i] == 0) continue;
    std::vector<double> expected;
    for (const Obstacle& o : s.obstacles) expected.push_back(std::abs(clearance(o, poses.position[i])));
    for (std::size_t j = 0; j < alive.size(); ++j)
      if (alive[j] == 0)
        expected.push_back(std::abs(distance(poses.position[i], poses.position[j]) - s.robot.radius_m));
    std::sort(expected.begin(), expected.end());
    const auto within =
        static_cast<std::size_t>(std::count_if(expected.begin(), expected.end(), [](double d) { return d <= 0.5; }));
    Proximity::Seen seen;
    const std::size_t size = sensor.sense(poses, i, seen);
    ASSERT_EQ(size, std::min<std::size_t>(8, within)) << i;
    for (std::size_t k = 0; k < size; ++k) EXPECT_NEAR(static_cast<double>(norm(seen[k])), expected[k], 1e-6);
    most = std::max(most, within);
  }
  EXPECT_GT(most, 8U);
}

TEST(ProximitySensor, VectorsAreInTheBodyFrameAndReachIsFromTheCentre) {
  Scenario s = plain_scenario();
  s.obstacles = {Wall{{-5.0, 0.25}, {5.0, 0.25}}, Wall{{0.35, -5.0}, {0.35, 5.0}}};
  Poses poses{{{0.0, 0.0}}, {unit_vector(pi<double> / 2)}};
  Proximity::Seen seen;
  ASSERT_EQ(Proximity(s).sense(poses, 0, seen), 1U) << "the other is 0.35 m away, reach is 0.30 m";
  EXPECT_NEAR(seen[0].x, 0.25F, 1e-6F);
  EXPECT_NEAR(seen[0].y, 0.0F, 1e-6F);
  s.robot.proximity_m = 0.0;
  EXPECT_EQ(Proximity(s).sense(poses, 0, seen), 0U);
}

// ---- Bodies of the dead ----

Scenario row(bool dead_bodies, BodyModel body) {
  Scenario s = plain_scenario();
  s.swarm.start.layout = Layout::list;
  s.swarm.start.positions = {{0, 0}, {0.4, 0}, {0.8, 0}};
  s.swarm.start.headings_rad = {0, 0, 0};
  s.swarm.root = 1;
  s.targets = std::vector<Vec2>{{5, 0}, {-5, 0}};
  s.radio.line_of_sight = true;
  s.robot.dead_bodies = dead_bodies;
  s.robot.body = body;
  s.events = {{.action = Die{1}}};
  return s;
}

TEST(DeadBodies, BlockSightOnlyIfTheyStay) {
  for (const bool stay : {true, false}) {
    World world(row(stay, BodyModel::disks));
    EXPECT_EQ(world.blocked().size(), 1U);
    world.step();
    EXPECT_EQ(world.links(0).size(), stay ? 0U : 1U);
    EXPECT_EQ(world.blocked().size(), stay ? 1U : 0U);
  }
}

TEST(DeadBodies, AreSeenOnlyIfTheyStay) {
  for (const bool stay : {true, false}) {
    Scenario s = row(stay, BodyModel::disks);
    Proximity sensor(s);
    const Poses poses{{{0, 0}, {0.3, 0}}, {{1, 0}, {1, 0}}};
    sensor.update(poses.position, std::vector<std::uint8_t>{1, 0}, 1);
    Proximity::Seen seen;
    ASSERT_EQ(sensor.sense(poses, 0, seen), stay ? 1U : 0U);
    if (!stay) continue;
    EXPECT_NEAR(static_cast<double>(seen[0].x), 0.3 - s.robot.radius_m, 1e-6);
  }
}

TEST(DeadBodies, AreInTheWayOnlyIfTheyStay) {
  for (const BodyModel body : {BodyModel::disks, BodyModel::box2d}) {
    if (body == BodyModel::box2d && !has_box2d()) continue;
    for (const bool stay : {true, false}) {
      const Scenario s = row(stay, body);
      const Poses start{{{0, 0}, {0.15, 0}}, {{1, 0}, {1, 0}}};
      Poses poses = start;
      const auto bodies = body == BodyModel::disks ? make_disks(s, 2) : make_box2d(s, poses);
      Radio radio(s, 2);
      Executor alone(1);
      std::vector<std::uint8_t> alive{1, 1};
      radio.update(poses.position, alive, {}, alone);
      alive[1] = 0;
      if (!stay) bodies->remove(1);
      if (!stay) radio.forget(1);
      const std::vector<Velocity> command{{0.2F, 0.0F, 0.0F}, {}};
      std::vector<Odometry> odometry(2);
      for (std::uint64_t t = 0; t < 10; ++t) {
        bodies->step(command, radio.near(), t, poses, odometry);
        radio.update(poses.position, alive, {}, alone);
      }
      EXPECT_EQ(poses.position[1] == start.position[1], !stay) << stay;
      EXPECT_EQ(distance(poses.position[0], poses.position[1]) < 2 * s.robot.radius_m - 0.01, !stay);
    }
  }
}

}  // namespace
}  // namespace banyan::world
