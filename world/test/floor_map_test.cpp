// SPDX-License-Identifier: MIT
// Maps in a world: the same links as among boxes that cover the same cells, bodies that stay out, what proximity sees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "../src/proximity.hpp"
#include "banyan/world/faults.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/placement.hpp"
#include "banyan/world/radio.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

constexpr const char* rooms_text =
    "41#\n"
    "6*#19.#19.#\n"
    "5*#39.#\n"
    "9*#19.#19.#\n"
    "14#6.21#\n"
    "9*#19.#19.#\n"
    "#19.21#\n"
    "9*#19.#19.#\n"
    "41#";

FloorMap rooms(double cell_m = 0.125, Vec2 origin = {-1.0, -0.5}, double angle_rad = 0.0) {
  FloorMap map;
  map.cell_m = cell_m;
  map.origin = origin;
  map.angle_rad = angle_rad;
  map.cells = std::make_shared<const CellGrid>(CellGrid::from_text(rooms_text));
  return map;
}

// The same area as boxes, slightly larger so that nothing passes between two of them.
std::vector<Obstacle> as_boxes(const FloorMap& map) {
  const CellFrame frame(map);
  std::vector<Obstacle> boxes;
  map.cells->each_block([&](Vec2 low, Vec2 high) {
    boxes.emplace_back(Box{frame.in_metres(0.5 * (low + high)), (high - low) * map.cell_m, map.angle_rad});
  });
  return boxes;
}

double draw(std::uint64_t robot, std::uint64_t tick, std::uint64_t k) {
  return to_uniform(bits(31, Purpose::loss, robot, tick, k));
}

// Robots that go their ways through walls and all, so that every kind of line of sight comes and goes.
TEST(FloorMap, HidesFromTheRadioWhatTheSameBoxesHide) {
  for (const double angle_rad : {0.0, 0.7}) {
    const FloorMap map = rooms(0.125, {-1.0, -0.5}, angle_rad);
    constexpr std::size_t robots = 60;
    Scenario s = plain_scenario();
    s.radio.line_of_sight = true;
    s.obstacles = {map};
    Scenario boxed = s;
    boxed.obstacles = as_boxes(map);
    Radio radio(s, robots), expected(boxed, robots);
    const Disc floor = enclosing(map);
    std::vector<Vec2> positions;
    for (std::size_t i = 0; i < robots; ++i)
      positions.push_back(floor.center + 3.0 * Vec2{2.0 * draw(i, 0, 1) - 1.0, 2.0 * draw(i, 0, 2) - 1.0});
    const std::vector<std::uint8_t> alive(robots, 1);
    Executor alone(1);
    std::size_t blocked = 0, linked = 0;
    for (std::uint64_t tick = 0; tick < 400; ++tick) {
      radio.update(positions, alive, {}, alone);
      expected.update(positions, alive, {}, alone);
      const auto found = radio.blocked(), wanted = expected.blocked();
      std::vector<std::pair<std::uint32_t, std::uint32_t>> odd;
      std::set_symmetric_difference(found.begin(), found.end(), wanted.begin(), wanted.end(), std::back_inserter(odd));
      for (const auto& [i, j] : odd)
        ADD_FAILURE() << "tick " << tick << " at angle " << angle_rad << ": (" << positions[i].x << ", "
                      << positions[i].y << ") to (" << positions[j].x << ", " << positions[j].y
                      << "): " << (blocks(map, positions[i], positions[j]) ? "map " : "")
                      << (std::any_of(
                              boxed.obstacles.begin(), boxed.obstacles.end(),
                              [&, a = positions[i], b = positions[j]](const Obstacle& o) { return blocks(o, a, b); })
                              ? "boxes "
                              : "")
                      << "block it";
      ASSERT_TRUE(odd.empty());
      blocked += radio.blocked().size();
      for (std::size_t i = 0; i < robots; ++i) linked += radio.links(i).size();
      for (std::size_t i = 0; i < robots; ++i)
        positions[i] += 0.02 * unit_vector(2.0 * pi<double> * draw(i, tick / 40, 3));
    }
    EXPECT_GT(blocked, 20000U);
    EXPECT_GT(linked, 20000U);
  }
}

