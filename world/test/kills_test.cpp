// SPDX-License-Identifier: MIT
// Deaths drawn by seed: how many, who, when; and events that wait for a moment of the mission.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "banyan/world/threads.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

Event kill(double time_s, const Kill& whom = {}) { return {.time_s = time_s, .action = whom}; }
Event kill_at(Event::When moment, double time_s, const Kill& whom = {}) { return {time_s, moment, whom}; }

std::set<std::size_t> dead(const World& world) {
  std::set<std::size_t> list;
  for (std::size_t i = 0; i < world.size(); ++i)
    if (world.alive()[i] == 0) list.insert(i);
  return list;
}

std::set<std::size_t> with_role(const World& world, Role role) {
  std::set<std::size_t> list;
  for (std::size_t i = 0; i < world.size(); ++i)
    if (world.alive()[i] != 0 && world.reports()[i].role == role) list.insert(i);
  return list;
}

bool includes(const std::set<std::size_t>& all, const std::set<std::size_t>& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

TEST(Kills, AShareOfAllIsRoundedAndDrawnAtOnce) {
  for (const auto& [share, expected] :
       std::map<double, std::size_t>{{0.0, 0}, {0.09, 1}, {0.33, 5}, {0.5, 8}, {1.0, 16}}) {
    Scenario s = ring("outwards", 16, 2, 3.0, 1);
    s.events = {kill(1.0, {.share = share})};
    World world(s);
    run_until(world, 10);
    EXPECT_EQ(world.deaths(), 0U);
    EXPECT_TRUE(world.pending_kills());
    EXPECT_FALSE(world.last_death_tick());
    world.step();
    EXPECT_EQ(dead(world).size(), expected) << share;
    EXPECT_EQ(world.deaths(), expected);
    EXPECT_FALSE(world.pending_kills());
    EXPECT_EQ(world.last_death_tick().value_or(99), expected > 0 ? 10U : 99U);
  }
}

TEST(Kills, TakeTheRoleTheyName) {
  const std::map<Kill::Of, Role> roles{
      {Kill::Of::connectors, Role::connector}, {Kill::Of::root, Role::root}, {Kill::Of::worker, Role::worker}};
  for (const auto& [of, role] : roles) {
    Scenario s = ring("inwards", 20, 3, 4.0, 2);
    s.events = {kill(12.0, {.of = of, .share = 0.5})};
    World world(s);
    run_until(world, 120);
    const auto before = with_role(world, role);
    ASSERT_FALSE(before.empty());
    world.step();
    EXPECT_TRUE(includes(before, dead(world)));
    EXPECT_EQ(dead(world).size(), static_cast<std::size_t>(std::floor(0.5 * static_cast<double>(before.size()) + 0.5)));
  }
}

TEST(Kills, WithoutANumberOneDies) {
  Scenario s = ring("outwards", 16, 2, 3.0, 1);
  s.events = {kill(1.0)};
  World world(s);
  run_until(world, 20);
  EXPECT_EQ(world.deaths(), 1U);
}

TEST(Kills, MoreThanThereAreIsAllOfThem) {
  Scenario s = ring("outwards", 16, 3, 3.0, 1);
  s.events = {kill(1.0, {.of = Kill::Of::worker, .count = 10})};
  World world(s);
  run_until(world, 10);
  const auto workers = with_role(world, Role::worker);
  world.step();
  EXPECT_EQ(dead(world), workers);
  EXPECT_FALSE(world.pending_kills());
}

TEST(Kills, OneByOneTheyDieInTurnsAndTheirNumberIsThatOfTheBegin) {
  Scenario s = ring("outwards", 20, 2, 3.0, 1);
  s.events = {kill(2.0, {.share = 0.2, .every_s = 1.5})};
  World world(s);
  for (int t = 0; t < 100; ++t) {
    // 4 of 20, at 2.0, 3.5, 5.0 and 6.5 s
    const std::size_t due = t < 20 ? 0 : std::min(4, 1 + (t - 20) / 15);
    world.step();
    ASSERT_EQ(world.deaths(), due) << t;
    ASSERT_EQ(dead(world).size(), due) << t;
    EXPECT_EQ(world.pending_kills(), due < 4) << t;
  }
  EXPECT_EQ(world.last_death_tick(), 65U);
}

TEST(Kills, AWorkerTakesItsParentAlong) {
  Scenario s = ring("inwards", 20, 3, 4.0, 2);
  s.events = {kill(12.0, {.of = Kill::Of::worker_and_parent})};
  World world(s);
  run_until(world, 120);
  std::set<std::set<std::size_t>> couples;
  for (const std::size_t w : with_role(world, Role::worker)) {
    const RobotId parent = up_of(world.reports()[w]);
    couples.insert(parent == nobody ? std::set{w} : std::set<std::size_t>{w, parent});
  }
  world.step();
  EXPECT_TRUE(couples.contains(dead(world)));
  EXPECT_EQ(dead(world).size(), 2U);
}

TEST(Kills, EveryRobotHasTheSameChance) {
  std::vector<int> deaths(16, 0);
  for (std::uint64_t seed = 0; seed < 1600; ++seed) {
    Scenario s = ring("outwards", 16, 2, 3.0, seed);
    s.events = {kill(0.0, {.count = 4})};
    World world(s);
    world.step();
    for (const std::size_t i : dead(world)) ++deaths[i];
  }
  // Binomial, mean 400, sigma 17.3: five sigma.
  for (const int n : deaths) EXPECT_NEAR(n, 400, 87);
}

TEST(Kills, TwoEventsOfAKindDrawApart) {
  int same = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Scenario s = ring("outwards", 32, 2, 3.0, seed);
    s.events = {kill(0.5)};
    World a(s);
    s.events = {kill(9.0), kill(0.5)};  // its place in the file is what it draws by
    World b(s);
    run_until(a, 10);
    run_until(b, 10);
    same += dead(a) == dead(b) ? 1 : 0;
  }
  EXPECT_LT(same, 8);
}

