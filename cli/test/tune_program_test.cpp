// SPDX-License-Identifier: MIT
// `banyan tune` as a user meets it: started for real, killed, started again.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "banyan/config/config.hpp"
#include "started_program.hpp"

namespace banyan::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

class TuneProgram : public StartedProgram {
 protected:
  void SetUp() override {
    StartedProgram::SetUp();
    write("world.toml", "[mission]\ntime_limit_s = 10.0\n[swarm]\nrobots = 5\n[targets]\ncount = 2\nradius_m = 1.0\n");
    write("quick.toml", file(2));
    write("long.toml", file(40));
  }

  static std::string file(int generations) {
    return "name = \"t\"\n[[worlds]]\nscenario = \"world.toml\"\n[seeds]\ntraining = \"1-2\"\ntest = \"11-12\"\n"
           "[optimizer]\ngenerations = " +
           std::to_string(generations) +
           "\npopulation = 6\nislands = 2\n"
           "[bounds]\ntarget_gain = [0.1, 1.1]\ntension_gain = [0.005, 0.8]\n";
  }
  pid_t start(Arguments arguments) {
    arguments.insert(arguments.begin(), "tune");
    return StartedProgram::start(arguments);
  }
  Outcome run(Arguments arguments) { return finish(start(std::move(arguments))); }

  // Waits until some generations are on the disk.
  void wait_for_generations(const std::string& table, std::ptrdiff_t rows) const {
    for (int i = 0; i < 20000; ++i) {
      const auto text = read(table);
      if (std::count(text.begin(), text.end(), '\n') > rows) return;
      std::this_thread::sleep_for(1ms);
    }
    FAIL() << "no generations within 20 s";
  }
};

TEST_F(TuneProgram, LeavesItsFilesAndASummary) {
  const auto outcome = run({"quick.toml"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "t: best fitness ")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "default")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "Results in out/t/")) << outcome.out;
  for (const char* name : {"best.toml", "tune.json", "generations.csv"})
    EXPECT_TRUE(exists(std::string("out/t/") + name)) << name;
  const auto results = json::parse(read("out/t/tune.json"));
  EXPECT_EQ(results.at("format"), "banyan.tune");
  EXPECT_EQ(results.at("tuning").at("optimizer").at("generations"), 2);
  ASSERT_EQ(results.at("candidates").size(), 4U);  // best, default, two islands
  EXPECT_EQ(results.at("candidates")[0].at("test").at("runs"), 2);
  EXPECT_GE(results.at("candidates")[0].at("training").at("fitness"),
            results.at("candidates")[2].at("training").at("fitness"));
}

TEST_F(TuneProgram, KilledAndStartedAgainEndsWithTheSameBest) {
  ASSERT_EQ(run({"long.toml", "--out", "whole", "--threads", "2"}).code, 0);
  const auto child = start({"long.toml", "--out", "killed", "--threads", "2"});
  wait_for_generations("killed/generations.csv", 8);
  ::kill(child, SIGKILL);
  ASSERT_EQ(finish(child).code, 1000 + SIGKILL);
  ASSERT_FALSE(exists("killed/tune.json")) << "it was finished before it was killed";

  const auto outcome = run({"long.toml", "--out", "killed", "--threads", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "from generation ")) << outcome.out;
  for (const char* name : {"best.toml", "tune.json", "generations.csv"})
    EXPECT_EQ(read(std::string("killed/") + name), read(std::string("whole/") + name)) << name;
}

TEST_F(TuneProgram, CtrlCLeavesWhatCanGoOn) {
  ASSERT_EQ(run({"long.toml", "--out", "whole"}).code, 0);
  const auto child = start({"long.toml", "--out", "stopped"});
  wait_for_generations("stopped/generations.csv", 4);
  ::kill(child, SIGINT);
  const auto stopped = finish(child);
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_TRUE(has(stopped.err, "goes on")) << stopped.err;
  EXPECT_EQ(stopped.out, "");
  EXPECT_FALSE(exists("stopped/tune.json"));
  ASSERT_EQ(run({"long.toml", "--out", "stopped"}).code, 0);
  EXPECT_EQ(read("stopped/best.toml"), read("whole/best.toml"));
}

