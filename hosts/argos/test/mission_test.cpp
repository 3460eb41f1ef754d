// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/mission.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "banyan/algorithms/algorithms.hpp"
#include "toy_simulator.hpp"

namespace banyan::argos {
namespace {

namespace fs = std::filesystem;

std::string scenario_file(const char* name) { return std::string(BANYAN_SCENARIOS) + "/" + name; }

class MissionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / ("banyan-argos-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  measure::Run play(const config::Configuration& configuration, const std::string& out,
                    const std::vector<Pose>& placed = {}) {
    ToySimulator simulator(configuration.scenario);
    MissionRun mission(configuration, out, false, placed, simulator);
    simulator.enter(mission);
    mission.begin();
    while (!mission.finished()) {
      simulator.step();
      mission.tick();
    }
    words_ = mission.finish(false);
    last_tick_ = mission.world().tick();
    return result_in(out);
  }
  // Of run.csv: the two columns that tests look at.
  static measure::Run result_in(const std::string& out) {
    measure::Run run;
    if (out.empty()) return run;
    std::ifstream file(out + "/run.csv");
    std::string header, row;
    std::getline(file, header);
    std::getline(file, row);
    std::istringstream names(header), values(row);
    for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');) {
      if (name == "complete") run.complete = value == "true" || value == "1";
      if (name == "completion_time_s" && !value.empty()) run.completion_time_s = std::stod(value);
      if (name == "deaths") run.deaths = static_cast<std::uint32_t>(std::stoul(value));
      if (name == "insertions") run.insertions = std::stoul(value);
    }
    return run;
  }

  fs::path folder_;
  std::string words_;
  std::uint64_t last_tick_ = 0;
};

// The whole way, with another simulator than ours: as long as in our own world, to 5 %.
TEST_F(MissionTest, TakesAsLongInAnotherSimulatorAsInTheWorld) {
  for (const char* algorithm : {"convoy", "outwards"}) {
    const auto configuration = load_mission(scenario_file("three-targets.toml"),
                                            {std::string("mission.algorithm=") + algorithm}, algorithms());
    const auto run = play(configuration, (folder_ / algorithm).string());
    record::Sinks none;
    world::Executor alone(1);
    const auto ours = record::run_scenario(world::World(configuration.scenario), none, alone);
    ASSERT_TRUE(ours.run.complete);
    EXPECT_TRUE(run.complete) << algorithm << ": " << words_;
    EXPECT_NEAR(run.completion_time_s, ours.run.completion_time_s, 0.05 * ours.run.completion_time_s) << algorithm;
    for (const char* file : {"run.csv", "run.json", "run.mcap"})
      EXPECT_TRUE(fs::exists(folder_ / algorithm / file)) << file;
    EXPECT_GT(fs::file_size(folder_ / algorithm / "run.mcap"), 10000U);
  }
}

TEST_F(MissionTest, EveryAlgorithmRuns) {
  for (const Algorithm* algorithm : algorithms()) {
    const auto configuration =
        load_mission(scenario_file("khepera-three-targets.toml"),
                     {"mission.algorithm=" + std::string(algorithm->name()), "mission.time_limit_s=5"}, algorithms());
    (void)play(configuration, "");
    EXPECT_NE(words_, "") << algorithm->name();
  }
}

TEST_F(MissionTest, DeathsReachTheRobots) {
  const auto configuration = load_mission(scenario_file("deaths.toml"), {}, algorithms());
  const auto run = play(configuration, (folder_ / "deaths").string());
  EXPECT_GT(run.deaths, 0U);
  EXPECT_TRUE(run.complete) << words_;
}

TEST_F(MissionTest, RobotsMayBeWhereTheSimulatorHasThem) {
  const auto configuration = load_mission(scenario_file("three-targets.toml"), {}, algorithms());
  std::vector<Pose> placed;
  placed.reserve(13);
  for (int k = 0; k < 12; ++k) placed.push_back({{0.3 * k, 0.1}, 6.0 * k});
  ToySimulator simulator(configuration.scenario);
  const MissionRun mission(configuration, "", false, placed, simulator);
  ASSERT_EQ(mission.world().size(), 12U);
  EXPECT_EQ(mission.start(5).position, placed[5].position);
  EXPECT_NEAR(std::remainder(mission.start(5).heading_rad - placed[5].heading_rad, 2.0 * pi<double>), 0.0, 1e-9);
  placed.push_back(placed.back());  // two in one place
  EXPECT_THROW(MissionRun(configuration, "", false, placed, simulator), MissionError);
}

TEST_F(MissionTest, ResultsAreNotReplacedUnasked) {
  const auto configuration = load_mission(scenario_file("khepera-three-targets.toml"),
                                          {"mission.algorithm=convoy", "mission.time_limit_s=1"}, algorithms());
  const std::string out = (folder_ / "once").string();
  (void)play(configuration, out);
  ToySimulator simulator(configuration.scenario);
  EXPECT_THROW(MissionRun(configuration, out, false, {}, simulator), MissionError);
  EXPECT_NO_THROW(MissionRun(configuration, out, true, {}, simulator));
}

TEST_F(MissionTest, SaysWhatArgosDoesNotDo) {
  const auto fault = [](const std::vector<std::string>& assignments) -> std::string {
    try {
      (void)load_mission(scenario_file("three-targets.toml"), assignments, algorithms());
    } catch (const MissionError& error) { return error.what(); }
    return "";
  };
  EXPECT_EQ(fault({}), "");
  const std::string many =
      fault({"radio.latency_ticks=3", "radio.model=bursts", "robot.wheel_noise=0.1", "tick_s=0.3", "seed=0"});
  for (const char* word : {"latency_ticks", "radio.model", "wheel_noise", "tick_s", "seed"})
    EXPECT_NE(many.find(word), std::string::npos) << word;
  EXPECT_NE(fault({"swarm.robots=70000"}).find("swarm.robots"), std::string::npos);
  EXPECT_NE(fault({"radio.lost=0.3"}).find("radio.loss"), std::string::npos) << "the nearest name";
  auto scenario = load_mission(scenario_file("three-targets.toml"), {}, algorithms()).scenario;
  scenario.events.push_back({.time_s = 1.0, .action = world::Blackout{2.0}});
  scenario.events.push_back({.time_s = 1.0, .action = world::Die{2}});
  EXPECT_EQ(not_in_argos(scenario), std::vector<std::string>{"events[0]: blackout cannot happen in ARGoS"});
}

}  // namespace
}  // namespace banyan::argos
