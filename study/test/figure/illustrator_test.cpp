// SPDX-License-Identifier: MIT
// The boxes of figures against the table of the study, cell by cell.
#include "../../src/figure/illustrator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "../planned_study.hpp"
#include "banyan/study/report.hpp"

namespace banyan::study {
namespace {

const std::string axes =
    "[[axes]]\nname = \"algorithm\"\nkey = \"mission.algorithm\"\nvalues = [\"convoy\", \"inwards\", \"outwards\"]\n"
    "[[axes]]\nname = \"los\"\ntitle = \"line of sight\"\nkey = \"radio.line_of_sight\"\nvalues = [false, true]\n"
    "[[axes]]\nname = \"r\"\ntitle = \"radius r (m)\"\nkey = \"targets.radius_m\"\nvalues = [1.5, 1.0]\n";

class Illustrations : public PlannedStudy {
 protected:
  // Six seeds; one in three runs misses, times and shares differ for each.
  void prepare(const std::string& figures, const std::string& more_axes = axes) {
    ASSERT_NO_FATAL_FAILURE(plan("seeds = \"1-6\"\n" + more_axes + figures));
    for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
      finish(plan_.runs[i], [&](auto& run) {
        run.complete = (i * 31 + 7) % 3 > 0;
        run.normalized_time = run.complete ? static_cast<double>((i * 7919 + 13) % 1009 + 1) / 1010.0 : 1.0;
        run.disconnected_time_ratio = i % 4 == 0 ? 0.0 : static_cast<double>((i * 104729) % 997) / 1000.0;
        run.committed = static_cast<std::uint32_t>(1 + (i * 13) % 6);
      });
    }
  }
  [[nodiscard]] BoxFigure figure(const std::vector<std::string>& each = {}) const {
    const Results all = results();
    return figure_of(study_, all, study_.figures.at(0), each);
  }
  [[nodiscard]] std::vector<TableRow> table() const { return table_of(results().csv()); }
};

std::vector<double> sorted(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values;
}

const std::string time_figure =
    "[[figures]]\nmetric = \"normalized_time\"\nx = \"r\"\nseries = \"algorithm\"\npanels = \"los\"\n";

// From the file that is drawn, against the table that is left.
TEST_F(Illustrations, BoxesHoldTheRunsOfTheTableAndItsMisses) {
  prepare(time_figure);
  (void)draw_figures(study_, results(), path(""));
  const auto json = nlohmann::json::parse(read("normalized_time.json"));
  EXPECT_EQ(read("normalized_time.json"), figure_json(figure()));
  ASSERT_EQ(json["panels"].size(), 2U);
  std::size_t misses = 0, boxes = 0;
  for (std::size_t p = 0; p < 2; ++p) {
    for (std::size_t g = 0; g < 2; ++g) {
      for (std::size_t s = 0; s < 3; ++s) {
        std::vector<double> times;
        std::size_t missed = 0;
        for (const TableRow& row : table()) {
          if (row.at("line_of_sight") != (p == 0 ? "false" : "true") || row.at("r") != (g == 0 ? "1.5" : "1")) continue;
          if (row.at("algorithm") != json["series"][s]["name"]) continue;
          if (row.at("complete") == "true") times.push_back(std::stod(row.at("normalized_time")));
          else ++missed;
        }
        const auto& box = json["panels"][p]["boxes"][g][s];
        EXPECT_EQ(sorted(box["values"].get<std::vector<double>>()), sorted(times));
        EXPECT_EQ(box["missed"], missed);
        EXPECT_EQ(times.size() + missed, 6U);
        misses += missed;
        ++boxes;
      }
    }
  }
  EXPECT_EQ(boxes, 12U);
  EXPECT_GT(misses, 12U);
  EXPECT_EQ(json["panels"][1]["title"], "line of sight on");
  EXPECT_EQ(json["x_label"], "radius r (m)");
  EXPECT_EQ(json["groups"], (std::vector<std::string>{"1.5", "1"}));
  EXPECT_EQ(json["measures"][0]["label"], "completion time / limit");
}

TEST_F(Illustrations, WhatIsNoTimeHasNoMisses) {
  prepare("[[figures]]\nmetric = \"disconnected_time_ratio\"\nseries = \"algorithm\"\n");
  const BoxFigure drawn = figure();
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_EQ(drawn.panels[0].boxes[s][s].missed, 0U);
    EXPECT_EQ(drawn.panels[0].boxes[s][s].values.size(), 24U) << "a group for each series, all else pooled";
  }
  EXPECT_EQ(drawn.groups, (std::vector<std::string>{"convoy", "inwards", "outwards"}));
}

