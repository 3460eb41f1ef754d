// SPDX-License-Identifier: MIT
// Links that somebody names do not outgrow G, and what ends that: another parent, or a silence that lasts.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tiny_world.hpp"

namespace banyan::caravan {
namespace {

// Up to six robots, each in reach of one before, of which one or two are sent somewhere, and perhaps elsewhere later.
class Mission {
 public:
  Mission(std::size_t robots, std::uint64_t seed)
      : dice_(seed),
        workers_(robots > 3 && dice_.comes_up(0.5F) ? 2U : 1U),
        world(start(robots), sent(robots, workers_)) {
    world.dice = Dice(seed + 1);
    aim();
  }
  void tick() {
    if (dice_.comes_up(0.004F)) aim();
    world.step();
  }

 private:
  std::vector<Vec2> start(std::size_t robots) {
    std::vector<Vec2> places{{0, 0}};
    while (places.size() < robots) {
      const Vec2 place = places[dice_.below(places.size())] + dice_.on_disc(0.9F);
      if (std::all_of(places.begin(), places.end(), [&](Vec2 p) { return distance(p, place) > 0.1F; }))
        places.push_back(place);
    }
    return places;
  }
  static std::vector<std::size_t> sent(std::size_t robots, std::size_t workers) {
    return workers == 1 ? std::vector{robots - 1} : std::vector{robots - 2, robots - 1};
  }
  void aim() {
    for (std::size_t k = 1; k <= workers_; ++k) world.send(world.size() - k, dice_.on_disc(3.0F));
  }

  Dice dice_;
  std::size_t workers_;

 public:
  TinyWorld world;
};

RC_GTEST_PROP(CaravanPromise, NoLinkToAParentOutgrowsG, ()) {
  Mission mission(*rc::gen::inRange<std::size_t>(2, 7), any_seed());
  TinyWorld& world = mission.world;
  const std::size_t n = world.size();
  std::vector<RobotId> parents(n, nobody);
  std::vector<float> lengths(n);
  for (int t = 0; t < 500; ++t) {
    mission.tick();
    RC_ASSERT(world.is_one_piece());
    for (std::size_t i = 0; i < n; ++i) {
      const RobotId parent = world.said(i).parent;
      if (parent == nobody) continue;
      const float length = world.between(i, parent);
      // Who has no other takes even a longer one; that does not grow either.
      if (parent == parents[i]) RC_ASSERT(length <= std::max(longest_edge, lengths[i]) + 1e-3F);
      lengths[i] = length;
    }
    for (std::size_t i = 0; i < n; ++i) parents[i] = world.said(i).parent;
  }
}

RC_GTEST_PROP(CaravanPromise, ASwarmStaysInOnePieceThoughPacketsGetLost, ()) {
  Mission mission(*rc::gen::inRange<std::size_t>(2, 7), any_seed());
  mission.world.loss = 0.3F;
  for (int t = 0; t < 500; ++t) {
    mission.tick();
    RC_ASSERT(mission.world.is_one_piece());
  }
}

TEST(CaravanPromise, AChildWhoseParentDiesGoesToWhereItWas) {
  // Root, connector and worker stand in a bow, the worker at its target and out of reach of the root.
  const Vec2 at_work{1.5F, 0};
  TinyWorld world({{0, 0}, {0.75F, 0.4F}, at_work}, {2});
  world.send(2, at_work);
  world.hold(0);
  world.hold(1);
  world.steps(50);
  ASSERT_EQ(world.said(2).parent, 1);
  const Vec2 before = world.places[2];
  world.kill(1);
  world.steps(4);
  EXPECT_LT(distance(world.places[2], before), 0.01F) << "a few packets may get lost";
  world.steps(26);
  const Vec2 way = world.places[2] - before;
  EXPECT_GT(norm(way), 0.2F);
  EXPECT_GT(dot(unit(way), unit(world.places[1] - before)), 0.99F) << "straight to it, not to the root";
  EXPECT_LT(world.until(200, [&] { return world.said(2).parent == 0; }), 100) << "by then in reach of the root";
}

// Worker 1 wants to go to the left; its child, worker 2, is at its target, and does not hear the root.
constexpr Vec2 to_the_left{-0.3F, 0.8F};
TinyWorld held_back() {
  TinyWorld world({{0, 0}, {0.3F, 0.3F}, {0.6F, -0.3F}}, {1, 2});
  world.send(1, to_the_left);
  world.send(2, {0.6F, -0.3F});
  world.hold(0);
  world.hold(2);
  world.part(0, 2);
  world.steps(300);
  return world;
}

TEST(CaravanPromise, AParentStaysForAChildThatHasNoOther) {
  TinyWorld world = held_back();
  ASSERT_EQ(world.said(2).parent, 1);
  EXPECT_LE(world.between(1, 2), longest_edge + 1e-3F);
  EXPECT_GT(world.to(1, to_the_left), 0.3F);
  // As soon as the child has named another, it is free.
  world.part(0, 2, false);
  EXPECT_LT(world.until(60, [&] { return world.said(2).parent == 0; }), 20);
  EXPECT_LT(world.until(300, [&] { return world.to(1, to_the_left) <= 0.1F; }), 200);
  EXPECT_GT(world.between(1, 2), 1.0F);
}

// Not for ever: once the child has been silent for a lease.
TEST(CaravanPromise, AParentIsFreeOnceItsChildHasBeenSilentForALease) {
  TinyWorld world = held_back();
  world.kill(2);
  world.steps(50);
  EXPECT_LE(world.between(1, 2), longest_edge + 1e-3F) << "it may only be hidden";
  world.steps(300);
  EXPECT_LE(world.to(1, to_the_left), 0.1F);
}

// Who hears somebody that has no parent yet may be all that it has.
TEST(CaravanPromise, NobodyLeavesBeforeAllAreTied) {
  // Robot 2 is heard by worker 1 alone, and for long does not hear it.
  TinyWorld world({{0, 0}, {0.5F, 0}, {1.3F, 0}}, {1});
  world.send(1, {0, 0.9F});
  world.hold(0);
  world.deafen(2, 1);
  for (int t = 0; t < 200; ++t) {
    world.step();
    ASSERT_LE(world.between(1, 2), longest_edge + 1e-3F) << t;
  }
  EXPECT_EQ(world.said(2).parent, nobody);
  world.deafen(2, 1, false);
  world.steps(5);
  EXPECT_EQ(world.said(2).parent, 1);
}

}  // namespace
}  // namespace banyan::caravan
