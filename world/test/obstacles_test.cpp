// SPDX-License-Identifier: MIT
// Obstacles against brute force: points along a line of sight, points of a surface.
#include "banyan/world/obstacles.hpp"

#include <gtest/gtest.h>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/random.hpp"

namespace banyan::world {
namespace {

// Numbers for one test, a function of how often they were asked for.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : seed_{seed} {}
  double between(double low, double high) {
    return low + (high - low) * to_uniform(bits(seed_, Purpose::placement, next_++));
  }
  Vec2 point(double half) { return {between(-half, half), between(-half, half)}; }

 private:
  std::uint64_t seed_, next_ = 0;
};

Obstacle random_obstacle(Draws& draws, int kind) {
  if (kind == 0) return Disc{draws.point(1.0), draws.between(0.05, 0.8)};
  const auto side = [&] { return draws.between(0.05, 1.5); };
  if (kind == 1) return Box{draws.point(1.0), {side(), side()}, draws.between(-4, 4)};
  return Wall{draws.point(1.5), draws.point(1.5)};
}

// By definition, without any of the library's geometry.
bool inside(const Disc& disc, Vec2 p) { return squared_norm(p - disc.center) < disc.radius_m * disc.radius_m; }
bool inside(const Box& box, Vec2 p) {
  const Vec2 q = p - box.center;
  const double x = std::cos(box.angle_rad) * q.x + std::sin(box.angle_rad) * q.y;
  const double y = -std::sin(box.angle_rad) * q.x + std::cos(box.angle_rad) * q.y;
  return std::abs(x) < box.size.x / 2 && std::abs(y) < box.size.y / 2;
}

TEST(Obstacles, BlockWhenAPointOfTheLineOfSightIsInside) {
  Draws draws(1);
  int blocked = 0;
  int knife_edge = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Obstacle obstacle = random_obstacle(draws, trial % 2);
    const Vec2 a = draws.point(2.0);
    const Vec2 b = draws.point(2.0);
    bool sampled = false;
    constexpr int samples = 2000;
    for (int k = 1; k < samples && !sampled; ++k) {
      const Vec2 p = a + (b - a) * (static_cast<double>(k) / samples);
      sampled = trial % 2 == 0 ? inside(std::get<Disc>(obstacle), p) : inside(std::get<Box>(obstacle), p);
    }
    blocked += sampled;
    if (sampled) { EXPECT_TRUE(blocks(obstacle, a, b)) << "trial " << trial; }
    knife_edge += !sampled && blocks(obstacle, a, b);  // a chord shorter than the sampling step
  }
  EXPECT_GT(blocked, 500);
  EXPECT_LT(knife_edge, 10);
}

TEST(Obstacles, WallBlocksWhereTheTwoSegmentsCross) {
  Draws draws(2);
  int blocked = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Wall wall{draws.point(1.5), draws.point(1.5)};
    const Vec2 a = draws.point(2.0);
    const Vec2 b = draws.point(2.0);
    // a + s (b - a) = from + t (to - from), by Cramer's rule
    const Vec2 u = b - a;
    const Vec2 w = wall.to - wall.from;
    const double det = -u.x * w.y + w.x * u.y;
    const Vec2 r = wall.from - a;
    const double s = (-r.x * w.y + w.x * r.y) / det;
    const double t = (u.x * r.y - r.x * u.y) / det;
    const bool crosses = s > 0 && s < 1 && t >= 0 && t <= 1;
    blocked += crosses;
    EXPECT_EQ(blocks(wall, a, b), crosses) << "trial " << trial;
  }
  EXPECT_GT(blocked, 300);
}

TEST(Obstacles, EdgeCasesOfALineOfSight) {
  const Wall wall{{0, -1}, {0, 1}};
  EXPECT_TRUE(blocks(wall, {-1, 1}, {1, 1})) << "through the end of a wall";
  EXPECT_FALSE(blocks(wall, {-1, 0}, {0, 0})) << "up to the wall";
  EXPECT_FALSE(blocks(wall, {0, -3}, {0, 3})) << "along the wall";
  EXPECT_FALSE(blocks(wall, {-1, 1.001}, {1, 1.001})) << "past the wall";
  const Disc disc{{0, 0}, 0.5};
  EXPECT_FALSE(blocks(disc, {-1, 0.5}, {1, 0.5})) << "touching";
  EXPECT_TRUE(blocks(disc, {-1, 0.4999}, {1, 0.4999}));
  EXPECT_TRUE(blocks(disc, {0.1, 0}, {0.1, 0})) << "one point inside";
  EXPECT_FALSE(blocks(disc, {0.6, 0}, {2, 0})) << "behind";
  const Box box{{0, 0}, {2, 1}, 0};
  EXPECT_FALSE(blocks(box, {-3, 0.5}, {3, 0.5})) << "along a side";
  EXPECT_TRUE(blocks(box, {-3, 0.4999}, {3, 0.4999}));
  EXPECT_TRUE(blocks(box, {0, 0}, {0.1, 0})) << "wholly inside";
  EXPECT_TRUE(blocks(box, {0, 0}, {0, 0}));
  EXPECT_FALSE(blocks(box, {1.2, 0}, {1.2, 0}));
}

