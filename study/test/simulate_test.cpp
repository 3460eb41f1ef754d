// SPDX-License-Identifier: MIT
// A run of a study is a run like any other, and what goes wrong is its outcome.
#include "banyan/study/simulate.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"
#include "banyan/measure/observer.hpp"
#include "banyan/record/table.hpp"
#include "banyan/version.hpp"
#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"
#include "temporary_folder.hpp"

namespace banyan::study {
namespace {

config::Configuration small_world() {
  auto loaded = config::parse_configuration("small.toml",
                                            "seed = 3\n[mission]\ntime_limit_s = 5.0\n[swarm]\nrobots = 6\n"
                                            "[targets]\ncount = 2\nradius_m = 0.9\n[output]\nrecord = false\n",
                                            algorithms());
  EXPECT_TRUE(loaded.ok());
  return loaded.configuration;
}

Outcome outcome_of(const config::Configuration& configuration, const std::string& directory = "") {
  return decode_outcome(simulate(encode(RunTask{config::config_json(configuration), directory}), algorithms()));
}

class SimulateTest : public TemporaryFolder {};

TEST_F(SimulateTest, GivesTheRowOfAWorldThatIsSteppedToItsEnd) {
  const auto configuration = small_world();
  world::World world(configuration.scenario);
  measure::Observer observer(world);
  world::Executor two(2);
  while (!observer.finished()) {
    world.step(two);
    (void)observer.observe(world);
  }
  const record::RunRow wanted{record::identify(configuration.scenario, version, git_id()), observer.result(world),
                              false};

  const auto outcome = outcome_of(configuration);

  EXPECT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.row, record::run_csv_row(wanted));
  EXPECT_GT(outcome.wall_s, 0.0);
}

TEST_F(SimulateTest, MalformedTasksAreFailedRuns) {
  const auto whole = encode(RunTask{config::config_json(small_world()), ""});
  for (const std::string& task :
       {std::string(), std::string("{}"), std::string("\xff\xff"), whole.substr(0, whole.size() / 2),
        encode(RunTask{"", ""}), encode(RunTask{"{\"radio\": {\"loss\": 2}}", ""}),
        encode(RunTask{"{\"no\": 1}", ""})}) {
    const auto outcome = decode_outcome(simulate(task, algorithms()));
    EXPECT_NE(outcome.error, "");
    EXPECT_EQ(outcome.error.find('\n'), std::string::npos);
    EXPECT_EQ(outcome.row, "");
  }
  EXPECT_NE(decode_outcome(simulate(encode(RunTask{"{\"radio\": {\"loss\": 2}}", ""}), algorithms()))
                .error.find("radio.loss: "),
            std::string::npos);
}

TEST_F(SimulateTest, KeepsWhatIsAskedForAndNothingElse) {
  auto configuration = small_world();
  EXPECT_EQ(outcome_of(configuration, path("none")).error, "");
  EXPECT_FALSE(exists("none"));

  const auto plain = outcome_of(configuration).row;
  configuration.output["record"] = true;
  EXPECT_EQ(outcome_of(configuration, path("a/b")).row, plain);
  EXPECT_TRUE(exists("a/b/run.mcap"));
  EXPECT_FALSE(exists("a/b/series.csv"));

  configuration.output["series"] = true;
  EXPECT_EQ(outcome_of(configuration, path("a/b")).row, plain) << "an earlier attempt's files are replaced";
  EXPECT_EQ(read("a/b/series.csv").substr(0, 5), "tick,");
  EXPECT_EQ(outcome_of(configuration, "").row, plain);
}

TEST_F(SimulateTest, AFolderThatCannotBeMadeIsTheRunsError) {
  auto configuration = small_world();
  configuration.output["record"] = true;
  write("file", "");
  const auto outcome = outcome_of(configuration, path("file/run"));
  EXPECT_EQ(outcome.row, "");
  EXPECT_EQ(outcome.error, path("file/run") + ": cannot create: Not a directory");
}

TEST_F(SimulateTest, AFileThatFillsTheDiskIsTheRunsErrorAndCostsNoOtherFile) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  auto configuration = small_world();
  configuration.output["record"] = configuration.output["series"] = true;
  std::filesystem::create_directory(path("run"));
  std::filesystem::create_symlink("/dev/full", path("run/series.csv"));
  const auto outcome = outcome_of(configuration, path("run"));
  EXPECT_EQ(outcome.row, "");
  EXPECT_EQ(outcome.error, path("run/series.csv") + ": cannot write: No space left on device");
  EXPECT_TRUE(exists("run/run.mcap"));
}

TEST_F(SimulateTest, FoldersMayHaveAnyName) {
  auto configuration = small_world();
  configuration.output["record"] = true;
  EXPECT_EQ(outcome_of(configuration, path("odd \xff\n\"'")).error, "");
  EXPECT_TRUE(exists("odd \xff\n\"'/run.mcap"));
}

RC_GTEST_PROP(Outcomes, TravelUnchanged, (const std::vector<unsigned char>& letters)) {
  std::string text;
  for (const auto c : letters) text += static_cast<char>(c % 128);
  const Outcome sent{text, std::string(text.rbegin(), text.rend()), static_cast<double>(letters.size()) / 3.0};
  const auto got = decode_outcome(encode(sent));
  RC_ASSERT(got.row == sent.row);
  RC_ASSERT(got.error == sent.error);
  RC_ASSERT(got.wall_s == sent.wall_s);
}

TEST(Outcomes, AnythingElseIsAFailedRun) {
  for (const char* bytes : {"", "x", "{}", "[]", "null", R"({"row":1,"error":"","wall_s":0})",
                            R"({"row":"","error":""})", R"({"row":"","error":"","wall_s":"0"})"})
    EXPECT_EQ(decode_outcome(bytes).error, "a worker sent what is no outcome") << bytes;
}

}  // namespace
}  // namespace banyan::study
