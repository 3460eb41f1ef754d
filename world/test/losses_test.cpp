// SPDX-License-Identifier: MIT
// The models of radio.model against closed forms: shares, lengths of bursts, a packet-error curve computed
// with the C library.
#include "../src/losses.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plain_scenario.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

Scenario with_radio(RadioModel::Model model) {
  Scenario s = plain_scenario();
  s.radio.model = model;
  return s;
}

TEST(Exponential, AgreesWithTheLibrarys) {
  for (double x = -600.0; x < 600.0; x += 0.37) EXPECT_NEAR(deterministic_exp(x) / std::exp(x), 1.0, 1e-12) << x;
  EXPECT_EQ(deterministic_exp(0.0), 1.0);
}

// What is lost over so many pairs and moments.
template <class Count> void each_packet(const Losses& losses, double loss, double distance_m, const Count& count) {
  for (std::uint64_t pair = 0; pair < 100; ++pair)
    for (std::uint64_t t = 0; t < 3000; ++t) count(pair, t, losses.lost(pair, pair + 1, t, {distance_m, 0.0}, loss));
}

TEST(Losses, OfADiscAreIndependentAtEveryDistance) {
  const Losses losses(with_radio(RadioModel::Model::disc));
  int lost = 0;
  int pairs = 0;
  bool last = false;
  each_packet(losses, 0.3, 1.9, [&](std::uint64_t /*pair*/, std::uint64_t /*t*/, bool is) {
    lost += is;
    pairs += is && last;
    last = is;
  });
  EXPECT_NEAR(lost / 3e5, 0.3, 0.005);
  EXPECT_NEAR(pairs / 3e5, 0.09, 0.005);
}

TEST(Losses, OfBurstsHaveTheirShareAndLength) {
  for (const double loss : {0.1, 0.3, 0.6})
    for (const double burst_s : {0.3, 2.0}) {
      Scenario s = with_radio(RadioModel::Model::bursts);
      s.radio.burst_s = burst_s;
      const Losses losses(s);
      int lost = 0;
      int bursts = 0;
      bool last = false;
      each_packet(losses, loss, 1.0, [&](std::uint64_t /*pair*/, std::uint64_t t, bool is) {
        lost += is;
        bursts += is && !(last && t > 0);
        last = is;
      });
      const double sigma = std::sqrt(loss * (1.0 - loss) * 2.0 * burst_s / 0.1 / 3e5);
      EXPECT_NEAR(lost / 3e5, loss, 5.0 * sigma) << loss << " " << burst_s;
      EXPECT_NEAR(static_cast<double>(lost) / bursts * 0.1, burst_s, 0.08 * burst_s) << loss << " " << burst_s;
    }
  const Losses losses(with_radio(RadioModel::Model::bursts));
  EXPECT_FALSE(losses.lost(1, 2, 5, {}, 0.0));
  EXPECT_TRUE(losses.lost(1, 2, 5, {}, 1.0));
}

TEST(Losses, GrowWithTheDistanceAsTheCurveSays) {
  Scenario s = with_radio(RadioModel::Model::path_loss);
  s.radio.shadowing_db = 0.0;
  s.radio.edge_loss = 0.4;
  const Losses losses(s);
  const double at_edge = -1.28 * std::log(2.0 * (1.0 - std::pow(0.6, 1.0 / 800.0)));
  for (const double distance_m : {0.5, 1.5, 1.8, 1.9, 1.95, 2.0}) {
    int lost = 0;
    each_packet(losses, 0.0, distance_m, [&](std::uint64_t /*pair*/, std::uint64_t /*t*/, bool is) { lost += is; });
    const double received = std::pow(1.0 - 0.5 * std::exp(-at_edge * std::pow(2.0 / distance_m, 3.0) / 1.28), 800.0);
    EXPECT_NEAR(lost / 3e5, 1.0 - received, 0.005) << distance_m;
  }
}

TEST(Losses, ByShadowingAreThoseOfThePairAndChangeInTime) {
  Scenario s = with_radio(RadioModel::Model::path_loss);
  s.radio.shadowing_db = 8.0;
  const auto share = [&](const Losses& losses, std::uint64_t to, std::uint64_t from, std::uint64_t begin) {
    int lost = 0;
    for (std::uint64_t t = begin; t < begin + 10; ++t) lost += losses.lost(to, from, t, {1.6, 0.0}, 0.0);
    return lost;
  };
  const Losses losses(s);
  int unlike_reverse = 0;
  int unlike_later = 0;
  int unlike_other = 0;
  for (std::uint64_t pair = 0; pair < 200; ++pair) {
    const int here = share(losses, pair, 1000 + pair, 0);
    unlike_reverse += std::abs(here - share(losses, 1000 + pair, pair, 0)) > 5;
    unlike_later += std::abs(here - share(losses, pair, 1000 + pair, 1000)) > 5;
    unlike_other += std::abs(here - share(losses, pair, 2000 + pair, 0)) > 5;
  }
  EXPECT_LT(unlike_reverse, 6);
  EXPECT_GT(unlike_later, 40);
  EXPECT_GT(unlike_other, 40);
  s.radio.shadowing_s = 0.0;
  const Losses constant(s);
  int changed = 0;
  for (std::uint64_t pair = 0; pair < 200; ++pair)
    changed += std::abs(share(constant, pair, 1000 + pair, 0) - share(constant, pair, 1000 + pair, 1000)) > 5;
  EXPECT_LT(changed, 6);
}

TEST(Losses, OneWayPairsAreDeafInOneDirectionForGood) {
  Scenario s = with_radio(RadioModel::Model::one_way);
  s.radio.one_way_share = 0.25;
  const Losses losses(s);
  int one_way = 0;
  for (std::uint64_t i = 0; i < 200; ++i)
    for (std::uint64_t j = 0; j < i; ++j) {
      const bool there = losses.lost(i, j, 7, {1.0, 0.0}, 0.0);
      const bool back = losses.lost(j, i, 7, {1.0, 0.0}, 0.0);
      EXPECT_FALSE(there && back);
      EXPECT_EQ(there, losses.lost(i, j, 700, {1.9, 0.0}, 0.0));
      EXPECT_EQ(losses.is_deaf(i, j), there);
      EXPECT_EQ(losses.is_deaf(j, i), back);
      one_way += there || back;
    }
  EXPECT_NEAR(one_way / 19900.0, 0.25, 0.015);
}

TEST(Losses, NobodyIsDeafWithOtherRadios) {
  for (const auto model : {RadioModel::Model::disc, RadioModel::Model::bursts, RadioModel::Model::path_loss}) {
    Scenario s = with_radio(model);
    s.radio.one_way_share = 1.0;
    EXPECT_FALSE(Losses(s).is_deaf(0, 1));
  }
}

// The world hands its packets to the model: of those that links carry so many arrive.
TEST(Losses, CountInAWorldWithAndWithoutClocks) {
  for (const bool clocks : {false, true}) {
    Scenario s = with_radio(RadioModel::Model::one_way);
    s.swarm.robots = 30;
    s.radio.one_way_share = 0.5;
    s.clocks.asynchronous = clocks;
    for (std::size_t i = 0; i < 30; ++i) s.events.push_back({.action = Freeze{i}});
    World world(s);
    run_until(world, 50);
    std::size_t links = 0;
    for (std::size_t i = 0; i < 30; ++i) links += world.links(i).size();
    EXPECT_NEAR(static_cast<double>(world.packets_received()) / (49.5 * static_cast<double>(links)), 0.75, 0.06);
  }
}

}  // namespace
}  // namespace banyan::world
