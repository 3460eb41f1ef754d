// SPDX-License-Identifier: MIT
// What somebody does to a running world is what a scenario with the same events would have brought.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

#include "banyan/world/bodies.hpp"
#include "banyan/world/obstacles.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t n) { return random() % n; }
double between(Random& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
}

constexpr BodyModel bodies[] = {BodyModel::disks, BodyModel::linear, BodyModel::box2d};

// Small, hard, and with everything that events can change.
Scenario arena(Random& random, BodyModel body) {
  const char* const algorithms[] = {"outwards", "inwards", "convoy"};
  Scenario s = ring(algorithms[below(random, 3)], 12 + below(random, 8), 2, 2.5, random());
  s.robot.body = body;
  s.robot.dead_bodies = below(random, 2) == 0;
  s.radio.line_of_sight = below(random, 2) == 0;
  s.radio.loss = below(random, 2) == 0 ? 0.0 : 0.2;
  s.robot.wheel_noise = 0.05;
  s.clocks.asynchronous = body != BodyModel::box2d && below(random, 4) == 0;
  s.radio.latency_ticks = 1 + static_cast<int>(below(random, 2));
  s.obstacles = {Disc{{-3.0, 3.0}, 0.3}, Box{{3.0, 3.0}, {0.5, 0.3}, 0.4}, Wall{{-1.0, -3.0}, {1.0, -3.2}}};
  s.events = {{.time_s = 4.0, .action = SetLoss{0.1}}, {1.0, Event::When::half_way, Kill{}}};
  s.swarm.room = 2;
  return s;
}

Action any_action(Random& random, const World& world) {
  const Vec2 position{between(random, -3.0, 3.0), between(random, -3.0, 3.0)};
  const std::size_t robot = below(random, world.size());
  const std::size_t target = below(random, world.targets().size());
  switch (below(random, std::variant_size_v<Action>)) {
    case 0: return Die{robot};
    case 1: return Freeze{robot, between(random, 0.1, 2.0)};
    case 2: return SetLoss{between(random, 0.0, 0.5)};
    case 3: return MoveTarget{target, position, below(random, 2) == 0 ? 0.0 : 0.1};
    case 4: return AddTarget{position};
    case 5:
      return Kill{.of = static_cast<Kill::Of>(below(random, 5)),
                  .count = 1 + below(random, 2),
                  .every_s = below(random, 2) == 0 ? 0.0 : 0.7};
    case 6: return Blackout{between(random, 0.1, 2.0)};
    case 7: return RemoveTarget{target};
    case 8: return SetLineOfSight{below(random, 2) == 0};
    case 9: return AddObstacle{position, between(random, 0.05, 0.4)};
    case 10: return RemoveObstacle{below(random, world.obstacles().size() + 1)};  // one more than there are
    case 11: return Join{below(random, std::min(world.arrived() + 1, world.size())), position};
    default: return MoveObstacle{below(random, world.obstacles().size() + 1), position};
  }
}
Event anything(Random& random, const World& world) {
  return {.time_s = -7.0, .action = any_action(random, world)};  // when it says is ignored
}

bool finite(const World& world) {
  for (std::size_t i = 0; i < world.size(); ++i)
    for (const Vec2 v : {world.positions()[i], world.headings()[i]})
      if (!std::isfinite(v.x) || !std::isfinite(v.y)) return false;
  return true;
}

