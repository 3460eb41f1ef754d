// SPDX-License-Identifier: MIT
// The program's commands on one run and its files, started for real.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"
#include "banyan/controller/core/printable.hpp"
#include "banyan/record/file.hpp"
#include "started_program.hpp"

namespace banyan::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

class Program : public StartedProgram {
 protected:
  void SetUp() override {
    StartedProgram::SetUp();
    write("small.toml", "[swarm]\nrobots = 8\n[targets]\ncount = 2\nradius_m = 1.5\n");
    // Never complete: its target is out of reach. Ends by its limit of three hours only.
    write("endless.toml", "[mission]\ntime_limit_s = 10000.0\n[swarm]\nrobots = 60\n[targets]\nradius_m = 200.0\n");
  }
  [[nodiscard]] json read_json(const std::string& name) const { return json::parse(read(name)); }
};

// ------------------------------------------------------------------------------------- a good run

TEST_F(Program, ARunLeavesItsThreeFilesAndAShortSummary) {
  const auto outcome = run({"run", "small.toml"});

  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LE(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 25);
  EXPECT_TRUE(has(outcome.out, "small: COMPLETE after ")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "Results in out/small-convoy-1/")) << outcome.out;
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(home_ / "out/small-convoy-1"))
    files.push_back(entry.path().filename());
  std::sort(files.begin(), files.end());
  EXPECT_EQ(files, (std::vector<std::string>{"run.csv", "run.json", "run.mcap"}));
}

// Without healing nobody follows a worker that dies.
TEST_F(Program, ASummaryTellsOfDeathsAndRecovery) {
  const std::string world = read("small.toml") + "[[events]]\nkind = \"kill\"\nwhen = \"complete\"\ntime_s = 1.0\n";
  write("widow.toml", world + "of = \"worker\"\n");
  const auto widow =
      run({"run", "widow.toml", "--set", "mission.algorithm=outwards", "--set", "mission.reading=literal"});
  ASSERT_EQ(widow.code, 0) << widow.err;
  EXPECT_TRUE(has(widow.out, "deaths     1 of 8 robots died, the last at ")) << widow.out;
  EXPECT_TRUE(has(widow.out, "not whole again in the 200.0 s after it")) << widow.out;
  EXPECT_LE(std::count(widow.out.begin(), widow.out.end(), '\n'), 25);
  const auto small = run({"run", "small.toml"});
  EXPECT_FALSE(has(small.out, "died")) << small.out;
  EXPECT_FALSE(has(small.out, "elected")) << small.out;
}

// With radios of 10 cm to 1 km, and no parameters of their own.
TEST_F(Program, AnyRobotCompletesWithoutASplit) {
  for (const auto& [scenario, most] :
       {std::pair{"kilobots", 2.0}, {"turtlebots", 1.25}, {"rovers", 1.25}, {"relay-drones", 1.25}}) {
    ASSERT_EQ(run({"run", std::string(BANYAN_SCENARIOS) + "/" + scenario + ".toml", "--out", scenario}).code, 0);
    const auto result = read_json(std::string(scenario) + "/run.json")["result"];
    EXPECT_EQ(result["complete"], true) << scenario;
    EXPECT_EQ(result["split_ticks"], 0) << scenario;
    EXPECT_LE(result["time_ratio"].get<double>(), most) << scenario;
  }
}

// One key changed over two decades: the mission completes in one piece, or the error begins with what was written.
TEST_F(Program, OneKeyIsChangedOverTwoDecades) {
  const std::vector<std::pair<std::string, std::vector<const char*>>> changes = {
      {"radio.range_m", {"0.2", "0.5", "1", "5", "20"}},
      {"swarm.robots", {"10", "50", "200"}},
      {"robot.wheel_limit_m_s", {"0.02", "0.05", "0.5", "2"}},
      {"robot.radius_m", {"0.007", "0.02", "0.2", "0.7"}},
      {"tick_s", {"0.01", "0.05", "0.3", "1"}}};
  int completed = 0, refused = 0;
  for (const auto& [key, values] : changes)
    for (const char* const value : values) {
      const std::string set = key + "=" + value;
      const auto outcome =
          run({"run", std::string(BANYAN_SCENARIOS) + "/three-targets.toml", "--json", "--no-record", "--set", set});
      if (outcome.code != 0) {
        EXPECT_EQ(outcome.err.rfind("--set " + set + ": error: ", 0), 0U) << outcome.err;
        ++refused;
        continue;
      }
      auto result = json::parse(outcome.out);
      if (result.contains("result")) result = result["result"];
      EXPECT_EQ(result["complete"], true) << set;
      EXPECT_EQ(result["split_ticks"], 0) << set;
      ++completed;
    }
  EXPECT_EQ(completed, 16);
  EXPECT_EQ(refused, 4);
}

TEST_F(Program, TooFewRobotsAreToldHowManyItTakes) {
  const auto outcome =
      run({"run", std::string(BANYAN_SCENARIOS) + "/three-targets.toml", "--no-record", "--set", "swarm.robots=5"});
  EXPECT_TRUE(has(outcome.out, "5 robots are too few")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "needs 6 for all (swarm.robots)")) << outcome.out;
}

