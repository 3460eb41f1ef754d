// SPDX-License-Identifier: MIT
// `banyan study` and `banyan collect` as a user meets them: started for real, killed, starved of disk
// and sent to other processes. Whatever happens on the way, the tables are those of an undisturbed run.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "banyan/record/mcap.hpp"
#include "banyan/study/workers.hpp"
#include "started_program.hpp"

namespace banyan::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// What the crc of a journal's line is taken of follows after a space.
std::string journal_line(const std::string& text) {
  std::array<char, 16> crc{};
  std::snprintf(crc.data(), crc.size(), "%08x ", record::mcap::crc32(text));
  return crc.data() + text;
}

class StudyProgram : public StartedProgram {
 protected:
  void SetUp() override {
    StartedProgram::SetUp();
    write("w.toml", "[mission]\ntime_limit_s = 5.0\n[swarm]\nrobots = 6\n[targets]\ncount = 2\nradius_m = 0.9\n");
    // Never complete, a few milliseconds a run: long enough to be caught in the middle.
    write("long.toml",
          "[mission]\ntime_limit_s = 300.0\n[swarm]\nrobots = 12\n[targets]\ncount = 2\nradius_m = 60.0\n");
    write("s.toml", study("w.toml", "1-5"));
    write("long-study.toml", study("long.toml", "1-15"));
  }

  // Four combinations of two axes.
  static std::string study(const std::string& scenario, const std::string& seeds, const std::string& more = "") {
    return "name = \"s\"\nscenario = \"" + scenario + "\"\nseeds = \"" + seeds +
           "\"\nfigures = []\n"
           "[[axes]]\nkey = \"mission.algorithm\"\nvalues = [\"outwards\", \"inwards\"]\n"
           "[[axes]]\nname = \"loss\"\nkey = \"radio.loss\"\nvalues = [0, 0.2]\n"
           "[statistics]\nresamples = 100\nby = [[\"algorithm\"]]\n" +
           more;
  }

  Outcome shell(const std::string& script, const Circumstances& how = {}) {
    auto in_bash = how;
    in_bash.program = "bash";
    return run({"-c", script}, in_bash);
  }

  // The tables of an undisturbed run of the file, to compare with.
  std::string reference(const std::string& file) {
    const auto outcome = run({"study", file, "--out", "reference-" + file, "--quiet"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return "reference-" + file;
  }
  void expect_same_tables(const std::string& folder, const std::string& wanted) {
    for (const char* table : {"/runs.csv", "/statistics.csv", "/comparisons.csv"}) {
      EXPECT_GT(read(wanted + table).size(), 100U);
      EXPECT_EQ(read(folder + table), read(wanted + table)) << folder << table;
    }
  }
  // Ids in the journals of a folder, with how often each is there.
  [[nodiscard]] std::map<std::string, int> journaled(const std::string& folder) const {
    std::map<std::string, int> times;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(home_ / folder / "journal", none)) {
      for (const auto& line : lines_of(contents(entry.path()))) {
        const auto value = json::parse(line.size() > 9 ? line.substr(9) : "", nullptr, false);
        if (value.is_object() && value.contains("id")) ++times[value["id"]];
      }
    }
    return times;
  }
  void expect_each_once(const std::string& folder, std::size_t runs) const {
    const auto times = journaled(folder);
    EXPECT_EQ(times.size(), runs);
    for (const auto& [id, count] : times) EXPECT_EQ(count, 1) << id;
  }
  // Waits until the journal holds so many runs; false if it takes too long.
  [[nodiscard]] bool await_runs(const std::string& folder, std::size_t runs) const {
    for (int i = 0; i < 20'000; ++i, std::this_thread::sleep_for(1ms)) {
      if (exists(folder + "/journal/all.jsonl") && journaled(folder).size() >= runs) return true;
    }
    return false;
  }
};

// ------------------------------------------------------------------------------ a study that runs

TEST_F(StudyProgram, LeavesTablesAndASummary) {
  const auto outcome = run({"study", "s.toml"});

  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "s: 20 runs\n  algorithm (outwards, inwards) x loss (0, 0.2) x 5 seeds\n"))
      << outcome.out;
  EXPECT_TRUE(has(outcome.out, "table      out/s/runs.csv")) << outcome.out;
  EXPECT_EQ(lines_of(read("out/s/runs.csv")).size(), 1U + 20U);
  const auto document = json::parse(read("out/s/study.json"));
  EXPECT_EQ(document["runs"], 20);
  EXPECT_EQ(document["failed"], 0);
  EXPECT_EQ(document["missing"], 0);
  EXPECT_EQ(document["config"], read("s.toml"));
  EXPECT_FALSE(exists("out/s/runs"));  // nothing is recorded unasked
  expect_each_once("out/s", 20);
}