TEST_F(Illustrations, RatiosAreOfPairs) {
  prepare(
      "[[figures]]\nmetric = \"normalized_time\"\ny_scale = \"ratio\"\nratio_to = \"inwards\"\n"
      "x = [\"los\", \"r\"]\nseries = \"algorithm\"\nwhere = { los = \"on\" }\n");
  const BoxFigure drawn = figure();
  EXPECT_EQ(drawn.measures.at(0).line, 1.0);
  EXPECT_EQ(drawn.measures.at(0).scale, Scale::log);
  EXPECT_EQ(drawn.counted, "pairs");
  ASSERT_EQ(drawn.series.size(), 2U) << "that of inwards itself would be a line at 1";
  const auto rows = table();
  std::size_t ratios = 0;
  for (std::size_t g = 0; g < 2; ++g) {
    for (std::size_t s = 0; s < 2; ++s) {
      std::vector<double> expected;
      std::size_t missed = 0;
      for (const TableRow& a : rows) {
        for (const TableRow& b : rows) {
          if (a.at("algorithm") != drawn.series[s].name || b.at("algorithm") != "inwards") continue;
          if (a.at("seed") != b.at("seed") || a.at("r") != b.at("r") || a.at("r") != drawn.groups[g]) continue;
          if (a.at("line_of_sight") != "true" || b.at("line_of_sight") != "true" || b.at("complete") != "true")
            continue;
          if (a.at("complete") == "true")
            expected.push_back(std::stod(a.at("normalized_time")) / std::stod(b.at("normalized_time")));
          else ++missed;
        }
      }
      EXPECT_EQ(sorted(drawn.panels[0].boxes[g][s].values), sorted(expected));
      EXPECT_EQ(drawn.panels[0].boxes[g][s].missed, missed);
      ratios += expected.size();
    }
  }
  EXPECT_GT(ratios, 4U);
  EXPECT_EQ(drawn.outer.at(0).title, "line of sight");
}

// Where the partner's value is 0 there is no ratio.
TEST_F(Illustrations, NoRatioToZero) {
  prepare(
      "[[figures]]\nmetric = \"disconnected_time_ratio\"\ny_scale = \"ratio\"\nratio_to = \"convoy\"\n"
      "series = \"algorithm\"\n");
  std::size_t zeros = 0;
  for (const TableRow& row : table())
    zeros += row.at("algorithm") == "convoy" && std::stod(row.at("disconnected_time_ratio")) == 0.0 ? 1 : 0;
  EXPECT_GT(zeros, 0U);
  EXPECT_EQ(figure().panels[0].boxes[0][0].values.size(), 24U - zeros);
}

TEST_F(Illustrations, SeveralMetricsArePanelsOrRows) {
  const std::string metrics =
      "[[figures]]\nmetrics = [\"normalized_time\", \"committed\", \"disconnected_time_ratio\"]\n"
      "series = \"algorithm\"\nx = \"r\"\n";
  prepare(metrics);
  BoxFigure drawn = figure();
  ASSERT_EQ(drawn.panels.size(), 3U);
  EXPECT_EQ(drawn.columns, 1U);
  EXPECT_EQ(drawn.panels[1].title, "robots in the tree at the end");
  EXPECT_EQ(drawn.measures[1].label, "") << "it is the title";
  EXPECT_EQ(drawn.panels[2].measure, 2U);
  prepare(metrics + "width_in = 7\n");
  EXPECT_EQ(figure().columns, 3U);
  prepare(metrics + "panels = \"los\"\ny_scale = [\"log\", \"linear\", \"linear\"]\n");
  drawn = figure();
  ASSERT_EQ(drawn.panels.size(), 6U);
  EXPECT_TRUE(drawn.grid);
  EXPECT_EQ(drawn.columns, 2U);
  EXPECT_EQ(drawn.panels[1].title + "|" + drawn.panels[3].title, "line of sight on|");
  EXPECT_EQ(drawn.measures[0].scale, Scale::log);
  EXPECT_EQ(drawn.measures[1].scale, Scale::linear);
  EXPECT_EQ(drawn.measures[1].label, "robots in the tree at the end");
}

