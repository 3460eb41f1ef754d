// SPDX-License-Identifier: MIT
// The benchmark (docs/benchmark.md) has every algorithm on the list, as it is and tuned, and each can be run there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/study/results.hpp"
#include "banyan/study/simulate.hpp"
#include "banyan/study/study.hpp"
#include "banyan/study/tune.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

namespace fs = std::filesystem;
const fs::path root = fs::path(BANYAN_SCENARIOS).parent_path();

study::Study benchmark(const char* name = "benchmark.toml") {
  auto loaded = study::load_study((root / "studies" / name).string());
  for (const auto& problem : loaded.problems) ADD_FAILURE() << config::to_string(problem);
  return std::move(loaded.study);
}

// The benchmark's smallest world, once, for all contenders.
study::Study tiny() {
  study::Study study = benchmark();
  study.parts.resize(1);
  study.parts[0].seeds = {1001};
  for (auto& axis : study.parts[0].axes)
    if (axis.name != "contender") axis.values.resize(1);
  return study;
}

TEST(Benchmark, EveryContenderRunsAndEveryAlgorithmIsOne) {
  const study::Plan plan = study::make_plan(tiny(), algorithms());
  ASSERT_TRUE(plan.ok()) << config::to_string(plan.problems.front());
  std::set<std::string, std::less<>> untuned, tuned;
  for (const auto& run : plan.runs) {
    const auto configuration = study::configuration_of(plan, run);
    const auto outcome = study::decode_outcome(
        study::simulate(study::encode(study::RunTask{config::config_json(configuration), ""}), algorithms()));
    ASSERT_EQ(outcome.error, "") << run.directory;
    EXPECT_TRUE(study::trial_of(outcome.row)) << run.directory;
    const auto& mission = configuration.scenario.mission;
    (mission.parameters.empty() ? untuned : tuned).insert(mission.algorithm);
  }
  for (const auto name : algorithms().names()) {
    EXPECT_TRUE(untuned.contains(name)) << name << " is not in studies/benchmark.toml";
    EXPECT_TRUE(tuned.contains(name)) << name << " is not in studies/benchmark.toml with the parameters of its tuning";
  }
}

// Convoy with its defaults, the others with the parameters of their tunings. Caravan's growth is in the ledger's class
// of large swarms.
TEST(Benchmark, GrowthHasEveryAlgorithmAndTheRobotsThatItsLabelsSay) {
  const study::Plan plan = study::make_plan(benchmark("growth.toml"), algorithms());
  ASSERT_TRUE(plan.ok()) << config::to_string(plan.problems.front());
  std::set<std::string, std::less<>> there;
  for (const auto& run : plan.runs) {
    const auto scenario = study::configuration_of(plan, run).scenario;
    there.insert(scenario.mission.algorithm);
    EXPECT_EQ(scenario.mission.parameters.empty(), scenario.mission.algorithm == "convoy") << run.directory;
    const std::string size = "N=" + std::to_string(robot_count(scenario)) + "/";
    EXPECT_NE(run.directory.find(size), std::string::npos) << run.directory << " has " << size;
  }
  for (const auto name : algorithms().names()) EXPECT_TRUE(name == "caravan" || there.contains(name)) << name;
}