TEST_F(StudyProgram, QuietSaysNothing) {
  const auto outcome = run({"study", "s.toml", "--quiet"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(StudyProgram, DoneTwiceIsDoneOnce) {
  ASSERT_EQ(run({"study", "s.toml"}).code, 0);
  const auto table = read("out/s/runs.csv"), journal = read("out/s/journal/all.jsonl");

  ASSERT_EQ(run({"study", "s.toml"}).code, 0);

  EXPECT_EQ(read("out/s/runs.csv"), table);
  EXPECT_EQ(read("out/s/journal/all.jsonl"), journal);
}

TEST_F(StudyProgram, RowsAreThoseOfSingleRuns) {
  ASSERT_EQ(run({"study", "s.toml"}).code, 0);
  ASSERT_EQ(run({"run", "w.toml", "--set", "mission.algorithm=inwards", "--set", "radio.loss=0.2", "--seed", "3",
                 "--out", "single"})
                .code,
            0);

  // inwards comes second, loss 0.2 second, seed 3 third: the 18th of 20 rows.
  const auto row = lines_of(read("out/s/runs.csv")).at(18);
  EXPECT_TRUE(row.ends_with("," + lines_of(read("single/run.csv")).at(1))) << row;
}

// ------------------------------------------------------------------------------------- figures --

class StudyFigures : public StudyProgram {
 protected:
  void SetUp() override {
    StudyProgram::SetUp();
    std::string text =
        study("w.toml", "1-2", "[[figures]]\nname = \"f\"\nmetric = \"committed\"\nseries = \"algorithm\"\n");
    write("f.toml", text.erase(text.find("figures = []\n"), 13));
  }
  // Finished work is there, whatever becomes of pictures.
  void expect_the_rest(const std::string& folder) {
    EXPECT_EQ(json::parse(read(folder + "/study.json"))["missing"], 0);
    EXPECT_GT(read(folder + "/runs.csv").size(), 100U);
    EXPECT_EQ(json::parse(read(folder + "/figures/f.json"))["format"], "banyan.figure");
  }
};

TEST_F(StudyFigures, AreDrawnInThreeFormats) {
  const auto outcome = run({"study", "f.toml", "--out", "o"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "figures    1 in o/figures (.svg, .pdf, .png)")) << outcome.out;
  expect_the_rest("o");
  EXPECT_TRUE(read("o/figures/f.pdf").starts_with("%PDF") && read("o/figures/f.png").starts_with("\x89PNG"));
  EXPECT_TRUE(has(read("o/figures/f.svg"), "robots in the tree at the end"));
}

TEST_F(StudyFigures, WithoutMatplotlibAllElseIsThere) {
  write("none/matplotlib/__init__.py", "raise ImportError('no matplotlib here')\n");
  const Circumstances none{.environment = {{"PYTHONPATH", (home_ / "none").string()}}};
  const auto outcome = run({"study", "f.toml", "--out", "o"}, none);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(has(outcome.err, "matplotlib is not installed (Debian: python3-matplotlib); to draw them: python3 "))
      << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("/figures.py o/figures\n")) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "figures    1 in o/figures (.json, to be drawn)")) << outcome.out;
  expect_the_rest("o");
  EXPECT_FALSE(exists("o/figures/f.svg"));
  const std::string later = outcome.err.substr(outcome.err.find("python3 "));
  EXPECT_EQ(shell("export PATH=/usr/bin:$PATH; " + later).code, 0);
  EXPECT_TRUE(exists("o/figures/f.svg"));
}

