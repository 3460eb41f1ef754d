// SPDX-License-Identifier: MIT
// A world that is given an algorithm instead of the name of one.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/algorithms/paper_algorithm.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

// inwards with another S.
constexpr PaperAlgorithmOf<paper::inwards> mine("mine", "for this test", []() noexcept {
  paper::Params params = paper::inwards_column();
  params.safe_range = 0.725F;
  return params;
});

// docs/paper.md: of the robots of the tree the one with the shortest way to the root through it.
constexpr paper::Growth shortest_way{
    .may_join = [](const paper::Robot& robot) noexcept { return robot.self.phase == Phase::select_parent; },
    .cost =
        [](const paper::Robot& robot, int k) noexcept {
          const float way = static_cast<float>(robot.said(k).label) / per_range + robot.range(k);
          return robot.said(k).committed ? way : not_counted;
        },
    .is_complete = [](const paper::Robot& root) noexcept { return root.self.subtree >= root.self.flood_robots; }};
constexpr PaperAlgorithmOf<shortest_way> shortest_ways("shortest-way", "outwards along shortest ways",
                                                       paper::outwards_column);

std::uint64_t hash_after_100_ticks(World world) {
  for (int t = 0; t < 100; ++t) world.step();
  return world.hash();
}

TEST(OwnAlgorithm, ARegisteredOneByReferenceIsTheSameAsByName) {
  Scenario scenario = plain_scenario();
  scenario.mission.algorithm = "inwards";
  EXPECT_EQ(hash_after_100_ticks(World(scenario)), hash_after_100_ticks(World(Scenario{}, inwards())));
  EXPECT_NE(hash_after_100_ticks(World(scenario)), hash_after_100_ticks(World(plain_scenario())));
}

TEST(OwnAlgorithm, ItsListIsWhatAScenarioChoosesFrom) {
  const AlgorithmList list{&outwards(), &mine};
  Scenario scenario;
  scenario.algorithms = &list;
  scenario.mission.algorithm = "mine";
  EXPECT_EQ(hash_after_100_ticks(World(scenario)), hash_after_100_ticks(World(Scenario{}, mine)));
  scenario.mission.algorithm = "inwards";  // one of Banyan's, but not of this program
  EXPECT_THROW(World{scenario}, std::invalid_argument);
  EXPECT_THROW(World{Scenario{}}, std::invalid_argument) << "nothing to choose from";
  scenario.mission.algorithm = "";
  EXPECT_THROW(World{scenario}, std::invalid_argument) << "none is chosen, and the world knows none by name";
  EXPECT_EQ(hash_after_100_ticks(World(plain_scenario(list))), hash_after_100_ticks(World(Scenario{}, outwards())));
}

TEST(OwnAlgorithm, TheRestOfItsScenarioIsCheckedToo) {
  Scenario scenario;
  scenario.targets = std::vector<Vec2>{{1, 0}};
  scenario.obstacles = {Disc{{1, 0}, 0.5}};
  EXPECT_THROW(World(scenario, mine), std::invalid_argument) << "a target in an obstacle";
}

TEST(OwnAlgorithm, DecidesWithItsOwnParameters) {
  const World world(Scenario{}, mine);
  EXPECT_EQ(world.scenario().mission.algorithm, "mine");
  EXPECT_EQ(&world.algorithm(), &mine);
  inside(world.swarm(), [](const auto& swarm) { EXPECT_FLOAT_EQ(swarm.params().safe_range, 0.725F); });
  EXPECT_NE(hash_after_100_ticks(world), hash_after_100_ticks(World(Scenario{}, inwards())));
}

TEST(OwnAlgorithm, IsWhatItsModelIsWithTheSameParameters) {
  Scenario scenario;
  scenario.mission.parameters = {{"safe_range", 0.725}};
  EXPECT_EQ(hash_after_100_ticks(World(Scenario{}, mine)), hash_after_100_ticks(World(scenario, inwards())));
}

TEST(OwnAlgorithm, ARuleOverThePapersTreeIsAFewLines) {
  Scenario scenario = ring("outwards", 20, 3, 3.0, 1);
  scenario.radio.line_of_sight = false;
  World own(scenario, shortest_ways);
  World papers(scenario, outwards());
  const auto all_there = [](const World& world) {
    return std::all_of(world.targets().begin(), world.targets().end(), [&](const Target& target) {
      return distance(world.positions()[target.worker], target.position) <= 0.2;
    });
  };
  bool was_there = false;
  for (int t = 0; t < 1500; ++t) {
    own.step();
    papers.step();
    was_there = was_there || all_there(own);
  }
  EXPECT_TRUE(was_there);
  EXPECT_NE(own.hash(), papers.hash());
}

TEST(OwnAlgorithm, ItsWorldCanBeInterferedWith) {
  World world(Scenario{}, mine);
  world.intervene({.action = Die{0}});
  world.step();
  EXPECT_EQ(world.alive()[0], 0);
}

TEST(OwnAlgorithm, ImpossibleParametersAreToldWithItsName) {
  Scenario scenario;
  scenario.mission.parameters = {{"safe_range", 0.6}};  // S below E
  try {
    const World world(scenario, mine);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(
        e.what(),
        "mine: recruitment_distance (E) must be below safe_range (S), else an edge would stop growing before it "
        "asks for a spare; here safe_range = 0.6 C, recruitment_distance = 0.660676 C by default");
  }
}

}  // namespace
}  // namespace banyan::world
