// SPDX-License-Identifier: MIT
// Links and lines of sight against plain geometry over all pairs and all bodies.
#include "banyan/world/radio.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/random.hpp"
#include "banyan/world/sight.hpp"

namespace banyan::world {
namespace {

using Real = long double;
struct Point {
  Real x, y;
};
Point point(Vec2 v) { return {v.x, v.y}; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
Real dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
Real cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
Real length(Point a) { return std::sqrt(dot(a, a)); }

// How clearly something is so: positive if it is, negative if not, near zero on the knife's edge.
using Margin = Real;

// A disc beside the segment a-b, nearer to it than radius.
Margin body_between(Point k, Point a, Point b, Real radius) {
  const Point d = b - a;
  const Real along = dot(k - a, d) / length(d);
  return std::min({along, length(d) - along, radius - std::fabs(cross(k - a, d)) / length(d)});
}

Real distance_to_segment(Point k, Point a, Point b) {
  const Point d = b - a;
  const Real t = std::clamp(dot(k - a, d) / dot(d, d), Real(0), Real(1));
  return length(Point{k.x - a.x - t * d.x, k.y - a.y - t * d.y});
}

Margin segments_cross(Point a, Point b, Point c, Point d) {
  const Real ab = length(b - a);
  const Real cd = length(d - c);
  if (cd == 0) return -1;
  const Real c_side = cross(b - a, c - a) / ab;
  const Real d_side = cross(b - a, d - a) / ab;
  const Real a_side = cross(d - c, a - c) / cd;
  const Real b_side = cross(d - c, b - c) / cd;
  const bool yes = (c_side > 0) != (d_side > 0) && (a_side > 0) != (b_side > 0);
  const Real near = std::min({std::fabs(c_side), std::fabs(d_side), std::fabs(a_side), std::fabs(b_side)});
  return yes ? near : -near;
}

Margin box_between(const Box& box, Point a, Point b) {
  const Real c = std::cos(static_cast<Real>(box.angle_rad));
  const Real s = std::sin(static_cast<Real>(box.angle_rad));
  const auto corner = [&](Real sx, Real sy) {
    const Real x = sx * static_cast<Real>(box.size.x) / 2;
    const Real y = sy * static_cast<Real>(box.size.y) / 2;
    return Point{static_cast<Real>(box.center.x) + c * x - s * y, static_cast<Real>(box.center.y) + s * x + c * y};
  };
  const Point corners[4] = {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
  Margin best = -1e9L;
  Real inside_a = 1e9L;
  Real inside_b = 1e9L;
  for (int k = 0; k < 4; ++k) {
    const Point p = corners[k];
    const Point q = corners[(k + 1) % 4];
    best = std::max(best, segments_cross(a, b, p, q));
    inside_a = std::min(inside_a, cross(q - p, a - p) / length(q - p));
    inside_b = std::min(inside_b, cross(q - p, b - p) / length(q - p));
  }
  return std::max({best, inside_a, inside_b});
}

Margin obstacle_between(const Obstacle& obstacle, Point a, Point b) {
  if (const auto* disc = std::get_if<Disc>(&obstacle))
    return static_cast<Real>(disc->radius_m) - distance_to_segment(point(disc->center), a, b);
  if (const auto* wall = std::get_if<Wall>(&obstacle)) return segments_cross(a, b, point(wall->from), point(wall->to));
  return box_between(std::get<Box>(obstacle), a, b);
}

struct Crowd {
  Scenario scenario;
  std::vector<Vec2> positions;
  std::vector<std::uint8_t> alive;
  std::vector<std::uint8_t> raised;  // none: sight is exact

  void show(Radio& radio, Executor& executor) const { radio.update(positions, alive, raised, executor); }
  [[nodiscard]] Scene scene() const {
    const Scenario& s = scenario;
    return {positions,          alive, raised, s.obstacles, s.radio.range_m, s.robot.radius_m, s.radio.line_of_sight,
            s.robot.dead_bodies};
  }
};

// 1 to 300 robots in a square, from sparse to overlapping, some dead, with and without obstacles and leaks.
Crowd crowd(std::uint64_t seed) {
  const auto draw = [&](std::uint64_t a, std::uint64_t b = 0) {
    return to_uniform(bits(seed, Purpose::placement, a, b));
  };
  Crowd c;
  const std::size_t robots = 1 + static_cast<std::size_t>(300 * draw(0) * draw(1));
  const double side_m = std::sqrt(static_cast<double>(robots)) * (0.12 + 1.5 * draw(2) * draw(3));
  c.scenario.radio.range_m = 0.4 + 1.8 * draw(4);
  c.scenario.radio.line_of_sight = draw(5) < 0.8;
  c.scenario.robot.radius_m = 0.02 + 0.08 * draw(6);
  for (std::size_t i = 0; i < robots; ++i) {
    c.positions.push_back({side_m * (draw(10, i) - 0.5), side_m * (draw(11, i) - 0.5)});
    c.alive.push_back(draw(12, i) < 0.9 ? 1 : 0);
  }
  if (draw(8) < 0.5) c.scenario.radio.sight_leak = 0.7 * draw(9);
  for (std::size_t i = 0; i < robots && c.scenario.radio.sight_leak > 0.0; ++i)
    c.raised.push_back(draw(13, i) < c.scenario.radio.sight_leak ? 1 : 0);
  if (draw(7) < 0.5) {
    for (std::uint64_t k = 0; k < 6; ++k) {
      const Vec2 at{side_m * (draw(20, k) - 0.5), side_m * (draw(21, k) - 0.5)};
      const Vec2 to{side_m * (draw(22, k) - 0.5), side_m * (draw(23, k) - 0.5)};
      if (k % 3 == 0) c.scenario.obstacles.push_back(Disc{at, 0.05 + 0.3 * draw(24, k)});
      if (k % 3 == 1)
        c.scenario.obstacles.push_back(Box{at, {0.1 + draw(24, k), 0.1 + draw(25, k)}, 6.0 * draw(26, k)});
      if (k % 3 == 2) c.scenario.obstacles.push_back(Wall{at, to});
    }
  }
  return c;
}

// How clearly bodies and obstacles hide two robots in range from each other. A body does not if it is nearer to an end
// with a raised antenna; in the very middle of two different ends nothing is clear.
Margin hidden_between(const Crowd& c, std::uint32_t i, std::uint32_t j) {
  const Point a = point(c.positions[i]);
  const Point b = point(c.positions[j]);
  const auto raised = [&](std::uint32_t robot) { return !c.raised.empty() && c.raised[robot] != 0; };
  Margin hidden = -1;
  for (std::uint32_t k = 0; k < c.positions.size(); ++k) {
    if (k == i || k == j) continue;
    const Point body = point(c.positions[k]);
    const Margin between = body_between(body, a, b, static_cast<Real>(c.scenario.robot.radius_m));
    const Real nearer_to_a = length(b - body) - length(body - a);
    const bool is_over = nearer_to_a > 0 ? raised(i) : raised(j);
    if (between > 0 && raised(i) != raised(j) && std::fabs(nearer_to_a) < 1e-8L) return 0;
    if (!is_over) hidden = std::max(hidden, between);
    else if (std::fabs(between) < 1e-9L) return 0;
  }
  for (const Obstacle& obstacle : c.scenario.obstacles) hidden = std::max(hidden, obstacle_between(obstacle, a, b));
  return hidden;
}

void compare(const Crowd& c, const Radio& radio, std::uint64_t seed) {
  constexpr Real edge = 1e-9L;
  const std::size_t n = c.positions.size();
  const auto blocked_list = radio.blocked();
  ASSERT_TRUE(std::is_sorted(blocked_list.begin(), blocked_list.end()));
  std::set<std::pair<std::uint32_t, std::uint32_t>> blocked(blocked_list.begin(), blocked_list.end());
  ASSERT_EQ(blocked.size(), blocked_list.size()) << "a blocked pair is listed twice";
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto row = radio.links(i);
    ASSERT_TRUE(std::is_sorted(row.begin(), row.end()));
    ASSERT_EQ(std::adjacent_find(row.begin(), row.end()), row.end());
    for (std::uint32_t j = i + 1; j < n; ++j) {
      const bool heard = std::binary_search(row.begin(), row.end(), j);
      const auto other = radio.links(j);
      ASSERT_EQ(heard, std::binary_search(other.begin(), other.end(), i)) << "not symmetric";
      const Point a = point(c.positions[i]);
      const Point b = point(c.positions[j]);
      Margin in_range = static_cast<Real>(c.scenario.radio.range_m) - length(b - a);
      if (c.alive[i] == 0 || c.alive[j] == 0) in_range = -1;
      Margin hidden = -1;
      if (c.scenario.radio.line_of_sight && in_range > 0) hidden = hidden_between(c, i, j);
      if (std::fabs(in_range) < edge || std::fabs(hidden) < edge) continue;
      ASSERT_EQ(heard, in_range > 0 && hidden < 0) << "seed " << seed << ": " << i << " - " << j << " of " << n;
      ASSERT_EQ(blocked.contains({i, j}), in_range > 0 && hidden > 0)
          << "seed " << seed << ": " << i << " - " << j << " of " << n;
    }
  }
}

TEST(Radio, AgreesWithPlainGeometryOverAllPairs) {
  Executor executor(1);
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    const Crowd c = crowd(seed);
    Radio radio(c.scenario, c.positions.size());
    c.show(radio, executor);
    ASSERT_NO_FATAL_FAILURE(compare(c, radio, seed));
  }
}

// What a radio remembers from one tick to the next must never show.
TEST(Radio, AgreesWithPlainGeometryWhileRobotsMoveAndDie) {
  Executor executor(2);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Crowd c = crowd(seed);
    Radio radio(c.scenario, c.positions.size());
    for (std::uint64_t tick = 0; tick < 12; ++tick) {
      c.show(radio, executor);
      ASSERT_NO_FATAL_FAILURE(compare(c, radio, seed));
      for (std::size_t i = 0; i < c.positions.size(); ++i) {
        const double far = tick % 4 == 3 ? 2.0 : 0.05;  // now and then everybody jumps
        c.positions[i] += Vec2{far * (to_uniform(bits(seed, Purpose::loss, i, 0, tick)) - 0.5),
                               far * (to_uniform(bits(seed, Purpose::loss, i, 1, tick)) - 0.5)};
        if (to_uniform(bits(seed, Purpose::loss, i, 2, tick)) < 0.02) c.alive[i] = 0;
      }
    }
  }
}

// Single precision, by which pairs are sifted, is coarse there.
TEST(Radio, AgreesWithPlainGeometryInAWideWorld) {
  Executor executor(1);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Crowd c = crowd(seed);
    for (Vec2& p : c.positions) p += Vec2{3e4, -2e4};
    c.positions.push_back({-3e4, 2e4});
    c.alive.push_back(1);
    if (!c.raised.empty()) c.raised.push_back(0);
    Radio radio(c.scenario, c.positions.size());
    for (std::uint64_t tick = 0; tick < 12; ++tick) {
      c.show(radio, executor);
      ASSERT_NO_FATAL_FAILURE(compare(c, radio, seed));
      for (std::size_t i = 0; i < c.positions.size(); ++i)
        c.positions[i] += Vec2{0.04 * (to_uniform(bits(seed, Purpose::loss, i, 0, tick)) - 0.5),
                               0.04 * (to_uniform(bits(seed, Purpose::loss, i, 1, tick)) - 0.5)};
    }
  }
}