TEST_F(TuneProgram, NeverReplacesAFinishedTuningUnasked) {
  ASSERT_EQ(run({"quick.toml", "--quiet"}).code, 0);
  const auto before = read("out/t/tune.json");
  const auto outcome = run({"quick.toml"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(has(outcome.err, "--force")) << outcome.err;
  EXPECT_EQ(read("out/t/tune.json"), before);
  const auto again = run({"quick.toml", "--force", "--quiet"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.out, "");
  EXPECT_EQ(read("out/t/tune.json"), before);  // the same seed
}

TEST_F(TuneProgram, NeverReplacesFilesThatAreNotItsOwn) {
  fs::create_directory(home_ / "mine");
  for (const char* name : {"best.toml", "fitness.svg", "generations.csv", "tune.json"}) {
    write(std::string("mine/") + name, "mine");
    for (const std::vector<std::string>& flags : {std::vector<std::string>{}, {"--force"}}) {
      std::vector<std::string> arguments{"quick.toml", "--out", "mine"};
      arguments.insert(arguments.end(), flags.begin(), flags.end());
      const auto outcome = run(arguments);
      EXPECT_EQ(outcome.code, 2) << name;
      EXPECT_TRUE(has(outcome.err, std::string("mine/") + name + " is not from a tuning")) << outcome.err;
      EXPECT_EQ(read(std::string("mine/") + name), "mine");
    }
    fs::remove(home_ / "mine" / name);
  }
}

TEST_F(TuneProgram, TwoInOneFolderAtOnceAreRefused) {
  const auto child = start({"long.toml"});
  wait_for_generations("out/t/generations.csv", 2);
  ::kill(child, SIGSTOP);  // still at work
  for (const char* flag : {"--quiet", "--force"}) {
    const auto outcome = run({"long.toml", flag});
    EXPECT_EQ(outcome.code, 2) << flag;
    EXPECT_TRUE(has(outcome.err, "another banyan is at work")) << outcome.err;
  }
  ::kill(child, SIGCONT);
  EXPECT_EQ(finish(child).code, 0);
  EXPECT_TRUE(exists("out/t/tune.json"));
  EXPECT_FALSE(exists("out/t/tune.lock"));
}

TEST_F(TuneProgram, ADryRunSaysWhatItWouldDoAndDoesNothing) {
  const auto outcome = run({"quick.toml", "--dry-run"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  // 2 islands of 6 individuals in 3 generations, 2 runs each; 4 candidates on 4 seeds.
  EXPECT_TRUE(has(outcome.out, "at most 88: 36 evaluations of 2 runs, and 16 to compare")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "target_gain                0.1       1.1       random")) << outcome.out;
  EXPECT_FALSE(exists("out"));
}

TEST_F(TuneProgram, RefusesBadInputBeforeItStarts) {
  write("bad.toml",
        "[[worlds]]\nscenario = \"nowhere.toml\"\n[seeds]\ntraining = \"1-3\"\ntest = \"3-4\"\n[bounds]\nx = [1, 2]\n");
  const auto outcome = run({"bad.toml"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(has(outcome.err, "bad.toml:2: error: worlds[0].scenario: ")) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "bad.toml:5: error: seeds.test: overlaps")) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "bad.toml:7: error: bounds.x: ")) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "3 errors")) << outcome.err;
  EXPECT_FALSE(exists("out"));
  EXPECT_EQ(run({"missing.toml"}).code, 2);
}

TEST_F(TuneProgram, ADamagedCheckpointIsTold) {
  const auto child = start({"long.toml"});
  wait_for_generations("out/t/generations.csv", 2);
  ::kill(child, SIGKILL);
  (void)finish(child);
  const auto whole = read("out/t/checkpoint.jsonl");
  write("out/t/checkpoint.jsonl", whole.substr(0, whole.size() / 2));
  const auto outcome = run({"long.toml"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(has(outcome.err, "checkpoint is damaged")) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "--force")) << outcome.err;
}

TEST_F(TuneProgram, TheTuningsOfTheRepositoryAreWithoutFault) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(BANYAN_SCENARIOS).parent_path() / "studies")) {
    if (!entry.path().filename().string().starts_with("tune-")) continue;
    ++files;
    const auto outcome = run({entry.path().string(), "--dry-run"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << entry.path();
    EXPECT_TRUE(has(outcome.out, entry.path().stem().string() + ": ")) << outcome.out;
  }
  EXPECT_GE(files, 4);
}

}  // namespace
}  // namespace banyan::cli
