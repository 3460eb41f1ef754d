// SPDX-License-Identifier: MIT
// Algorithms of other authors in whole worlds: what they promise to keep joins all robots, and their missions end.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "banyan/world/threads.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

// Parts that the links make which both ends say they keep, counted by plain search.
std::size_t parts_by_kept_links(const World& world) {
  const auto reports = world.reports();
  const auto has = [&](std::size_t i, std::size_t j) {
    return world.alive()[i] && world.alive()[j] && keeps(reports[i], static_cast<RobotId>(j));
  };
  std::vector<std::size_t> part(world.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < world.size(); ++i)
      for (std::size_t j = 0; j < world.size(); ++j)
        if (part[j] > part[i] && has(i, j) && has(j, i)) {
          part[j] = part[i];
          changed = true;
        }
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < world.size(); ++i) count += part[i] == i && world.alive()[i] ? 1 : 0;
  return count;
}

// Of C: in trying(), what is left is for links that are stretched by who knows it late.
constexpr double longest = 0.85;

// Parts of the living that no link is left between which a robot would make: 5 % shorter than the longest that it
// keeps.
std::size_t parts_in_reach(const World& world) {
  const double reach_m = 0.95 * longest * world.scenario().radio.range_m;
  std::vector<std::size_t> todo, parts(world.size(), 0);
  std::size_t count = 0;
  for (std::size_t first = 0; first < world.size(); ++first) {
    if (!world.alive()[first] || parts[first] != 0) continue;
    parts[first] = ++count;
    for (todo = {first}; !todo.empty();) {
      const std::size_t i = todo.back();
      todo.pop_back();
      for (const std::uint32_t j : world.links(i))
        if (parts[j] == 0 && distance(world.positions()[i], world.positions()[j]) < reach_m) {
          parts[j] = count;
          todo.push_back(j);
        }
    }
  }
  return count;
}

// Clocks that run apart, packets that come late or not at all, long ticks. What a designer has to fit to that is: how
// long a neighbour may be silent, how far and how fast a link may be stretched by who knows its length late, and how
// long a tree takes.
Scenario trying(const std::string& algorithm, std::uint64_t seed) {
  Scenario s = ring(algorithm, 14 + seed % 7, 2 + seed % 3, 2.5 + 0.5 * static_cast<double>(seed % 3), seed);
  constexpr double ticks_s[] = {0.1, 0.05, 0.2, 0.15};
  s.tick_s = ticks_s[seed % 4];
  s.radio.loss = 0.1 * static_cast<double>(seed % 4);
  s.radio.latency_ticks = 1 + static_cast<int>(seed / 2 % 3);
  s.clocks.asynchronous = seed % 3 != 0;
  s.clocks.drift = s.clocks.asynchronous ? 0.1 : 0.0;
  const double late_rounds = s.radio.latency_ticks + 1;
  const double late_s = s.tick_s * late_rounds;
  const double drive_s = s.radio.range_m / s.robot.wheel_limit_m_s;
  s.mission.parameters = {{"liveness_rounds", 20.0 + late_rounds},
                          {"guard_rate", std::min(1.0, 0.2 / late_s) * drive_s},
                          {"build_rounds", 25.0 / s.tick_s + 100.0 * late_rounds},
                          {"longest_link", longest}};
  return s;
}
std::uint64_t worlds(std::uint64_t few, std::uint64_t many) { return long_search() ? many : few; }
void run_for(World& world, double seconds) {
  run_until(world, world.tick() + static_cast<std::uint64_t>(seconds / world.scenario().tick_s));
}

// All in the list that are not over the tree.
std::vector<std::string> baselines() {
  std::vector<std::string> names;
  for (const Algorithm* algorithm : algorithms())
    if (algorithm != &outwards() && algorithm != &inwards() && algorithm != &convoy())
      names.emplace_back(algorithm->name());
  return names;
}
class Baseline : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, Baseline, testing::ValuesIn(baselines()));
// Of those that promise to keep links, which Fiedler control and cohesive control do not.
class KeptLinks : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, KeptLinks, testing::Values("link-consensus", "mst"));

TEST_P(KeptLinks, WhatIsKeptJoinsAllAndNoKeptLinkOutgrowsTheRadio) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scenario s = ring(GetParam(), 14 + 3 * seed, 2 + seed % 3, 3.0, seed);
    s.radio.loss = seed % 2 == 0 ? 0.2 : 0.0;
    World world(s);
    run_until(world, 100);  // the first links and the first tree
    while (world.tick() < 500) {
      world.step();
      ASSERT_EQ(parts_by_kept_links(world), 1U) << GetParam() << ", seed " << seed << ", tick " << world.tick();
      for (std::size_t i = 0; i < world.size(); ++i)
        for (const RobotId other : world.reports()[i].kept)
          if (other != nobody) {
            ASSERT_LT(distance(world.positions()[i], world.positions()[other]), s.radio.range_m)
                << seed << ", tick " << world.tick();
          }
    }
  }
}