// A crowd in which many stand, some creep, some drive and a few are fast, each on its own way to and fro; in every
// third crowd nearly all drive.
class Traffic {
 public:
  explicit Traffic(std::uint64_t seed) : crowd(world::crowd(seed)), seed_(seed), heading_(crowd.positions.size()) {
    crowd.scenario.robot.dead_bodies = draw(1) < 0.5;
    for (std::size_t i = 0; i < heading_.size(); ++i) heading_[i] = unit_vector(6.2831853 * draw(2, i));
  }

  // True if robot i has just died.
  bool move(std::size_t i, std::uint64_t tick) {
    constexpr double mixed[] = {0.0, 0.0, 0.0, 0.0, 1e-9, 1e-5, 1e-3, 0.02, 0.02, 0.1};  // m per tick
    constexpr double alike[] = {0.0, 0.01, 0.02, 0.02, 0.02, 0.02, 0.02, 0.02, 0.02, 0.02};
    const auto& speeds = seed_ % 3 == 0 ? alike : mixed;
    if (!crowd.raised.empty() && draw(15, i, tick) < 0.2) crowd.raised[i] ^= 1;  // also while everybody rests
    if (draw(3, i, tick) < 0.02) heading_[i] = unit_vector(6.2831853 * draw(4, i, tick));
    const bool everybody_rests = draw(5, tick / 8) < 0.2;
    if (!everybody_rests)
      crowd.positions[i] += heading_[i] * speeds[static_cast<std::size_t>(10 * draw(6, i, tick / 30))];
    if (draw(7, i, tick) < 0.0005)
      crowd.positions[i] =
          crowd.positions[static_cast<std::size_t>(draw(8, i, tick) * static_cast<double>(heading_.size()))] +
          Vec2{0.2, 0.1};
    if (crowd.alive[i] == 0 || draw(9, i, tick) >= 0.0003) return false;
    crowd.alive[i] = 0;
    return true;
  }