TEST(FloorMap, IsAsFarAwayAsTheSameBoxes) {
  const FloorMap map = rooms(0.1, {0.3, -0.2}, -1.1);
  const std::vector<Obstacle> boxes = as_boxes(map);
  for (std::uint64_t k = 0; k < 3000; ++k) {
    const Vec2 p = enclosing(map).center + 4.0 * Vec2{2.0 * draw(k, 1, 1) - 1.0, 2.0 * draw(k, 1, 2) - 1.0};
    const double expected = clearance(boxes, p);
    if (expected >= 0.0) {
      ASSERT_NEAR(clearance(map, p), expected, 1e-9);
      ASSERT_NEAR(distance(nearest_surface_point(map, p), p), expected, 1e-9);
    } else {
      ASSERT_LT(clearance(map, p), 1e-9);
    }
    ASSERT_LE(distance(enclosing(map).center, nearest_surface_point(map, p)), enclosing(map).radius_m + 1e-9);
  }
  const Obstacle there = moved(map, {5.0, 6.0});
  EXPECT_NEAR(center_of(there).x, 5.0, 1e-12);
  EXPECT_NEAR(center_of(there).y, 6.0, 1e-12);
}

// Whichever the body, wheels at full speed in changing directions get it into no wall.
TEST(FloorMap, KeepsBodiesOut) {
  for (const BodyModel body : {BodyModel::disks, BodyModel::box2d, BodyModel::linear}) {
    if (body == BodyModel::box2d && !has_box2d()) continue;
    Scenario s = plain_scenario();
    s.robot.body = body;
    s.obstacles = {rooms()};
    s.swarm.robots = 8;
    s.swarm.start.center = {0.2, 0.7};
    Poses poses = place(s);
    ASSERT_EQ(poses.position.size(), 8U);
    const auto bodies = body == BodyModel::disks    ? make_disks(s, 8)
                        : body == BodyModel::linear ? make_linear(s, 8)
                                                    : make_box2d(s, poses);
    std::vector<Velocity> command(8);
    std::vector<Odometry> odometry(8);
    double deepest_m = 0.0;
    std::size_t touches = 0;
    for (std::uint64_t tick = 0; tick < 3000; ++tick) {
      for (std::size_t i = 0; i < 8; ++i)
        command[i] = {0.2F, 0.0F,
                      static_cast<float>(draw(i, tick / 50, 4) < 0.3 ? 2.0 * draw(i, tick / 50, 5) - 1.0 : 0.0)};
      bodies->step(command, {}, tick, poses, odometry);
      for (const Vec2 p : poses.position) {
        const double depth_m = s.robot.radius_m - clearance(s.obstacles[0], p);
        deepest_m = std::max(deepest_m, depth_m);
        touches += depth_m > -0.002 ? 1 : 0;
      }
    }
    EXPECT_LT(deepest_m, body == BodyModel::box2d ? 0.003 : 1e-6) << static_cast<int>(body);
    EXPECT_GT(touches, 1000U) << "they were at walls";
    for (const Vec2 p : poses.position) EXPECT_LT(distance(p, enclosing(s.obstacles[0]).center), 4.0) << "still inside";
  }
}

