// SPDX-License-Identifier: MIT
// Tuning: the file, the fitness, the search. Most searches here are of a formula in place of a
// simulation, so that the answer is known.
#include "banyan/study/tune.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../temporary_folder.hpp"
#include "banyan/algorithms/algorithms.hpp"
#include "banyan/record/file.hpp"
#include "banyan/record/table.hpp"
#include "banyan/study/simulate.hpp"

#ifdef __SANITIZE_THREAD__
// pagmo sorts nsga2's fronts with TBB, which is built without the sanitizer: it sees the memory that
// TBB hands from thread to thread, and not how.
extern "C" const char* __tsan_default_suppressions();  // NOLINT
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libtbb.so\nrace:libtbb.so\n";
}  // NOLINT
#endif

namespace banyan::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

record::RunRow row_with(bool complete, std::uint64_t ticks, std::uint64_t broken, std::uint64_t split, double time) {
  record::RunRow row;
  row.id.name = "a, \"quoted\" name";
  row.run.complete = complete;
  row.run.ticks = ticks;
  row.run.broken_ticks = broken;
  row.run.split_ticks = split;
  row.run.normalized_time = time;
  row.run.completion_time_s = complete ? 100.0 * time : -1.0;
  row.run.disconnected_time_ratio = static_cast<double>(broken) / static_cast<double>(ticks);
  row.run.held_ratio = complete ? 1.0 : 0.25;
  row.run.robots = 20;
  row.run.committed = 7;
  return row;
}

// ------------------------------------------------------------------------------------ fitness --

TEST(TuneFitness, ReadsARowOfTheTable) {
  const auto trial = trial_of(record::run_csv_row(row_with(true, 200, 5, 8, 0.25)));
  ASSERT_TRUE(trial);
  EXPECT_TRUE(trial->complete);
  EXPECT_DOUBLE_EQ(trial->disconnected, 8.0 / 200.0);  // the graph was split more often than an edge broken
  EXPECT_DOUBLE_EQ(trial->normalized_time, 0.25);
  EXPECT_DOUBLE_EQ(trial->completion_time_s, 25.0);
  EXPECT_DOUBLE_EQ(trial->held, 1.0);
  EXPECT_DOUBLE_EQ(trial->committed, 7.0 / 20.0);
  EXPECT_DOUBLE_EQ(trial_of(record::run_csv_row(row_with(false, 200, 5, 8, 1.0)))->held, 0.25);
}

TEST(TuneFitness, ASingleBrokenTickOfALongRunCounts) {
  const auto trial = trial_of(record::run_csv_row(row_with(true, 10'000'000, 1, 0, 0.5)));
  ASSERT_TRUE(trial);
  EXPECT_GT(trial->disconnected, 0.0);
}

TEST(TuneFitness, RefusesWhatIsNoRow) {
  const auto row = record::run_csv_row(row_with(true, 200, 5, 8, 0.25));
  EXPECT_FALSE(trial_of(""));
  EXPECT_FALSE(trial_of(row.substr(0, row.size() / 2)));
  EXPECT_FALSE(trial_of(row + ",1"));
  EXPECT_FALSE(trial_of(record::run_csv_header()));
}

TEST(TuneFitness, TheTwoStepsByHand) {
  const Trial quick{true, 0.0, 0.2, 20.0}, slow{true, 0.0, 0.6, 60.0}, never{false, 0.0, 1.0, 0.0},
      apart{true, 0.25, 0.1, 10.0};
  const auto fitness = [](std::vector<Trial> trials) { return Fitness{}.of(merit_of(trials)); };
  EXPECT_DOUBLE_EQ(fitness({quick}), 1.8);
  EXPECT_DOUBLE_EQ(fitness({quick, slow}), 1.6);
  EXPECT_DOUBLE_EQ(fitness({never}), 1.0);
  EXPECT_DOUBLE_EQ(fitness({apart}), 0.75);
  // One disconnected run keeps the point on the first step, however quick the others are.
  EXPECT_DOUBLE_EQ(fitness({quick, quick, quick, apart}), 1.0 - 0.25 / 4.0);
  EXPECT_DOUBLE_EQ(Fitness{}.of(Merit{0.4}), -0.4);
}

// Held 1 and 1/4, times 0.2 and 1 (a miss is the limit), disconnected 0.1 and 0.5, committed 0.4 and 1.
TEST(TuneFitness, TheGradedFitnessByHand) {
  const std::vector<Trial> trials{{true, 0.1, 0.2, 20.0, 1.0, 0.4}, {false, 0.5, 1.0, 0.0, 0.25, 1.0}};
  const Merit merit = merit_of(trials);
  EXPECT_DOUBLE_EQ(merit.held, 0.625);
  EXPECT_DOUBLE_EQ(merit.time, 0.6);
  EXPECT_DOUBLE_EQ(merit.disconnected, 0.3);
  EXPECT_DOUBLE_EQ(merit.committed, 0.7);
  const Fitness tenths{Judgement::graded, {0.3, 0.4, 0.2, 0.1}};
  EXPECT_DOUBLE_EQ(tenths.of(merit), 0.3 * 0.625 + 0.4 * 0.4 + 0.2 * 0.7 + 0.1 * 0.3);  // 0.5175
  EXPECT_DOUBLE_EQ((Fitness{Judgement::graded, {3.0, 4.0, 2.0, 1.0}}.of(merit)), tenths.of(merit))
      << "shares of the sum";
  EXPECT_DOUBLE_EQ((Fitness{Judgement::graded, {0.0, 0.0, 5.0, 0.0}}.of(merit)), 0.7);
  EXPECT_DOUBLE_EQ((Fitness{Judgement::graded, {0.0, 1.0, 0.0, 0.0}}.of(merit)), 0.4);
  EXPECT_DOUBLE_EQ(tenths.of(Merit{0.4}), -0.4);
  // The goals of nsga2: (0.3 (1 - 0.625) + 0.2 0.3 + 0.1 0.7) / 0.6, and the time.
  EXPECT_DOUBLE_EQ(tenths.goals(merit)[0], (0.1125 + 0.06 + 0.07) / 0.6);
  EXPECT_DOUBLE_EQ(tenths.goals(merit)[1], 0.6);
}

// Unlike the two steps, it tells two points apart that were both disconnected once.
TEST(TuneFitness, TheGradedFitnessHasNoGate) {
  const Trial quick{true, 0.01, 0.2, 20.0, 1.0, 0.5}, slow{true, 0.01, 0.6, 60.0, 1.0, 0.5},
      whole{true, 0.0, 0.6, 60.0, 1.0, 0.5};
  const auto of = [](Judgement judgement, const Trial& trial) {
    return Fitness{judgement, {}}.of(merit_of({&trial, 1}));
  };
  EXPECT_EQ(of(Judgement::two_step, quick), of(Judgement::two_step, slow));
  EXPECT_GT(of(Judgement::two_step, whole), of(Judgement::two_step, quick));
  EXPECT_GT(of(Judgement::graded, quick), of(Judgement::graded, slow));
  EXPECT_GT(of(Judgement::graded, quick), of(Judgement::graded, whole))
      << "one tick in a hundred, and three times as fast";
}