  void change_settings(Radio& radio, std::uint64_t tick) {
    Scenario& s = crowd.scenario;
    if (draw(10, tick) < 0.02) radio.occlude(s.radio.line_of_sight = !s.radio.line_of_sight, s.obstacles);
    if (s.obstacles.empty() || draw(11, tick) >= 0.05) return;
    Obstacle& obstacle =
        s.obstacles[static_cast<std::size_t>(draw(12, tick) * static_cast<double>(s.obstacles.size()))];
    obstacle = moved(obstacle, center_of(obstacle) + Vec2{0.3 * draw(13, tick) - 0.15, 0.3 * draw(14, tick) - 0.15});
    radio.occlude(s.radio.line_of_sight, s.obstacles);
  }

  Crowd crowd;

 private:
  [[nodiscard]] double draw(std::uint64_t what, std::uint64_t a = 0, std::uint64_t b = 0) const {
    return to_uniform(bits(seed_, Purpose::loss, what, a, b));
  }
  std::uint64_t seed_;
  std::vector<Vec2> heading_;
};

void expect_same(const Radio& radio, const Radio& other, std::size_t robots) {
  for (std::size_t i = 0; i < robots; ++i) ASSERT_TRUE(std::ranges::equal(radio.links(i), other.links(i))) << i;
  ASSERT_EQ(radio.blocked(), other.blocked());
  ASSERT_TRUE(std::ranges::equal(radio.near(), other.near()));
}