TEST_F(Program, TheTableAndTheJsonHoldTheSame) {
  ASSERT_EQ(run({"run", "small.toml", "--out", "o"}).code, 0);

  const auto result = read_json("o/run.json")["result"];
  std::istringstream table(read("o/run.csv"));
  std::string header, row, name, cell;
  ASSERT_TRUE(std::getline(table, header) && std::getline(table, row));
  std::istringstream names(header), cells(row);
  std::size_t columns = 0;
  while (std::getline(names, name, ',')) {
    std::getline(cells, cell, ',');
    ++columns;
    ASSERT_TRUE(result.contains(name)) << name;
    const auto& value = result[name];
    if (value.is_string()) EXPECT_EQ(value.get<std::string>(), cell) << name;
    else if (value.is_boolean()) EXPECT_EQ(value.get<bool>() ? "true" : "false", cell) << name;
    else if (value.is_null()) EXPECT_EQ(cell, "") << name;
    else EXPECT_EQ(value.get<double>(), std::stod(cell)) << name;
  }
  EXPECT_EQ(columns, result.size());
  EXPECT_FALSE(std::getline(table, row));
}

TEST_F(Program, JsonOnStandardOutputIsTheFileAndNothingElse) {
  const auto outcome = run({"run", "small.toml", "--json", "--out", "o"});

  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, read("o/run.json"));
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Program, QuietSaysNothing) {
  const auto outcome = run({"run", "small.toml", "--quiet"});

  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_TRUE(exists("out/small-convoy-1/run.json"));
}

TEST_F(Program, OptionsReachTheRunAndItsRecords) {
  ASSERT_EQ(run({"run", "small.toml", "--set", "mission.algorithm=inwards", "--set", "radio.loss=0.25", "--seed", "9",
                 "--series", "--no-record"})
                .code,
            0);

  const auto file = read_json("out/small-inwards-9/run.json");
  EXPECT_EQ(file["config"]["mission"]["algorithm"], "inwards");
  EXPECT_EQ(file["config"]["radio"]["loss"], 0.25);
  EXPECT_EQ(file["config"]["seed"], 9);
  EXPECT_EQ(file["result"]["seed"], 9);
  EXPECT_FALSE(exists("out/small-inwards-9/run.mcap"));
  const auto series = read("out/small-inwards-9/series.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(series.begin(), series.end(), '\n')),
            file["result"]["ticks"].get<std::size_t>() + 1);
}

TEST_F(Program, TheJsonOfARunRunsItAgainToTheSameState) {
  ASSERT_EQ(
      run({"run", "small.toml", "--out", "a", "--set", "robot.wheel_noise=0.1", "--set", "targets.phase_deg=33.3"})
          .code,
      0);
  ASSERT_EQ(run({"run", "a/run.json", "--out", "b", "--threads", "2"}).code, 0);

  EXPECT_EQ(read_json("a/run.json")["result"]["hash"], read_json("b/run.json")["result"]["hash"]);
  EXPECT_EQ(read_json("a/run.json")["config"], read_json("b/run.json")["config"]);
}

TEST_F(Program, AMissionThatDoesNotCompleteIsAResult) {
  const auto outcome = run({"run", "endless.toml", "--set", "mission.time_limit_s=2", "--out", "o"});

  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(has(outcome.out, "NOT COMPLETE within 2.0 s: 0 of 3 targets reached")) << outcome.out;
  EXPECT_EQ(read_json("o/run.json")["result"]["complete"], false);
  // ... and why it could not: as a warning with the bound, before the run.
  EXPECT_TRUE(has(outcome.err, "endless.toml:5: warning: targets: out of reach: no connected network of fewer than"))
      << outcome.err;
}

// ------------------------------------------------------------------------------ nothing is overwritten

TEST_F(Program, EveryRunGetsADirectoryOfItsOwn) {
  ASSERT_EQ(run({"run", "small.toml", "-q"}).code, 0);
  const auto first = read("out/small-convoy-1/run.mcap");
  ASSERT_EQ(run({"run", "small.toml", "-q"}).code, 0);

  EXPECT_TRUE(exists("out/small-convoy-1.2/run.json"));
  EXPECT_EQ(read("out/small-convoy-1/run.mcap"), first);
}

