// SPDX-License-Identifier: MIT
// The table of a study: a row for every run that is there, whatever became of it.
#include "banyan/study/results.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "banyan/study/folder.hpp"
#include "banyan/study/journal.hpp"
#include "planned_study.hpp"

namespace banyan::study {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

class ResultsTest : public PlannedStudy {
 protected:
  void SetUp() override {
    PlannedStudy::SetUp();
    ASSERT_NO_FATAL_FAILURE(
        plan("seeds = [1, 2]\n"
             "[[axes]]\nkey = \"mission.algorithm\"\nvalues = [\"outwards\", \"inwards\"]\n"
             "[[parts]]\nname = \"p\"\n[[parts.axes]]\nname = \"noise\"\nkey = \"radio.loss\"\n"
             "values = [0, 0.1]\nlabels = [\"none, at all\", \"some\"]\n"
             "[[parts]]\nname = \"q\"\n"));
    ASSERT_EQ(plan_.rows.size(), 12U);
    ASSERT_EQ(plan_.runs.size(), 8U);  // those of q are the ones without noise of p
    for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
      finish(plan_.runs[i], [&](auto& run) {
        run.normalized_time = 0.1 * static_cast<double>(i);
        run.complete = i % 2 == 0;
        if (run.complete) run.completion_time_s = 3.0;
      });
    }
  }
};

TEST_F(ResultsTest, HasARowPerPlannedRow) {
  const Results results(study_, plan_, outcomes_);
  EXPECT_EQ(results.rows(), 12U);
  EXPECT_EQ(results.missing(), 0U);
  EXPECT_EQ(results.failed(), 0U);
  EXPECT_EQ(results.axes(), (std::vector<std::string>{"algorithm", "noise"}));
  const auto time = results.values("normalized_time"), complete = results.values("complete");
  const auto loss = results.values("loss"), completion = results.values("completion_time_s");
  for (std::size_t row = 0; row < 12; ++row) {
    const auto& planned = plan_.rows[row];
    EXPECT_DOUBLE_EQ(time[row], 0.1 * static_cast<double>(planned.run));
    EXPECT_EQ(complete[row], planned.run % 2 == 0 ? 1.0 : 0.0);
    EXPECT_EQ(loss[row], planned.part == 0 && planned.values[1] == 1 ? 0.1 : 0.0);
    EXPECT_EQ(std::isnan(completion[row]), complete[row] == 0.0);
    EXPECT_EQ(results.label(row, "algorithm"), planned.values[0] ? "inwards" : "outwards");
    EXPECT_EQ(results.label(row, "noise"), planned.part ? "" : planned.values[1] ? "some" : "none, at all");
    EXPECT_EQ(results.label(row, "unknown"), "");
  }
}

TEST_F(ResultsTest, TheTableIsTidy) {
  const auto lines = lines_of(Results(study_, plan_, outcomes_).csv());
  ASSERT_EQ(lines.size(), 13U);
  std::string header = record::run_csv_header();
  while (header.ends_with('\n')) header.pop_back();
  EXPECT_EQ(lines[0], "study,part,run,noise,error," + header) << "algorithm is a column of every run";
  const auto& run = plan_.runs[plan_.rows[0].run];
  EXPECT_EQ(lines[1], "s,p," + run.id + ",\"none, at all\",," + outcomes_.at(run.id).row);
  EXPECT_EQ(lines[9], "s,q," + run.id + ",,," + outcomes_.at(run.id).row);
}

TEST_F(ResultsTest, WhatIsMissingIsLeftOut) {
  outcomes_.erase(plan_.runs[0].id);  // of both parts
  const Results results(study_, plan_, outcomes_);
  EXPECT_EQ(results.rows(), 10U);
  EXPECT_EQ(results.missing(), 2U);
  EXPECT_EQ(results.values("normalized_time").size(), 10U);
  EXPECT_EQ(lines_of(results.csv()).size(), 11U);
  EXPECT_EQ(results.csv().find(plan_.runs[0].id), std::string::npos);
  EXPECT_EQ(results.planned(0).seed, 2U);
}

TEST_F(ResultsTest, WhatFailedIsARowWithoutResults) {
  const auto& run = plan_.runs[1];
  outcomes_[run.id] = {"", "it \"failed\", badly", 1.0};
  const Results results(study_, plan_, outcomes_);
  EXPECT_EQ(results.rows(), 12U);
  EXPECT_EQ(results.failed(), 2U);
  EXPECT_TRUE(std::isnan(results.values("normalized_time")[1]));
  EXPECT_TRUE(std::isnan(results.values("complete")[1]));
  EXPECT_EQ(results.values("seed")[1], 2.0) << "what was asked for is known";
  const auto line = lines_of(results.csv())[2];
  EXPECT_TRUE(line.starts_with("s,p," + run.id + ",\"none, at all\",\"it \"\"failed\"\", badly\",w,outwards,")) << line;
}

TEST_F(ResultsTest, ARowOfAnotherVersionSaysSo) {
  {
    Journal journal(path("j"), "s", "1.2", "abc");
    for (const auto& run : plan_.runs) {
      auto outcome = outcomes_[run.id];
      if (run.id == plan_.runs[1].id) outcome.row = "1,2,3";
      journal.append({run.id, outcome});
    }
  }
  const auto gathered = gather({path("j")}, "s");
  const Results results(study_, plan_, gathered.outcomes);
  EXPECT_EQ(results.failed(), 2U);
  EXPECT_NE(lines_of(results.csv())[2].find("written by another version"), std::string::npos);
}

TEST(Columns, AreMetricsOrNot) {
  for (const char* name :
       {"complete", "normalized_time", "committed", "bytes_per_robot_s", "loss", "seed", "time_ratio", "recovered",
        "recovery_time_s", "last_death_s", "network_length_m", "elections"})
    EXPECT_TRUE(is_metric(name)) << name;
  for (const char* name : {"hash", "algorithm", "version", "nothing", ""}) EXPECT_FALSE(is_metric(name)) << name;
  for (const char* name : {"complete", "recovered", "survivors_suffice"}) EXPECT_TRUE(is_boolean(name)) << name;
  EXPECT_FALSE(is_boolean("committed"));
  EXPECT_TRUE(is_identifying("seed"));
  EXPECT_TRUE(is_identifying("algorithm"));
  EXPECT_FALSE(is_identifying("robots"));
  const auto all = metrics();
  EXPECT_EQ(std::count(all.begin(), all.end(), "completion_time_s"), 1);
  EXPECT_EQ(std::count(all.begin(), all.end(), "seed"), 0);
}

}  // namespace
}  // namespace banyan::study