// The labels are what the tables of the page go by.
TEST(Benchmark, EveryRadioIsWhatItsLabelSays) {
  const study::Study study = benchmark();
  for (const auto& part : study.parts) {
    const auto radio =
        std::find_if(part.axes.begin(), part.axes.end(), [](const auto& axis) { return axis.name == "radio"; });
    ASSERT_NE(radio, part.axes.end()) << part.name;
    std::set<std::string> labels;
    for (const auto& value : radio->values) labels.insert(value.label);
    EXPECT_EQ(labels, (std::set<std::string>{"clear", "sight", "loss", "sight+loss", "leaky"})) << part.name;
  }
  study::Study small = study;
  for (auto& part : small.parts) {
    part.seeds = {1001};
    for (auto& axis : part.axes)
      if (axis.name != "radio") axis.values.resize(1);
  }
  const study::Plan plan = study::make_plan(small, algorithms());
  ASSERT_TRUE(plan.ok()) << config::to_string(plan.problems.front());
  EXPECT_EQ(plan.runs.size(), 3U * 5U);
  for (const auto& run : plan.runs) {
    const auto configuration = study::configuration_of(plan, run);
    const auto& radio = configuration.scenario.radio;
    const bool leaky = run.directory.find("leaky") != std::string::npos;
    const bool sight = leaky || run.directory.find("sight") != std::string::npos;
    EXPECT_EQ(radio.line_of_sight, sight) << run.directory;
    EXPECT_EQ(radio.loss, run.directory.find("loss") != std::string::npos ? 0.3 : 0.0) << run.directory;
    EXPECT_EQ(radio.sight_leak, leaky ? 0.18 : 0.0) << run.directory;
  }
}

TEST(Benchmark, EveryTuningHasTheSameWorldsSeedsFitnessAndEffort) {
  std::set<std::string> shared, tuned;
  for (const auto& entry : fs::directory_iterator(root / "studies")) {
    if (!entry.path().filename().string().starts_with("tune-benchmark-")) continue;
    auto loaded = study::load_tune(entry.path().string(), algorithms());
    ASSERT_TRUE(loaded.ok()) << config::to_string(loaded.problems.front());
    auto& plan = loaded.plan;
    const std::string best = "results/tune/" + plan.name.substr(5) + "/best.toml";
    EXPECT_TRUE(fs::exists(root / best)) << best;
    tuned.insert(plan.worlds.front().scenario.mission.algorithm);
    EXPECT_FALSE(plan.initial.empty()) << plan.name << " does not start from the algorithm's defaults";
    plan.name.clear();
    plan.bounds.clear();
    plan.initial.clear();
    for (auto& world : plan.worlds) {
      world.scenario.mission.algorithm = "outwards";
      world.scenario.mission.reading = "corrected";
    }
    shared.insert(study::tune_json(plan));
  }
  EXPECT_EQ(shared.size(), 1U);
  for (const auto name : algorithms().names())
    EXPECT_TRUE(tuned.contains(std::string(name))) << "studies/tune-benchmark-" << name << ".toml";
}

TEST(Benchmark, EveryFrontIsOfItsTuningButForTheSearch) {
  int fronts = 0;
  for (const auto& entry : fs::directory_iterator(root / "studies")) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with("front-benchmark-")) continue;
    ++fronts;
    auto front = study::load_tune(entry.path().string(), algorithms());
    ASSERT_TRUE(front.ok()) << config::to_string(front.problems.front());
    const std::string name = "tune" + file.substr(std::string("front").size());
    const auto tuning = study::load_tune((root / "studies" / name).string(), algorithms()).plan;
    EXPECT_EQ(front.plan.optimizer.search, study::Search::nsga2) << file;
    front.plan.optimizer.search = tuning.optimizer.search;
    front.plan.name = tuning.name;
    EXPECT_EQ(study::tune_json(front.plan), study::tune_json(tuning)) << file;
  }
  EXPECT_GT(fronts, 0);
}

TEST(Benchmark, NoSeedOfATuningIsReportedOn) {
  const auto tuning = study::load_tune((root / "studies/tune-benchmark-convoy.toml").string(), algorithms()).plan;
  for (const char* name : {"benchmark.toml", "benchmark-full.toml", "growth.toml", "oracle.toml"}) {
    for (const auto& part : benchmark(name).parts) {
      for (const auto seed : part.seeds) {
        EXPECT_EQ(std::count(tuning.training.begin(), tuning.training.end(), seed), 0) << seed;
        EXPECT_EQ(std::count(tuning.test.begin(), tuning.test.end(), seed), 0) << seed;
      }
    }
  }
  EXPECT_EQ(benchmark("benchmark-full.toml").parts.at(0).seeds.size(), 50U);
}

}  // namespace
}  // namespace banyan::cli