TEST(Intervene, IsAsIfTheScenarioHadHadTheEventFromTheStart) {
  const int worlds = long_search() ? 300 : 30;
  std::size_t happened[std::variant_size_v<Action>] = {};
  for (int k = 0; k < worlds; ++k) {
    Random random(static_cast<std::uint32_t>(k));
    if (bodies[k % 3] == BodyModel::box2d && !has_box2d()) continue;
    World live(arena(random, bodies[k % 3]));
    std::vector<std::uint64_t> hashes;
    for (int t = 0; t < 120; ++t) {
      for (std::size_t times = below(random, 12) == 0 ? 1 + below(random, 3) : 0; times > 0; --times) {
        const Event event = anything(random, live);
        if (!live.faults_now(event).empty()) continue;
        const std::uint64_t before = live.hash();
        live.intervene(event);
        ASSERT_EQ(live.hash(), before) << "it has not happened yet";
        ++happened[event.action.index()];
      }
      live.step();
      hashes.push_back(live.hash());
    }
    ASSERT_TRUE(finite(live)) << k;
    World planned(live.scenario());
    for (std::size_t t = 0; t < hashes.size(); ++t) {
      planned.step();
      ASSERT_EQ(planned.hash(), hashes[t]) << "world " << k << ", tick " << t + 1;
    }
    EXPECT_EQ(planned.line_of_sight(), live.line_of_sight());
    ASSERT_EQ(planned.obstacles().size(), live.obstacles().size());
    for (std::size_t o = 0; o < live.obstacles().size(); ++o)
      EXPECT_EQ(center_of(planned.obstacles()[o]), center_of(live.obstacles()[o]));
  }
  for (std::size_t kind = 0; kind < std::variant_size_v<Action>; ++kind)
    EXPECT_GT(happened[kind], 0U) << "no event of kind " << kind;
}

TEST(Intervene, ACopyGoesOnAlikeWithObstaclesAndSightAsTheyAre) {
  for (const BodyModel body : bodies) {
    if (body == BodyModel::box2d && !has_box2d()) continue;
    Random random(7 + static_cast<unsigned>(body));
    World world(arena(random, body));
    world.intervene({.action = MoveObstacle{1, {0.4, 0.2}}});
    world.intervene({.action = AddObstacle{{-0.6, 0.3}, 0.2}});
    world.intervene({.action = RemoveObstacle{0}});
    world.intervene({.action = SetLineOfSight{!world.line_of_sight()}});
    for (int t = 0; t < 10; ++t) world.step();
    World copy(world);
    for (int t = 0; t < 40; ++t) {
      world.step();
      copy.step();
      ASSERT_EQ(copy.hash(), world.hash()) << t;
    }
  }
}

TEST(Intervene, MovesTheObstacleForBodiesRadioAndSensors) {
  for (const BodyModel body : bodies) {
    if (body == BodyModel::box2d && !has_box2d()) continue;
    Scenario s = ring("outwards", 2, 1, 3.0, 1);
    s.robot.body = body;
    s.radio.line_of_sight = true;
    s.swarm.start = {.layout = Layout::list, .positions = {{-0.5, 0.0}, {0.5, 0.0}}, .headings_rad = {0.0, 0.0}};
    s.obstacles = {Wall{{-9.0, -1.0}, {-9.0, 1.0}}, Disc{{9.0, 9.0}, 0.3}};
    World world(s);
    world.step();
    ASSERT_EQ(world.links(0).size(), 1U);
    world.intervene({.action = MoveObstacle{0, {0.0, 0.0}}});
    world.step();
    EXPECT_TRUE(world.links(0).empty()) << "the wall stands between them";
    EXPECT_EQ(world.blocked().size(), 1U);
    const Wall wall = std::get<Wall>(world.obstacles()[0]);
    EXPECT_EQ(wall.from, (Vec2{0.0, -1.0}));
    EXPECT_EQ(wall.to, (Vec2{0.0, 1.0}));
    EXPECT_EQ(std::get<Wall>(world.scenario().obstacles[0]).from, (Vec2{-9.0, -1.0})) << "where it began";

    world.intervene({.action = SetLineOfSight{false}});
    world.step();
    EXPECT_EQ(world.links(0).size(), 1U) << "the radio goes through the wall now";
    EXPECT_FALSE(world.line_of_sight());
    EXPECT_FALSE(inside(world.swarm(), [](const auto& s) { return s.params().line_of_sight; })) << "its robots know";

    world.intervene({.action = MoveObstacle{1, world.positions()[1] + Vec2{0.1, 0.0}}});
    for (int t = 0; t < 100; ++t) world.step();
    EXPECT_GT(clearance(world.obstacles()[1], world.positions()[1]), s.robot.radius_m - 0.01)
        << "it is pushed out of the disc";
  }
}