TEST_F(StudyFigures, APictureThatCannotBeReplacedIsSaid) {
  fs::create_directories(home_ / "o/figures/f.png");  // permissions would not stop root
  write("o/journal/all.jsonl", "");
  const auto outcome = run({"study", "f.toml", "--out", "o"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(has(outcome.err, "figures were not drawn, or not all: ") && has(outcome.err, "f.png")) << outcome.err;
  expect_the_rest("o");
}

// --------------------------------------------------------------------------------- several routes

TEST_F(StudyProgram, ShardsGiveTheTableOfOneProcess) {
  const auto wanted = reference("s.toml");
  std::vector<pid_t> shards;
  shards.reserve(4);
  for (const char* shard : {"1/4", "2/4", "3/4", "4/4"})
    shards.push_back(start({"study", "s.toml", "--out", "four", "--shard", shard, "--quiet"}));
  for (const pid_t shard : shards) EXPECT_EQ(finish(shard).code, 0);
  EXPECT_FALSE(exists("four/runs.csv"));

  const auto outcome = run({"collect", "s.toml", "--out", "four"});

  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_same_tables("four", wanted);
  expect_each_once("four", 20);
}

TEST_F(StudyProgram, ShardsOfSeveralMachinesAreCollected) {
  const auto wanted = reference("s.toml");
  ASSERT_EQ(run({"study", "s.toml", "--out", "a", "--shard", "1/2"}).code, 0);
  const auto early = run({"collect", "s.toml", "--out", "all", "a"});
  EXPECT_EQ(early.code, 1);
  EXPECT_TRUE(has(early.err, "10 of 20 runs are missing")) << early.err;
  EXPECT_FALSE(exists("all"));
  EXPECT_EQ(run({"collect", "s.toml", "--out", "half", "a", "--partial"}).code, 0);
  EXPECT_EQ(lines_of(read("half/runs.csv")).size(), 1U + 10U);

  ASSERT_EQ(run({"study", "s.toml", "--out", "b", "--shard", "2/2"}).code, 0);
  const auto outcome = run({"collect", "s.toml", "--out", "all", "a", "b"});

  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_same_tables("all", wanted);
}

// Results that are kept as a table, without the journal: new statistics need no new runs.
TEST_F(StudyProgram, ATableIsCollectedLikeAJournal) {
  const auto wanted = reference("s.toml");
  const std::string table = read(wanted + "/runs.csv");
  write("kept/runs.csv", table);
  const auto outcome = run({"collect", "s.toml", "--out", "again", "kept"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "outwards - inwards")) << outcome.out;
  expect_same_tables("again", wanted);
  expect_each_once("again", 20);

  // A column that this program does not know changes nothing.
  std::string wider;
  for (const auto& line : lines_of(table)) wider += "new," + line + "\n";
  write("wider/runs.csv", wider);
  ASSERT_EQ(run({"collect", "s.toml", "--out", "from-wider", "wider"}).code, 0);
  expect_same_tables("from-wider", wanted);
}

// The kept table in its own folder, as help and docs/studies.md have it, and a label with a line break.
TEST_F(StudyProgram, AFolderOfWhichOnlyTheTableWasKeptIsCollected) {
  const auto wanted = reference("s.toml");
  write("kept/runs.csv", read(wanted + "/runs.csv"));
  const auto outcome = run({"collect", "s.toml", "--out", "kept"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_same_tables("kept", wanted);
  expect_each_once("kept", 20);
  EXPECT_EQ(run({"study", "s.toml", "--out", "kept"}).code, 0) << "nothing left to do";

  std::string text = read("s.toml");
  const std::string axis = "name = \"loss\"\n";
  ASSERT_TRUE(has(text, axis));
  text.replace(text.find(axis), axis.size(), "name = \"air\"\nlabels = [\"on the first\\nline\", \"b\"]\n");
  write("broken.toml", text);
  const auto broken = run({"study", "broken.toml", "--out", "lines"});
  ASSERT_EQ(broken.code, 0) << broken.err;
  write("lines-kept/runs.csv", read("lines/runs.csv"));
  EXPECT_EQ(run({"collect", "broken.toml", "--out", "again", "lines-kept"}).code, 0);
}

TEST_F(StudyProgram, ATableThatIsNoneIsRefused) {
  const std::string table = read(reference("s.toml") + "/runs.csv");
  const auto collect = [&](const std::string& text) {
    write("kept/runs.csv", text);
    const auto outcome = run({"collect", "s.toml", "--out", "new", "kept"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_FALSE(exists("new"));
    return outcome.err;
  };
  EXPECT_TRUE(has(collect("a,b\n1,2\n"), "runs.csv: has no columns \"study\", \"run\" and \"error\""));
  EXPECT_TRUE(has(collect(table.substr(0, table.size() - 20)), "runs.csv: line 21 has"));
  std::string other = table;
  other.replace(other.find("\ns,") + 1, 1, "t");
  EXPECT_TRUE(has(collect(other), "belongs to the study \"t\", not to \"s\""));
  // Of other versions.
  std::string narrower, numbered;
  for (const auto& line : lines_of(table)) {
    const std::string before = line.substr(0, line.rfind(','));
    narrower += before + "\n";
    numbered += before + (numbered.empty() ? ",format_version\n" : ",2\n");
  }
  EXPECT_TRUE(
      has(collect(narrower), "runs.csv: has no column \"format_version\": the table was written by another version"));
  EXPECT_TRUE(
      has(collect(numbered), "runs.csv: has rows of another format_version: the table was written by another version"));
}

TEST_F(StudyProgram, MoreShardsThanRunsAreNoFault) {
  const auto outcome = run({"study", "s.toml", "--shard", "21/50"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "shard 21 of 50 is done (0 runs, 0 failed)")) << outcome.out;
}

TEST_F(StudyProgram, BadShardsAreRefused) {
  for (const char* shard : {"0/4", "5/4", "1", "1/", "/4", "1/4x", "-1/4", "1/0", "1/4/2", " 1/4"})
    expect_refused({"study", "s.toml", "--shard", shard}, "expects i/n");
}

TEST_F(StudyProgram, TwoProcessesOfMpiGiveTheTableOfOne) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "Open MPI is not built with the thread sanitizer, which would see races in it";
#endif
  if (!study::Processes::supported()) GTEST_SKIP() << "this build has no MPI";
  const auto wanted = reference("s.toml");

  // As in study/test/workers/workers_test.cpp: as root, more processes than cores, shared memory alone.
  Circumstances how{.program = BANYAN_MPIRUN};
  how.environment = {{"ASAN_OPTIONS", "detect_leaks=0"},
                     {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                     {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                     {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
                     {"OMPI_MCA_btl", "self,vader"},
                     {"OMPI_MCA_pml", "ob1"},
                     {"OMPI_MCA_btl_vader_single_copy_mechanism", "none"}};
  const auto outcome = run({"-n", "2", BANYAN_PROGRAM, "study", "s.toml", "--out", "two"}, how);

  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  expect_same_tables("two", wanted);
  expect_each_once("two", 20);

  const auto refused = run({"-n", "2", BANYAN_PROGRAM, "study", "missing.toml"}, how);
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(has(refused.err, "missing.toml: error: there is no such file")) << refused.err;
}

// ------------------------------------------------------------------------------ stopped on the way

TEST_F(StudyProgram, KilledAtAnyMomentItGoesOn) {
  const auto wanted = reference("long-study.toml");

  for (const std::size_t runs : {0, 1, 7, 25, 50}) {
    const pid_t child = start({"study", "long-study.toml", "--out", "o", "--quiet"});
    ASSERT_TRUE(await_runs("o", runs));
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    EXPECT_EQ(finish(child).code, 1000 + SIGKILL) << "it was over before it could be killed";
    EXPECT_FALSE(exists("o/runs.csv"));
  }
  ASSERT_EQ(run({"study", "long-study.toml", "--out", "o"}).code, 0);

  expect_same_tables("o", wanted);
  expect_each_once("o", 60);
}

TEST_F(StudyProgram, CtrlCEndsItInOrder) {
  const auto wanted = reference("long-study.toml");

  for (const int number : {SIGINT, SIGTERM}) {
    const auto before = journaled("o").size();
    const pid_t child = start({"study", "long-study.toml", "--out", "o"});
    ASSERT_TRUE(await_runs("o", before + 2));
    ASSERT_EQ(::kill(child, number), 0);
    const auto outcome = finish(child);
    EXPECT_EQ(outcome.code, 128 + number) << outcome.err;
    EXPECT_TRUE(has(outcome.err, number == SIGINT ? "stopped by Ctrl-C after " : "stopped by SIGTERM after "))
        << outcome.err;
    EXPECT_FALSE(exists("o/runs.csv"));
  }
  ASSERT_EQ(run({"study", "long-study.toml", "--out", "o"}).code, 0);

  expect_same_tables("o", wanted);
  expect_each_once("o", 60);
}

TEST_F(StudyProgram, AFullDiskLosesNothing) {
  const auto wanted = reference("s.toml");

  // A row takes some 430 bytes: the disk is full within the header and within the runs.
  for (const rlim_t bytes : {70, 1000, 5000}) {
    const auto outcome = run({"study", "s.toml", "--out", "o", "--quiet"}, {.largest_file = bytes});
    EXPECT_EQ(outcome.code, 1) << bytes;
    EXPECT_TRUE(has(outcome.err, "cannot write: File too large")) << bytes << outcome.err;
  }
  EXPECT_GT(journaled("o").size(), 5U);
  EXPECT_FALSE(exists("o/runs.csv"));
  fs::create_directories(home_ / "o/statistics.csv.part");  // runs are done, and then a table cannot be written
  EXPECT_EQ(run({"study", "s.toml", "--out", "o"}).code, 1);
  EXPECT_FALSE(exists("o/study.json"));
  fs::remove(home_ / "o/statistics.csv.part");
  ASSERT_EQ(run({"study", "s.toml", "--out", "o"}).code, 0);

  expect_same_tables("o", wanted);
  expect_each_once("o", 20);
}

TEST_F(StudyProgram, ATornLastLineIsDoneAgain) {
  const auto wanted = reference("s.toml");
  ASSERT_EQ(run({"study", "s.toml", "--out", "o"}).code, 0);
  fs::resize_file(home_ / "o/journal/all.jsonl", fs::file_size(home_ / "o/journal/all.jsonl") - 100);

  ASSERT_EQ(run({"study", "s.toml", "--out", "o"}).code, 0);

  expect_same_tables("o", wanted);
  expect_each_once("o", 20);
}

TEST_F(StudyProgram, ADamagedLineIsNamedAndNothingTouched) {
  const auto wanted = reference("s.toml");
  ASSERT_EQ(run({"study", "s.toml", "--out", "o"}).code, 0);
  auto lines = lines_of(read("o/journal/all.jsonl"));
  lines.at(2)[50] ^= 1;
  std::string damaged, mended;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    damaged += lines[i] + "\n";
    if (i != 2) mended += lines[i] + "\n";
  }
  write("o/journal/all.jsonl", damaged);

  for (const char* command : {"study", "collect"}) {
    const auto outcome = run({command, "s.toml", "--out", "o"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(has(outcome.err, "o/journal/all.jsonl: line 3: the line is damaged; delete it")) << outcome.err;
  }
  EXPECT_EQ(read("o/journal/all.jsonl"), damaged);
  expect_same_tables("o", wanted);

  write("o/journal/all.jsonl", mended);  // as the message says
  ASSERT_EQ(run({"study", "s.toml", "--out", "o"}).code, 0);
  expect_same_tables("o", wanted);
  expect_each_once("o", 20);
}

TEST_F(StudyProgram, OnlyOneIsAtWorkOnAStudy) {
  const pid_t child = start({"study", "long-study.toml", "--out", "o", "--quiet"});
  ASSERT_TRUE(await_runs("o", 1));
  ASSERT_EQ(::kill(child, SIGSTOP), 0);

  const auto second = run({"study", "long-study.toml", "--out", "o"});
  EXPECT_EQ(second.code, 1);
  EXPECT_TRUE(has(second.err, "another banyan is at work on this study")) << second.err;
  const auto forced = run({"study", "long-study.toml", "--out", "o", "--force"});
  EXPECT_EQ(forced.code, 2);
  EXPECT_TRUE(has(forced.err, "another banyan is at work on this study")) << forced.err;
  EXPECT_TRUE(exists("o/journal/all.jsonl"));

  ASSERT_EQ(::kill(child, SIGKILL), 0);
  finish(child);
}

// What is done and then gone is no success, however the journal went.
TEST_F(StudyProgram, AJournalThatIsTakenAwayIsNoSuccess) {
  for (const bool replaced : {false, true}) {
    const pid_t child = start({"study", "long-study.toml", "--out", "o", "--quiet", "--threads", "2"});
    ASSERT_TRUE(await_runs("o", 1));
    ASSERT_EQ(::kill(child, SIGSTOP), 0);
    fs::remove(home_ / "o/journal/all.jsonl");
    if (replaced) write("o/journal/all.jsonl", "");
    ASSERT_EQ(::kill(child, SIGCONT), 0);
    const auto outcome = finish(child);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "o/journal/all.jsonl: this file was removed or replaced")) << outcome.err;
    EXPECT_FALSE(exists("o/study.json"));
    fs::remove_all(home_ / "o");
  }
}

TEST_F(StudyProgram, ARowOfAnotherVersionIsTriedAgain) {
  const auto wanted = reference("s.toml");
  for (const char* journal : {"all", "shard-1-of-1"}) {
    ASSERT_EQ(run({"study", "s.toml", "--out", "o"}).code, 0);
    auto lines = lines_of(read("o/journal/all.jsonl"));
    auto line = json::parse(lines.at(3).substr(9));
    line["row"] = line["row"].get<std::string>() + ",one more";
    lines.at(3) = journal_line(line.dump());
    std::string text;
    for (const auto& one : lines) text += one + "\n";
    fs::remove_all(home_ / "o");
    write("o/journal/" + std::string(journal) + ".jsonl", text);

    const auto outcome = run({"study", "s.toml", "--out", "o"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(has(outcome.err, "1 of 20 runs failed: column \"error\" of o/runs.csv; --retry")) << outcome.err;
    EXPECT_TRUE(
        has(read("o/runs.csv"), ".jsonl: the row was written by another version of banyan; --retry runs it again"));
    EXPECT_EQ(run({"collect", "s.toml", "--out", "o"}).code, 1);
    int shards_at_fault = 0;
    for (const char* shard : {"1/2", "2/2"})
      shards_at_fault += run({"study", "s.toml", "--out", "o", "--shard", shard}).code;
    EXPECT_EQ(shards_at_fault, 1);

    const auto retried = run({"study", "s.toml", "--out", "o", "--retry"});
    EXPECT_EQ(retried.code, 0) << retried.err;
    expect_same_tables("o", wanted);
    fs::remove_all(home_ / "o");
  }
}

// ----------------------------------------------------------------------------------- runs that fail

TEST_F(StudyProgram, ARunThatFailsIsARowWithItsError) {
  write("record.toml", study("w.toml", "1-5", "[set]\noutput.record = true\n"));
  write("o/journal/.keep", "");
  ASSERT_EQ(run({"study", "s.toml", "--out", "o", "--shard", "1/2"}).code, 0);  // half of them, without recordings
  write("o/runs", "a file in the way");

  const auto outcome = run({"study", "record.toml", "--out", "o"});

  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(has(outcome.err, "10 of 20 runs failed: column \"error\" of o/runs.csv; --retry")) << outcome.err;
  const auto rows = lines_of(read("o/runs.csv"));
  ASSERT_EQ(rows.size(), 1U + 20U);
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(), [](const auto& row) { return has(row, "Not a directory"); }), 10);
  const auto columns = [](const std::string& row) {
    bool quoted = false;
    return std::count_if(row.begin(), row.end(), [&](char c) {
      if (c == '"') quoted = !quoted;
      return c == ',' && !quoted;
    });
  };
  for (const auto& row : rows) EXPECT_EQ(columns(row), columns(rows.front())) << row;
  EXPECT_EQ(json::parse(read("o/study.json"))["failed"], 10);

  const auto again = run({"study", "record.toml", "--out", "o"});  // remembered, not tried again
  EXPECT_EQ(again.code, 1);
  EXPECT_EQ(journaled("o").size(), 20U);
  EXPECT_EQ(run({"study", "record.toml", "--out", "o", "--shard", "2/2"}).code, 1);

  fs::remove(home_ / "o/runs");
  const auto retried = run({"study", "record.toml", "--out", "o", "--retry"});
  EXPECT_EQ(retried.code, 0) << retried.err;
  EXPECT_EQ(read("o/runs.csv"), read(reference("s.toml") + "/runs.csv"));
  EXPECT_TRUE(exists("o/runs/algorithm=outwards,loss=0/seed=2/run.mcap"));
}

TEST_F(StudyProgram, SeedsWhoseWorldsCannotBeBuiltAreRowsToo) {
  // Obstacles all around leave a target so little room that some seeds find none.
  write("tight.toml",
        "seed = 2  # which the study does not use\n[mission]\ntime_limit_s = 1.0\n[swarm]\nrobots = 6\n"
        "[targets]\nlayout = \"random\"\ncount = 1\nradius_m = 10.0\n"
        "[[obstacles]]\nkind = \"box\"\ncenter_m = [-7, 0]\nsize_m = [10, 24]\n"
        "[[obstacles]]\nkind = \"box\"\ncenter_m = [0, 7]\nsize_m = [24, 10]\n"
        "[[obstacles]]\nkind = \"box\"\ncenter_m = [0, -7]\nsize_m = [24, 10]\n"
        "[[obstacles]]\nkind = \"box\"\ncenter_m = [5.905, 0]\nsize_m = [7.81, 24]\n");
  write("t.toml", "scenario = \"tight.toml\"\nseeds = \"1-20\"\nfigures = []\n");

  const auto outcome = run({"study", "t.toml"});

  ASSERT_EQ(outcome.code, 1) << outcome.err;
  const auto rows = lines_of(read("out/t/runs.csv"));
  ASSERT_EQ(rows.size(), 1U + 20U);
  const auto failed = std::count_if(rows.begin(), rows.end(), [](const auto& row) { return has(row, "obstacle"); });
  EXPECT_GT(failed, 0);
  EXPECT_LT(failed, 20);
  EXPECT_TRUE(has(outcome.err, std::to_string(failed) + " of 20 runs failed")) << outcome.err;
}

// ------------------------------------------------------------------------------- what is there stays

TEST_F(StudyProgram, ADryRunWritesNothing) {
  const auto outcome = run({"study", "s.toml", "--dry-run"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "s: 20 runs")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "from sample runs")) << outcome.out;
  EXPECT_FALSE(exists("out"));

  const auto wanted = reference("s.toml");
  const auto table = read(wanted + "/runs.csv");
  EXPECT_EQ(run({"study", "s.toml", "--out", wanted, "--dry-run", "--force"}).code, 0);
  EXPECT_EQ(read(wanted + "/runs.csv"), table);
  expect_each_once(wanted, 20);
}

TEST_F(StudyProgram, AnotherPlanNeedsConsent) {
  ASSERT_EQ(run({"study", "s.toml", "--out", "o"}).code, 0);
  const auto table = read("o/runs.csv");
  write("s.toml", study("w.toml", "3-8"));

  const auto refused = run({"study", "s.toml", "--out", "o"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(has(refused.err, "finished with another plan (20 runs; now 24 runs)") || has(refused.err, "--extend"))
      << refused.err;
  EXPECT_EQ(read("o/runs.csv"), table);

  const auto extended = run({"study", "s.toml", "--out", "o", "--extend"});
  ASSERT_EQ(extended.code, 0) << extended.err;
  EXPECT_TRUE(has(extended.out, "12 to do here")) << extended.out;
  expect_same_tables("o", reference("s.toml"));
  expect_each_once("o", 20 + 12);

  ASSERT_EQ(run({"study", "s.toml", "--out", "o", "--force"}).code, 0);
  expect_same_tables("o", "reference-s.toml");
  expect_each_once("o", 24);
}

TEST_F(StudyProgram, AnotherStudysFolderIsRefused) {
  ASSERT_EQ(run({"study", "s.toml", "--out", "o"}).code, 0);
  ASSERT_EQ(run({"study", "s.toml", "--out", "unfinished", "--shard", "1/2"}).code, 0);
  write("other.toml", "scenario = \"w.toml\"\nseeds = [1]\nfigures = []\n");

  const auto finished = run({"study", "other.toml", "--out", "o"});
  EXPECT_EQ(finished.code, 2);
  EXPECT_TRUE(has(finished.err, "o holds the finished study \"s\"")) << finished.err;
  const auto unfinished = run({"study", "other.toml", "--out", "unfinished"});
  EXPECT_EQ(unfinished.code, 1);
  EXPECT_TRUE(has(unfinished.err, "belongs to the study \"s\", not to \"other\"")) << unfinished.err;
  EXPECT_FALSE(exists("unfinished/journal/all.jsonl"));
}

TEST_F(StudyProgram, FilesOfOthersAreNeverTouched) {
  for (const char* file :
       {"mine/runs.csv", "mine/statistics.csv", "mine/comparisons.csv", "mine/figures/f.svg", "mine/runs/a/b"}) {
    write(file, "mine");
    for (const Arguments& arguments :
         {Arguments{"study", "s.toml", "--out", "mine"}, Arguments{"study", "s.toml", "--out", "mine", "--force"}}) {
      const auto outcome = run(arguments);
      EXPECT_EQ(outcome.code, 2) << file;
      EXPECT_TRUE(has(outcome.err, "is not of a study; choose another --out DIR")) << outcome.err;
      EXPECT_EQ(read(file), "mine");
    }
    fs::remove_all(home_ / "mine");
  }
  write("file", "");
  EXPECT_EQ(run({"study", "s.toml", "--out", "file"}).code, 2);
}

// Nothing that a folder or a file may be is an error of the program's own.
TEST_F(StudyProgram, FoldersAndFilesThatCannotBeAreSaidByName) {
  fs::create_directory_symlink("loop", home_ / "loop");
  for (const std::string& folder : {std::string(300, 'x'), std::string("loop"), std::string("loop/x")}) {
    const std::string reason = folder.size() == 300 ? "File name too long" : "Too many levels of symbolic links";
    for (const Arguments& arguments : {Arguments{"run", "w.toml", "--out", folder},
                                       {"study", "s.toml", "--out", folder},
                                       {"study", "s.toml", "--out", folder, "--force"},
                                       {"collect", "s.toml", "--out", folder}}) {
      const auto outcome = run(arguments);
      EXPECT_EQ(outcome.code, 1) << arguments[0];
      EXPECT_TRUE(has(outcome.err, folder) && has(outcome.err, reason)) << arguments[0] << outcome.err;
      EXPECT_FALSE(has(outcome.err, "internal error")) << outcome.err;
    }
  }
  ASSERT_EQ(run({"study", "s.toml", "--out", "o"}).code, 0);
  const auto good = json::parse(read("o/study.json"));
  for (const char* key : {"format", "study", "plan", "runs"}) {
    auto odd = good;
    odd[key] = json::array({7});
    write("o/study.json", odd.dump());
    const auto outcome = run({"study", "s.toml", "--out", "o"});
    EXPECT_EQ(outcome.code, 1) << key;
    EXPECT_TRUE(has(outcome.err, "o/study.json: is not what a study writes")) << outcome.err;
  }
  auto later = good;
  later["format_version"] = 2;
  write("o/study.json", later.dump());
  const auto outcome = run({"study", "s.toml", "--out", "o"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(has(outcome.err, "o/study.json: was written by another version of banyan")) << outcome.err;
}

TEST_F(StudyProgram, ForceIsNotForShards) {
  ASSERT_EQ(run({"study", "s.toml", "--out", "o", "--shard", "1/2"}).code, 0);
  const auto outcome = run({"study", "s.toml", "--out", "o", "--shard", "2/2", "--force"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(exists("o/journal/shard-1-of-2.jsonl"));
}

TEST_F(StudyProgram, ResultsOfAnotherVersionNeedConsent) {
  ASSERT_EQ(run({"study", "s.toml", "--out", "o", "--shard", "1/2"}).code, 0);
  auto lines = lines_of(read("o/journal/shard-1-of-2.jsonl"));
  auto header = json::parse(lines.at(0).substr(9));
  header["version"] = "0.0.1";
  std::string journal = journal_line(header.dump()) + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) journal += lines[i] + "\n";
  write("o/journal/shard-1-of-2.jsonl", journal);

  const auto refused = run({"study", "s.toml", "--out", "o"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(has(refused.err, "made by banyan 0.0.1 (git ")) << refused.err;
  EXPECT_TRUE(has(refused.err, "--mix-versions")) << refused.err;

  const auto mixed = run({"study", "s.toml", "--out", "o", "--mix-versions"});
  EXPECT_EQ(mixed.code, 0) << mixed.err;
  expect_each_once("o", 20);
}

// ---------------------------------------------------------------------------------------- bad input

TEST_F(StudyProgram, AMillionRunsByMistakeAreNotStarted) {
  write("s.toml", study("w.toml", "1-250000"));
  expect_refused({"study", "s.toml"}, "this study has 1,000,000 runs; add --yes if that is meant");
  write("s.toml", study("w.toml", "1-9000000"));
  expect_refused({"study", "s.toml", "--yes"}, "this study has 36,000,000 runs; 10,000,000 are the most");
}

// Planning ten million runs takes minutes.
TEST_F(StudyProgram, ALongPlanIsNotSilent) {
  write("s.toml", study("w.toml", "1-2500000"));
  const pid_t child = start({"study", "s.toml", "--yes", "--dry-run"});
  const std::string wanted = " of 10,000,000 runs planned, about ";
  for (int k = 0; k < 6'000 && !has(read("stderr.txt"), wanted); ++k) std::this_thread::sleep_for(10ms);
  ::kill(child, SIGKILL);
  const auto outcome = finish(child);
  EXPECT_TRUE(has(outcome.err, wanted)) << outcome.err;
}

TEST_F(StudyProgram, OnATerminalItAsks) {
  write("s.toml", study("w.toml", "1-250000"));
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0 || ::grantpt(terminal) != 0 || ::unlockpt(terminal) != 0) GTEST_SKIP() << "no pseudo-terminals";
  const int end = ::open(::ptsname(terminal), O_RDWR | O_NOCTTY);
  ASSERT_GE(end, 0);
  ASSERT_EQ(::write(terminal, "n\n", 2), 2);

  const auto outcome = run({"study", "s.toml"}, {.input = end});

  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(has(outcome.err, "this study has 1,000,000 runs; go on? [y/N] ")) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "nothing was started")) << outcome.err;
  EXPECT_FALSE(exists("out"));
  ::close(end);
  ::close(terminal);
}

TEST_F(StudyProgram, FaultsNameFileAndLine) {
  write("empty-axis.toml", "scenario = \"w.toml\"\nseeds = [1]\n[[axes]]\nkey = \"radio.loss\"\nvalues = []\n");
  expect_refused({"study", "empty-axis.toml"}, "empty-axis.toml:5: error: axes[0].values: is an empty list");
  write("unknown.toml", "scenario = \"w.toml\"\nseeds = [1]\n[[axes]]\nkey = \"radio.los\"\nvalues = [0, 0.5]\n");
  expect_refused({"study", "unknown.toml"}, "unknown.toml:5: error: radio.los: ");
  expect_refused({"study", "unknown.toml"}, "radio.loss");
  write("twice.toml",
        "scenario = \"w.toml\"\nseeds = [1]\n[[axes]]\nname = \"a\"\nkey = \"radio.loss\"\n"
        "values = [0.0, 0.1]\n[[axes]]\nname = \"b\"\nkey = \"radio.loss\"\nvalues = [0.2, 0.3]\n");
  expect_refused({"study", "twice.toml"}, "two of its runs are the same: (a=0, b=0.2) and (a=0.1, b=0.2) with seed 1");
  write("seeds.toml", "scenario = \"w.toml\"\nseeds = [1, 2, 1]\n");
  expect_refused({"study", "seeds.toml"}, "seeds.toml:2: error: seeds: holds the seed 1 twice");
  expect_refused({"study", "s.toml", "--set", "radio.lost=1"}, "--set radio.lost=1: error: radio.lost");
  expect_refused({"study", "s.toml", "--with", "none.toml"}, "none.toml: error: there is no such file");
}

// ------------------------------------------------------------------------- from anywhere, in any form

TEST_F(StudyProgram, StartedElsewhereItFindsItsFilesAndWritesBelowOneFolder) {
  const auto wanted = reference("s.toml");
  fs::create_directories(home_ / "some/where");

  const auto outcome = run({"study", "../../s.toml", "--out", "deep/er/"}, {.directory = "some/where"});

  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_same_tables("some/where/deep/er", wanted);
  EXPECT_EQ(std::distance(fs::directory_iterator(home_ / "some/where"), fs::directory_iterator{}), 1);
}

TEST_F(StudyProgram, JsonIsTakenAsWell) {
  const auto wanted = reference("s.toml");
  const json document = {{"name", "s"},
                         {"scenario", "w.json"},
                         {"seeds", "1-5"},
                         {"figures", json::array()},
                         {"axes",
                          {{{"key", "mission.algorithm"}, {"values", {"outwards", "inwards"}}},
                           {{"name", "loss"}, {"key", "radio.loss"}, {"values", {0, 0.2}}}}},
                         {"statistics", {{"resamples", 100}, {"by", {{"algorithm"}}}}}};
  write("s.json", document.dump());
  write("w.json",
        R"({"mission": {"time_limit_s": 5.0}, "swarm": {"robots": 6}, "targets": {"count": 2, "radius_m": 0.9}})");

  const auto outcome = run({"study", "s.json", "--out", "o"});

  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_same_tables("o", wanted);
}

TEST_F(StudyProgram, AnEarlierRunIsABaseScenario) {
  const auto wanted = reference("s.toml");
  ASSERT_EQ(run({"run", "w.toml", "--seed", "77", "--out", "earlier"}).code, 0);
  write("s.toml", study("earlier/run.json", "1-5"));

  const auto outcome = run({"study", "s.toml", "--out", "o"});

  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_same_tables("o", wanted);
}

TEST_F(StudyProgram, OptionsReachIntoListsOfTheScenario) {
  write("w.toml", read("w.toml") + "[[events]]\ntime_s = 1\nkind = \"freeze\"\nrobot = 1\nduration_s = 1\n");
  const auto outcome = run({"study", "s.toml", "--set", "events[0].time_s=2", "--set", "events[0].robot = 2", "-n"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  expect_refused({"study", "s.toml", "--set", "events[1].time_s=2"}, "this one does not exist");
}

// --------------------------------------------------------------------------------------------- Slurm

TEST_F(StudyProgram, TheJobArrayDoesWhatOneProcessDoes) {
  const auto wanted = reference("s.toml");
  const std::string odd = "it's \"odd\" $HOME";
  fs::create_directories(home_ / odd);
  for (const char* file : {"s.toml", "w.toml"}) fs::copy(home_ / file, home_ / odd / file);
  write(odd + "/with.toml", "radio.range_m = 2.0\n");

  const auto written = run({"study", odd + "/s.toml", "--out", odd + "/o ut", "--with", odd + "/with.toml", "--set",
                            "mission.time_limit_s=5", "--sbatch", "job.sh", "--shards", "3", "--threads", "2"});
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_FALSE(exists(odd + "/o ut"));
  const auto script = read("job.sh");
  EXPECT_TRUE(has(script, "#SBATCH --array=1-3\n")) << script;
  EXPECT_TRUE(has(script, "#SBATCH --cpus-per-task=2\n")) << script;
  ASSERT_EQ(shell("bash -n job.sh").code, 0) << read("stderr.txt");
  EXPECT_EQ(run({"study", odd + "/s.toml", "--sbatch", "job.sh"}).code, 1);  // not replaced unasked
  EXPECT_EQ(read("job.sh"), script);

  fs::create_directories(home_ / "elsewhere");
  for (const char* task : {"1", "2", "3"}) {
    const auto outcome =
        shell("bash ../job.sh", {.directory = "elsewhere", .environment = {{"SLURM_ARRAY_TASK_ID", task}}});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_FALSE(exists(odd + "/o ut/runs.csv"));
  const auto lines = lines_of(script);
  ASSERT_TRUE(has(lines.back(), " collect ")) << lines.back();
  const auto outcome = shell(lines.back(), {.directory = "elsewhere"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_same_tables(odd + "/o ut", wanted);
}

TEST_F(StudyProgram, AJobArrayNeedsAFile) {
  const int input = ::open((home_ / "s.toml").c_str(), O_RDONLY);
  const auto outcome = run({"study", "-", "--sbatch", "-"}, {.input = input});
  ::close(input);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "banyan: --sbatch needs a study in a file, not standard input\n");
  EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace banyan::cli