TEST_F(Program, AGivenDirectoryWithResultsIsRefusedUnlessForced) {
  ASSERT_EQ(run({"run", "small.toml", "-q", "--out", "o", "--series"}).code, 0);
  const auto before = read("o/run.json");

  const auto refused = run({"run", "small.toml", "--out", "o", "--seed", "2"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(has(refused.err, "o already holds results (run.mcap, run.csv, run.json, series.csv); add --force"))
      << refused.err;
  EXPECT_EQ(read("o/run.json"), before);

  EXPECT_EQ(run({"run", "small.toml", "-q", "--out", "o", "--seed", "2", "--force"}).code, 0);
  EXPECT_EQ(read_json("o/run.json")["result"]["seed"], 2);
  EXPECT_FALSE(exists("o/series.csv"));  // of the earlier run: would not belong to this one
}

// ------------------------------------------------------------------------------------- bad input

TEST_F(Program, RefusesFilesThatAreNoScenario) {
  write("empty.toml", "");
  write("binary.toml", std::string("\x7f"
                                   "ELF\0\0\1\2",
                                   8));
  write("garbage.toml", "\x93\xfe\xfa\x01garbage");
  write("syntax.toml", "[targets]\ncount = = 2\n");
  write("syntax.json", "{\"targets\": {\"count\" 2}}");
  fs::create_directory(home_ / "folder");

  expect_refused({"run", "missing.toml"}, "missing.toml: error: there is no such file");
  expect_refused({"run", "folder"}, "folder: error: is a directory");
  expect_refused({"run", "empty.toml"}, "empty.toml: error: is empty");
  expect_refused({"run", "binary.toml"}, "binary.toml: error: is a binary file");
  expect_refused({"run", "garbage.toml"}, "garbage.toml:1: error: this is not TOML");
  expect_refused({"run", "syntax.toml"}, "syntax.toml:2: error: this is not TOML");
  expect_refused({"run", "syntax.json"}, "syntax.json:1: error: this is not JSON");
  expect_refused({"run", "/bin/sh"}, "is a binary file");
}

TEST_F(Program, RefusesBadValuesByOption) {
  const auto bad = [&](const std::string& assignment, const std::string& reason) {
    expect_refused({"run", "small.toml", "--set", assignment}, "--set " + assignment + ": error: " + reason);
  };
  bad("radio.los=true", "radio.los: there is no such key; did you mean radio.loss?");
  bad("radio.loss=high", "radio.loss: must be a number (0 to 1), not the text \"high\"");
  bad("radio.range_m=nan", "radio.range_m: is nan; allowed: 0.01 to 100000 m");
  bad("radio.range_m=inf", "radio.range_m: is inf; allowed: 0.01 to 100000 m");
  bad("targets.radius_m=-1", "targets.radius_m: is -1; allowed: 0 to");
  bad("swarm.robots=0", "swarm.robots: is 0; allowed: 2 to 65535");
  bad("swarm.robots=2", "swarm.robots: 2 robots cannot serve 2 targets");
  bad("swarm.start.pitch_m=0.1", "swarm.start.pitch_m: robots do not fit");
  bad("mission.algorithm=sideways", "mission.algorithm: must be \"outwards\"");
  expect_refused({"run", "small.toml", "--seed", "x"}, "--seed x: error: seed: must be a whole number");
  expect_refused({"run", "small.toml", "--seed", "-1"}, "seed: is -1");
}

TEST_F(Program, RefusesWorldsThatCannotBe) {
  const std::string obstacle = "[[obstacles]]\nkind = \"disc\"\ncenter_m = [1.5, 0.0]\nradius_m = 0.4\n";
  write("inside.toml", read("small.toml") + obstacle);
  write("crowd.toml", "[swarm]\nrobots = 100\n[targets]\nradius_m = 5.0\n" +
                          std::string("[[obstacles]]\nkind = \"wall\"\nfrom_m = [-1, -1]\nto_m = [1, -1]\n") +
                          "[[obstacles]]\nkind = \"wall\"\nfrom_m = [1, -1]\nto_m = [1, 1]\n[[obstacles]]\nkind = "
                          "\"wall\"\nfrom_m = [1, 1]\nto_m = [-1, 1]\n" +
                          "[[obstacles]]\nkind = \"wall\"\nfrom_m = [-1, 1]\nto_m = [-1, -1]\n");
  expect_refused({"run", "inside.toml"}, "inside.toml:3: error: targets: target 0 at (1.5, 0) lies inside an obstacle");
  expect_refused({"run", "crowd.toml"}, "of 100 robots fit between the obstacles");
}

TEST_F(Program, TellsAllFaultsAtOnce) {
  write("bad.toml", "tick = 0.1\n[radio]\nloss = 2\nrange_m = \"far\"\n[targets]\ncount = 0\n");
  const auto outcome = run({"validate", "bad.toml", "small.toml", "missing.toml"});

  EXPECT_EQ(outcome.code, 2);
  for (const char* line :
       {"bad.toml:1: error: tick: there is no such key; did you mean tick_s?", "bad.toml:3: error: radio.loss: is 2",
        "bad.toml:4: error: radio.range_m: must be a number", "bad.toml:6: error: targets.count: is 0",
        "missing.toml: error: there is no such file", "5 errors"}) {
    EXPECT_TRUE(has(outcome.err, line)) << line << "\n" << outcome.err;
  }
  EXPECT_TRUE(has(outcome.out, "small.toml: ok: convoy (corrected), 8 robots, 2 targets"));
}

TEST_F(Program, ValidateSpeaksJsonAndShowsWhatAScenarioStandsFor) {
  write("bad.toml", "[targets]\ncuont = 2\n");
  const auto report = json::parse(run({"validate", "--json", "bad.toml", "small.toml"}).out);
  EXPECT_EQ(report[0]["ok"], false);
  EXPECT_EQ(report[0]["problems"][0]["line"], 2);
  EXPECT_EQ(report[0]["problems"][0]["key"], "targets.cuont");
  EXPECT_EQ(report[1]["config"]["swarm"]["robots"], 8);

  const auto shown = run({"validate", "small.toml", "--show", "toml", "--set", "radio.loss=0.5"});
  const auto again = config::parse_configuration("shown.toml", shown.out, algorithms());
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again.configuration.scenario.radio.loss, 0.5);
}

// A terminal would obey them: rename its window, clear its screen, show a line that nobody wrote.
TEST_F(Program, NoControlCharacterReachesTheTerminal) {
  const std::string evil = "\x1b]0;owned\a\x1b[2J\xc2\x9b\xff";
  write("name.toml", "name = \"\\u001b]0;owned\\u0007\\u001b[2Jok\"\n[targets]\nlayout = \"ring\"\n");
  write("key.toml", "\"\\u001b[2Jkey\" = 1\n[mission]\nalgorithm = \"\\u009b2J\"\n[targets]\n");
  write(evil + ".toml", read("small.toml"));
  write(evil + ".json", "{\"targets\": {\"count\" 2}}");
  const auto expect_harmless = [](const std::string& text) {
    EXPECT_EQ(printable_lines(text), text);
    EXPECT_TRUE(valid_utf8(text));
  };
  for (const Arguments& arguments : std::vector<Arguments>{{"validate", "name.toml"},
                                                           {"validate", "key.toml"},
                                                           {"validate", evil + ".toml"},
                                                           {"validate", evil + ".json"},
                                                           {"validate", evil},
                                                           {"run", evil + ".toml", "--out", "out-" + evil},
                                                           {"run", evil + ".toml", "--out", "out-" + evil},
                                                           {"run", "http://localhost/#scenario=a&%1b[2J" + evil + "=1"},
                                                           {"run", "#scenario=%1b%5b2J"},
                                                           {"run", "#scenario=three-targets&set=%1b[2J=1"},
                                                           {"run", "small.toml", "--set", evil + "=1"},
                                                           {"run", "small.toml", "--" + evil},
                                                           {"export", evil},
                                                           {"study", evil},
                                                           {evil}}) {
    const auto outcome = run(arguments);
    EXPECT_NE(outcome.out + outcome.err, "") << arguments[0];
    expect_harmless(outcome.out);
    expect_harmless(outcome.err);
  }
  EXPECT_TRUE(has(run({"validate", "name.toml"}).err, "name: is \"\\x1b]0;owned\\x07\\x1b[2Jok\"; allowed: 1 to 100"));
  // What a program reads keeps its own escapes and the exact key.
  const auto report = json::parse(run({"validate", "--json", "key.toml"}).out);
  EXPECT_EQ(report[0]["problems"][0]["key"], "\x1b[2Jkey");
}

TEST_F(Program, BadUsageIsTwoAndNamesWhatWasMeant) {
  EXPECT_TRUE(has(run({"rn", "small.toml"}).err, "\"rn\" is unknown; did you mean run?"));
  EXPECT_TRUE(has(run({"run", "small.toml", "--seed", "1", "--seed", "2"}).err, "--seed is given twice; give it once"));
  EXPECT_TRUE(has(run({"run", "small.toml", "--qiet"}).err, "\"--qiet\" is unknown; did you mean --quiet?"));
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"rn"},
                                             {"run"},
                                             {"run", "small.toml", "--threads", "0"},
                                             {"run", "small.toml", "--set"},
                                             {"draw", "x.mcap", "--at", "nan"},
                                             {"draw", "x.mcap", "--at", "-1"},
                                             {"draw", "x.mcap", "--width", "nan"},
                                             {"film", "x.mcap", "-o", "x.gif", "--speed", "nan"},
                                             {"bench", "--window", "nan"},
                                             {"bench", "dens"},
                                             {"algorithms", "outward"},
                                             {"keys", "zzz"}}) {
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << (arguments.empty() ? "" : arguments[0]) << "\n" << outcome.err;
    EXPECT_NE(outcome.err, "");
    EXPECT_EQ(outcome.out, "");
  }
}

