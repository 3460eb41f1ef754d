// SPDX-License-Identifier: MIT
// Events do what they say, at the tick they say.
#include <gtest/gtest.h>

#include <algorithm>

#include "worlds.hpp"

namespace banyan::world {
namespace {

Event event(double time_s, const Action& action) { return {.time_s = time_s, .action = action}; }

TEST(Events, TheDeadFallSilentAndStayWhereTheyAre) {
  Scenario s = ring("outwards", 16, 2, 4.0, 1);
  s.events = {event(3.0, Die{5})};
  World world(s);
  for (int t = 0; t < 30; ++t) world.step();
  EXPECT_EQ(world.alive()[5], 1);
  const Vec2 here = world.positions()[5];
  const std::vector<std::uint8_t> last_words = said(world, 5);
  for (int t = 0; t < 40; ++t) {
    world.step();
    EXPECT_EQ(world.alive()[5], 0);
    EXPECT_TRUE(world.links(5).empty());
    EXPECT_EQ(said(world, 5), last_words) << "at tick " << world.tick();
    for (std::size_t i = 0; i < world.size(); ++i) {
      const auto links = world.links(i);
      EXPECT_FALSE(std::binary_search(links.begin(), links.end(), 5U));
      const Neighbors& table = neighbors_of(world.swarm(), i);
      const int k = table.find(5);
      EXPECT_TRUE(i == 5 || k < 0 || table.age(k) > t) << i;
    }
  }
  EXPECT_LT(distance(world.positions()[5], here), 0.05) << "others may push it, no more";
  EXPECT_EQ(std::count(world.alive().begin(), world.alive().end(), 0), 1);
}

TEST(Events, AFrozenRobotTalksButDoesNotMove) {
  Scenario s = ring("outwards", 16, 2, 4.0, 1);
  s.swarm.start.pitch_m = 0.8;  // nobody is pushed
  World probe(s);
  const std::size_t worker = probe.targets()[0].worker;
  s.events = {event(2.0, Freeze{worker, 3.0})};
  World world(s);
  for (int t = 0; t < 20; ++t) world.step();
  const Vec2 here = world.positions()[worker];
  for (int t = 0; t < 30; ++t) {
    world.step();
    ASSERT_EQ(world.positions()[worker], here) << t;
    ASSERT_EQ(world.alive()[worker], 1);
    ASSERT_FALSE(world.links(worker).empty());
  }
  for (int t = 0; t < 20; ++t) world.step();
  EXPECT_GT(distance(world.positions()[worker], here), 0.01) << "it thaws after 3 s";
}

TEST(Events, WithoutDurationARobotStaysFrozen) {
  Scenario s = ring("outwards", 16, 2, 4.0, 1);
  s.swarm.start.pitch_m = 0.8;
  const std::size_t worker = World(s).targets()[0].worker;
  s.events = {event(2.0, Freeze{worker})};
  World world(s);
  for (int t = 0; t < 20; ++t) world.step();
  const Vec2 here = world.positions()[worker];
  for (int t = 0; t < 200; ++t) world.step();
  EXPECT_EQ(world.positions()[worker], here);
}

// A root that cannot move goes on talking. Those that can reach the targets without it, in one piece with it.
TEST(Events, ARootThatIsFrozenDoesNotKeepTheOthersFromTheirTargets) {
  Scenario s = ring("convoy", 9, 2, 9.0, 3);
  s.targets = std::vector<Vec2>{{9.0, 2.0}, {9.0, -2.0}};
  std::size_t root = 0;
  {
    World probe(s);
    for (int t = 0; t < 10; ++t) probe.step();
    while (probe.reports()[root].role != Role::root) ++root;
  }
  for (const double frozen_s : {1.0, 20.0}) {
    s.events = {event(frozen_s, Freeze{root})};
    World world(s);
    for (int t = 0; t < 1500; ++t) world.step();
    for (const Target& target : world.targets())
      EXPECT_LT(distance(world.positions()[target.worker], target.position), target_tolerance_m(s)) << frozen_s;
    EXPECT_LT(norm(world.positions()[root]), 6.0);
    EXPECT_FALSE(world.links(root).empty());
  }
}

// Six cannot; but nobody leaves the others for that, however often the role is handed over.
TEST(Events, TooFewRobotsAndAFrozenRootStayInOnePiece) {
  Scenario s = ring("convoy", 6, 2, 9.0, 3);
  s.targets = std::vector<Vec2>{{9.0, 2.0}, {9.0, -2.0}};
  s.events = {event(1.0, Freeze{5})};
  World world(s);
  for (int t = 0; t < 1500; ++t) {
    world.step();
    std::vector<std::uint8_t> reached(world.size(), 0);
    std::vector<std::size_t> open{0};
    reached[0] = 1;
    while (!open.empty()) {
      const auto links = world.links(open.back());
      open.pop_back();
      for (const std::uint32_t i : links)
        if (reached[i]++ == 0) open.push_back(i);
    }
    ASSERT_EQ(std::count(reached.begin(), reached.end(), 0), 0) << "at tick " << t;
  }
}

TEST(Events, LossChangesAtItsTime) {
  Scenario s = ring("outwards", 20, 2, 4.0, 1);
  s.events = {event(1.0, SetLoss{1.0}), event(2.0, SetLoss{0.0})};
  World world(s);
  for (int t = 0; t < 10; ++t) world.step();
  const std::uint64_t before = world.packets_received();
  EXPECT_GT(before, 0U);
  for (int t = 0; t < 10; ++t) world.step();
  EXPECT_EQ(world.packets_received(), before);
  world.step();
  std::size_t links = 0;
  for (std::size_t i = 0; i < world.size(); ++i) links += world.links(i).size();
  EXPECT_EQ(world.packets_received(), before + links);
}

TEST(Events, ATargetMovesAndItsWorkerFollows) {
  Scenario s = ring("inwards", 14, 2, 2.0, 1);
  s.events = {event(2.0, MoveTarget{1, {0.5, -2.5}, 0.0})};
  World world(s);
  for (int t = 0; t < 20; ++t) world.step();
  EXPECT_NEAR(norm(world.targets()[1].position), 2.0, 1e-9);
  world.step();
  EXPECT_EQ(world.targets()[1].position, (Vec2{0.5, -2.5}));
  for (int t = 0; t < 900; ++t) world.step();
  EXPECT_LT(distance(world.positions()[world.targets()[1].worker], world.targets()[1].position), 0.3);
}

TEST(Events, ANewTargetGoesToTheNearestSpare) {
  Scenario s = ring("outwards", 20, 2, 2.0, 1);
  const Vec2 where{0.3, 2.4};
  s.events = {event(1.0, AddTarget{where})};
  World world(s);
  for (int t = 0; t < 10; ++t) world.step();
  ASSERT_EQ(world.targets().size(), 2U);
  std::size_t expected = world.size();
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (world.reports()[i].role != Role::spare) continue;
    if (expected == world.size() ||
        distance(world.positions()[i], where) < distance(world.positions()[expected], where))
      expected = i;
  }
  ASSERT_LT(expected, world.size());
  world.step();
  ASSERT_EQ(world.targets().size(), 3U);
  EXPECT_EQ(world.targets()[2].position, where);
  EXPECT_EQ(world.targets()[2].worker, expected);
  EXPECT_TRUE(is_worker(world.swarm(), expected));
  EXPECT_EQ(world.reports()[expected].role, Role::worker);
}

TEST(Events, WithNobodyLeftANewTargetIsNotAssigned) {
  Scenario s = ring("outwards", 4, 2, 1.5, 1);
  const World probe(s);
  std::size_t free_robot = 0;
  while (is_worker(probe.swarm(), free_robot) || probe.reports()[free_robot].role == Role::root) ++free_robot;
  s.events = {event(0.2, Die{free_robot}), event(0.5, AddTarget{{0.0, 1.0}})};
  World world(s);
  for (int t = 0; t < 10; ++t) world.step();
  EXPECT_EQ(world.targets().size(), 2U);
}

TEST(Events, EqualTimesActInFileOrderAndOrderInTheFileDoesNotMatterOtherwise) {
  Scenario s = ring("outwards", 16, 2, 4.0, 1);
  s.events = {event(2.0, MoveTarget{0, {1, 1}, 0.0}), event(1.0, Die{3}), event(2.0, MoveTarget{0, {2, 2}, 0.0})};
  World world(s);
  for (int t = 0; t < 11; ++t) world.step();
  EXPECT_EQ(world.alive()[3], 0);
  for (int t = 0; t < 10; ++t) world.step();
  EXPECT_EQ(world.targets()[0].position, (Vec2{2, 2}));
}

TEST(Events, AnEventAtTimeZeroActsBeforeTheFirstTick) {
  Scenario s = ring("outwards", 16, 2, 4.0, 1);
  s.events = {event(0.0, Die{2})};
  World world(s);
  world.step();
  EXPECT_EQ(world.alive()[2], 0);
  world.step();
  EXPECT_EQ(world.packets_sent(), 15U);
}

TEST(Events, InABlackoutNobodyHearsAnything) {
  for (const int latency : {1, 3}) {
    Scenario s = ring("outwards", 20, 2, 4.0, 1);
    s.radio.latency_ticks = latency;
    s.events = {event(1.0, Blackout{0.7})};
    World world(s);
    for (int t = 0; t < 10; ++t) world.step();
    const std::uint64_t before = world.packets_received();
    EXPECT_GT(before, 0U);
    // What was sent within it is lost, too.
    for (int t = 0; t < 7 + latency - 1; ++t) {
      world.step();
      ASSERT_EQ(world.packets_received(), before) << t;
    }
    world.step();
    EXPECT_GT(world.packets_received(), before);
  }
}

TEST(Events, AnInterruptedBlackoutIsInTheHash) {
  Scenario s = ring("outwards", 20, 2, 4.0, 1);
  s.events = {event(1.0, Blackout{0.7})};
  World a(s);
  s.events[0] = event(1.0, Blackout{0.8});
  World b(s);
  for (int t = 0; t < 12; ++t) {
    a.step();
    b.step();
  }
  EXPECT_NE(a.hash(), b.hash());
}

TEST(Events, ATargetDrivesInAStraightLineAtItsSpeed) {
  Scenario s = ring("inwards", 14, 2, 2.0, 1);
  const Vec2 goal{0.5, -2.5};
  s.events = {event(2.0, MoveTarget{1, goal, 0.15})};
  World world(s);
  const Vec2 from = world.targets()[1].position;
  const double way = distance(from, goal);
  for (int t = 0; t < 400; ++t) {
    world.step();
    const double gone = std::clamp(0.015 * (t - 20), 0.0, way);
    const Vec2 expected = from + (goal - from) * (gone / way);
    ASSERT_LT(distance(world.targets()[1].position, expected), 1e-9) << t;
    ASSERT_NEAR(norm(world.targets()[0].position), 2.0, 1e-9);
  }
  EXPECT_EQ(world.targets()[1].position, goal);
}

TEST(Events, AJumpEndsADrive) {
  Scenario s = ring("inwards", 14, 2, 2.0, 1);
  s.events = {event(1.0, MoveTarget{1, {0.5, -2.5}, 0.1}), event(2.0, MoveTarget{1, {1.0, 1.0}, 0.0})};
  World world(s);
  for (int t = 0; t < 40; ++t) world.step();
  EXPECT_EQ(world.targets()[1].position, (Vec2{1.0, 1.0}));
}

TEST(Events, ATargetThatIsGivenUpHasNoWorkerAnyMore) {
  Scenario s = ring("inwards", 14, 2, 2.0, 1);
  s.events = {event(3.0, RemoveTarget{1})};
  World world(s);
  const std::size_t worker = world.targets()[1].worker;
  for (int t = 0; t < 30; ++t) world.step();
  EXPECT_TRUE(world.targets()[1].active);
  EXPECT_TRUE(is_worker(world.swarm(), worker));
  world.step();
  EXPECT_FALSE(world.targets()[1].active);
  EXPECT_TRUE(world.targets()[0].active);
  EXPECT_FALSE(is_worker(world.swarm(), worker));
  EXPECT_EQ(world.reports()[worker].serves, nobody);
  EXPECT_NE(world.reports()[worker].role, Role::worker);
  for (int t = 0; t < 300; ++t) {
    world.step();
    ASSERT_FALSE(world.holder(1)) << t;
  }
}

TEST(Events, WhoeverGaveUpATargetCanBeSentToAnother) {
  Scenario s = ring("inwards", 3, 2, 2.0, 1);  // nobody else is left: the third is root
  s.events = {event(1.0, RemoveTarget{1}), event(2.0, AddTarget{{0.0, 1.0}})};
  World world(s);
  const std::size_t worker = world.targets()[1].worker;
  for (int t = 0; t < 21; ++t) world.step();
  ASSERT_EQ(world.targets().size(), 3U);
  EXPECT_EQ(world.targets()[2].worker, worker);
  EXPECT_EQ(world.reports()[worker].serves, worker);
}

// Whatever their bodies, radio and sensors: those who are to join later change nothing before.
TEST(Join, UntilThenTheRobotIsNotThere) {
  for (const BodyModel body : {BodyModel::disks, BodyModel::box2d, BodyModel::linear}) {
    if (body == BodyModel::box2d && !has_box2d()) continue;
    Scenario s = ring("convoy", 12, 2, 4.0, 3);
    s.robot.body = body;
    s.radio.line_of_sight = true;
    s.events = {event(2.0, Die{4})};
    World without(s);
    s.events.push_back(event(3.0, Join{12, {0.0, -2.0}}));
    World with(s);
    for (int t = 0; t < 30; ++t) {
      without.step();
      with.step();
      ASSERT_EQ(with.arrived(), 12U);
      ASSERT_EQ(with.alive()[12], 0);
      for (std::size_t i = 0; i < 12; ++i) {
        ASSERT_EQ(with.positions()[i], without.positions()[i]) << i << " at tick " << t;
        ASSERT_EQ(said(with, i), said(without, i)) << i << " at tick " << t;
      }
    }
    EXPECT_EQ(with.packets_sent(), without.packets_sent());
    with.step();
    EXPECT_EQ(with.arrived(), 13U);
    EXPECT_EQ(with.alive()[12], 1);
    EXPECT_FALSE(with.links(12).empty());
    EXPECT_LT(distance(with.positions()[12], {0.0, -2.0}), 0.05);
    EXPECT_EQ(with.deaths(), 1U);
  }
}

TEST(Join, MakesASpareThatTakesPart) {
  for (const char* algorithm : {"outwards", "inwards", "convoy", "caravan"}) {
    for (const bool clocks : {false, true}) {
      Scenario s = ring(algorithm, 9, 2, 2.5, 5);
      s.clocks.asynchronous = clocks;
      s.events = {event(1.0, Join{9, {0.0, -1.5}})};
      World world(s);
      for (int t = 0; t < 15; ++t) world.step();
      EXPECT_EQ(world.reports()[9].role, Role::spare) << algorithm;
      bool held = false;
      for (int t = 0; t < 3000 && !held; ++t) {
        world.step();
        held = world.holder(0) && world.holder(1);
        ASSERT_FALSE(world.links(9).empty()) << algorithm << " at tick " << t;
      }
      EXPECT_TRUE(held) << algorithm;
    }
  }
}

TEST(Join, WhoHasDiedMayComeBackAndKnowsNothing) {
  for (const bool bodies_stay : {true, false}) {
    for (const BodyModel body : {BodyModel::disks, BodyModel::box2d, BodyModel::linear}) {
      if (body == BodyModel::box2d && !has_box2d()) continue;
      Scenario s = ring("convoy", 12, 2, 4.0, 3);
      s.robot.body = body;
      s.robot.dead_bodies = bodies_stay;
      const std::size_t worker = World(s).targets()[0].worker;
      s.events = {event(4.0, Die{worker}), event(6.0, Join{worker, {0.0, -1.0}})};
      World world(s);
      const std::vector<std::uint8_t> first_words = said(world, worker);
      for (int t = 0; t < 60; ++t) world.step();
      EXPECT_EQ(world.alive()[worker], 0);
      EXPECT_NE(said(world, worker), first_words);
      world.step();
      EXPECT_EQ(world.alive()[worker], 1);
      EXPECT_EQ(world.reports()[worker].role, Role::spare);
      EXPECT_EQ(world.reports()[worker].serves, nobody);
      EXPECT_LT(distance(world.positions()[worker], {0.0, -1.0}), 0.05);
      EXPECT_FALSE(world.links(worker).empty());
      const Vec2 here = world.positions()[worker];
      for (int t = 0; t < 100; ++t) world.step();
      EXPECT_GT(distance(world.positions()[worker], here), 0.0) << "it has a body that moves";
      EXPECT_EQ(world.arrived(), 12U);
    }
  }
}

TEST(Join, OfARobotThatIsThereChangesNothing) {
  Scenario s = ring("convoy", 9, 2, 3.0, 3);
  World plain(s);
  s.events = {event(2.0, Join{4, {0.0, -1.0}})};
  World world(s);
  for (int t = 0; t < 40; ++t) {
    plain.step();
    world.step();
  }
  for (std::size_t i = 0; i < world.size(); ++i) EXPECT_EQ(world.positions()[i], plain.positions()[i]);
}

}  // namespace
}  // namespace banyan::world