TEST_P(Baseline, ReachesTargetsThatAreNear) {
  World world(ring(GetParam(), 24, 3, 3.0, 7));
  while (world.tick() < 1500 && !all_held(world)) world.step();
  EXPECT_TRUE(all_held(world));
  EXPECT_GT(world.tick(), 100U) << "faster than wheels";
}

// Whatever clocks, delays and missions do, nobody is let go while all live.
TEST_P(KeptLinks, NobodyIsLostWhileAllLive) {
  for (std::uint64_t seed = 1; seed <= worlds(8, 200); ++seed) {
    const Scenario s = trying(GetParam(), seed);
    World world(s);
    run_for(world, 10.0 + 200.0 * s.tick_s * s.radio.latency_ticks);  // the first links and the first tree
    for (int change = 0; change < 3; ++change) {
      const double angle = 1.3 * static_cast<double>(seed + static_cast<std::uint64_t>(change));
      const Vec2 place = unit_vector(angle) * 2.5;
      if (change == 0) world.intervene({.action = MoveTarget{0, place, 0.1}});
      if (change == 1) world.intervene({.action = AddTarget{place}});
      if (change == 2) world.intervene({.action = RemoveTarget{1}});
      for (double until_s = world.time_s() + 20.0; world.time_s() < until_s;) {
        world.step();
        ASSERT_EQ(parts_by_kept_links(world), 1U) << GetParam() << ", seed " << seed << ", " << world.time_s() << " s";
      }
    }
  }
}

// All the living in reach of one another believe in one living root.
bool has_its_root(const World& world) {
  for (std::size_t i = 0; i < world.size(); ++i) {
    const RobotId root = world.reports()[i].root;
    if (world.alive()[i] && (root == nobody || !world.alive()[root])) return false;
  }
  return true;
}

// Who dies takes links along. Those who are left and within reach of one another are one again soon.
TEST_P(KeptLinks, TheLivingWithinReachBecomeOneAgain) {
  std::size_t harm = 0;
  for (std::uint64_t seed = 1; seed <= worlds(6, 100); ++seed) {
    Scenario s = trying(GetParam(), seed);
    s.swarm.robots = 24;
    s.robot.dead_bodies = false;
    World world(s);
    run_for(world, 30.0);
    world.intervene({.action = Kill{.of = seed % 2 == 0 ? Kill::Of::robots : Kill::Of::root}});
    world.intervene({.action = Kill{.of = Kill::Of::robots, .count = 4, .every_s = 0.7}});
    const double end_s = world.time_s() + 60.0 + 250.0 * s.tick_s * s.radio.latency_ticks;
    for (; world.time_s() < end_s; world.step()) harm += parts_by_kept_links(world) > 1 || !has_its_root(world) ? 1 : 0;
    EXPECT_EQ(world.deaths(), 5U);
    EXPECT_LE(parts_by_kept_links(world), parts_in_reach(world)) << GetParam() << ", seed " << seed;
    if (parts_in_reach(world) == 1) { EXPECT_TRUE(has_its_root(world)) << GetParam() << ", seed " << seed; }
  }
  EXPECT_GT(harm, 0U) << "no death was of consequence";
}

TEST_P(Baseline, TheSameWorldIsTheSameOnAnyNumberOfThreads) {
  for (std::uint64_t seed = 1; seed <= worlds(3, 40); ++seed) {
    Scenario s = trying(GetParam(), seed);
    s.swarm.robots = 40;
    s.events = {{.time_s = 4.0, .action = Kill{.count = 3}}, {.time_s = 6.0, .action = SetLoss{0.4}}};
    expect_the_same_on_any_number_of_threads(s, 120, GetParam() + ", seed " + std::to_string(seed));
  }
}

TEST_P(Baseline, TheSameWorldTwiceIsTheSame) {
  World a(hostile(GetParam(), 20, 3));
  World b(a);
  run_until(a, 150);
  run_until(b, 150);
  EXPECT_EQ(a.hash(), b.hash());
}

bool stays_connected(const Scenario& scenario, std::uint64_t ticks) {
  World world(scenario);
  while (world.tick() < ticks) {
    world.step();
    if (parts_by_range(world) > 1) return false;
  }
  return true;
}

// Near targets it reaches in one piece. Workers that set out at full speed before there is an estimate are out of range
// before anybody has noticed (docs/baselines.md).
TEST(FiedlerControl, CutsNoSmallNetworkUnlessWorkersDoNotWaitForTheEstimate) {
  int cut = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scenario s = ring("fiedler", 18, 3, 3.0, seed);
    EXPECT_TRUE(stays_connected(s, 900)) << seed;
    s.mission.parameters = {{"target_gain", 1.0}, {"settling_rounds", 0.0}};
    cut += stays_connected(s, 900) ? 0 : 1;
  }
  EXPECT_GT(cut, 3) << "the page says otherwise";
}

}  // namespace
}  // namespace banyan::world