// --------------------------------------------------------------------------- disk full, interruption

TEST_F(Program, AFullDiskIsSaidAndCostsNeitherTheRunNorTheOtherFiles) {
  const auto outcome = finish(
      start({"run", "endless.toml", "--set", "mission.time_limit_s=600", "--out", "o"}, {.largest_file = 300'000}));

  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "o/run.mcap: cannot write: File too large")) << outcome.err;  // what EFBIG is called
  EXPECT_TRUE(has(outcome.err, "what was recorded until then is in o/run.mcap.part")) << outcome.err;
  const auto rescued = run({"export", "o/run.mcap.part"});
  EXPECT_EQ(rescued.code, 0) << rescued.err;
  EXPECT_GT(std::count(rescued.out.begin(), rescued.out.end(), '\n'), 60);
  EXPECT_FALSE(exists("o/run.mcap"));
  EXPECT_EQ(read_json("o/run.json")["result"]["ticks"], 6000);
  EXPECT_TRUE(has(read("o/run.csv"), "\nendless,"));
  EXPECT_TRUE(has(outcome.out, "endless: NOT COMPLETE within 600.0 s")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "  run.csv ")) << outcome.out;
  EXPECT_FALSE(has(outcome.out, "  run.mcap ")) << outcome.out;
}

TEST_F(Program, AFullDiskDoesNotCostTheEarlierRecording) {
  ASSERT_EQ(run({"run", "small.toml", "-q", "--out", "o"}).code, 0);
  const auto recording = read("o/run.mcap");

  const auto outcome =
      finish(start({"run", "endless.toml", "--set", "mission.time_limit_s=600", "--out", "o", "--force"},
                   {.largest_file = 300'000}));

  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(read("o/run.mcap"), recording);
  EXPECT_TRUE(has(outcome.err, "o/run.mcap is that of another run")) << outcome.err;
  EXPECT_EQ(read_json("o/run.json")["result"]["name"], "endless");
}

TEST_F(Program, AFileThatCannotBeMadeIsSaidBeforeTheRun) {
  fs::create_directories(home_ / "o/run.mcap.part");
  const auto outcome = run({"run", "endless.toml", "--out", "o"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(has(outcome.err, "o/run.mcap: cannot create: Is a directory")) << outcome.err;
  EXPECT_FALSE(has(outcome.err, "until then")) << outcome.err;
}

TEST_F(Program, AFullStandardOutputIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  ASSERT_EQ(run({"run", "small.toml", "-q", "--out", "o"}).code, 0);
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"run", "small.toml", "--json", "--out", "p"},
                                             {"algorithms"},
                                             {"keys"},
                                             {"--help"},
                                             {"export", "o/run.mcap"},
                                             {"draw", "o/run.mcap"},
                                             {"validate", "small.toml"}}) {
    const auto outcome = finish(start(arguments, {.out = "/dev/full"}));
    EXPECT_EQ(outcome.code, 1) << arguments[0];
    EXPECT_TRUE(has(outcome.err, "standard output: ")) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "No space left on device")) << outcome.err;
  }
  EXPECT_TRUE(exists("p/run.json"));  // the results themselves are safe
}