TEST(TuneFitness, ScoresInNumbersForPeople) {
  const std::vector<Trial> trials{
      {true, 0.0, 0.2, 20.0}, {true, 0.5, 0.4, 40.0}, {false, 0.0, 1.0, 0.0}, {true, 0.0, 0.9, 90.0}};
  const auto score = score_of(trials);
  EXPECT_EQ(score.trials, 4U);
  EXPECT_DOUBLE_EQ(score.complete_share, 0.75);
  EXPECT_DOUBLE_EQ(score.disconnected_share, 0.25);
  ASSERT_TRUE(score.median_time_s);
  EXPECT_DOUBLE_EQ(*score.median_time_s, 65.0);  // of 20, 40, 90 and never
}

TEST(TuneFitness, RunsNeverCompleteAreLaterThanAllInTheMedian) {
  const Trial quick{true, 0.0, 0.2, 20.0}, slow{true, 0.0, 0.4, 40.0}, never{false, 0.0, 1.0, 0.0};
  const auto median = [](std::vector<Trial> trials) { return score_of(trials).median_time_s; };
  EXPECT_EQ(median({quick, never, slow}), 40.0);
  EXPECT_EQ(median({never, quick, slow, quick}), 30.0);
  EXPECT_FALSE(median({never}));
  EXPECT_FALSE(median({quick, never}));  // between 20 s and never
  EXPECT_FALSE(median({never, quick, never}));
  EXPECT_FALSE(median({never, never}));
}

// ----------------------------------------------------------------------------------- the file --

class Tune : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "banyan-tune-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    home_ = pattern;
    write("world.toml",
          "name = \"world\"\n[mission]\nalgorithm = \"outwards\"\ntime_limit_s = 10.0\n[swarm]\nrobots = "
          "5\n[targets]\ncount = 2\nradius_m = "
          "1.0\n");
  }
  void TearDown() override { fs::remove_all(home_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(home_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string folder(const std::string& name) const {
    fs::create_directories(home_ / name);
    return (home_ / name).string();
  }
  // A whole file; a part given replaces the one with the same start.
  [[nodiscard]] static std::string file(
      const std::string& optimizer = "",
      const std::string& bounds = "target_gain = [0.1, 1.1]\navoidance_gain = [0.0, 2.0]\n",
      const std::string& seeds = "training = \"1-2\"\ntest = [11, 12, 13]\n",
      const std::string& worlds = "[[worlds]]\nscenario = \"world.toml\"\n", const std::string& rest = "") {
    return worlds + "[seeds]\n" + seeds + "[optimizer]\n" + optimizer + "[bounds]\n" + bounds + rest;
  }
  [[nodiscard]] LoadedTune load(const std::string& text) const {
    return parse_tune((home_ / "tune.toml").string(), text, algorithms());
  }
  [[nodiscard]] TunePlan plan(const std::string& text) const {
    auto loaded = load(text);
    for (const auto& problem : loaded.problems) ADD_FAILURE() << config::to_string(problem);
    return std::move(loaded.plan);
  }
  // Exactly one problem, at that line of the file, with that in its text.
  void expect_problem(const std::string& text, int line, const std::string& part) const {
    const auto loaded = load(text);
    ASSERT_EQ(loaded.problems.size(), 1U)
        << text << (loaded.problems.empty() ? "" : config::to_string(loaded.problems[1 % loaded.problems.size()]));
    EXPECT_FALSE(loaded.ok());
    EXPECT_EQ(loaded.problems[0].place.line, line) << config::to_string(loaded.problems[0]);
    EXPECT_TRUE(has(config::to_string(loaded.problems[0]), part)) << config::to_string(loaded.problems[0]);
  }
  fs::path home_;
};

TEST_F(Tune, ReadsAFile) {
  const auto p = plan("name = \"n\"\ndescription = \"d\"\n" +
                      file("algorithm = \"nsga2\"\ngenerations = 7\npopulation = 12\nislands = 3\nseed = 5\n"
                           "crossover_probability = 0.5\n",
                           "target_gain = [0.1, 1]\n", "training = \"3-5\"\ntest = [9]\n",
                           "[[worlds]]\nscenario = \"world.toml\"\nset = { \"radio.range_m\" = 2.5 }\n"
                           "[[worlds]]\nscenario = \"world.toml\"\nset = { targets = { radius_m = 1.5 } }\n"
                           "[set]\n\"mission.algorithm\" = \"inwards\"\nradio.range_m = 2.25\n",
                           "[initial]\ntarget_gain = 0.75\n"));
  EXPECT_EQ(p.name, "n");
  EXPECT_EQ(p.optimizer.search, Search::nsga2);
  EXPECT_EQ(p.optimizer.generations, 7U);
  EXPECT_EQ(p.optimizer.population, 12U);
  EXPECT_EQ(p.optimizer.islands, 3U);
  EXPECT_EQ(p.optimizer.seed, 5U);
  EXPECT_EQ(p.optimizer.crossover_probability, 0.5);
  EXPECT_EQ(p.optimizer.mutation_probability, 1.0);  // one parameter
  EXPECT_EQ(p.training, (std::vector<std::uint64_t>{3, 4, 5}));
  EXPECT_EQ(p.test, (std::vector<std::uint64_t>{9}));
  ASSERT_EQ(p.worlds.size(), 2U);
  EXPECT_EQ(p.worlds[0].scenario.radio.range_m, 2.5);  // a world's own change wins
  EXPECT_EQ(p.worlds[1].scenario.radio.range_m, 2.25);
  EXPECT_EQ(p.worlds[0].scenario.mission.algorithm, "inwards");
  EXPECT_EQ(std::get<world::RingTargets>(p.worlds[1].scenario.targets).radius_m, 1.5);
  EXPECT_EQ(p.initial, (std::vector<double>{0.75}));
  EXPECT_EQ(p.evaluations(), 12U * 8U);
  EXPECT_EQ(p.runs(), 6U);
}

TEST_F(Tune, ReadsJsonToTheSamePlan) {
  const auto toml = plan(file("generations = 3\n", "target_gain = [0.1, 1.1]\n"));
  const auto loaded =
      parse_tune((home_ / "tune.json").string(),
                 R"({"worlds": [{"scenario": "world.toml"}], "seeds": {"training": "1-2", "test": [11, 12, 13]},
                                     "optimizer": {"generations": 3}, "bounds": {"target_gain": [0.1, 1.1]}})",
                 algorithms());
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(tune_json(loaded.plan), tune_json(toml));
  EXPECT_EQ(tune_digest(loaded.plan), tune_digest(toml));
}