TEST_F(Illustrations, NothingEmptyIsDrawn) {
  prepare(time_figure);
  // No run with line of sight, none of inwards, none at 1.5 m of convoy.
  for (const PlannedRow& row : plan_.rows) {
    const bool gone = row.values[1] == 1 || row.values[0] == 1 || (row.values[0] == 0 && row.values[2] == 0);
    if (gone) outcomes_.erase(plan_.runs[row.run].id);
  }
  const BoxFigure drawn = figure();
  ASSERT_EQ(drawn.panels.size(), 1U);
  EXPECT_EQ(drawn.panels[0].title, "") << "there is no other to tell it from";
  ASSERT_EQ(drawn.series.size(), 2U);
  EXPECT_EQ(drawn.series[1].name, "outwards");
  EXPECT_EQ(drawn.groups.size(), 2U) << "there are runs of outwards at 1.5 m";
  outcomes_.clear();
  EXPECT_TRUE(figure().panels.empty());
  const auto report = draw_figures(study_, results(), path(""));
  EXPECT_EQ(report.empty, (std::vector<std::string>{"normalized_time"}));
  EXPECT_TRUE(report.figures.empty() && report.complaint.empty());
  EXPECT_FALSE(exists("normalized_time.json"));
}

TEST_F(Illustrations, InAGridRowsAndColumnsWithoutRunsAreLeftOut) {
  prepare("[[figures]]\nmetrics = [\"recovery_time_s\", \"committed\"]\nseries = \"algorithm\"\npanels = \"los\"\n");
  BoxFigure drawn = figure();  // nobody died: no recovery
  ASSERT_EQ(drawn.panels.size(), 2U);
  EXPECT_EQ(drawn.panels[0].title, "line of sight off") << "titles of columns move to the first row that there is";
  EXPECT_EQ(drawn.panels[0].measure, 1U);
  for (const PlannedRow& row : plan_.rows)
    if (row.values[1] == 0) outcomes_.erase(plan_.runs[row.run].id);
  drawn = figure();
  ASSERT_EQ(drawn.panels.size(), 1U);
  EXPECT_EQ(drawn.columns, 1U);
  EXPECT_EQ(drawn.panels[0].title, "");
}

// Each algorithm has the colour of its place in the program's list, whatever the study shows of it.
TEST_F(Illustrations, AnAlgorithmHasOneColourInAllFigures) {
  const auto styles = [&](const BoxFigure& drawn) {
    std::map<std::string, std::size_t> found;
    for (const Series& series : drawn.series) found[series.name] = series.style.value_or(99);
    return found;
  };
  prepare(time_figure);
  const auto all = styles(figure());
  prepare(time_figure + "where = { algorithm = [\"outwards\", \"inwards\"] }\n");
  for (const auto& [name, style] : styles(figure())) EXPECT_EQ(style, all.at(name)) << name;
  prepare(
      "[[figures]]\nmetric = \"committed\"\nseries = \"algorithm\"\n",
      "[[axes]]\nname = \"algorithm\"\nkey = \"mission.algorithm\"\nvalues = [\"mst\", \"outwards\", \"convoy\"]\n");
  const auto others = styles(figure());
  EXPECT_EQ(others.at("convoy"), all.at("convoy"));
  EXPECT_EQ(others.at("outwards"), all.at("outwards"));
  std::set<std::size_t> different;
  for (const auto& [name, style] : all) different.insert(style);
  different.insert(others.at("mst"));
  EXPECT_EQ(different.size(), 4U);
}

TEST_F(Illustrations, VariantsOfAnAlgorithmShareItsColour) {
  prepare("[[figures]]\nmetric = \"committed\"\nseries = \"way\"\n",
          "[[axes]]\nname = \"way\"\nkeys = [\"mission.algorithm\", \"radio.range_m\"]\n"
          "values = [[\"outwards\", 2], [\"inwards\", 2], [\"inwards\", 3]]\nlabels = [\"a\", \"b\", \"b, far\"]\n");
  const BoxFigure drawn = figure();
  ASSERT_EQ(drawn.series.size(), 3U);
  EXPECT_EQ(drawn.series[1].style, drawn.series[2].style);
  EXPECT_NE(drawn.series[1].variant, drawn.series[2].variant);
  EXPECT_NE(drawn.series[0].style, drawn.series[1].style);
  // An axis of something else has a colour a value.
  prepare("[[figures]]\nmetric = \"committed\"\nseries = \"r\"\n");
  EXPECT_NE(figure().series[0].style, figure().series[1].style);
}