TEST_F(Program, ADirectoryThatCannotBeMadeIsSaidBeforeTheRun) {
  write("file", "x");
  const auto below = run({"run", "small.toml", "--out", "file/o"});
  EXPECT_EQ(below.code, 1);
  EXPECT_TRUE(has(below.err, "file/o: cannot be created: Not a directory; choose another place with --out DIR"))
      << below.err;
  const auto same = run({"run", "small.toml", "--out", "file"});
  EXPECT_EQ(same.code, 2);
  EXPECT_EQ(read("file"), "x");
}

// What would be said there must not end up in the first file that is opened.
TEST_F(Program, WithoutStandardStreamsFilesAreWhole) {
  ASSERT_EQ(run({"run", "small.toml", "-q", "--out", "whole", "--series"}).code, 0);
  for (const std::vector<int>& closed : {std::vector<int>{2}, {1, 2}, {0, 2}, {0, 1, 2}}) {
    const auto outcome = run({"run", "small.toml", "--out", "o", "--series"}, {.closed = closed});
    const bool unheard = std::find(closed.begin(), closed.end(), 1) != closed.end();
    EXPECT_EQ(outcome.code, unheard ? 1 : 0);  // the summary
    for (const std::string file : {"run.mcap", "series.csv"}) EXPECT_EQ(read("o/" + file), read("whole/" + file));
    fs::remove_all(home_ / "o");
    const auto refused = run({"run", "small.toml", "--out", "whole", "--no-record"}, {.closed = closed});
    EXPECT_EQ(refused.code, 2);
    const auto warned = run({"export", "whole/run.mcap", "-o", "robots.csv", "--force"}, {.closed = closed});
    EXPECT_EQ(warned.code, 0);
    EXPECT_TRUE(read("robots.csv").starts_with("tick,time_s,"));
  }
}