TEST_F(Tune, TheDigestIsOfWhatCounts) {
  const auto digest = tune_digest(plan(file()));
  EXPECT_EQ(tune_digest(plan("# a comment\n" + file())), digest);
  EXPECT_NE(tune_digest(plan(file("seed = 2\n"))), digest);
  EXPECT_NE(tune_digest(plan(file("", "target_gain = [0.1, 1.1]\navoidance_gain = [0.0, 2.0000000000000004]\n"))),
            digest);
  write("world.toml", contents(home_ / "world.toml") + "center_m = [0.1, 0.0]\n");
  EXPECT_NE(tune_digest(plan(file())), digest);
}

TEST_F(Tune, EveryFaultOfAFileHasItsLine) {
  // Lines: 1-2 the world, 3-5 seeds, 6 optimizer, 7 its first key.
  const std::string bounds = "target_gain = [0.1, 1.1]\n", seeds = "training = \"1-2\"\ntest = \"11-13\"\n";
  expect_problem(file("algorithm = \"sgaa\"\n"), 7, "did you mean \"sga\"");
  expect_problem(file("generatons = 3\n"), 7, "did you mean optimizer.generations");
  expect_problem(file("generations = 0\n"), 7, "optimizer.generations");
  expect_problem(file("generations = 2.5\n"), 7, "whole number");
  expect_problem(file("population = 7\n"), 7, "even");
  expect_problem(file("population = 10\nalgorithm = \"nsga2\"\n"), 7, "multiples of 4");
  expect_problem(file("population = 4\nalgorithm = \"nsga2\"\n"), 7, "at least 8");
  expect_problem(file("population = 4\nalgorithm = \"cmaes\"\n"), 7, "at least 5");
  expect_problem(file("algorithm = \"cmaes\"\ncrossover_probability = 0.5\n"), 8, "has no meaning");
  expect_problem(file("step = 0.5\n"), 7, "has no meaning");
  expect_problem(file("mutation_probability = 1.5\n"), 7, "mutation_probability");
  expect_problem(file("seed = -1\n"), 7, "optimizer.seed");
  expect_problem(file("islands = 0\n"), 7, "optimizer.islands");

  expect_problem(file("", "target_gain = [1.1, 0.1]\n"), 8, "below the highest");
  expect_problem(file("", "target_gain = [0.5, 0.5]\n"), 8, "below the highest");
  expect_problem(file("", "target_gain = [0.1, 5.0]\n"), 8, "allowed: 0 to 1.9");
  expect_problem(file("", "target_gain = [nan, 1.0]\n"), 8, "allowed: 0 to 1.9");
  expect_problem(file("", "target_gain = 1.0\n"), 8, "[lowest, highest]");
  expect_problem(file("", "target_gain = [0.1, 0.2, 0.3]\n"), 8, "[lowest, highest]");
  expect_problem(file("", "target_gian = [0.1, 1.0]\n"), 8, "did you mean target_gain");
  expect_problem(file("", "rnge = [1.0, 2.0]\n"), 8, "no such parameter");
  expect_problem(file("", ""), 7, "at least one parameter");

  expect_problem(file("", bounds, "training = \"1-5\"\ntest = \"5-9\"\n"), 5, "overlaps seeds.training (5)");
  expect_problem(file("", bounds, "training = \"5-1\"\ntest = [9]\n"), 4, "seeds.training");
  expect_problem(file("", bounds, "training = []\ntest = [9]\n"), 4, "empty");
  expect_problem(file("", bounds, "training = [1, 1]\ntest = [9]\n"), 4, "twice");
  expect_problem(file("", bounds, "training = [1.5]\ntest = [9]\n"), 4, "seeds.training");
  expect_problem(file("", bounds, "training = [1]\n"), 3, "seeds.test");

  expect_problem(file("", bounds, seeds, "[[worlds]]\nscenario = \"missing.toml\"\n"), 2, "missing.toml");
  expect_problem(file("", bounds, seeds, "[[worlds]]\nscenario = 3\n"), 2, "must be a text");
  expect_problem(file("", bounds, seeds, "[[worlds]]\n"), 1, "worlds[0].scenario");
  expect_problem(file("", bounds, seeds, "worlds = []\n"), 1, "at least one world");
  expect_problem(file("", bounds, seeds, "[[worlds]]\nscenario = \"world.toml\"\nset = { \"radio.rnge_m\" = 2.5 }\n"),
                 0,
                 "tune.toml:3: error: radio.rnge_m");  // an option, to config
  expect_problem(file("", bounds, seeds, "[[worlds]]\nscenario = \"world.toml\"\nset = { seed = 3 }\n"), 3,
                 "worlds[0].set: sets seed; a tuning takes its seeds from [seeds]");
  expect_problem(file("", bounds, seeds, "[[worlds]]\nscenario = \"world.toml\"\n", "[set]\nseed = 3\n"), 10,
                 "set: sets seed; a tuning takes its seeds from [seeds]");
  expect_problem(file("", bounds, seeds,
                      "[[worlds]]\nscenario = \"world.toml\"\n[[worlds]]\nscenario = \"world.toml\"\n"
                      "set = { \"mission.algorithm\" = \"inwards\" }\n"),
                 4, "one search is for one algorithm");
  expect_problem(file("", bounds, seeds, "nmae = \"x\"\n[[worlds]]\nscenario = \"world.toml\"\n"), 1,
                 "did you mean name");
  expect_problem(file("", bounds, seeds, "name = \"a/b\"\n[[worlds]]\nscenario = \"world.toml\"\n"), 1,
                 "letters, digits");

  expect_problem(file("", bounds, seeds, "[[worlds]]\nscenario = \"world.toml\"\n", "[initial]\ntarget_gain = 1.5\n"),
                 10, "allowed: 0.1 to 1.1");
  expect_problem(
      file("", bounds, seeds, "[[worlds]]\nscenario = \"world.toml\"\n", "[initial]\navoidance_gain = 1.5\n"), 10,
      "is not searched");
  expect_problem(file("", bounds, seeds, "[[worlds]]\nscenario = \"world.toml\"\n", "[initial]\nnonsense = 1.5\n"), 10,
                 "no such parameter");
  expect_problem(file("", "safe_range = [0.25, 1.0]\n", seeds, "[[worlds]]\nscenario = \"world.toml\"\n",
                      "[initial]\nsafe_range = 0.99\n"),
                 9, "cannot be run");
  expect_problem("[[worlds]\n", 1, "");
}