// To the bit, on every edge.
void expect_exact(const Crowd& c, const Radio& radio) {
  const Scene scene = c.scene();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> linked, blocked, found;
  for (std::uint32_t i = 0; i < c.positions.size(); ++i) {
    for (const std::uint32_t j : radio.links(i))
      if (i < j) found.emplace_back(i, j);
    for (std::uint32_t j = i + 1; j < c.positions.size(); ++j)
      if (in_range(scene, i, j)) (hears(scene, i, j) ? linked : blocked).emplace_back(i, j);
  }
  ASSERT_EQ(found, linked);
  ASSERT_EQ(radio.blocked(), blocked);
}

// Robots on a lattice: many lines of sight that just touch a body or pass an obstacle's corner, distances of just C.
TEST(Radio, IsItsSpecificationOnEveryEdge) {
  Executor executor(1);
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Crowd c = crowd(seed);
    const auto snap = [&](Vec2 p) { return Vec2{0.25 * std::round(4.0 * p.x), 0.25 * std::round(4.0 * p.y)}; };
    for (Vec2& p : c.positions) p = snap(p);
    for (Obstacle& obstacle : c.scenario.obstacles) obstacle = moved(obstacle, snap(center_of(obstacle)));
    c.scenario.radio.range_m = 0.5 + 0.25 * static_cast<double>(seed % 7);
    c.scenario.robot.radius_m = seed % 2 == 0 ? 0.0625 : 0.1;
    c.scenario.robot.dead_bodies = seed % 3 != 0;
    Radio radio(c.scenario, c.positions.size());
    c.show(radio, executor);
    ASSERT_NO_FATAL_FAILURE(expect_exact(c, radio)) << "seed " << seed;
  }
}