// What is in somebody else's unfinished file was not recorded by this run.
TEST_F(Program, APartOfAnotherProcessIsNotClaimed) {
  fs::create_directories(home_ / "o");
  const int other = record::open_locked((home_ / "o/run.csv.part").string(), O_WRONLY | O_CREAT);
  const auto outcome = run({"run", "small.toml", "--out", "o", "--no-record"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(has(outcome.err, "o/run.csv: is being written by another process (o/run.csv.part)")) << outcome.err;
  EXPECT_FALSE(has(outcome.err, "until then")) << outcome.err;
  ::close(other);
}

TEST_F(Program, ASeedIsReadToItsLastDigit) {
  const std::string most = "9007199254740992", more = "9007199254740993";
  ASSERT_EQ(run({"run", "small.toml", "--seed", most, "-q", "--out", "o"}).code, 0);
  EXPECT_EQ(read_json("o/run.json")["result"]["seed"], std::int64_t{1} << 53);
  fs::remove_all(home_ / "out");
  expect_refused({"run", "small.toml", "--seed", more}, "seed: is " + more + "; allowed: 0 to " + most);
  write("seed.toml", "seed = " + more + "\n" + read("small.toml"));
  expect_refused({"run", "seed.toml"}, "seed.toml:1: error: seed: is " + more + "; allowed: 0 to " + most);
  write("seed.json", "{\"seed\": " + more + ", \"targets\": {\"count\": 2, \"radius_m\": 1.5}}");
  expect_refused({"run", "seed.json"}, "seed.json:1: error: seed: is " + more);
}

TEST_F(Program, AFileTooLargeForAScenarioIsRefusedUnread) {
  std::string text = "[targets]\nlayout = \"list\"\npositions_m = [\n";
  while (text.size() < 9'000'000) text += "[1.25, 3.5], [2.25, 4.5], [3.25, 5.5], [4.25, 6.5],\n";
  write("targets.toml", text + "]\n");
  expect_refused({"run", "targets.toml"}, "targets.toml: error: is larger than 8 MiB: this is no scenario");
}

// A run that goes on to recover from a death has no more "at most".
TEST_F(Program, ProgressAfterTheLimitSaysSo) {
  // Its targets are out of reach, so the run waits for a recovery that cannot be.
  write("late.toml",
        "[mission]\ntime_limit_s = 0.1\n[swarm]\nrobots = 3000\n[swarm.start]\npitch_m = 0.9\n"
        "[targets]\nradius_m = 390.0\n[[events]]\nkind = \"die\"\nrobot = 5\ntime_s = 0.0\n");
  const pid_t child = start({"run", "late.toml", "--no-record", "--threads", "1", "--out", "o"});
  const std::string wanted = " s, after its limit of 0.1 s, 0 of 3 targets reached";
  for (int k = 0; k < 12'000 && !has(read("stderr.txt"), wanted); ++k) std::this_thread::sleep_for(10ms);
  ::kill(child, SIGTERM);
  const auto outcome = finish(child);
  EXPECT_EQ(outcome.code, 143) << outcome.err;
  const auto at = outcome.err.find(wanted);
  ASSERT_NE(at, std::string::npos) << outcome.err;
  EXPECT_FALSE(has(outcome.err.substr(at, outcome.err.find('\n', at) - at), " left")) << outcome.err;
}

class Interrupted : public Program, public ::testing::WithParamInterface<int> {};

TEST_P(Interrupted, LeavesValidFilesOfWhatWasDone) {
  const pid_t child = start({"run", "endless.toml", "--series", "--out", "o"});
  for (int i = 0; i < 1000 && !exists("o/run.mcap.part"); ++i) std::this_thread::sleep_for(10ms);
  std::this_thread::sleep_for(300ms);
  ASSERT_EQ(::kill(child, GetParam()), 0);
  const auto outcome = finish(child);

  EXPECT_EQ(outcome.code, 128 + GetParam()) << outcome.err;
  const std::string name = GetParam() == SIGINT ? "Ctrl-C" : GetParam() == SIGHUP ? "SIGHUP" : "SIGTERM";
  EXPECT_TRUE(has(outcome.err, "stopped by " + name + " at ")) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "is in o")) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "endless: STOPPED at ")) << outcome.out;
  const auto result = read_json("o/run.json")["result"];
  EXPECT_EQ(result["interrupted"], true);
  EXPECT_EQ(result["complete"], false);
  const auto ticks = result["ticks"].get<std::size_t>();
  EXPECT_GT(ticks, 0U);
  const auto series = read("o/series.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(series.begin(), series.end(), '\n')), ticks + 1);
  const auto exported = run({"export", "o/run.mcap", "-o", "robots.csv"});
  EXPECT_EQ(exported.code, 0) << exported.err;
  const auto rows = read("robots.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n')),
            (ticks + 1) * 60 + 1);  // header, tick 0
  for (const auto& entry : fs::directory_iterator(home_ / "o")) EXPECT_NE(entry.path().extension(), ".part");
}

INSTANTIATE_TEST_SUITE_P(BySignal, Interrupted, ::testing::Values(SIGINT, SIGTERM, SIGHUP), [](const auto& test) {
  return test.param == SIGINT ? "CtrlC" : test.param == SIGHUP ? "Sighup" : "Sigterm";
});

// Before the first frame of a large swarm is there, a second may pass.
TEST_F(Program, ALargeRunThatIsKilledAtOnceLeavesARecordingThatCanBeRead) {
  const pid_t child = start({"run", BANYAN_SCENARIOS "/swarm-10000.toml", "--out", "o"});
  const auto bytes = [&] {
    std::error_code none;
    const auto size = fs::file_size(home_ / "o/run.mcap.part", none);
    return none ? 0 : size;
  };
  for (int i = 0; i < 6000 && bytes() == 0; ++i) std::this_thread::sleep_for(10ms);
  std::this_thread::sleep_for(50ms);
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  EXPECT_EQ(finish(child).code, 1000 + SIGKILL);
  ASSERT_GT(bytes(), 0U);
  EXPECT_FALSE(exists("o/run.mcap") || exists("o/run.json"));
  const auto exported = run({"export", "o/run.mcap.part", "-o", "robots.csv"});
  EXPECT_TRUE(exported.code == 0 || has(exported.err, "the recording holds no frames")) << exported.err;
}

TEST_F(Program, ABagDoesNotReplaceTheRecordingItIsMadeOf) {
  ASSERT_EQ(run({"run", "small.toml", "-q", "--out", "o"}).code, 0);
  const auto bag = run({"export", "o/run.mcap", "-o", "bag.mcap"});
  EXPECT_EQ(bag.code, 0) << bag.err;
  EXPECT_TRUE(has(bag.err, " messages to bag.mcap")) << bag.err;
  EXPECT_GT(fs::file_size(home_ / "bag.mcap"), 1000U);
  const std::string before = read("o/run.mcap");
  const auto itself = run({"export", "o/run.mcap", "-o", "o/../o/run.mcap", "--force"});
  EXPECT_EQ(itself.code, 2);
  EXPECT_TRUE(has(itself.err, "would replace the recording itself; give another name")) << itself.err;
  EXPECT_EQ(read("o/run.mcap"), before);
  fs::rename(home_ / "o/run.mcap", home_ / "o/run.mcap.part");
  EXPECT_EQ(run({"export", "o/run.mcap.part", "-o", "o/run.mcap"}).code, 2);
  EXPECT_EQ(read("o/run.mcap.part"), before);
}