TEST(Kills, AreTheSameForAnyNumberOfThreadsAndInACopyMadeMidway) {
  Scenario s = hostile("inwards", 30, 5);
  s.events = {kill_at(Event::When::half_way, 3.0, {.of = Kill::Of::connectors, .share = 0.3, .every_s = 2.0}),
              kill(8.0, {.count = 5, .every_s = 1.0})};
  World world(s);
  World on_three(s);
  Executor three(3);
  run_until(world, 100);  // within the second kill
  ASSERT_EQ(world.deaths(), 2U);
  World copy(world);
  run_until(world, 400);
  run_until(copy, 400);
  while (on_three.tick() < 400) on_three.step(three);
  EXPECT_GT(world.deaths(), 5U);
  EXPECT_EQ(copy.hash(), world.hash());
  EXPECT_EQ(copy.deaths(), world.deaths());
  EXPECT_EQ(copy.last_death_tick(), world.last_death_tick());
  EXPECT_EQ(on_three.hash(), world.hash());
}

TEST(Kills, WhatIsStillToComeIsInTheHash) {
  Scenario s = ring("outwards", 16, 2, 3.0, 1);
  s.events = {kill(1.0, {.count = 3, .every_s = 5.0})};
  World three(s);
  s.events = {kill(1.0, {.count = 4, .every_s = 5.0})};
  World four(s);
  run_until(three, 12);
  run_until(four, 12);
  ASSERT_EQ(dead(three), dead(four));
  EXPECT_NE(three.hash(), four.hash());
}

// ---- Moments of the mission ----

double remaining(const World& world) {
  double sum = 0.0;
  for (const Target& target : world.targets()) sum += distance(world.positions()[target.worker], target.position);
  return sum;
}