// Against one that sees each tick as its first, against its specification and now and then plain geometry.
TEST(Radio, WhatItKeepsFromTickToTickIsWhatItWouldFindAnew) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Traffic traffic(seed);
    const Crowd& c = traffic.crowd;
    const std::size_t robots = c.positions.size();
    Executor executor(1 + static_cast<int>(seed % 4));
    Executor alone(1);
    Radio radio(c.scenario, robots);
    for (std::uint64_t tick = 0; tick < 150; ++tick) {
      c.show(radio, executor);
      Radio anew(c.scenario, robots);
      c.show(anew, alone);
      ASSERT_NO_FATAL_FAILURE(expect_same(radio, anew, robots)) << "seed " << seed << ", tick " << tick;
      if (tick % 10 == 9) { ASSERT_NO_FATAL_FAILURE(expect_exact(c, radio)) << "seed " << seed << ", tick " << tick; }
      if (tick % 50 == 49 && c.scenario.robot.dead_bodies) { ASSERT_NO_FATAL_FAILURE(compare(c, radio, seed)); }
      traffic.change_settings(radio, tick);
      for (std::size_t i = 0; i < robots; ++i)
        if (traffic.move(i, tick) && !c.scenario.robot.dead_bodies) radio.forget(static_cast<std::uint32_t>(i));
    }
  }
}

// Only what happens around a robot makes it look again. One that was at the edge of what it looks at goes away, far
// enough for its clock to wrap, and comes back.
TEST(Radio, WhoHasBeenAwayForLongIsSeenAgain) {
  Scenario scenario;
  scenario.radio.range_m = 2.0;
  const double reach_m =
      1.1 * scenario.radio.range_m + scenario.robot.radius_m + 4.0 * scenario.robot.wheel_limit_m_s * scenario.tick_s;
  const std::vector<std::uint8_t> alive(3, 1);
  Executor executor(1);
  for (double away_m = 0.0; away_m < 6.0; away_m += 0.25) {
    // The second robot stands where its cell ends, so that the third is out of sight once it has left the reach.
    std::vector<Vec2> positions = {{0.01 - reach_m, 0.0}, {0.0, 0.0}, {reach_m - 0.01, 0.0}};
    Radio radio(scenario, positions.size());
    const int steps = static_cast<int>(away_m / 0.02);
    for (int t = 0; t < 2 * steps + 50; ++t) {
      radio.update(positions, alive, {}, executor);
      Radio anew(scenario, positions.size());
      anew.update(positions, alive, {}, executor);
      ASSERT_NO_FATAL_FAILURE(expect_same(radio, anew, positions.size())) << away_m << " m, tick " << t;
      positions[2].x += t < steps ? 0.02 : -0.02;
    }
    EXPECT_EQ(radio.links(1).size(), 1U);
  }
}

TEST(Radio, NearPairsAreAllPairsThatCouldTouch) {
  Executor executor(1);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Crowd c = crowd(seed);
    Radio radio(c.scenario, c.positions.size());
    radio.update(c.positions, c.alive, {}, executor);
    const double near_m = 2 * c.scenario.robot.radius_m + 4 * c.scenario.robot.wheel_limit_m_s * c.scenario.tick_s +
                          c.scenario.robot.radius_m / 7;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (std::uint32_t i = 0; i < c.positions.size(); ++i)
      for (std::uint32_t j = i + 1; j < c.positions.size(); ++j)
        if (distance(c.positions[i], c.positions[j]) < near_m) expected.emplace_back(i, j);
    ASSERT_TRUE(std::equal(expected.begin(), expected.end(), radio.near().begin(), radio.near().end())) << seed;
  }
}

class Straight : public testing::Test {
 protected:
  bool linked(std::vector<Vec2> positions, std::vector<std::uint8_t> alive = {},
              const std::vector<std::uint8_t>& raised = {}) {
    alive.resize(positions.size(), 1);
    Radio radio(scenario, positions.size());
    Executor executor(1);
    radio.update(positions, alive, raised, executor);
    const auto row = radio.links(0);
    return std::binary_search(row.begin(), row.end(), 1U);
  }
  Scenario scenario;
};