TEST_F(Tune, TellsAllFaultsAtOnceInTheOrderOfTheFile) {
  const auto loaded = load(file("generations = 0\npopulation = 7\n", "target_gain = [2, 1]\nx = [1, 2]\n",
                                "training = \"1-2\"\ntest = \"2-3\"\n", "[[worlds]]\nscenario = \"no.toml\"\n"));
  ASSERT_EQ(loaded.problems.size(), 6U);
  for (std::size_t i = 1; i < loaded.problems.size(); ++i)
    EXPECT_LE(loaded.problems[i - 1].place.line, loaded.problems[i].place.line);
}

TEST_F(Tune, ReadsTheFitness) {
  const auto fitness = [&](const std::string& text) {
    return plan(file("", "target_gain = [0.1, 1.1]\n", "training = [1]\ntest = [2]\n",
                     "[[worlds]]\nscenario = \"world.toml\"\n", text))
        .fitness;
  };
  EXPECT_EQ(fitness("").judgement, Judgement::two_step);
  EXPECT_EQ(fitness("[fitness]\nkind = \"two-step\"\n").judgement, Judgement::two_step);
  const auto graded = fitness("[fitness]\nkind = \"graded\"\nheld = 5\ncommitted = 0\n");
  EXPECT_EQ(graded.judgement, Judgement::graded);
  EXPECT_EQ(graded.weights.held, 5.0);
  EXPECT_EQ(graded.weights.time, Fitness{}.weights.time);
  EXPECT_EQ(graded.weights.committed, 0.0);
  EXPECT_NE(tune_digest(plan(file("", "target_gain = [0.1, 1.1]\n") + "[fitness]\nkind = \"graded\"\n")),
            tune_digest(plan(file("", "target_gain = [0.1, 1.1]\n") + "[fitness]\nkind = \"graded\"\ntime = 0.5\n")));
}

TEST_F(Tune, EveryFaultOfTheFitnessHasItsLine) {
  const std::string graded = file("", "target_gain = [0.1, 1.1]\n") + "[fitness]\nkind = \"graded\"\n";  // lines 9, 10
  expect_problem(file("", "target_gain = [0.1, 1.1]\n") + "[fitness]\nkind = \"grded\"\n", 10,
                 "did you mean \"graded\"");
  expect_problem(graded + "held = -1\n", 11, "allowed: 0 to");
  expect_problem(graded + "broken = 1\n", 11, "fitness.broken");
  expect_problem(graded + "held = 0\ntime = 0\ndisconnected = 0\ncommitted = 0\n", 9, "no weight above 0");
  expect_problem(file("", "target_gain = [0.1, 1.1]\n") + "[fitness]\nheld = 1\n", 10, "has no meaning");
  expect_problem(
      file("algorithm = \"nsga2\"\n", "target_gain = [0.1, 1.1]\n") + "[fitness]\nkind = \"graded\"\ntime = 0\n", 7,
      "two goals");
}

TEST_F(Tune, OtherAlgorithmsParametersAreNotSearched) {
  const std::string bounds = "target_gain = [0.1, 1.1]\nlink_gain = [0.0, 1.0]\n";
  expect_problem(file("", bounds), 9, "is no parameter of outwards");
  EXPECT_TRUE(load(file("", bounds, "training = [1]\ntest = [2]\n", "[[worlds]]\nscenario = \"world.toml\"\n",
                        "[set]\n\"mission.algorithm\" = \"link-consensus\"\n"))
                  .ok());
}

// Whatever is on the list: half to one and a half times the default of every parameter of its own.
TEST_F(Tune, EveryAlgorithmCanBeTuned) {
  for (const Algorithm* algorithm : algorithms()) {
    const std::string name(algorithm->name());
    const auto rows = algorithm->parameters();
    const auto values = algorithm->values({});
    std::string bounds;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double low = std::max(config::widened(rows[k]->minimum), 0.5 * config::widened(values[k])),
                   high = std::min(config::widened(rows[k]->maximum), 1.5 * config::widened(values[k]));
      if (!(low < high)) continue;
      bounds +=
          std::string(rows[k]->key) + " = [" + config::number_text(low) + ", " + config::number_text(high) + "]\n";
    }
    const auto p =
        plan("name = \"" + name + "\"\n" +
             file("generations = 1\npopulation = 2\nislands = 1\n", bounds, "training = [1]\ntest = [2]\n",
                  "[[worlds]]\nscenario = \"world.toml\"\n",
                  "[set]\n\"mission.algorithm\" = \"" + name + "\"\n[fitness]\nkind = \"graded\"\n[initial]\n"));
    ASSERT_GT(p.bounds.size(), 5U) << name;
    const auto workers = thread_workers([](std::string_view task) { return simulate(task, algorithms()); }, 2);
    const auto result = tune(p, *workers, folder(name));
    const auto &best = result.candidates.at(0), &untuned = result.candidates.at(1);
    EXPECT_GE(p.fitness.of(best.training.merit), p.fitness.of(untuned.training.merit))
        << name << " starts from its defaults";
    EXPECT_GT(p.fitness.of(untuned.training.merit), 0.0) << name;
  }
}

TEST_F(Tune, AFileIsLaidOverItsBase) {
  fs::create_directories(home_ / "below");
  write("below/base.toml",
        "name = \"base\"\ndescription = \"d\"\n[[worlds]]\nscenario = \"../world.toml\"\n[seeds]\ntraining = "
        "[1, 2]\ntest = [3]\n[optimizer]\nseed = 5\ngenerations = 7\n");
  const auto p = plan(
      "base = \"below/base.toml\"\n[optimizer]\ngenerations = 9\n[seeds]\ntraining = [4]\n"
      "[bounds]\ntarget_gain = [0.1, 1.1]\n");
  EXPECT_EQ(p.name, "tune") << "the file's, not the base's";
  EXPECT_EQ(p.description, "d");
  EXPECT_EQ(p.worlds.size(), 1U) << "found beside the base";
  EXPECT_EQ(p.training, (std::vector<std::uint64_t>{4}));
  EXPECT_EQ(p.test, (std::vector<std::uint64_t>{3}));
  EXPECT_EQ(p.optimizer.seed, 5U);
  EXPECT_EQ(p.optimizer.generations, 9U);
}

TEST_F(Tune, FaultsOfABaseSayWhereTheyAre) {
  const std::string bounds = "[bounds]\ntarget_gain = [0.1, 1.1]\n";
  expect_problem("base = 3\n" + file("", "target_gain = [0.1, 1.1]\n"), 1, "must be the name of a file");
  expect_problem("base = \"none.toml\"\n" + file("", "target_gain = [0.1, 1.1]\n"), 1, "none.toml");
  write("base.toml", file("generatons = 3\n", "avoidance_gain = [0.1, 1.1]\n"));
  expect_problem("base = \"base.toml\"\n" + bounds, 7, "base.toml:7: error: optimizer.generatons");
  write("circle.toml", "base = \"circle.toml\"\n");
  expect_problem("base = \"circle.toml\"\n" + file("", "target_gain = [0.1, 1.1]\n"), 1,
                 "circle.toml:1: error: base: is one too many");
}