// nohup banyan run ... goes on when its terminal is closed.
TEST_F(Program, AnIgnoredHangupStaysIgnored) {
  const std::string script = "trap '' HUP; exec \"$0\" run endless.toml --set mission.time_limit_s=20 -q --out o";
  const pid_t child = start({"-c", script, BANYAN_PROGRAM}, {.program = "/bin/bash"});
  for (int i = 0; i < 1000 && !exists("o/run.mcap.part"); ++i) std::this_thread::sleep_for(10ms);
  ASSERT_EQ(::kill(child, SIGHUP), 0);
  EXPECT_EQ(finish(child).code, 0);
  EXPECT_EQ(read_json("o/run.json")["result"]["interrupted"], false);
}

// --------------------------------------------------------------------------------- recordings, lists

TEST_F(Program, ExportAndDrawReadWhatRunWrote) {
  ASSERT_EQ(run({"run", "small.toml", "-q", "--out", "o"}).code, 0);

  const auto table = run({"export", "o/run.mcap", "--from", "1", "--to", "2", "--every", "5"});
  EXPECT_EQ(table.code, 0);
  EXPECT_TRUE(table.out.starts_with(
      "tick,time_s,robot,x_m,y_m,heading_rad,role,phase,parent,old_parent,alive,connected,target\n10,1.0"));
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 1 + 3 * 8);

  EXPECT_EQ(run({"draw", "o/run.mcap", "--at", "3", "-o", "frame.svg"}).code, 0);
  EXPECT_TRUE(has(read("frame.svg"), "<svg"));
  const auto refused = run({"draw", "o/run.mcap", "-o", "frame.svg"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(has(refused.err, "frame.svg exists; add --force")) << refused.err;
  EXPECT_TRUE(has(run({"draw", "o/run.mcap", "--at", "9999"}).err, "the recording ends at "));
}

TEST_F(Program, WhatIsNoRecordingIsRefused) {
  write("short.mcap", "\x89MCAP");
  for (const char* path : {"small.toml", "missing.mcap", "short.mcap", "/"}) {
    for (const char* command : {"export", "draw"}) {
      const auto outcome = run({command, path});
      EXPECT_EQ(outcome.code, 1) << command << " " << path;
      EXPECT_TRUE(has(outcome.err, path)) << outcome.err;
      EXPECT_EQ(outcome.out, "");
    }
  }
}

TEST_F(Program, AlgorithmsAreListedWithTheirParameters) {
  const auto text = run({"algorithms"}).out;
  for (const char* part : {"outwards", "inwards", "target_gain", "tau", "Table I", "the mission's target tolerance"})
    EXPECT_TRUE(has(text, part)) << part;

  EXPECT_TRUE(has(text, "Bytes of a message: outwards 61, inwards 61, convoy 96, caravan 40, ")) << text;
  const auto list = json::parse(run({"algorithms", "--json"}).out);
  ASSERT_GE(list.size(), 2U);
  std::map<std::string, double> tau{{"outwards", 0.49}, {"inwards", 0.2539}, {"convoy", 1.0}};  // Table I, and ours
  for (const auto& entry : list)
    for (const auto& row : entry["parameters"])
      if (const auto own = tau.find(entry["name"]); own != tau.end() && row["key"] == "target_gain") {
        EXPECT_EQ(row["default"]["literal"], own->second);
        tau.erase(own);
      }
  EXPECT_TRUE(tau.empty());
}

TEST_F(Program, AlgorithmsSayWhatAParameterMayBeAndWhetherItGrowsWithTheBody) {
  const auto text = run({"algorithms", "convoy"}).out;
  EXPECT_TRUE(has(text, "; 0 to 1, more for larger bodies\n")) << text;
  std::map<std::string, bool> grows{{"safe_range", false}, {"clearance", true}, {"target_gain", false}};
  const auto list = json::parse(run({"algorithms", "convoy", "--json"}).out);
  for (const auto& row : list[0]["parameters"])
    if (const auto own = grows.find(row["key"]); own != grows.end()) {
      EXPECT_EQ(row["grows_with_body"], own->second) << row["key"];
      grows.erase(own);
    }
  EXPECT_TRUE(grows.empty());
}

// Two algorithms may mean different things by one key.
TEST_F(Program, EachAlgorithmSaysWhatItsOwnParametersMean) {
  for (const Algorithm* algorithm : algorithms()) {
    const auto text = run({"algorithms", std::string(algorithm->name())}).out;
    std::size_t at = 0;
    for (const ParameterInfo* info : algorithm->parameters()) {
      const auto row = text.find("\n" + std::string(info->key) + " ");
      ASSERT_NE(row, std::string::npos) << algorithm->name() << ": " << info->key;
      const auto next = text.find("\n    ", text.find("\n    ", row) + 1);
      const auto end = text.find('\n', next + 1);
      EXPECT_TRUE(has(text.substr(row, end - row), std::string(info->meaning))) << text.substr(row, end - row);
      EXPECT_TRUE(has(text.substr(row, end - row), std::string(info->advice))) << text.substr(row, end - row);
      ++at;
    }
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), static_cast<std::ptrdiff_t>(10 + 3 * at))
        << "and nothing about parameters of others";
  }
  const auto all = run({"algorithms"}).out;
  for (const Algorithm* algorithm : algorithms())
    for (const ParameterInfo* info : algorithm->parameters())
      EXPECT_TRUE(has(all, std::string(info->meaning))) << algorithm->name() << ": " << info->key;
}