TEST_F(Straight, TheRangeIsStrict) {
  scenario.radio.range_m = 2.0;
  EXPECT_FALSE(linked({{0, 0}, {2.0, 0}}));
  EXPECT_TRUE(linked({{0, 0}, {std::nextafter(2.0, 0.0), 0}}));
}

TEST_F(Straight, ABodyBetweenBlocksEvenWhenDead) {
  scenario.radio.line_of_sight = true;
  EXPECT_FALSE(linked({{0, 0}, {1, 0}, {0.5, 0.07}}));
  EXPECT_FALSE(linked({{0, 0}, {1, 0}, {0.5, 0.07}}, {1, 1, 0}));
  EXPECT_TRUE(linked({{0, 0}, {1, 0}, {0.5, 0.0705}}));
  EXPECT_TRUE(linked({{0, 0}, {1, 0}, {1.08, 0}})) << "a body behind the other end blocks nothing";
  scenario.radio.line_of_sight = false;
  EXPECT_TRUE(linked({{0, 0}, {1, 0}, {0.5, 0}}));
}

// One body in the way: the end nearer to it decides. Of several each must be passed, and an obstacle never is.
TEST_F(Straight, ARaisedAntennaLooksOverBodiesNearIt) {
  scenario.radio.line_of_sight = true;
  scenario.radio.sight_leak = 0.5;
  EXPECT_FALSE(linked({{0, 0}, {1, 0}, {0.3, 0}}, {}, {0, 0, 1}));
  EXPECT_TRUE(linked({{0, 0}, {1, 0}, {0.3, 0}}, {}, {1, 0, 0}));
  EXPECT_FALSE(linked({{0, 0}, {1, 0}, {0.3, 0}}, {}, {0, 1, 0}));
  EXPECT_TRUE(linked({{0, 0}, {1, 0}, {0.7, 0}}, {}, {0, 1, 0}));
  EXPECT_TRUE(linked({{0, 0}, {1, 0}, {0.2, 0}, {0.4, 0}}, {}, {1, 0, 0, 0}));
  EXPECT_FALSE(linked({{0, 0}, {1, 0}, {0.2, 0}, {0.7, 0}}, {}, {1, 0, 0, 0}));
  EXPECT_TRUE(linked({{0, 0}, {1, 0}, {0.2, 0}, {0.7, 0}}, {}, {1, 1, 0, 0}));
  EXPECT_TRUE(linked({{0, 0}, {1, 0}, {0.3, 0}}, {1, 1, 0}, {1, 0, 0})) << "the body of a dead robot is as high as any";
  scenario.obstacles = {Wall{{0.25, -1}, {0.25, 1}}};
  EXPECT_FALSE(linked({{0, 0}, {1, 0}, {0.3, 0}}, {}, {1, 1, 1}));
  EXPECT_FALSE(linked({{0, 0}, {1, 0}, {5, 0}}, {}, {1, 1, 1}));
}

TEST_F(Straight, TheDeadAreSilent) {
  EXPECT_FALSE(linked({{0, 0}, {1, 0}}, {0, 1}));
  EXPECT_FALSE(linked({{0, 0}, {1, 0}}, {1, 0}));
}

TEST(Radio, AWideAndThinSwarmTakesNoMoreMemoryThanADenseOne) {
  Scenario scenario;
  std::vector<Vec2> positions;
  positions.reserve(400);
  for (int k = 0; k < 400; ++k) positions.push_back({1000.0 * k, 1500.0 * (k % 7)});
  const std::vector<std::uint8_t> alive(positions.size(), 1);
  Radio radio(scenario, positions.size());
  Executor executor(1);
  radio.update(positions, alive, {}, executor);
  for (std::size_t i = 0; i < positions.size(); ++i) EXPECT_TRUE(radio.links(i).empty());
  EXPECT_LT(radio.memory_bytes(), 400U * 1000U);
}

}  // namespace
}  // namespace banyan::world