TEST(FloorMap, IsSeenByProximityOnAllSides) {
  Scenario s = plain_scenario();
  s.robot.proximity_m = 0.7;
  s.obstacles = {rooms()};
  const Proximity proximity(s);
  Proximity::Seen seen;
  int in_corners = 0;
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const Vec2 p = Vec2{-0.8, -0.3} + 4.7 * Vec2{draw(k, 2, 1), draw(k, 2, 2)};
    if (clearance(s.obstacles[0], p) <= 0.0) continue;
    const Poses poses = one_robot(p, 6.0 * draw(k, 2, 3));
    const std::size_t count = proximity.sense(poses, 0, seen);
    // Of each cell within reach some point is seen that is no farther, and not more than an eighth of a turn aside.
    each_near(std::get<FloorMap>(s.obstacles[0]), p, 0.699, [&](Vec2 point) {
      const Vec2 d = rotate_back(poses.heading[0], point - p);
      const bool covered =
          std::any_of(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count), [&](const auto& o) {
            const Vec2 q{static_cast<double>(o.x), static_cast<double>(o.y)};
            return norm(q) <= norm(d) + 1e-6 && dot(q, d) >= (std::sqrt(0.5) - 1e-6) * norm(q) * norm(d);
          });
      EXPECT_TRUE(covered) << p.x << ' ' << p.y;
    });
    in_corners += count > 4 ? 1 : 0;
    const double nearest = clearance(s.obstacles[0], p);
    ASSERT_EQ(count > 0, nearest <= 0.7);
    if (count > 0) { ASSERT_NEAR(norm(seen[0]), nearest, 1e-6) << "the nearest point is the first"; }
  }
  EXPECT_GT(in_corners, 20);
}

TEST(FloorMap, StartsAndRandomTargetsStayClear) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Scenario s = plain_scenario();
    s.seed = seed;
    s.obstacles = {rooms()};
    s.swarm.robots = 20;
    s.swarm.start.center = {0.2, 0.7};
    if (seed % 2 == 0) s.swarm.start.layout = Layout::random;
    s.targets = RandomTargets{4, 2.0, {1.5, 1.5}};
    for (const Vec2 p : place(s).position) EXPECT_GE(clearance(s.obstacles, p), s.robot.radius_m);
    for (const Vec2 p : target_positions(s)) EXPECT_GE(clearance(s.obstacles, p), s.robot.radius_m);
  }
}

TEST(FloorMap, TellsOfRoomsThatNobodyReaches) {
  Scenario s = plain_scenario();
  FloorMap map = rooms();
  std::string text = rooms_text;
  text.replace(text.find("14#6.21#"), 8, "41#");
  map.cells = std::make_shared<const CellGrid>(CellGrid::from_text(text));
  s.obstacles = {map};
  s.swarm.robots = 6;
  s.swarm.start.center = {0.2, 0.7};
  s.targets = std::vector<Vec2>{{0.0, 0.2}};
  const auto found = faults(s);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].warning);
  EXPECT_EQ(found[0].key, "obstacles[0]");
  EXPECT_NE(found[0].text.find("no robot can reach 3 closed rooms"), std::string::npos) << found[0].text;
  s.targets = std::vector<Vec2>{{0.0, 4.5}};
  EXPECT_NE(faults(s)[0].text.find("is in a room that no robot can reach"), std::string::npos);
  s.obstacles = {rooms()};
  s.targets = std::vector<Vec2>{{0.0, 4.5}};
  for (const Fault& fault : faults(s)) EXPECT_TRUE(fault.warning) << fault.text;
}

TEST(FloorMap, OfAWorldThatIsCopiedIsShared) {
  Scenario s = ring("convoy", 12, 3, 1.0, 1);
  s.obstacles = {rooms(0.125, {-1.0, -0.5})};
  s.swarm.start.center = {0.2, 0.7};
  s.targets = std::vector<Vec2>{{0.0, 0.2}, {1.0, 1.5}, {0.0, 3.0}};
  World world(s);
  for (int k = 0; k < 50; ++k) world.step();
  World copy = world;
  EXPECT_EQ(std::get<FloorMap>(copy.obstacles()[0]).cells, std::get<FloorMap>(world.obstacles()[0]).cells);
  for (int k = 0; k < 50; ++k) world.step(), copy.step();
  EXPECT_EQ(copy.hash(), world.hash());
  Event move;
  move.action = MoveObstacle{0, center_of(world.obstacles()[0]) + Vec2{0.125, 0.0}};
  EXPECT_TRUE(copy.faults_now(move).empty());
  copy.intervene(move);
  copy.step(), world.step();
  EXPECT_NE(copy.hash(), world.hash());
}

}  // namespace
}  // namespace banyan::world