TEST_F(Tune, ABaseMayHaveABaseAndSayWhatIsForAnotherOptimizer) {
  write("worlds.toml", file("algorithm = \"cmaes\"\nstep = 0.5\npopulation = 8\n") + "[fitness]\nkind = \"graded\"\n");
  write("bounds.toml", "base = \"worlds.toml\"\n[bounds]\navoidance_gain = [0.1, 1.1]\n");
  const auto p = plan("base = \"bounds.toml\"\n[optimizer]\nalgorithm = \"nsga2\"\n");
  EXPECT_EQ(p.optimizer.search, Search::nsga2);
  EXPECT_EQ(p.optimizer.population, 8U);
  EXPECT_EQ(p.fitness.judgement, Judgement::graded);
  ASSERT_FALSE(p.bounds.empty());
  EXPECT_TRUE(std::any_of(p.bounds.begin(), p.bounds.end(), [](const TuneBound& b) {
    return b.parameter == "avoidance_gain" && b.low == 0.1 && b.high == 1.1;
  }));
  expect_problem("base = \"bounds.toml\"\n[optimizer]\nalgorithm = \"nsga2\"\nstep = 0.5\n", 4, "has no meaning");
}

TEST_F(Tune, AMissingFileIsAProblem) {
  const auto loaded = load_tune((home_ / "none.toml").string(), algorithms());
  ASSERT_EQ(loaded.problems.size(), 1U);
  EXPECT_TRUE(has(config::to_string(loaded.problems[0]), "none.toml"));
}

TEST_F(Tune, WarnsOfBoundsInWhichNothingRuns) {
  const auto loaded = load(file("", "safe_range = [0.96, 1.0]\n"));  // S < delta = 0.95 is impossible
  EXPECT_TRUE(loaded.ok());
  ASSERT_EQ(loaded.problems.size(), 1U);
  EXPECT_TRUE(loaded.problems[0].warning);
}

TEST_F(Tune, InfeasibilityGrowsWithTheDistance) {
  const auto p = plan(file("", "recruitment_distance = [0.25, 1.0]\nsafe_range = [0.25, 1.0]\n"));
  const auto at = [&](double e, double s) { return infeasibility(p, std::vector{e, s}); };
  EXPECT_EQ(at(0.65, 0.7), 0.0);
  EXPECT_GT(at(0.7, 0.7), 0.0);                // E < S is strict
  EXPECT_NEAR(at(0.8, 0.7), 0.1 / 1.1, 1e-6);  // 0.1 C too much
  EXPECT_NEAR(at(1.0, 0.7), 0.3 / 1.3, 1e-6);
  EXPECT_NEAR(at(0.5, 1.0), 0.05 / 1.05, 1e-6);  // S < delta = 0.95
  EXPECT_LE(at(1.0, 0.25), 1.0);
}

// Also where the reason is another than the paper's chain of lengths, for whatever algorithm.
TEST_F(Tune, WhateverDoesNotFitHasASlopeThatLeadsBack) {
  auto p = plan(file("", "avoidance_gain = [0.1, 5.0]\n"));
  const auto look = [&](const char* algorithm, std::initializer_list<TuneBound> bounds) {
    for (auto& world : p.worlds) world.scenario.mission.algorithm = algorithm;
    p.bounds = bounds;
  };
  look("mst", {{"trigger_distance", 0.5, 1.0},
               {"longest_link", 0.5, 1.0}});  // the first below the second; by default 0.8 and 0.95
  const auto at = [&](double a, double b) { return infeasibility(p, std::vector{a, b}); };
  EXPECT_EQ(at(0.8, 0.9), 0.0);
  double before = 0.0;
  for (const double trigger : {0.61, 0.7, 0.8, 0.9, 1.0}) {
    EXPECT_GT(at(trigger, 0.6), before) << trigger;
    before = at(trigger, 0.6);
  }
  EXPECT_LT(before, 1.0);
  // From (1, 0.6) to (0.8, 0.95) they meet after 0.4 / 0.55 of the way.
  EXPECT_NEAR(before, 0.4 / 0.55 / (1.0 + 0.4 / 0.55), 1e-4);
  look("link-consensus", {{"add_distance", 0.1, 1.0}, {"nominate_distance", 0.1, 1.0}});
  EXPECT_EQ(at(0.5, 0.6), 0.0);
  EXPECT_GT(at(0.9, 0.5), at(0.6, 0.5));
  EXPECT_GT(at(0.6, 0.5), 0.0);
}

// --------------------------------------------------------------------------------- the search --

// Calls of bowl().
std::atomic<int>& runs() {
  static std::atomic<int> count{0};
  return count;
}

json config_of(std::string_view task) { return json::parse(json::from_msgpack(task).at("config").get<std::string>()); }

// What a formula makes of a run: quickest at target_gain 0.6 and avoidance_gain 1.0.
std::string bowl(std::string_view task) {
  ++runs();
  const auto config = config_of(task);
  const auto& parameters = config.at("mission").at("parameters");
  const double x = parameters.value("target_gain", 0.49) - 0.6,
               y = (parameters.value("avoidance_gain", 0.5) - 1.0) / 2.0;
  const double time = std::min(2.0 * (x * x + y * y) + 0.001 * config.at("seed").get<double>(), 1.0);
  Outcome outcome;
  outcome.row = record::run_csv_row(row_with(true, 1000, 0, 0, time));
  return encode(outcome);
}
// Every gain of time costs connectivity.
std::string conflict(std::string_view task) {
  const auto config = config_of(task);
  const double x = config.at("mission").at("parameters").value("target_gain", 0.49);
  Outcome outcome;
  outcome.row = record::run_csv_row(row_with(true, 10000, static_cast<std::uint64_t>(4000.0 * x), 0, 1.0 - 0.5 * x));
  return encode(outcome);
}
std::string failing(std::string_view /*task*/) {
  Outcome outcome;
  outcome.error = "the world fell apart";
  return encode(outcome);
}

std::string optimizer(const char* algorithm, int generations = 4) {
  return "algorithm = \"" + std::string(algorithm) + "\"\ngenerations = " + std::to_string(generations) +
         "\npopulation = 8\nislands = 2\n";
}

// Everything that a tuning leaves and that does not depend on the program that draws.
std::vector<std::string> outcome_of(const fs::path& directory) {
  std::vector<std::string> files;
  for (const char* name : {"best.toml", "generations.csv", "front.csv", "tune.json"})
    files.push_back(contents(directory / name));
  return files;
}