TEST_F(Program, EveryCommandHelpsWithExamples) {
  const auto help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* command : {"run", "validate", "export", "draw", "film", "view", "algorithms", "keys", "bench"}) {
    EXPECT_TRUE(has(help.out, std::string("  ") + command)) << command;
    const auto own = run({command, "--help"});
    EXPECT_EQ(own.code, 0);
    EXPECT_TRUE(has(own.out, "Examples:")) << command;
    std::istringstream lines(own.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120U) << line;
  }
  EXPECT_FALSE(has(help.out, "complete-keys"));
  EXPECT_TRUE(run({"--version"}).out.starts_with("banyan 0.")) << run({"--version"}).out;
}

TEST_F(Program, BenchReportsTheFiguresOfItsLayouts) {
  const auto outcome = run({"bench", "--json", "--windows", "1", "--window", "0.01", "dense-94-los", "spread-94-los"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto report = json::parse(outcome.out);
  EXPECT_EQ(report.size(), 2U);
  for (const auto& entry : report) EXPECT_GT(entry["robot_steps_per_s"].get<double>(), 0.0);
  // The layouts are what their names claim.
  EXPECT_NEAR(report["dense-94-los"]["neighbors_in_range_start"].get<double>(), 85.0, 8.0);
  EXPECT_NEAR(report["spread-94-los"]["neighbors_in_range_start"].get<double>(), 7.0, 1.5);
  EXPECT_GT(report["dense-94-los"]["moving_share"].get<double>(), 0.6);
  EXPECT_EQ(report["dense-94-los"]["algorithm"], "inwards");
}

TEST_F(Program, BenchRunsAWholeMissionWithAnyAlgorithm) {
  const auto mission = run({"bench", "--json", "--windows", "1", "--window", "0.01", "mission-94"});
  ASSERT_EQ(mission.code, 0) << mission.err;
  const auto convoy = json::parse(mission.out)["mission-94"];
  EXPECT_EQ(convoy["algorithm"], "convoy");
  EXPECT_EQ(convoy["robots"], 94);
  // It starts as a cluster and ends spread out over four branches.
  EXPECT_GT(convoy["neighbors_in_range_start"].get<double>(), 1.5 * convoy["neighbors_in_range_end"].get<double>());
  const auto other =
      run({"bench", "--json", "--windows", "1", "--window", "0.01", "spread-94-los", "--algorithm", "inwards"});
  ASSERT_EQ(other.code, 0) << other.err;
  EXPECT_EQ(json::parse(other.out)["spread-94-los"]["algorithm"], "inwards");
  const auto unknown = run({"bench", "spread-94-los", "--algorithm", "inward"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(has(unknown.err, "--algorithm: must be \"outwards\", \"inwards\", \"convoy\", ")) << unknown.err;
  EXPECT_TRUE(has(unknown.err, ", not the text \"inward\"")) << unknown.err;
  for (const std::string_view name : algorithms().names())
    EXPECT_TRUE(has(unknown.err, '"' + std::string(name) + '"')) << unknown.err;
}

// --------------------------------------------------------------------------------------- completion

class Completion : public Program {
 protected:
  std::vector<std::string> complete(const std::string& line) {
    const std::string script =
        "source " BANYAN_COMPLETION "; COMP_LINE=$1; COMP_POINT=${#1}; _banyan; printf '%s\\n' \"${COMPREPLY[@]}\"";
    const auto outcome = finish(start({"-c", script, "bash", BANYAN_PROGRAM + line}, {.program = "/bin/bash"}));
    std::vector<std::string> words;
    std::istringstream in(outcome.out);
    for (std::string word; std::getline(in, word);)
      if (!word.empty()) words.push_back(word);
    std::sort(words.begin(), words.end());
    return words;
  }
};

using Words = std::vector<std::string>;

TEST_F(Completion, KnowsCommandsOptionsKeysValuesAndFiles) {
  EXPECT_EQ(complete(" "), (Words{"--help", "--version", "algorithms", "argos", "bench", "collect",  "demo",
                                  "doctor", "draw",      "export",     "film",  "fleet", "hub",      "keys",
                                  "listen", "robot",     "run",        "study", "tune",  "validate", "view"}));
  EXPECT_EQ(complete(" ru"), Words{"run"});
  EXPECT_EQ(complete(" run --th"), Words{"--threads"});
  EXPECT_EQ(complete(" run small.toml --set radio.lo"), Words{"radio.loss="});
  Words names(algorithms().names().begin(), algorithms().names().end());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(complete(" run small.toml --set mission.algorithm="), names);
  EXPECT_EQ(complete(" run --set mission.parameters.target_"), Words{"mission.parameters.target_gain="});
  EXPECT_EQ(complete(" run sm"), Words{"small.toml"});
  EXPECT_EQ(complete(" algorithms in"), Words{"inwards"});
  fs::create_directory(home_ / "out");
  EXPECT_EQ(complete(" draw o"), Words{"out/"});
  write("run.mcap", "");
  EXPECT_EQ(complete(" film "), (Words{"out/", "run.mcap"}));
  EXPECT_EQ(complete(" view r"), Words{"run.mcap"});
  EXPECT_EQ(complete(" view sm"), Words{"small.toml"});
}

}  // namespace
}  // namespace banyan::cli