TEST(Obstacles, SightIsMutualToTheLastBit) {
  Draws draws(3);
  for (int trial = 0; trial < 3000; ++trial) {
    // Short coordinates make ties and exact touches frequent.
    const auto snap = [](Vec2 p) { return Vec2{std::round(p.x * 4) / 4, std::round(p.y * 4) / 4}; };
    Obstacle obstacle = Disc{snap(draws.point(1.0)), 0.5};
    if (trial % 3 == 1) obstacle = Box{snap(draws.point(1.0)), {1.0, 0.5}, pi<double> / 4 * (trial % 8)};
    if (trial % 3 == 2) obstacle = Wall{snap(draws.point(1.5)), snap(draws.point(1.5))};
    const Vec2 a = snap(draws.point(2.0));
    const Vec2 b = snap(draws.point(2.0));
    EXPECT_EQ(blocks(obstacle, a, b), blocks(obstacle, b, a));
  }
}

TEST(Obstacles, ClearanceIsTheDistanceToTheNearestPointOfTheSurface) {
  Draws draws(4);
  for (int trial = 0; trial < 300; ++trial) {
    const Obstacle obstacle = random_obstacle(draws, trial % 3);
    const Vec2 p = draws.point(2.0);
    double nearest = 1e9;
    bool in = false;
    constexpr int samples = 4000;
    for (int k = 0; k <= samples; ++k) {
      const double s = static_cast<double>(k) / samples;
      Vec2 surface{};
      if (const auto* disc = std::get_if<Disc>(&obstacle)) {
        surface = disc->center + disc->radius_m * Vec2{std::cos(2 * M_PI * s), std::sin(2 * M_PI * s)};
        in = inside(*disc, p);
      } else if (const auto* box = std::get_if<Box>(&obstacle)) {
        const double side = 4 * s;
        const double t = side - std::floor(side) - 0.5;
        const Vec2 q = side < 1 ? Vec2{t, -0.5} : side < 2 ? Vec2{0.5, t} : side < 3 ? Vec2{-t, 0.5} : Vec2{-0.5, -t};
        const Vec2 scaled{q.x * box->size.x, q.y * box->size.y};
        surface = box->center + rotate(Vec2{std::cos(box->angle_rad), std::sin(box->angle_rad)}, scaled);
        in = inside(*box, p);
      } else {
        const auto& wall = std::get<Wall>(obstacle);
        surface = wall.from + (wall.to - wall.from) * s;
      }
      nearest = std::min(nearest, distance(surface, p));
    }
    EXPECT_NEAR(clearance(obstacle, p), in ? -nearest : nearest, 2e-3) << "trial " << trial;
  }
}

TEST(Obstacles, PushOutTakesTheShortestWay) {
  Draws draws(5);
  constexpr double radius = 0.07;
  for (int trial = 0; trial < 2000; ++trial) {
    const Obstacle obstacle = random_obstacle(draws, trial % 3);
    const Vec2 p = draws.point(1.5);
    const double room = clearance(obstacle, p);
    const Vec2 shift = push_out(obstacle, p, radius);
    if (room >= radius) {
      EXPECT_EQ(shift, Vec2{});
      continue;
    }
    EXPECT_NEAR(clearance(obstacle, p + shift), radius, 1e-12) << "trial " << trial;
    EXPECT_NEAR(norm(shift), radius - room, 1e-12) << "trial " << trial;
  }
}

TEST(Obstacles, PushOutFromTheVeryMiddle) {
  EXPECT_NEAR(norm(push_out(Disc{{1, 2}, 0.5}, {1, 2}, 0.1)), 0.6, 1e-12);
  EXPECT_NEAR(norm(push_out(Box{{1, 2}, {1, 0.4}, 0.3}, {1, 2}, 0.1)), 0.3, 1e-12);
  const Vec2 off = push_out(Wall{{0, 0}, {1, 1}}, {0.5, 0.5}, 0.1);
  EXPECT_NEAR(norm(off), 0.1, 1e-12);
  EXPECT_NEAR(dot(off, Vec2{1, 1}), 0.0, 1e-12) << "perpendicular to the wall";
}

}  // namespace
}  // namespace banyan::world