class TuneSearch : public Tune, public ::testing::WithParamInterface<const char*> {
 protected:
  static void run_through(const TunePlan& p, const std::string& directory, Work work, int threads) {
    const auto workers = thread_workers(work, threads);
    const auto result = tune(p, *workers, directory);
    ASSERT_FALSE(result.interrupted);
    EXPECT_TRUE(tune_finished(directory));
    EXPECT_FALSE(fs::exists(directory + "/checkpoint.jsonl"));
  }
};
INSTANTIATE_TEST_SUITE_P(Optimizers, TuneSearch, ::testing::Values("sga", "nsga2", "cmaes"),
                         [](const auto& search) { return std::string(search.param); });

TEST_P(TuneSearch, InterruptedAnywhereEndsWithTheSameFiles) {
  const auto p = plan(file(optimizer(GetParam())));
  const auto whole = folder("whole");
  run_through(p, whole, bowl, 2);
  for (int calls = 1; calls <= 5; ++calls) {
    const auto directory = folder("stopped-" + std::to_string(calls));
    const auto workers = thread_workers(bowl, 2);
    TuneHooks hooks;
    int left = calls;
    hooks.stopped = [&] { return --left <= 0; };
    const auto first = tune(p, *workers, directory, hooks);
    ASSERT_TRUE(first.interrupted);
    EXPECT_FALSE(tune_finished(directory));
    const auto second = tune(p, *workers, directory);
    ASSERT_FALSE(second.interrupted);
    EXPECT_EQ(outcome_of(directory), outcome_of(whole)) << "stopped at call " << calls;
  }
}

TEST_P(TuneSearch, InterruptedAgainAndAgainEndsWithTheSameFiles) {
  const auto p = plan(file(optimizer(GetParam())));
  const auto whole = folder("whole"), bits = folder("bits");
  run_through(p, whole, bowl, 1);
  TuneHooks hooks;
  int left = 0;
  hooks.stopped = [&] { return --left <= 0; };
  TuneResult result;
  for (int attempts = 0; attempts < 20; ++attempts) {
    left = 2;  // about a generation at a time
    const auto workers = thread_workers(bowl, 1);
    result = tune(p, *workers, bits, attempts < 19 ? hooks : TuneHooks{});
    if (!result.interrupted) break;
  }
  EXPECT_FALSE(result.interrupted);
  EXPECT_GT(result.resumed_at, 0U);
  EXPECT_EQ(outcome_of(bits), outcome_of(whole));
}

std::string really(std::string_view task) { return simulate(task, algorithms()); }

TEST_P(TuneSearch, AnyNumberOfThreadsGivesTheSame) {
  const auto p = plan(file(optimizer(GetParam(), 2)));
  const auto one = folder("one"), three = folder("three");
  run_through(p, one, really, 1);  // real runs
  run_through(p, three, really, 3);
  EXPECT_EQ(outcome_of(one), outcome_of(three));
}

TEST_P(TuneSearch, FindsTheBottomOfABowl) {
  const auto p =
      plan(file("generations = 25\npopulation = 16\nislands = 2\nalgorithm = \"" + std::string(GetParam()) + "\"\n"));
  const auto workers = thread_workers(bowl, 2);
  const auto result = tune(p, *workers, folder("out"));
  const auto& best = result.candidates.at(0);
  EXPECT_NEAR(best.point[0], 0.6, 0.05);
  EXPECT_NEAR(best.point[1], 1.0, 0.1);
  EXPECT_GT(p.fitness.of(best.training.merit), 1.99);
  // Table I: 2 (0.11^2 + 0.25^2) + mean of 0.001 seed.
  const double untuned = 2.0 * (0.11 * 0.11 + 0.25 * 0.25);
  EXPECT_EQ(result.candidates.at(1).name, "default");
  EXPECT_NEAR(p.fitness.of(result.candidates[1].training.merit), 2.0 - untuned - 0.0015, 1e-6);
  EXPECT_NEAR(p.fitness.of(result.candidates[1].test.merit), 2.0 - untuned - 0.012, 1e-6);
  EXPECT_EQ(result.candidates[1].point, (std::vector<double>{0.49, 0.5}));
  EXPECT_EQ(result.evaluations, 2U * 16U * 26U);
}