TEST(Moments, HalfWayIsWhenHalfOfTheWorkersDistancesIsLeft) {
  Scenario s = ring("inwards", 20, 3, 4.0, 2);
  s.events = {kill_at(Event::When::half_way, 1.3)};
  World world(s);
  const double at_first = remaining(world);
  std::uint64_t half_way = 0;
  for (int t = 0; t < 600 && world.deaths() == 0; ++t) {
    if (half_way == 0 && remaining(world) <= 0.5 * at_first) half_way = world.tick();
    world.step();
  }
  ASSERT_GT(half_way, 10U);
  EXPECT_EQ(world.last_death_tick(), half_way + 13);
}

TEST(Moments, CompleteIsWhenAllTargetsAreHeldForTheFirstTime) {
  Scenario s = ring("inwards", 20, 3, 4.0, 2);
  s.events = {kill_at(Event::When::complete, 0.0), kill_at(Event::When::complete, 2.0)};
  World world(s);
  std::uint64_t complete = 0;
  for (int t = 0; t < 1500 && complete == 0; ++t) {
    world.step();
    bool all = true;
    for (const Target& target : world.targets())
      all = all && distance(world.positions()[target.worker], target.position) <= target_tolerance_m(s);
    if (all) complete = world.tick();
  }
  ASSERT_GT(complete, 10U);
  EXPECT_EQ(world.deaths(), 0U);
  world.step();
  EXPECT_EQ(world.deaths(), 1U);
  EXPECT_EQ(world.last_death_tick(), complete);
  EXPECT_TRUE(world.pending_kills());
  run_until(world, complete + 21);
  EXPECT_EQ(world.deaths(), 2U);
  EXPECT_FALSE(world.pending_kills());
}

TEST(Moments, ThatNeverComeLetNothingHappen) {
  Scenario s = ring("inwards", 20, 3, 4.0, 2);
  s.mission.parameters = {{"give_up_after_drives", 30.0}};
  s.events = {kill_at(Event::When::complete, 0.0), {.action = Freeze{World(s).targets()[0].worker}}};
  World world(s);
  run_until(world, 900);
  EXPECT_EQ(world.deaths(), 0U);
  EXPECT_TRUE(world.pending_kills());
}

TEST(Moments, CompleteWaitsForATreeInOnePiece) {
  Scenario s = plain_scenario();
  s.swarm.start.layout = Layout::list;
  for (int i = 0; i < 4; ++i) s.swarm.start.positions.push_back({1.1 * i, 0.0});
  s.swarm.root = 0;
  s.targets = std::vector<Vec2>{{3.3, 0.0}};  // where its worker stands
  for (std::size_t i = 0; i < 4; ++i) s.events.push_back({.action = Freeze{i}});
  s.events.push_back(kill_at(Event::When::complete, 0.0));
  World whole(s);
  run_until(whole, 200);
  EXPECT_EQ(whole.deaths(), 1U);
  s.events.insert(s.events.begin(), Event{.action = Die{1}});
  World split(s);
  run_until(split, 200);
  ASSERT_TRUE(split.holder(0));
  EXPECT_EQ(split.deaths(), 1U) << "the one by name";
  EXPECT_TRUE(split.pending_kills());
}

TEST(Moments, CompleteDoesNotWaitForATargetThatWasGivenUp) {
  Scenario s = ring("inwards", 20, 2, 3.0, 2);
  s.mission.parameters = {{"give_up_after_drives", 30.0}};
  s.events = {kill_at(Event::When::complete, 0.0),
              {.action = Freeze{World(s).targets()[1].worker}},  // the other worker never arrives, and insists
              {.time_s = 90.0, .action = RemoveTarget{1}}};
  World world(s);
  run_until(world, 901);
  EXPECT_EQ(world.deaths(), 0U);
  ASSERT_TRUE(world.holder(0));
  world.step();
  EXPECT_EQ(world.deaths(), 1U);
}

}  // namespace
}  // namespace banyan::world
