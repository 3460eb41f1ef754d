// SPDX-License-Identifier: MIT
// Posts: a spare that does not see the edge comes along the gradient, and a call dies with its source.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tiny_world.hpp"

namespace banyan::caravan {
namespace {

// Worker 1 has arrived and stays; worker 2 goes on from there. The only spare hears neither end of that edge.
constexpr Vec2 far_target{2.6F, 0};
TinyWorld outpost(float call_after_rounds) {
  TinyWorld world({{0, 0}, {0.8F, 0}, {1.0F, 0}, {-0.5F, 0.1F}}, {1, 2});
  world.params.call_after_rounds = call_after_rounds;
  world.send(1, {0.8F, 0});
  world.send(2, far_target);
  return world;
}

TEST(CaravanPosts, ASpareOutOfSightComesAlongTheGradientAndJoins) {
  TinyWorld world = outpost(Params{}.call_after_rounds);
  EXPECT_LT(world.until(1000, [&] { return world.to(2, far_target) <= 0.1F; }), 500);
  EXPECT_EQ(world.role(3), Role::connector);
  EXPECT_EQ(world.said(2).parent, 3);
  EXPECT_TRUE(world.leads_to(2, 0));
}

TEST(CaravanPosts, WithoutACallItStaysWhereItIs) {
  TinyWorld world = outpost(6000.0F);
  world.hold(0);
  world.steps(1000);
  EXPECT_GT(world.to(2, far_target), 0.8F);
  EXPECT_LE(world.between(1, 2), longest_edge + 1e-3F) << "held by its promise";
  EXPECT_EQ(world.role(3), Role::spare);
  EXPECT_LT(world.places[3].x, 0.0F);
}

// Nobody is spare, and each of two workers needs a robot of its own behind it: the last but one comes up.
TEST(CaravanPosts, WithoutSparesAChainGathersItsSlackWhereItCalls) {
  TinyWorld world({{0, 0}, {0.6F, 0}, {1.2F, 0}, {1.8F, 0}, {2.4F, 0}, {2.4F, 0.5F}, {2.4F, -0.5F}}, {5, 6});
  world.send(5, {2.2F, 1.2F});
  world.send(6, {2.2F, -1.2F});
  const auto both = [&] { return world.to(5, {2.2F, 1.2F}) <= 0.1F && world.to(6, {2.2F, -1.2F}) <= 0.1F; };
  EXPECT_LT(world.until(1500, both), 1000);
}

TEST(CaravanPosts, AnEdgeCallsOnlyAfterItHasWaited) {
  TinyWorld world({{0, 0}, {0.3F, 0}, {-0.45F, 0}}, {1});
  world.params.call_after_rounds = 50.0F;
  world.send(1, {2.4F, 0});
  world.hold(0);
  world.until(200, [&] { return world.between(0, 1) > 0.9F; });
  for (int t = 0; t < 48; ++t) {
    world.step();
    ASSERT_EQ(world.said(1).call.source, nobody) << t;
  }
  world.steps(6);
  EXPECT_EQ(world.said(1).call.source, 1);
  EXPECT_EQ(world.said(1).call.hops, 0);
  EXPECT_EQ(world.said(0).call.hops, 1);
  EXPECT_EQ(world.said(2).call.hops, 2);
}

// Up to seven robots near each other, and a radio that joins them by a random connected graph. Robot 1's edge to the
// root is stretched, and it calls.
TinyWorld calling(std::size_t robots, Dice& dice) {
  std::vector<Vec2> places{{0, 0}, {0.93F, 0}};
  while (places.size() < robots) places.push_back(Vec2{0.1F, 0.3F} + dice.on_disc(0.2F));
  TinyWorld world(places, {1});
  world.by_distance = false;
  world.send(1, {3.0F, 0});
  world.hold_all();
  for (std::size_t i = 2; i < robots; ++i) {
    const std::size_t joined = i == 2 ? 0 : dice.below(i - 1) == 0 ? 0 : 2 + dice.below(i - 2);
    for (std::size_t j = 0; j < i; ++j)
      if (j != joined && (j == 1 || !dice.comes_up(0.25F))) world.part(i, j);
  }
  return world;
}

bool anybody_passes_on(const TinyWorld& world, RobotId source) {
  for (std::size_t i = 0; i < world.size(); ++i)
    if (world.lives(i) && world.said(i).call.source == source) return true;
  return false;
}

RC_GTEST_PROP(CaravanPosts, TheGradientCountsHopsOnAnyGraph, ()) {
  Dice dice(any_seed());
  const auto robots = *rc::gen::inRange<std::size_t>(3, 8);
  TinyWorld world = calling(robots, dice);
  world.steps(100);
  // By breadth-first search.
  std::vector<std::size_t> hops(robots, robots);
  hops[1] = 0;
  for (std::size_t round = 0; round < robots; ++round)
    for (std::size_t i = 0; i < robots; ++i)
      for (std::size_t j = 0; j < robots; ++j)
        if (world.hears(i, j)) hops[i] = std::min(hops[i], hops[j] + 1);
  for (std::size_t i = 0; i < robots; ++i) {
    RC_ASSERT(world.said(i).call.source == 1);
    RC_ASSERT(world.said(i).call.hops == hops[i]);
  }
}

// How long a call outlives its source, in rounds.
int outlives(std::size_t robots, std::uint64_t seed) {
  Dice dice(seed);
  TinyWorld world = calling(robots, dice);
  world.steps(100);
  RC_ASSERT(anybody_passes_on(world, 1));
  world.kill(1);
  const int rounds = world.until(4000, [&] { return !anybody_passes_on(world, 1); });
  for (int t = 0; t < 50; ++t) {
    world.step();
    RC_ASSERT(!anybody_passes_on(world, 1));
  }
  return rounds;
}

TEST(CaravanPosts, ACallDiesWithItsSource) {
  EXPECT_TRUE(rc::check([] {
    const auto robots = *rc::gen::inRange<std::size_t>(3, 8);
    // 2 I after the last news has come, which takes a round a hop.
    RC_ASSERT(outlives(robots, any_seed()) <= 2 * 5 + 2 * static_cast<int>(robots));
  }));
}

// The count has meanwhile come more than half round, and is no echo of what had ended.
TEST(CaravanPosts, ACallIsTakenUpAgainByARobotThatHeardNobodyForLong) {
  Dice dice(1);
  TinyWorld world = calling(3, dice);
  world.steps(100);
  ASSERT_EQ(world.said(2).call.source, 1);
  world.jam(2);
  world.steps(150);
  ASSERT_EQ(world.said(2).call.source, nobody);
  world.jam(2, false);
  EXPECT_LT(world.until(200, [&] { return world.said(2).call.source == 1; }), 5);
}

// No robot counts more than 250 hops.
RC_GTEST_PROP(CaravanPosts, NoCallOutlivesItsSourceForEver, ()) {
  RC_ASSERT(outlives(*rc::gen::inRange<std::size_t>(3, 8), any_seed()) <= 250 / 2 * 12);
}

}  // namespace
}  // namespace banyan::caravan
