// SPDX-License-Identifier: MIT
// Corners that only one end of an edge has passed, and edges so short that every second robot is heard.
#include <gtest/gtest.h>

#include "tiny_world.hpp"

namespace banyan::caravan {
namespace {

// Worker 1 stands; worker 2 draws the root to the side, so that its edge to 1 sweeps towards the corner.
TEST(CaravanSight, TheParentKeepsACornerOutOfTheEdgeThatOnlyItsChildHasSeen) {
  constexpr Vec2 corner{0.35F, 0.1F};
  for (const bool is_seen : {false, true}) {
    TinyWorld world({{0, 0}, {0.6F, 0}, {0, 0.6F}}, {1, 2});
    world.params.line_of_sight = true;
    world.send(1, {0.6F, 0});
    world.send(2, {-0.3F, 1.6F});
    world.hold(1);
    if (is_seen) world.see_obstacles(1, {rotate_back(unit_vector(0.9F), corner - world.places[1])});
    float room = 1.0F;
    for (int t = 0; t < 300; ++t) {
      world.step();
      room = std::min(room, cross(corner - world.places[0], world.places[1] - world.places[0]) /
                                -world.between(0, 1));  // above the line from 0 to 1
    }
    if (is_seen) EXPECT_GT(room, 0.015F);
    else EXPECT_LT(room, 0.0F) << "nobody knows of it: this world would show a fault";
  }
}

// Worker 1 has arrived, over edges of half the length.
TinyWorld folded(bool line_of_sight) {
  TinyWorld world({{0, 0}, {0.2F, 0}, {-0.2F, 0.1F}, {-0.2F, -0.1F}, {0, 0.2F}, {0, -0.2F}, {-0.3F, 0}}, {1});
  world.params.link_redundancy = 2;
  world.params.line_of_sight = line_of_sight;
  world.hold(0);
  world.send(1, {1.5F, 0});
  world.steps(700);
  return world;
}

TEST(CaravanSight, WithTwoPathsAnyRobotMayDie) {
  const TinyWorld world = folded(false);
  EXPECT_LE(world.to(1, {1.5F, 0}), 0.1F);
  const auto way = world.way_up(1);
  ASSERT_GT(way.size(), 3U);
  EXPECT_LE(world.longest_on(way), 0.5F * longest_edge + 1e-3F);
  for (std::size_t k = 2; k < way.size(); ++k)
    EXPECT_LE(world.between(way[k - 2], way[k]), longest_edge + 2e-3F) << "without robot " << way[k - 1];
}

TEST(CaravanSight, WithTwoPathsNobodyHidesItsNeighboursFromEachOther) {
  const TinyWorld world = folded(true);
  const auto way = world.way_up(1);
  ASSERT_GT(way.size(), 3U);
  for (std::size_t k = 2; k < way.size(); ++k)
    EXPECT_GT(distance_to_segment(world.places[way[k - 1]], world.places[way[k - 2]], world.places[way[k]]),
              world.params.body_radius)
        << "robot " << way[k - 1];
}

}  // namespace
}  // namespace banyan::caravan