// A wall that was there and goes; a disc that stands where nothing was.
TEST(Intervene, ObstaclesComeAndGoForBodiesRadioAndSensors) {
  for (const BodyModel body : bodies) {
    if (body == BodyModel::box2d && !has_box2d()) continue;
    Scenario s = ring("outwards", 2, 1, 3.0, 1);
    s.robot.body = body;
    s.radio.line_of_sight = true;
    s.swarm.start = {.layout = Layout::list, .positions = {{-0.5, -1.5}, {0.5, -1.5}}, .headings_rad = {0.0, 0.0}};
    s.obstacles = {Wall{{0.0, -1.0}, {0.0, 1.0}}, Disc{{9.0, 9.0}, 0.3}};
    World world(s);
    world.intervene({.action = MoveObstacle{0, {0.0, -1.5}}});
    world.step();
    ASSERT_TRUE(world.links(0).empty()) << "the wall stands between them";
    world.intervene({.action = RemoveObstacle{0}});
    world.step();
    EXPECT_EQ(world.links(0).size(), 1U);
    ASSERT_EQ(world.obstacles().size(), 1U);
    EXPECT_EQ(std::get<Disc>(world.obstacles()[0]).center, (Vec2{9.0, 9.0})) << "it has moved up";
    world.intervene({.action = AddObstacle{(world.positions()[0] + world.positions()[1]) * 0.5, 0.2}});
    world.step();
    EXPECT_TRUE(world.links(0).empty()) << "the disc stands between them";
    world.intervene({.action = MoveObstacle{1, world.positions()[1] + Vec2{0.1, 0.0}}});
    for (int t = 0; t < 100; ++t) world.step();
    EXPECT_GT(clearance(world.obstacles()[1], world.positions()[1]), s.robot.radius_m - 0.01) << "it is a body, too";
    EXPECT_EQ(world.scenario().obstacles.size(), 2U) << "what it began with";
  }
}

// Exactly on their centres, where there is no direction to push in; among obstacles, where pushing out
// of one is pushing into another.
TEST(Intervene, ObstaclesMayJumpOntoRobots) {
  for (const BodyModel body : bodies) {
    if (body == BodyModel::box2d && !has_box2d()) continue;
    Scenario s = ring("convoy", 16, 2, 3.0, 3);
    s.robot.body = body;
    s.radio.line_of_sight = true;
    s.obstacles = {Disc{{-5.0, 5.0}, 0.6}, Box{{5.0, 5.0}, {1.2, 0.8}, 0.0}, Wall{{-1.0, -5.0}, {1.0, -5.0}}};
    World world(s);
    for (int t = 0; t < 60; ++t) {
      if (t % 5 == 0)
        for (std::size_t o = 0; o < 3; ++o)
          world.intervene({.action = MoveObstacle{o, world.positions()[(static_cast<std::size_t>(t) + o) % 16]}});
      world.step();
      ASSERT_TRUE(finite(world)) << t;
    }
    for (const Vec2 p : world.positions()) EXPECT_LT(norm(p), 20.0) << "nobody is shot away";
  }
}

TEST(Intervene, IsHashedWhileItLasts) {
  Scenario s = ring("outwards", 8, 2, 3.0, 1);
  s.obstacles = {Disc{{50.0, 50.0}, 0.6}};
  World a(s);
  World b(s);
  a.intervene({.action = MoveObstacle{0, {60.0, 50.0}}});
  b.intervene({.action = MoveObstacle{0, {70.0, 50.0}}});
  a.step();
  b.step();
  EXPECT_EQ(a.positions()[0], b.positions()[0]) << "nobody has met it yet";
  EXPECT_NE(a.hash(), b.hash());

  std::set<std::uint64_t> hashes;
  for (const Action& action : {Action(SetLoss{}), Action(AddObstacle{{60.0, 50.0}, 0.3}),
                               Action(AddObstacle{{60.0, 50.0}, 0.4}), Action(RemoveObstacle{0})}) {
    World world(s);
    world.intervene({.action = action});
    world.step();
    hashes.insert(world.hash());
  }
  EXPECT_EQ(hashes.size(), 4U);
}

