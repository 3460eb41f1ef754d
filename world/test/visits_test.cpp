// SPDX-License-Identifier: MIT
// Places that a robot has to reach once: each is reached, the robot is free again, and one that cannot be reached does
// not keep the others waiting.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "worlds.hpp"

namespace banyan::world {
namespace {

const std::vector<Vec2> places{{1.5, 0.5}, {-1.0, 2.0}, {3.0, -1.0}, {-3.0, 0.0}, {0.5, 2.5}};

Scenario visiting(const std::string& algorithm, std::size_t at_once = 1) {
  Scenario s = ring(algorithm, 12, 1, 1.0, 3);
  s.visits.positions = places;
  s.visits.at_once = at_once;
  s.mission.stop_when_complete = false;
  return s;
}

TEST(Visits, ARobotIsAtEachPlaceOnceAndThenFree) {
  for (const char* algorithm : {"convoy", "caravan"})
    for (const std::size_t at_once : {std::size_t{1}, std::size_t{3}}) {
      World world(visiting(algorithm, at_once));
      std::vector<char> been(places.size(), 0);
      std::size_t most = 0;
      for (int t = 0; t < 4000 && world.visited() < places.size(); ++t) {
        world.step();
        std::size_t under_way = 0;
        for (const Target& target : world.targets()) under_way += target.visit && target.active ? 1 : 0;
        most = std::max(most, under_way);
        for (std::size_t k = 0; k < places.size(); ++k)
          for (std::size_t i = 0; i < world.size(); ++i)
            if (distance(world.positions()[i], places[k]) <= target_tolerance_m(world.scenario())) been[k] = 1;
      }
      EXPECT_EQ(world.visited(), places.size()) << algorithm;
      EXPECT_EQ(std::count(been.begin(), been.end(), 1), static_cast<std::ptrdiff_t>(places.size()));
      EXPECT_LE(most, at_once);
      for (int t = 0; t < 50; ++t) world.step();
      std::size_t workers = 0;
      for (const Report& report : world.reports()) workers += report.role == Role::worker ? 1 : 0;
      EXPECT_EQ(workers, 1U) << "of the target alone";
    }
}

TEST(Visits, APlaceBehindAWallAllRoundDoesNotKeepTheOthersWaiting) {
  Scenario s = visiting("convoy");
  s.visits.positions->insert(s.visits.positions->begin(), {0.9, -0.9});  // the nearest
  s.visits.patience_s = 20.0;
  const Vec2 corner[] = {{0.6, -0.6}, {1.2, -0.6}, {1.2, -1.2}, {0.6, -1.2}};
  for (std::size_t k = 0; k < 4; ++k) s.obstacles.emplace_back(Wall{corner[k], corner[(k + 1) % 4]});
  World world(s);
  for (int t = 0; t < 6000 && world.visited() < places.size(); ++t) world.step();
  EXPECT_EQ(world.visited(), places.size());
}

TEST(Visits, ARobotThatDiesOnItsWayIsReplaced) {
  World world(visiting("convoy"));
  int killed = 0;
  for (int t = 0; t < 6000 && world.visited() < places.size(); ++t) {
    world.step();
    for (const Target& target : world.targets())
      if (target.visit && target.active && t > 30 && killed < 2 && world.alive()[target.worker] != 0) {
        world.intervene({.action = Die{target.worker}});
        ++killed;
      }
  }
  EXPECT_EQ(killed, 2);
  EXPECT_EQ(world.visited(), places.size());
}

TEST(Visits, AMissionOfVisitsAloneIsCompleteAndItsEventsHappen) {
  Scenario s = visiting("convoy");
  s.targets = std::vector<Vec2>{};
  s.events = {{.time_s = 1.0, .when = Event::When::complete, .action = Die{0}}};
  World world(s);
  for (int t = 0; t < 4000 && world.deaths() == 0; ++t) world.step();
  EXPECT_EQ(world.visited(), places.size());
  EXPECT_EQ(world.deaths(), 1U);
}

TEST(Visits, AreAPartOfTheHash) {
  Scenario s = visiting("convoy");
  World a(s);
  s.visits.positions->back() = {0.5, 2.6};
  World b(s);
  a.step();
  b.step();
  EXPECT_NE(a.hash(), b.hash());
  s = visiting("convoy");
  World c(s), d((s.visits.patience_s = 30.0, s));
  EXPECT_EQ(c.hash(), d.hash());
  for (int t = 0; t < 30; ++t) c.step(), d.step();
  EXPECT_NE(c.hash(), d.hash()) << "one is on its way, and will be given up at another time";
}

}  // namespace
}  // namespace banyan::world
