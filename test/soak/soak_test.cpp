// SPDX-License-Identifier: MIT
// The soak: its missions, its eyes on planted faults, its shrinking, and the command itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>
#include <set>
#include <sstream>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"
#include "banyan/world/faults.hpp"
#include "banyan/world/random.hpp"
#include "banyan/world/world.hpp"
#include "free_path.hpp"
#include "in_reach.hpp"
#include "isolated.hpp"
#include "journal.hpp"
#include "mission.hpp"
#include "plain_scenario.hpp"
#include "sample.hpp"
#include "shrink.hpp"
#include "sight.hpp"
#include "soak.hpp"
#include "start_loss.hpp"
#include "started_program.hpp"
#include "terminal.hpp"

namespace banyan::soak {
namespace {

using world::Scenario;

std::string text_of_scenario(const Scenario& s) {
  config::Configuration configuration;
  configuration.scenario = s;
  return config::config_json(configuration);
}

TEST(SoakMission, IsAFunctionOfSeedAndNumber) {
  std::set<std::string> seen;
  for (const std::uint64_t seed : {1U, 2U})
    for (std::uint64_t index = 0; index < 20; ++index) {
      const std::string text = text_of_scenario(mission(seed, index));
      EXPECT_EQ(text, text_of_scenario(mission(seed, index)));
      EXPECT_TRUE(seen.insert(text).second);
    }
}

TEST(SoakMission, EveryKindIsDrawnAndNoneIsImpossible) {
  std::set<world::Layout> starts;
  std::set<world::RadioModel::Model> radios;
  int many = 0, obstacles = 0, deaths = 0, promised = 0, missions = 600;
  for (int index = 0; index < missions; ++index) {
    const Scenario s = mission(3, static_cast<std::uint64_t>(index));
    for (const world::Fault& fault : world::faults(s)) EXPECT_TRUE(fault.warning) << fault.key << fault.text;
    const Traits t = traits_of(s);
    starts.insert(s.swarm.start.layout);
    radios.insert(s.radio.model);
    many += t.many;
    obstacles += t.obstacles;
    deaths += t.deaths;
    promised += is_promised("split", s);
    EXPECT_LE(s.radio.loss, 0.3);
    EXPECT_LE(world::target_positions(s).size(), 100U);
  }
  EXPECT_EQ(starts.size(), 6U) << "and the hexagonal one twice, compact and loose";
  EXPECT_EQ(radios.size(), 4U);
  EXPECT_NEAR(many, 0.05 * missions, 15);
  EXPECT_NEAR(obstacles, 0.33 * missions, 60);
  EXPECT_NEAR(deaths, 0.19 * missions, 45);
  EXPECT_GT(promised, 0.2 * missions);
}

// The world finds links by its own way; here they are told from positions.
TEST(SoakSight, AgreesWithTheWorldOnLinks) {
  std::size_t hidden = 0;
  std::size_t linked = 0;
  for (std::uint64_t index = 0; index < 25; ++index) {
    Scenario s = mission(4, index);
    s.radio.line_of_sight = true;
    if (world::robot_count(s) > 120) continue;
    world::World world(s);
    for (int t = 0; t < 20; ++t) world.step();
    const SightCheck sight(world);
    for (std::size_t i = 0; i < world.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const auto links = world.links(i);
        const bool link = std::binary_search(links.begin(), links.end(), static_cast<std::uint32_t>(j));
        const bool seen = world.alive()[i] != 0 && world.alive()[j] != 0 && sight.in_range(i, j) && !sight.hidden(i, j);
        EXPECT_TRUE(seen || !link) << index << ": " << i << " " << j;
        linked += link;
        hidden += seen && !link;  // by less than the millimetre that the soak lets pass
      }
  }
  EXPECT_GT(linked, 1000U);
  EXPECT_LT(static_cast<double>(hidden), 0.02 * static_cast<double>(linked));
}

// Of three robots in a row the first does not hear the second, or is not heard, and the third is hidden by the second.
TEST(SoakSight, NobodyHearsBothWaysThroughABody) {
  Scenario s = world::plain_scenario();
  s.swarm.start.layout = world::Layout::list;
  s.swarm.start.positions = {{0.0, 0.0}, {0.9, 0.0}, {1.8, 0.0}};
  s.targets = std::vector<world::Vec2>{{6.0, 0.0}};
  s.radio.model = world::RadioModel::Model::one_way;
  s.radio.one_way_share = 0.5;
  const auto is_one_way = [](const world::World& w, std::size_t i, std::size_t j) {
    return w.is_deaf(i, j) || w.is_deaf(j, i);
  };
  while (true) {
    const world::World w(s);
    if (is_one_way(w, 0, 1) && !is_one_way(w, 0, 2) && !is_one_way(w, 1, 2)) break;
    ++s.seed;
  }
  for (const bool line_of_sight : {false, true}) {
    s.radio.line_of_sight = line_of_sight;
    const world::World world(s);
    EXPECT_EQ(SightCheck(world).components_both_ways(std::vector<bool>(3, true)), line_of_sight ? 2U : 1U);
  }
}

Scenario literal(std::uint64_t seed) {
  Scenario s = world::plain_scenario();
  s.mission.algorithm = "outwards";
  s.mission.reading = "literal";  // which breaks edges and stalls; that is what it is there to show
  s.targets = world::RingTargets{4, 9.0, 0.0, {}};
  s.seed = seed;
  return s;
}

bool found(const SoakOutcome& outcome, const std::string& kind) {
  const auto same = [&](const Finding& f) { return f.kind == kind; };
  return std::any_of(outcome.findings.begin(), outcome.findings.end(), same);
}

TEST(SoakWatch, SeesWhatAnAlgorithmAsPrintedDoesWrong) {
  std::set<std::string> kinds;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const Finding& finding : watch(literal(seed), false).findings) kinds.insert(finding.kind);
  EXPECT_TRUE(kinds.contains("broken-edge"));
  EXPECT_TRUE(kinds.contains("incomplete"));
}

TEST(SoakWatch, ADeathThatTearsTheLivingApartExcusesASplit) {
  Scenario s = world::plain_scenario();
  s.swarm.start.layout = world::Layout::list;
  for (int i = 0; i < 7; ++i) s.swarm.start.positions.push_back({1.5 * i, 0.0});
  for (std::size_t i = 0; i < 7; ++i) s.events.push_back({.action = world::Freeze{i}});
  s.targets = std::vector<world::Vec2>{{9.0, 0.0}};
  s.mission.time_limit_s = 20.0;
  EXPECT_FALSE(found(watch(s, false), "split"));
  s.events.push_back({.time_s = 5.0, .action = world::Die{3}});
  EXPECT_FALSE(found(watch(s, false), "split"));
}

TEST(SoakWatch, ASplitWithoutADeathIsFound) {
  Scenario s = world::plain_scenario();
  s.swarm.start.layout = world::Layout::list;
  s.swarm.start.positions = {{0.0, 0.0}, {1.9, 0.0}};
  s.targets = std::vector<world::Vec2>{{6.0, 0.0}};
  s.obstacles = {world::Disc{{50.0, 50.0}, 1.0}};
  s.events = {{.action = world::Freeze{0}}, {.action = world::Freeze{1}}};
  s.mission.time_limit_s = 5.0;
  EXPECT_FALSE(found(watch(s, false), "split"));
  s.events.push_back({.time_s = 2.0, .action = world::MoveObstacle{0, {0.95, 0.0}}});  // which pushes both aside
  const SoakOutcome outcome = watch(s, true);
  ASSERT_TRUE(found(outcome, "split"));
  EXPECT_NEAR(outcome.findings.front().time_s, 2.1, 0.11);
  EXPECT_FALSE(found(outcome, "not-reproducible"));
  EXPECT_FALSE(is_promised("split", s)) << "there is an obstacle";
  s.obstacles.clear();
  s.events.clear();
  s.swarm.start = {};
  EXPECT_TRUE(is_promised("split", s));
  EXPECT_TRUE(is_promised("crash", mission(1, 1)));
  EXPECT_FALSE(is_promised("incomplete", s));
}

// Three robots in a row: a network is promised to stay whole if it begins so over links of up to 0.95 C.
TEST(SoakWatch, APromiseIsForStartsInOnePiece) {
  Scenario s = world::plain_scenario();
  s.targets = std::vector<world::Vec2>{{6.0, 0.0}};
  s.swarm.start.layout = world::Layout::list;
  for (const double longest_m : {1.0, 1.9, 1.91}) {
    s.swarm.start.positions = {{0.0, 0.0}, {1.5, 0.0}, {1.5 + longest_m, 0.0}};
    EXPECT_EQ(is_promised("split", s), longest_m <= 0.95 * s.radio.range_m) << longest_m;
  }
}

// Two frozen robots, 0.95 C apart. After 2 s an obstacle appears between them, which pushes both aside.
Scenario two_pushed_apart() {
  Scenario s = world::plain_scenario();
  s.swarm.start.layout = world::Layout::list;
  s.swarm.start.positions = {{0.0, 0.0}, {1.9, 0.0}};
  s.targets = std::vector<world::Vec2>{{6.0, 0.0}};
  s.obstacles = {world::Disc{{50.0, 50.0}, 1.0}};
  s.events = {{.action = world::Freeze{0}},
              {.action = world::Freeze{1}},
              {.time_s = 2.0, .action = world::MoveObstacle{0, {0.95, 0.0}}}};
  s.mission.time_limit_s = 5.0;
  return s;
}

// Nobody has torn what packets never joined: a pair of which one never hears the other.
TEST(SoakWatch, ASplitOfANetworkThatWasNeverJoinedHasANameOfItsOwn) {
  Scenario s = two_pushed_apart();
  s.radio.model = world::RadioModel::Model::one_way;
  for (const double share : {0.0, 1.0}) {
    s.radio.one_way_share = share;
    const SoakOutcome outcome = watch(s, false);
    EXPECT_EQ(found(outcome, "unlinked-split"), share == 1.0);
    EXPECT_EQ(found(outcome, "split"), share == 0.0);
  }
}

// Over links that lose more than 30 % of their packets, or just as many.
TEST(SoakWatch, ASplitOverLinksThatLoseTooMuchHasANameOfItsOwn) {
  Scenario s = two_pushed_apart();
  struct Case {
    world::RadioModel::Model model;
    double loss;
    bool faint;
  };
  using enum world::RadioModel::Model;
  for (const Case c :
       {Case{disc, 0.3, false}, Case{disc, 0.31, true}, Case{bursts, 0.3, false}, Case{path_loss, 0.0, false},
        Case{path_loss, 0.3, true}, Case{one_way, 0.2, false}, Case{one_way, 0.3, true}}) {
    s.radio.model = c.model;
    s.radio.loss = c.loss;
    s.radio.one_way_share = 0.1;
    s.radio.edge_loss = 0.05;
    s.radio.shadowing_db = 1.0;
    const SoakOutcome outcome = watch(s, false);
    EXPECT_EQ(found(outcome, "faint-split"), c.faint) << static_cast<int>(c.model) << ' ' << c.loss;
    EXPECT_EQ(found(outcome, "split"), !c.faint) << static_cast<int>(c.model) << ' ' << c.loss;
  }
}

TEST(SoakStartLoss, AgreesWithThePageOfTheModel) {
  world::RadioModel radio;
  radio.loss = 0.2;
  EXPECT_DOUBLE_EQ(mean_loss(radio, 1.0), 0.2);
  radio.model = world::RadioModel::Model::one_way;
  radio.one_way_share = 0.2;
  EXPECT_NEAR(mean_loss(radio, 1.0), 1.0 - 0.8 * 0.9, 1e-12);
  radio = {};
  radio.model = world::RadioModel::Model::path_loss;
  radio.shadowing_db = 0.0;
  EXPECT_NEAR(mean_loss(radio, 2.0), 0.5, 1e-9);
  EXPECT_NEAR(mean_loss(radio, 1.8), 0.06, 0.005);
  EXPECT_NEAR(mean_loss(radio, 1.6), 0.002, 0.0005);
  EXPECT_NEAR(mean_loss(radio, std::vector{2.0, 1.6}), 0.251, 0.001);
  EXPECT_EQ(mean_loss(radio, std::vector<double>{}), 0.0);
}

// As many packets as two robots that stand still lose in the world, over many pairs and shadows.
TEST(SoakStartLoss, AgreesWithTheWorld) {
  Scenario s = world::plain_scenario();
  s.swarm.start.layout = world::Layout::list;
  s.swarm.start.positions = {{0.0, 0.0}, {1.7, 0.0}};
  s.targets = std::vector<world::Vec2>{{6.0, 0.0}};
  s.events = {{.action = world::Freeze{0}}, {.action = world::Freeze{1}}};
  s.radio.model = world::RadioModel::Model::path_loss;
  s.radio.shadowing_s = 0.5;
  s.radio.loss = 0.1;
  world::World world(s);
  constexpr int ticks = 20000;
  for (int tick = 0; tick < ticks; ++tick) world.step();
  const double heard = static_cast<double>(world.packets_received()) / (2.0 * ticks);
  EXPECT_NEAR(1.0 - heard, mean_loss(s.radio, 1.7), 0.02);
}

// A worker that freezes is replaced with reason; it is counted all the same, and nobody promised that it would not be.
TEST(SoakWatch, AReplacedWorkerIsCountedAlsoWhereItIsHeldUp) {
  Scenario s = world::plain_scenario();
  s.targets = std::vector<world::Vec2>{{4.0, 0.0}};
  s.swarm.robots = 12;
  s.mission.time_limit_s = 80.0;
  EXPECT_FALSE(found(watch(s, false), "replaced"));
  s.events = {{.time_s = 3.0, .action = world::Freeze{world::World(s).targets()[0].worker}}};
  EXPECT_TRUE(found(watch(s, false), "replaced"));
  EXPECT_FALSE(is_promised("replaced", s));
}

TEST(SoakWatch, TooFewRobotsAreNoFinding) {
  Scenario s = world::plain_scenario();
  s.mission.algorithm = "inwards";  // whose workers are slow
  s.swarm.robots = 5;
  s.targets = std::vector<world::Vec2>{{-9.0, 0.0}, {9.0, 0.0}};
  s.mission.time_limit_s = 60.0;
  EXPECT_FALSE(found(watch(s, false), "incomplete"));
  s.swarm.robots = 30;
  EXPECT_TRUE(found(watch(s, false), "incomplete")) << "a straight drive takes 44 s";
}

// The nearest robots start up to a metre nearer to the targets than the centre.
TEST(SoakWatch, TooLittleTimeForTheStraightWayIsNoFinding) {
  Scenario s = world::plain_scenario();
  s.swarm.robots = 30;
  s.targets = std::vector<world::Vec2>{{-9.0, 0.0}, {9.0, 0.0}};
  s.mission.time_limit_s = 38.0;  // 8.8 m take 44 s
  EXPECT_FALSE(found(watch(s, false), "incomplete"));
  s.robot.wheel_noise = 0.1;
  EXPECT_TRUE(found(watch(s, false), "incomplete")) << "wheels may be faster";
  s.robot.wheel_noise = 0.0;
  s.events = {{.time_s = 1.0, .action = world::MoveTarget{0, {-12.0, 0.0}}},
              {.time_s = 1.0, .action = world::MoveTarget{1, {12.0, 0.0}}}};
  EXPECT_TRUE(found(watch(s, false), "incomplete")) << "the targets have moved";
}

TEST(SoakInReach, EachTargetNeedsARobotOfItsOwn) {
  const std::vector<world::Vec2> targets{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
  const std::vector<world::Vec2> robots{{1.0, 1.0}, {0.0, 3.0}, {2.0, 3.0}};
  EXPECT_TRUE(all_in_reach(robots, targets, 3.01));
  EXPECT_FALSE(all_in_reach(robots, targets, 2.9)) << "one robot is in reach of all of them";
  EXPECT_FALSE(all_in_reach({robots[0], robots[1]}, targets, 9.0));
  // The first target has taken the robot that is the only one for the second.
  EXPECT_TRUE(all_in_reach({{0.0, 0.0}, {-3.0, 0.0}}, {{-1.0, 0.0}, {2.0, 0.0}}, 2.5));
  EXPECT_TRUE(all_in_reach(robots, {}, 0.0));
}

TEST(SoakShrink, LeavesNothingThatIsNotNeeded) {
  Scenario s = mission(1, 0);
  s.swarm.start = {};
  s.swarm.robots = 90;
  s.targets = std::vector<world::Vec2>{{3, 0}, {-4, 0}, {0, 5}, {0, -3}, {2, 2}};
  s.obstacles = {world::Disc{{3, 3}, 0.3}, world::Disc{{-3, 3}, 0.3}};
  s.events = {{3.0, world::Event::When::time, world::Freeze{1, 1.0}}, {4.0, world::Event::When::time, world::Die{2}}};
  s.radio.loss = 0.2;
  s.radio.line_of_sight = true;
  int runs = 0;
  const auto fails = [&runs](const Scenario& t) {
    ++runs;
    const auto targets = world::target_positions(t);
    const bool far = std::any_of(targets.begin(), targets.end(), [](world::Vec2 p) { return norm(p) > 4.5; });
    const bool death = std::any_of(t.events.begin(), t.events.end(),
                                   [](const world::Event& e) { return std::holds_alternative<world::Die>(e.action); });
    return far && death && *t.swarm.robots >= 9 && t.radio.loss > 0.0;
  };
  const Scenario small = shrink(s, 12.0, fails, 150);
  EXPECT_EQ(*small.swarm.robots, 9U);
  EXPECT_EQ(world::target_positions(small), (std::vector<world::Vec2>{{0, 5}}));
  EXPECT_EQ(small.events.size(), 1U);
  EXPECT_TRUE(small.obstacles.empty());
  EXPECT_EQ(small.radio.loss, 0.2);
  EXPECT_FALSE(small.radio.line_of_sight);
  EXPECT_EQ(small.mission.time_limit_s, 13.0);
  EXPECT_LE(runs, 150);
  runs = 0;
  static_cast<void>(shrink(s, 12.0, fails, 5));
  EXPECT_EQ(runs, 5);
}

TEST(SoakIsolated, SaysTheSameFromAProcessOfItsOwnAndOutlivesACrash) {
  const Scenario s = literal(2);
  const SoakOutcome here = watch(s, false);
  const SoakOutcome there = Isolated(s, false).wait();
  EXPECT_EQ(here.hash, there.hash);
  ASSERT_EQ(here.findings.size(), there.findings.size());
  for (std::size_t i = 0; i < here.findings.size(); ++i) {
    EXPECT_EQ(here.findings[i].kind, there.findings[i].kind);
    EXPECT_EQ(here.findings[i].time_s, there.findings[i].time_s);
    EXPECT_EQ(here.findings[i].text, there.findings[i].text);
  }
  Scenario impossible = s;
  impossible.mission.algorithm = "there is none";
  EXPECT_TRUE(found(Isolated(impossible, false).wait(), "crash"));
}

std::string text_of_file(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(SoakCommand, KeepsAJournalThatDoesNotDependOnProcessesAndGoesOn) {
  const record::test::TemporaryDirectory directory;
  SoakOptions options;
  options.seed = 22;  // two short missions, one of them with a finding
  options.missions = 2;
  options.threads = 1;
  options.quiet = true;
  options.out = directory.file("one");
  static_cast<void>(run_soak(options));
  const auto rows = [](const std::string& path) {
    std::istringstream lines(text_of_file(path));
    std::multiset<std::string> all;
    for (std::string line; std::getline(lines, line);) all.insert(line);
    return all;
  };
  const auto one = rows(options.out + "/soak.csv");
  EXPECT_EQ(one.size(), 3U);
  options.threads = 3;
  options.out = directory.file("three");
  static_cast<void>(run_soak(options));
  EXPECT_EQ(rows(options.out + "/soak.csv"), one);
  // Cut off in the middle of the last row, as by a full disk: that mission is run again, the others are not.
  const std::string journal = options.out + "/soak.csv";
  std::filesystem::resize_file(journal, std::filesystem::file_size(journal) - 5);
  static_cast<void>(run_soak(options));
  EXPECT_EQ(rows(journal), one);
}

TEST(SoakCommand, KeepsAMissionWholeIfAskedTo) {
  const record::test::TemporaryDirectory directory;
  SoakOptions options;
  options.seed = 31;  // a mission with a finding
  options.from = options.missions.emplace(1);
  options.quiet = options.whole = true;
  options.out = directory.file("whole");
  static_cast<void>(run_soak(options));
  std::size_t kept = 0;
  for (const auto& entry : std::filesystem::directory_iterator(options.out)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string stem = entry.path().stem().string();
    const Scenario found = config::load_configuration(entry.path().string(), algorithms()).configuration.scenario;
    const Scenario drawn = mission(options.seed, std::stoull(stem.substr(stem.rfind('-') + 1)));
    EXPECT_EQ(world::robot_count(found), world::robot_count(drawn));
    EXPECT_EQ(found.mission.time_limit_s, drawn.mission.time_limit_s);
    ++kept;
  }
  EXPECT_GT(kept, 0U);
}

TEST(SoakCommand, NamesALineOfItsJournalThatIsNone) {
  const record::test::TemporaryDirectory directory;
  const std::string path = directory.file("soak.csv");
  { SoakJournal(path, 9, false).add({.index = 3, .kind = "plain", .robots = 7, .targets = 2}); }
  EXPECT_EQ(SoakJournal(path, 9, false).rows().at(3).robots, 7U);
  EXPECT_FALSE(SoakJournal(path, 8, false).has(3)) << "another seed's";
  std::ofstream(path, std::ios::app) << "9,4,\"plain\",many,2,false,0.0,0.000,0.0,0000000000000000,\n";
  try {
    const SoakJournal damaged(path, 9, false);
    FAIL() << "a number of robots that is none";
  } catch (const cli::CommandError& e) {
    EXPECT_NE(std::string(e.what()).find("soak.csv:3"), std::string::npos) << e.what();
  }
  EXPECT_FALSE(SoakJournal(path, 9, true).has(3)) << "begun anew";
}

class SoakProgram : public cli::StartedProgram {};

TEST_F(SoakProgram, RefusesWhatIsOutOfRange) {
  const auto refused = [&](const cli::Arguments& arguments, const char* why) {
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.code, cli::exit_usage);
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("see banyan_soak --help"), std::string::npos) << outcome.err;
  };
  refused({"--seed", "9007199254740993", "--missions", "1", "-o", "o"}, "--seed");
  refused({"--from", "99999999999999999999", "--missions", "1", "-o", "o"}, "--from");
  refused({"--missions", "0", "-o", "o"}, "--missions");
}

TEST_F(SoakProgram, WatchesAScenario) {
  const auto outcome = run({std::string(BANYAN_SCENARIOS) + "/three-targets.toml"});
  EXPECT_EQ(outcome.code, cli::exit_done) << outcome.err;
  EXPECT_NE(outcome.out.find("nothing found"), std::string::npos) << outcome.out;
}

TEST(SoakJournal, CountsAMissionInEachOfItsKinds) {
  std::map<std::uint64_t, SoakRow> rows;
  for (std::uint64_t k = 1; k <= 41; ++k)
    rows[k] = {.index = k,
               .kind = k == 41 ? "loose start, noise" : "noise",
               .complete = k != 7,
               .complete_s = static_cast<double>(k),
               .bound_s = 2.0};
  rows[3].findings = "split@1.0";
  EXPECT_EQ(table_of(rows),
            "  kind               missions  complete  findings time/bound    95 %   worst\n"
            "  loose start               1         1         0      20.50   20.50   20.50\n"
            "  noise                    41        40         1      10.50   19.50   20.50\n"
            "  all                      41        40         1      10.50   19.50   20.50\n");
}

using world::Box;
using world::Disc;
using world::Vec2;
using world::Wall;

TEST(FreePath, OfPlainShapes) {
  EXPECT_DOUBLE_EQ(free_path_m({}, {0, 0}, {3, 4}), 5.0);
  EXPECT_DOUBLE_EQ(free_path_m({Disc{{1.5, 5}, 0.6}}, {0, 0}, {3, 4}), 5.0) << "beside the way";
  EXPECT_NEAR(free_path_m({Wall{{0, -3}, {0, 4}}}, {-4, 0}, {4, 0}), 10.0, 1e-9) << "round its nearer end";
  // Two tangents and an arc; the polygon within is a little shorter.
  const double round = 2.0 * std::sqrt(3.0) + 2.0 * std::asin(0.5);
  EXPECT_NEAR(free_path_m({Disc{{0, 0}, 1}}, {-2, 0}, {2, 0}), round, 0.02 * round);
  EXPECT_LE(free_path_m({Disc{{0, 0}, 1}}, {-2, 0}, {2, 0}), round);
  EXPECT_NEAR(free_path_m({Box{{0, 0}, {2, 2}, 0}}, {-2, 0}, {2, 0}), 2.0 + 2.0 * std::sqrt(2.0), 1e-6);
  EXPECT_TRUE(std::isinf(
      free_path_m({Wall{{-2, -1}, {2, -1}}, Wall{{1, -2}, {0, 2}}, Wall{{0.3, 2.4}, {-1.5, -2}}}, {0, 0}, {4, 0})));
}

bool covers(const world::Obstacle& obstacle, Vec2 p) {
  if (const auto* disc = std::get_if<Disc>(&obstacle)) return distance(disc->center, p) < disc->radius_m;
  const auto* box = std::get_if<Box>(&obstacle);
  const Vec2 x{std::cos(box->angle_rad), std::sin(box->angle_rad)}, off = p - box->center;
  return std::abs(off.x * x.x + off.y * x.y) < 0.5 * box->size.x &&
         std::abs(off.y * x.x - off.x * x.y) < 0.5 * box->size.y;
}

// Brute force: ways over a fine grid, whose steps lead to the 32 nearest points in different directions; at most 1.4 %
// longer than a free way, but for the corners that it rounds.
TEST(FreePath, AgreesWithAGrid) {
  constexpr int n = 81;
  constexpr double pitch = 0.1;
  const auto at = [](int k) {
    const int column = k % n - n / 2, row = k / n - n / 2;
    return Vec2{column * pitch, row * pitch};
  };
  int longer = 0;
  for (std::uint64_t index = 0; index < 12; ++index) {
    std::vector<world::Obstacle> obstacles;
    std::mt19937_64 rng(77 + index);
    const auto between = [&](double from, double to) { return from + (to - from) * world::to_uniform(rng()); };
    for (int k = 0; k < 5; ++k) {
      const Vec2 center{between(-2, 2), between(-2, 2)};
      if (k % 2 == 0) obstacles.emplace_back(Disc{center, between(0.3, 1.0)});
      else obstacles.emplace_back(Box{center, {between(0.5, 2.5), between(0.5, 1.5)}, between(0, 3)});
    }
    const auto free = [&](Vec2 p) {
      return std::none_of(obstacles.begin(), obstacles.end(), [&](const auto& o) { return covers(o, p); });
    };
    std::vector<double> way(std::size_t{n} * n, 1e9);
    const int from = (n / 2) * n + 8, to = (n / 2) * n + n - 9;
    std::set<std::pair<double, int>> queue{{0.0, from}};
    way[from] = 0.0;
    while (!queue.empty()) {
      const int k = queue.begin()->second;
      queue.erase(queue.begin());
      for (int dy = -3; dy <= 3; ++dy)
        for (int dx = -3; dx <= 3; ++dx) {
          const int x = k % n + dx, y = k / n + dy, next = y * n + x;
          if (std::gcd(dx, dy) != 1 || x < 0 || y < 0 || x >= n || y >= n) continue;
          const double length = way[static_cast<std::size_t>(k)] + pitch * std::hypot(dx, dy);
          if (length >= way[static_cast<std::size_t>(next)]) continue;
          bool open = true;
          for (int part = 1; part <= 12 && open; ++part) open = free(at(k) + (at(next) - at(k)) * (part / 12.0));
          if (!open) continue;
          queue.erase({way[static_cast<std::size_t>(next)], next});
          way[static_cast<std::size_t>(next)] = length;
          queue.insert({length, next});
        }
    }
    const double exact = free_path_m(obstacles, at(from), at(to)), grid = way[to];
    longer += exact > 1.02 * distance(at(from), at(to)) ? 1 : 0;
    EXPECT_LE(exact, grid + 0.02) << "world " << index;
    EXPECT_GE(exact, grid / 1.014 - 0.4) << "world " << index;
  }
  EXPECT_GE(longer, 4) << "worlds in which there is something to go round";
}

}  // namespace
}  // namespace banyan::soak