TEST(Intervene, RefusesWhatCannotHappenInTheWordsOfFaults) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Scenario s = ring("outwards", 5, 2, 3.0, 1);
  s.obstacles = {Disc{{5.0, 5.0}, 0.6}};
  s.events = {{.time_s = 100.0, .action = SetLoss{}}};
  World world(s);
  world.step();
  const std::uint64_t before = world.hash();
  const std::pair<Event, std::string> cases[] = {
      {{.action = Die{5}}, "events[1].robot: there is no robot 5; the last one is 4"},
      {{.action = Join{6}}, "events[1].robot: the next robot to join at that time is 5; robots join in the order of"},
      {{.action = Join{5}}, "events[1].robot: there is no place for another robot; there are 5"},
      {{.action = MoveTarget{2}}, "events[1].target: there is no target 2 at that time; the last one is 1"},
      {{.action = RemoveTarget{2}}, "events[1].target: there is no target 2"},
      {{.action = MoveObstacle{1}}, "events[1].obstacle: there is no obstacle 1; the last one is 0"},
      {{.action = RemoveObstacle{1}}, "events[1].obstacle: there is no obstacle 1; the last one is 0"},
      {{.action = AddObstacle{{0.0, 5.0}, 0.0}}, "events[1].radius_m: "},
      {{.action = AddObstacle{{0.0, 5.0}, -0.3}}, "events[1].radius_m: "},
      {{.action = MoveObstacle{0, {nan, 0.0}}}, "events[1].position_m[0]: is nan; allowed: -100000000 to 100000000 m"},
      {{.action = AddTarget{{5.0, 5.0}}}, "events[1].position_m: the target at (5, 5) lies inside an obstacle"},
      {{.action = SetLoss{nan}}, "events[1].loss: is nan; allowed: 0 to 1"},
      {{.action = Blackout{}}, "events[1].duration_s: must be above 0"},
      {{.when = Event::When::complete, .action = SetLoss{}}, "events[1].when: what somebody does happens now"},
  };
  for (const auto& [event, words] : cases) {
    std::string said;
    try {
      world.intervene(event);
    } catch (const std::invalid_argument& e) { said = e.what(); }
    EXPECT_NE(said.find(words), std::string::npos) << said << "\n  wanted: " << words;
  }
  EXPECT_EQ(world.hash(), before);
  EXPECT_EQ(world.scenario().events.size(), 1U);

  world.intervene({.action = AddTarget{{1.0, 1.0}}});
  world.intervene({.action = AddTarget{{1.0, 1.0}}});
  EXPECT_THROW(world.intervene({.action = AddTarget{{1.0, 1.0}}}), std::invalid_argument)
      << "5 robots cannot serve 5 targets";
  EXPECT_THROW(world.intervene({.action = MoveTarget{2}}), std::invalid_argument)
      << "it is there from the next step on";
  world.step();
  world.intervene({.action = MoveTarget{2, {1.0, -1.0}}});
}

// A target may be put where an obstacle was, and not where one is by now.
TEST(Intervene, ObstaclesCountWhereTheyAre) {
  Scenario s = ring("outwards", 8, 2, 3.0, 1);
  s.obstacles = {Disc{{5.0, 5.0}, 0.6}};
  World world(s);
  for (int k = 0; k < 2; ++k) {
    const Vec2 was = k == 0 ? Vec2{5.0, 5.0} : Vec2{-5.0, 5.0};
    const Vec2 is = k == 0 ? Vec2{-5.0, 5.0} : Vec2{6.0, 6.0};
    world.intervene({.action = MoveObstacle{0, is}});
    for (int t = 0; t < 2; ++t) {  // in the same tick, and later
      EXPECT_TRUE(world.faults_now({.action = AddTarget{was}}).empty()) << t;
      EXPECT_FALSE(world.faults_now({.action = AddTarget{is}}).empty()) << t;
      world.step();
    }
  }
}

}  // namespace
}  // namespace banyan::world