TEST_F(Illustrations, EachCombinationIsAFigureWithItsOwnName) {
  prepare(
      "[[figures]]\nname = \"f\"\ntitle = \"Times\"\nmetric = \"normalized_time\"\nseries = \"algorithm\"\n"
      "each = [\"los\", \"r\"]\n");
  EXPECT_EQ(figure({"on", "1.5"}).title, "Times (line of sight on, radius r = 1.5 m)");
  const auto drawn = draw_figures(study_, results(), path(""));
  EXPECT_EQ(drawn.figures,
            (std::vector<std::string>{"f-los-off-r-1.5", "f-los-off-r-1", "f-los-on-r-1.5", "f-los-on-r-1"}));
  for (const std::string& name : drawn.figures) {
    EXPECT_TRUE(exists(name + ".json")) << name;
    EXPECT_FALSE(exists(name + ".svg")) << "nobody was asked to draw";
  }
}

// An axis that is the same throughout is not worth a word.
TEST_F(Illustrations, TitlesNameWhatDiffers) {
  const std::string each =
      "[[figures]]\nmetric = \"normalized_time\"\nseries = \"algorithm\"\neach = [\"los\", \"r\"]\n";
  prepare(each);
  EXPECT_EQ(figure({"on", "1.5"}).title, "line of sight on, radius r = 1.5 m");
  prepare(each + "where = { los = \"on\" }\n");
  EXPECT_EQ(figure({"on", "1.5"}).title, "radius r = 1.5 m");
  prepare(each + "title = \"Times\"\n");
  for (const PlannedRow& row : plan_.rows)
    if (row.values[1] == 0 || row.values[2] == 1) outcomes_.erase(plan_.runs[row.run].id);  // no runs but on, 1.5
  EXPECT_EQ(figure({"on", "1.5"}).title, "Times");
}

// A run that never completed may have fewer robots than any that did, which is no feat.
TEST_F(Illustrations, NoBoundIsUndercutByRunsThatNeverCompleted) {
  for (const char* metric : {"committed_ratio", "oracle_ratio", "deployment_ratio"}) {
    prepare("[[figures]]\nmetric = \"" + std::string(metric) + "\"\nseries = \"algorithm\"\nx = \"r\"\n");
    for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
      finish(plan_.runs[i], [&](auto& run) {
        run.complete = i % 3 > 0;
        const double ratio = run.complete ? 1.0 + static_cast<double>(i) / 100.0 : 0.5;
        run.committed_ratio = run.oracle_ratio = run.deployment_ratio = ratio;
      });
    }
    const BoxFigure drawn = figure();
    EXPECT_FALSE(drawn.measures[0].late);
    std::size_t runs = 0, missed = 0;
    for (const auto& group : drawn.panels[0].boxes) {
      for (const BoxRuns& box : group) {
        for (const double value : box.values) EXPECT_GE(value, 1.0) << metric;
        runs += box.values.size();
        missed += box.missed;
      }
    }
    const auto rows = table();
    const auto complete = [](const TableRow& row) { return row.at("complete") == "true"; };
    EXPECT_EQ(runs, static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), complete))) << metric;
    EXPECT_EQ(runs + missed, rows.size()) << metric;
  }
}

// Nor is it one in a ratio, of it or by it.
TEST_F(Illustrations, RatiosLeaveOutBoundsOfRunsThatNeverCompleted) {
  prepare(
      "[[figures]]\nmetric = \"committed_ratio\"\ny_scale = \"ratio\"\nratio_to = \"inwards\"\nseries = "
      "\"algorithm\"\n");
  for (std::size_t i = 0; i < plan_.runs.size(); ++i)
    finish(plan_.runs[i], [&](auto& run) {
      run.complete = i % 5 > 0;
      run.committed_ratio = run.complete ? 2.0 : 0.5;
    });
  std::size_t ratios = 0, missed = 0;
  const BoxFigure drawn = figure();
  for (const auto& group : drawn.panels[0].boxes) {
    for (const BoxRuns& box : group) {
      for (const double value : box.values) EXPECT_EQ(value, 1.0) << "of two that completed";
      ratios += box.values.size();
      missed += box.missed;
    }
  }
  EXPECT_GT(ratios, 0U);
  EXPECT_GT(missed, 0U);
}

TEST_F(Illustrations, BooleansAreShares) {
  prepare("[[figures]]\nmetric = \"complete\"\nseries = \"algorithm\"\n[statistics]\nconfidence = 0.9\n");
  const BoxFigure drawn = figure();
  EXPECT_EQ(drawn.measures[0].share_confidence, 0.9);
  EXPECT_EQ(drawn.panels[0].boxes[0][0].values.size(), 24U);
}

}  // namespace
}  // namespace banyan::study