TEST_P(TuneSearch, TheBestSoFarNeverGetsWorse) {
  const auto p = plan(file(optimizer(GetParam(), 8)));
  const auto directory = folder("out");
  run_through(p, directory, bowl, 2);
  std::istringstream table(contents(directory + "/generations.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "generation,island,evaluations,best_fitness,mean_fitness,worst_fitness,target_gain,avoidance_gain");
  std::vector<double> best(2, -1.0);
  int rows = 0;
  for (char comma = 0; std::getline(table, line); ++rows) {
    std::istringstream cells(line);
    double generation = 0.0, evaluations = 0.0, now = 0.0, mean = 0.0, worst = 0.0;
    std::size_t island = 9;
    cells >> generation >> comma >> island >> comma >> evaluations >> comma >> now >> comma >> mean >> comma >> worst;
    ASSERT_LT(island, 2U);
    EXPECT_EQ(generation, rows / 2);
    EXPECT_EQ(evaluations, 8.0 * (generation + 1.0));
    EXPECT_GE(now, best[island]);
    EXPECT_GE(now, mean);
    EXPECT_GE(mean, worst);
    best[island] = now;
  }
  EXPECT_EQ(rows, 2 * 9);
}

TEST_F(Tune, DrawsItsFigureOrSaysThatItCannot) {
  const auto p = plan(file(optimizer("sga")));
  const auto workers = thread_workers(bowl, 2);
  TuneHooks hooks;
  hooks.drawer = {BANYAN_FIGURES_SCRIPT, {"/no/python"}};
  const auto without = tune(p, *workers, folder("without"), hooks);
  ASSERT_EQ(without.warnings.size(), 1U);
  EXPECT_TRUE(has(without.warnings[0], "figures were not drawn")) << without.warnings[0];
  EXPECT_TRUE(tune_finished((home_ / "without").string()));
  EXPECT_TRUE(fs::exists(home_ / "without/fitness.json"));
  hooks.drawer.pythons = {"/usr/bin/python3"};
  EXPECT_TRUE(tune(p, *workers, folder("with"), hooks).warnings.empty());
  EXPECT_EQ(contents(home_ / "with/fitness.json"), contents(home_ / "without/fitness.json"));
  const auto figure = contents(home_ / "with/fitness.svg");
  EXPECT_TRUE(has(figure, "best, island 1")) << figure.substr(0, 500);
  EXPECT_TRUE(has(figure, "mean of the populations"));
}

TEST_F(Tune, ManyIslandsShareACurve) {
  const auto p = plan(file("generations = 2\npopulation = 2\nislands = 9\n"));
  const auto workers = thread_workers(bowl, 2);
  (void)tune(p, *workers, folder("out"));
  EXPECT_TRUE(has(contents(home_ / "out/fitness.json"), "best, mean and range of the islands"));
}

TEST_F(Tune, AnotherSeedSearchesElsewhere) {
  const auto first = folder("first"), second = folder("second");
  const auto workers = thread_workers(bowl, 2);
  (void)tune(plan(file(optimizer("sga"))), *workers, first);
  (void)tune(plan(file(optimizer("sga") + "seed = 2\n")), *workers, second);
  EXPECT_NE(contents(first + "/best.toml"), contents(second + "/best.toml"));
}

TEST_F(Tune, BestTomlIsAFragmentOfAScenario) {
  const auto p = plan(file(optimizer("sga")));
  const auto directory = folder("out");
  const auto workers = thread_workers(bowl, 2);
  const auto result = tune(p, *workers, directory);
  const auto loaded = config::parse_configuration(
      "with-best.toml", contents(home_ / "world.toml") + contents(directory + "/best.toml"), algorithms());
  ASSERT_TRUE(loaded.ok());
  const auto& parameters = loaded.configuration.scenario.mission.parameters;
  ASSERT_EQ(parameters.size(), 2U);
  EXPECT_EQ(parameters[0], (std::pair<std::string, double>{"target_gain", result.candidates[0].point[0]}));
  EXPECT_EQ(parameters[1], (std::pair<std::string, double>{"avoidance_gain", result.candidates[0].point[1]}));
}

TEST_F(Tune, StartsFromTheInitialPoint) {
  const auto p =
      plan(file("generations = 1\npopulation = 2\nislands = 1\n",
                "target_gain = [0.1, 1.1]\navoidance_gain = [0.0, 2.0]\n", "training = [1]\ntest = [2]\n",
                "[[worlds]]\nscenario = \"world.toml\"\n", "[initial]\ntarget_gain = 0.6\navoidance_gain = 1.0\n"));
  const auto workers = thread_workers(bowl, 1);
  const auto result = tune(p, *workers, folder("out"));
  EXPECT_NEAR(p.fitness.of(result.candidates[0].training.merit), 2.0 - 0.001, 1e-6);
}

TEST_F(Tune, NsgaTwoLeavesAFrontInWhichNobodyBeatsAnother) {
  const auto p = plan(file(optimizer("nsga2", 6)));
  const auto directory = folder("out");
  const auto workers = thread_workers(conflict, 2);
  const auto result = tune(p, *workers, directory);
  EXPECT_GT(result.front, 3U);
  std::istringstream table(contents(directory + "/front.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line,
            "island,disconnected_time_ratio,normalized_time,held,disconnected,committed,target_gain,avoidance_gain");
  double last_apart = -1.0, last_time = 2.0;
  std::size_t rows = 0;
  for (char comma = 0; std::getline(table, line); ++rows) {
    std::istringstream cells(line);
    double island = 0.0, apart = 0.0, time = 0.0, held = 0.0, disconnected = 0.0, committed = 0.0, gain = 0.0;
    cells >> island >> comma >> apart >> comma >> time >> comma >> held >> comma >> disconnected >> comma >>
        committed >> comma >> gain;
    EXPECT_EQ(disconnected, apart);
    EXPECT_GT(apart, last_apart);  // ascending, so the time must fall
    EXPECT_LT(time, last_time);
    EXPECT_NEAR(time, 1.0 - 0.5 * gain, 1e-6);
    last_apart = apart;
    last_time = time;
  }
  EXPECT_EQ(rows, result.front);
}

TEST_F(Tune, TheGradedFrontIsOfTimeAndAllTheRest) {
  const auto p = plan(file(optimizer("nsga2", 6)) + "[fitness]\nkind = \"graded\"\n");
  const auto directory = folder("out");
  const auto workers = thread_workers(conflict, 2);
  const auto result = tune(p, *workers, directory);
  std::istringstream table(contents(directory + "/front.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "island,cost,normalized_time,held,disconnected,committed,target_gain,avoidance_gain");
  double best = 0.0;
  std::size_t rows = 0;
  for (char comma = 0; std::getline(table, line); ++rows) {
    std::istringstream cells(line);
    double island = 0.0, cost = 0.0, time = 0.0, held = 0.0, disconnected = 0.0, committed = 0.0, gain = 0.0;
    cells >> island >> comma >> cost >> comma >> time >> comma >> held >> comma >> disconnected >> comma >> committed >>
        comma >> gain;
    EXPECT_NEAR(cost, (0.3 * (1.0 - held) + 0.2 * disconnected + 0.1 * committed) / 0.6, 1e-9);
    EXPECT_EQ(held, 1.0);
    EXPECT_NEAR(disconnected, 0.4 * gain, 1e-4);
    EXPECT_NEAR(committed, 0.35, 1e-9);
    // All targets held, a share of 0.4 gain disconnected, 7 of 20 robots committed; weights 0.3, 0.2, 0.1.
    EXPECT_NEAR(cost, (0.2 * 0.4 * gain + 0.1 * 0.35) / 0.6, 1e-4);
    EXPECT_NEAR(time, 1.0 - 0.5 * gain, 1e-6);
    best = std::max(best, 1.0 - 0.6 * cost - 0.4 * time);
  }
  EXPECT_EQ(rows, result.front);
  EXPECT_GT(rows, 3U);
  EXPECT_NEAR(p.fitness.of(result.candidates[0].training.merit), best, 1e-6) << "the fittest is on the front";
}

TEST_F(Tune, TheComparisonIsPartOfTheProgress) {
  const auto p = plan(file(optimizer("sga")));  // 2 islands x 8 x 5 evaluations of 2 runs; 4 candidates on 5 seeds
  const auto workers = thread_workers(bowl, 2);
  TuneHooks hooks;
  std::vector<double> searching, comparing;
  hooks.progress = [&](double share, const std::string& text) {
    (has(text, "comparing") ? comparing : searching).push_back(share);
  };
  (void)tune(p, *workers, folder("out"), hooks);
  ASSERT_FALSE(searching.empty());
  ASSERT_FALSE(comparing.empty());
  EXPECT_DOUBLE_EQ(searching.back(), 160.0 / 180.0);
  EXPECT_DOUBLE_EQ(comparing.back(), 1.0);
}

TEST_F(Tune, WhatCannotBeRunOrWasSeenCostsNoRun) {
  const auto p = plan(file("population = 16\ngenerations = 6\nislands = 1\n",
                           "safe_range = [0.25, 0.975]\nrecruitment_distance = [0.225, 0.95]\n"));
  runs() = 0;
  const auto workers = thread_workers(bowl, 2);
  const auto result = tune(p, *workers, folder("out"));
  const int most = static_cast<int>(result.evaluations * p.runs() + result.candidates.size() * 5);
  EXPECT_LT(runs().load(), most);
  EXPECT_EQ(infeasibility(p, result.candidates[0].point), 0.0);
}

TEST_F(Tune, NothingThatRunsIsAnError) {
  auto loaded = load(file(optimizer("sga", 1), "safe_range = [0.96, 1.0]\n"));
  ASSERT_TRUE(loaded.ok());
  const auto workers = thread_workers(bowl, 1);
  EXPECT_THROW((void)tune(loaded.plan, *workers, folder("out")), TuneError);
}

TEST_F(Tune, ARunThatFailsEndsTheTuning) {
  const auto p = plan(file(optimizer("sga")));
  const auto workers = thread_workers(failing, 2);
  try {
    (void)tune(p, *workers, folder("out"));
    FAIL() << "no error";
  } catch (const TuneError& e) { EXPECT_TRUE(has(e.what(), "the world fell apart")) << e.what(); }
}

// ----------------------------------------------------------------------------- the checkpoint --

class TuneCheckpoint : public Tune {
 protected:
  void SetUp() override {
    Tune::SetUp();
    plan_ = plan(file(optimizer("sga")));
    directory_ = folder("out");
    const auto workers = thread_workers(bowl, 1);
    TuneHooks hooks;
    int left = 3;
    hooks.stopped = [&] { return --left <= 0; };
    ASSERT_TRUE(tune(plan_, *workers, directory_, hooks).interrupted);
    whole_ = contents(checkpoint());
    ASSERT_GT(whole_.size(), 1000U);
  }
  [[nodiscard]] fs::path checkpoint() const { return fs::path(directory_) / "checkpoint.jsonl"; }
  void put(const std::string& text) const { std::ofstream(checkpoint(), std::ios::binary | std::ios::trunc) << text; }
  void expect_refused(const TunePlan& p, const std::string& part) const {
    const auto workers = thread_workers(bowl, 1);
    try {
      (void)tune(p, *workers, directory_);
      FAIL() << "no error";
    } catch (const TuneError& e) {
      EXPECT_TRUE(has(e.what(), part)) << e.what();
      EXPECT_TRUE(has(e.what(), "--force")) << "says what to do: " << e.what();
    }
  }
  TunePlan plan_;
  std::string directory_, whole_;
};

TEST_F(TuneCheckpoint, DamageOfAnyKindIsToldAndNothingIsOverwritten) {
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{50}, whole_.find('\n'),
                                   whole_.find('\n') + 1, whole_.size() / 2, whole_.size() - 2, whole_.size() - 1}) {
    put(whole_.substr(0, length));
    expect_refused(plan_, "damaged");
    EXPECT_EQ(contents(checkpoint()).size(), length);
  }
  for (std::size_t at = 3; at < whole_.size(); at += whole_.size() / 7) {
    auto text = whole_;
    text[at] = text[at] == '1' ? '2' : '1';
    if (at > whole_.find('\n')) {
      put(text);
      expect_refused(plan_, "damaged");
    }
  }
  put("{}\n{}\n");
  expect_refused(plan_, "damaged");
  put("not a checkpoint\nat all\n");
  expect_refused(plan_, "damaged");
}

TEST_F(TuneCheckpoint, AChangedTuningIsTold) {
  expect_refused(plan(file(optimizer("sga") + "seed = 9\n")), "belongs to another tuning");
  expect_refused(plan(file(optimizer("sga"), "target_gain = [0.1, 1.0]\navoidance_gain = [0.0, 2.0]\n")),
                 "belongs to another tuning");
  write("world.toml", contents(home_ / "world.toml") + "phase_deg = 10.0\n");
  expect_refused(plan(file(optimizer("sga"))), "belongs to another tuning");
}

TEST_F(TuneCheckpoint, AnotherVersionIsTold) {
  auto head = json::parse(whole_.substr(0, whole_.find('\n')));
  head["git"] = "0123456789ab";
  put(head.dump() + whole_.substr(whole_.find('\n')));
  expect_refused(plan_, "0123456789ab");
}

TEST_F(TuneCheckpoint, IsRemovedWithTheOtherOutputsAndNothingElse) {
  std::ofstream(fs::path(directory_) / "mine.txt") << "mine";
  remove_tune_outputs(directory_);
  EXPECT_FALSE(fs::exists(checkpoint()));
  EXPECT_FALSE(fs::exists(fs::path(directory_) / "generations.csv"));
  EXPECT_TRUE(fs::exists(fs::path(directory_) / "mine.txt"));
}

TEST_F(Tune, KnowsItsOwnFilesFromOthers) {
  const auto directory = folder("out");
  const auto foreign = [&] { return fs::path(foreign_tune_output(directory)).filename().string(); };
  EXPECT_EQ(foreign(), "");
  write("out/mine.txt", "mine");
  EXPECT_EQ(foreign(), "");
  for (const char* name : {"best.toml", "generations.csv", "front.csv", "fitness.json", "fitness.svg", "fitness.png"}) {
    write(std::string("out/") + name, "mine");
    EXPECT_EQ(foreign(), name);
    fs::remove(fs::path(directory) / name);
  }
  for (const char* name : {"tune.json", "checkpoint.jsonl"}) {
    write(std::string("out/") + name, "{\"worlds\": [{\"scenario\": \"world.toml\"}]}");
    EXPECT_EQ(foreign(), name);
    fs::remove(fs::path(directory) / name);
  }
  const auto workers = thread_workers(bowl, 2);
  (void)tune(plan(file(optimizer("sga", 1))), *workers, directory);
  EXPECT_EQ(foreign(), "");
}

TEST_F(Tune, AFolderIsLockedOnceAtATime) {
  const auto directory = folder("out");
  {
    const TuneLock lock(directory);
    EXPECT_THROW(TuneLock another(directory), TuneBusy);
    EXPECT_THROW(TuneLock another(directory), TuneBusy);  // the first refusal took nothing away
  }
  EXPECT_TRUE(fs::is_empty(directory));
  EXPECT_NO_THROW(TuneLock again(directory));
  EXPECT_THROW(TuneLock nowhere(directory + "/nowhere"), record::FileError);
}

TEST_F(TuneCheckpoint, IsKnownHoweverMuchOfItIsLeft) {
  EXPECT_EQ(foreign_tune_output(directory_), "");
  for (const std::size_t length : {std::size_t{0}, std::size_t{10}, whole_.size() / 2}) {
    put(whole_.substr(0, length));
    EXPECT_EQ(foreign_tune_output(directory_), "") << length;
  }
}

TEST_F(TuneCheckpoint, AFullDiskIsAnErrorAndKeepsTheOldOne) {
  fs::remove(checkpoint());
  fs::create_directory(checkpoint());  // cannot be replaced by a file
  const auto workers = thread_workers(bowl, 1);
  EXPECT_ANY_THROW((void)tune(plan_, *workers, directory_));
}

}  // namespace
}  // namespace banyan::study
