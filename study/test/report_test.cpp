// SPDX-License-Identifier: MIT
// Tables of statistics against values that are worked out here, group by group and pair by pair.
#include "banyan/study/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "banyan/study/paired.hpp"
#include "banyan/study/statistics.hpp"
#include "planned_study.hpp"

namespace banyan::study {
namespace {

// Rows whose cells are as given.
std::vector<TableRow> picked(const std::vector<TableRow>& rows, const TableRow& wanted) {
  std::vector<TableRow> found;
  for (const auto& row : rows) {
    if (std::all_of(wanted.begin(), wanted.end(), [&](const auto& w) { return row.at(w.first) == w.second; }))
      found.push_back(row);
  }
  return found;
}

double cell_value(const std::string& cell) { return cell.empty() ? std::nan("") : std::stod(cell); }

// Two parts: algorithm x r x q, and algorithm alone. Metrics depend on everything, in no simple way.
class ReportTest : public PlannedStudy {
 protected:
  void SetUp() override {
    PlannedStudy::SetUp();
    prepare("by = [[\"r\"], [\"way\", \"r\"], [\"way\"], []]\n");
  }
  void prepare(const std::string& by) {
    ASSERT_NO_FATAL_FAILURE(
        plan("seeds = \"1-7\"\nfigures = []\n"
             "[[axes]]\nname = \"way\"\nkeys = [\"mission.algorithm\", \"radio.range_m\"]\n"
             "values = [[\"outwards\", 2], [\"inwards\", 2], [\"inwards\", 3]]\n"
             "labels = [\"outwards\", \"inwards\", \"tuned\"]\n"
             "[[parts]]\nname = \"big\"\n"
             "[[parts.axes]]\nname = \"r\"\nkey = \"targets.radius_m\"\nvalues = [1.5, 1.0]\n"
             "[[parts.axes]]\nname = \"q\"\nkey = \"radio.loss\"\nvalues = [0, 0.1]\n"
             "[[parts]]\nname = \"small\"\n"
             "[statistics]\ncompare = \"way\"\nresamples = 100\nmetrics = [\"normalized_time\", \"complete\"]\n" +
             by));
    for (std::size_t i = 0; i < plan_.runs.size(); ++i) set(plan_.runs[i], time_of(i), complete(i));
  }
  void set(const PlannedRun& run, double time, bool done) {
    finish(run, [&](auto& result) {
      result.normalized_time = time;
      result.complete = done;
    });
  }
  // Of a run of the plan; with six decimals, as in the table.
  static double time_of(std::size_t run) { return static_cast<double>((run * 7919 + 13) % 1009) / 1000.0; }
  static bool complete(std::size_t run) { return (run * 31 + 7) % 5 < 3; }
  static double value_of(std::size_t run, const std::string& metric) {
    return metric == "complete" ? (complete(run) ? 1.0 : 0.0) : time_of(run);
  }
  // The label of an axis in a row of the plan, "" if its part has none.
  [[nodiscard]] std::string label(const PlannedRow& row, const std::string& axis) const {
    const auto& axes = study_.parts[row.part].axes;
    for (std::size_t a = 0; a < axes.size(); ++a)
      if (axes[a].name == axis) return axes[a].values[row.values[a]].label;
    return "";
  }
  [[nodiscard]] bool there(const PlannedRow& row) const {
    const auto at = outcomes_.find(plan_.runs[row.run].id);
    return at != outcomes_.end() && at->second.error.empty();
  }
  // Whether a run belongs to the group that a row of a table is about.
  [[nodiscard]] bool in_group(const PlannedRow& run, const TableRow& row, bool but_algorithm) const {
    if (study_.parts[run.part].name != row.at("part")) return false;
    constexpr std::array<std::string_view, 3> axes{"way", "r", "q"};
    return std::all_of(axes.begin(), axes.end(), [&](std::string_view name) {
      const std::string axis(name);
      return (but_algorithm && axis == "way") || row.at(axis) == "*" || row.at(axis) == label(run, axis);
    });
  }
  [[nodiscard]] std::vector<TableRow> statistics() const { return table_of(statistics_csv(study_, results())); }
  [[nodiscard]] std::vector<TableRow> comparisons() const { return table_of(comparisons_csv(study_, results())); }
  void check_statistics() const {
    for (const auto& row : statistics()) {
      std::vector<double> values;
      for (const auto& run : plan_.rows)
        if (there(run) && in_group(run, row, false)) values.push_back(value_of(run.run, row.at("metric")));
      ASSERT_EQ(row.at("runs"), std::to_string(values.size()));
      if (values.empty()) {
        EXPECT_EQ(row.at("mean") + row.at("median") + row.at("positive_high"), "");
        continue;
      }
      std::sort(values.begin(), values.end());
      double sum = 0.0, squares = 0.0, positive = 0.0;
      for (const double v : values) sum += v, positive += v > 0.0 ? 1.0 : 0.0;
      const auto n = static_cast<double>(values.size());
      for (const double v : values) squares += (v - sum / n) * (v - sum / n);
      EXPECT_NEAR(cell_value(row.at("mean")), sum / n, 1e-5);
      EXPECT_NEAR(cell_value(row.at("standard_deviation")), values.size() > 1 ? std::sqrt(squares / (n - 1)) : 0.0,
                  1e-5);
      EXPECT_NEAR(cell_value(row.at("minimum")), values.front(), 1e-6);
      EXPECT_NEAR(cell_value(row.at("maximum")), values.back(), 1e-6);
      const auto half = values.size() / 2;
      const double median = values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
      EXPECT_NEAR(cell_value(row.at("median")), median, 1e-6);
      EXPECT_NEAR(cell_value(row.at("positive")), positive / n, 1e-5);
      EXPECT_LE(cell_value(row.at("mean_low")), cell_value(row.at("mean")) + 1e-6);
      EXPECT_GE(cell_value(row.at("mean_high")), cell_value(row.at("mean")) - 1e-6);
    }
  }
  // The pairs of a row of comparisons: runs of both values with the same seed in the same world.
  struct Pair {
    std::size_t first = 0, second = 0, world = 0;  // indices of runs; a number per r and q
  };
  [[nodiscard]] std::vector<Pair> pairs_of_row(const TableRow& row) const {
    std::vector<Pair> pairs;
    std::map<std::string, std::size_t> worlds;
    for (const auto& a : plan_.rows) {
      for (const auto& b : plan_.rows) {
        if (a.part != b.part || a.seed != b.seed || label(a, "r") != label(b, "r") || label(a, "q") != label(b, "q"))
          continue;
        if (label(a, "way") != row.at("first") || label(b, "way") != row.at("second")) continue;
        if (!there(a) || !there(b) || !in_group(a, row, true)) continue;
        const auto world = worlds.emplace(label(a, "r") + "/" + label(a, "q"), worlds.size()).first->second;
        pairs.push_back({a.run, b.run, world});
      }
    }
    return pairs;
  }
  static void expect_cells(const TableRow& row, const std::vector<std::pair<const char*, double>>& cells) {
    for (const auto& [name, value] : cells) {
      if (std::isnan(value)) EXPECT_EQ(row.at(name), "") << name;
      else EXPECT_NEAR(cell_value(row.at(name)), value, 1e-5 * (1.0 + std::abs(value))) << name;
    }
  }
  static void expect_bounds(const TableRow& row, const char* low, const char* high, const Interval& interval) {
    EXPECT_EQ(std::isnan(interval.low), row.at(low).empty());
    if (std::isnan(interval.low)) return;
    if (std::isinf(interval.low)) {
      EXPECT_EQ(row.at(low), "-inf");
      EXPECT_EQ(row.at(high), "inf");
      return;
    }
    expect_cells(row, {{low, interval.low}, {high, interval.high}});
  }
  static void check_shares(const TableRow& row, const std::vector<Pair>& pairs) {
    PairedShares test{pairs.size(), 0, 0};
    for (const auto& pair : pairs) {
      test.first_only += complete(pair.first) && !complete(pair.second) ? 1 : 0;
      test.second_only += !complete(pair.first) && complete(pair.second) ? 1 : 0;
    }
    EXPECT_EQ(row.at("test"), "mcnemar");
    EXPECT_EQ(row.at("ranked"), std::to_string(pairs.size()));
    EXPECT_EQ(row.at("first_missed") + row.at("both_missed") + row.at("misses") + row.at("p_missed"), "");
    expect_bounds(row, "shift_low", "shift_high", test.interval(1.0 - 0.95));
    if (pairs.empty()) return;
    expect_cells(row, {{"shift", test.difference()}, {"p", test.p()}, {"effect", test.effect()}, {"margin", 0.05}});
  }
  static void check_ranks(const TableRow& row, const std::vector<Pair>& pairs) {
    PairedValues ranked;
    PairedShares misses{pairs.size(), 0, 0};
    std::size_t both = 0;
    double sum = 0.0;
    for (const auto& [first, second, world] : pairs) {
      sum += (complete(first) ? time_of(first) : 1.0) - (complete(second) ? time_of(second) : 1.0);
      misses.first_only += !complete(first) && complete(second) ? 1 : 0;
      misses.second_only += complete(first) && !complete(second) ? 1 : 0;
      both += !complete(first) && !complete(second) ? 1 : 0;
      if (!complete(first) || !complete(second)) continue;
      ranked.first.push_back(time_of(first));
      ranked.second.push_back(time_of(second));
      ranked.stratum.push_back(world);
    }
    const SignedRank test(ranked);
    EXPECT_EQ(row.at("test"), "signed rank");
    EXPECT_EQ(row.at("ranked"), std::to_string(test.pairs()));
    EXPECT_EQ(row.at("first_missed"), std::to_string(misses.first_only + both));
    EXPECT_EQ(row.at("second_missed"), std::to_string(misses.second_only + both));
    EXPECT_EQ(row.at("both_missed"), std::to_string(both));
    EXPECT_EQ(row.at("first_larger"), std::to_string(test.first_larger()));
    EXPECT_EQ(row.at("second_larger"), std::to_string(test.second_larger()));
    expect_bounds(row, "shift_low", "shift_high", test.interval(1.0 - 0.95));
    std::sort(ranked.second.begin(), ranked.second.end());
    const double median = quantile(ranked.second, 0.5);
    const double none = std::nan("");
    expect_cells(row, {{"shift", test.shift()},
                       {"effect", test.effect()},
                       {"second_median", median},
                       {"margin", 0.05 * median},
                       {"p", test.pairs() > 0 ? test.p() : none},
                       {"p_missed", pairs.empty() ? none : misses.p()},
                       {"mean_difference", pairs.empty() ? none : sum / static_cast<double>(pairs.size())}});
    if (pairs.empty()) return;
    EXPECT_LE(cell_value(row.at("mean_low")), cell_value(row.at("mean_difference")) + 1e-6);
    EXPECT_GE(cell_value(row.at("mean_high")), cell_value(row.at("mean_difference")) - 1e-6);
  }
  void check_comparisons() const {
    for (const auto& row : comparisons()) {
      const auto pairs = pairs_of_row(row);
      EXPECT_EQ(row.at("way"), "*");
      ASSERT_EQ(row.at("pairs"), std::to_string(pairs.size()));
      if (row.at("metric") == "complete") check_shares(row, pairs);
      else check_ranks(row, pairs);
      if (pairs.empty()) {
        for (const char* cell : {"verdict", "misses", "first_median", "shift", "shift_low", "p", "p_holm", "holm_low"})
          EXPECT_EQ(row.at(cell), "") << cell;
      }
    }
  }
};

TEST_F(ReportTest, GroupsAreThoseAskedForOnce) {
  const auto rows = statistics();
  const auto count = [&](const TableRow& wanted) { return picked(rows, wanted).size(); };
  const std::string metric = "complete";
  EXPECT_EQ(count({{"part", "big"}, {"metric", metric}}), 3U * 2 * 2 + 2 + 3 * 2 + 3 + 1);
  EXPECT_EQ(count({{"part", "small"}, {"metric", metric}}), 3U + 1) << "by algorithm, and all";
  EXPECT_EQ(count({{"part", "big"}, {"way", "*"}, {"r", "*"}, {"q", "*"}, {"metric", metric}}), 1U);
  EXPECT_EQ(count({{"part", "small"}, {"r", ""}, {"metric", metric}}), 4U) << "an axis that a part has not";
  // In the order of the file: 1.5 before 1.
  const auto by_r = picked(rows, {{"part", "big"}, {"way", "*"}, {"q", "*"}, {"metric", metric}});
  EXPECT_EQ(by_r.at(0).at("r"), "1.5");
  EXPECT_EQ(by_r.at(1).at("r"), "1");
}

TEST_F(ReportTest, StatisticsAreOfTheRunsOfTheirGroup) { check_statistics(); }

TEST_F(ReportTest, ComparisonsPairBySeedAndPooledAxes) { check_comparisons(); }

TEST_F(ReportTest, MissingAndFailedRunsAreNotCounted) {
  for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
    if (i % 5 == 1) outcomes_[plan_.runs[i].id] = {"", "failed", 1.0};
    if (i % 7 == 3) outcomes_.erase(plan_.runs[i].id);
  }
  check_statistics();
  check_comparisons();
}

TEST_F(ReportTest, AGroupOfWhichAllFailedHasNoNumbers) {
  for (const auto& row : plan_.rows)
    if (label(row, "way") == "inwards") outcomes_[plan_.runs[row.run].id] = {"", "failed", 1.0};
  check_statistics();
  check_comparisons();
  EXPECT_FALSE(picked(comparisons(), {{"pairs", "0"}, {"p_holm", ""}}).empty());
}

TEST_F(ReportTest, NoTestIsMadeTwice) {
  // [r] and [algorithm, r] differ in the compared axis alone, and so do [algorithm] and [].
  auto rows = comparisons();
  for (auto& row : rows)
    EXPECT_EQ(picked(rows, {{"part", row["part"]},
                            {"r", row["r"]},
                            {"q", row["q"]},
                            {"metric", row["metric"]},
                            {"first", row["first"]},
                            {"second", row["second"]}})
                  .size(),
              1U);
  EXPECT_EQ(picked(rows, {{"part", "big"}}).size(), (4U + 2 + 1) * 2 * 3);
  EXPECT_EQ(picked(rows, {{"part", "small"}}).size(), 1U * 2 * 3);
}

TEST_F(ReportTest, ComparedAgainstSomeItIsTheSecond) {
  prepare("against = [\"inwards\"]\n");
  check_comparisons();
  std::map<std::pair<std::string, std::string>, std::size_t> pairs;
  for (const auto& row : comparisons()) ++pairs[{row.at("first"), row.at("second")}];
  const std::size_t each = (4 + 1) * std::size_t{2};  // worlds of both parts, metrics
  EXPECT_EQ(pairs, (decltype(pairs){{{"outwards", "inwards"}, each}, {{"tuned", "inwards"}, each}}));
}

// A family is one metric and two values in one grouping of one part: which axes are pooled tells the grouping.
TEST_F(ReportTest, HolmCorrectsTheTestsOfOneClaim) {
  std::map<std::string, std::vector<TableRow>> families;
  for (const TableRow& row : comparisons()) {
    const auto pooled = [&](const char* axis) { return row.at(axis) == "*" ? "*" : "."; };
    families[row.at("part") + row.at("metric") + row.at("first") + row.at("second") + pooled("r") + pooled("q")]
        .push_back(row);
  }
  EXPECT_EQ(families.size(), 2U * 3U * (3U + 1U)) << "big by r and q, by r, by nothing; small";
  for (auto& [name, rows] : families) {
    std::sort(rows.begin(), rows.end(),
              [](const TableRow& x, const TableRow& y) { return cell_value(x.at("p")) < cell_value(y.at("p")); });
    double least = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      least = std::max(least, std::min(1.0, static_cast<double>(rows.size() - i) * cell_value(rows[i].at("p"))));
      EXPECT_NEAR(cell_value(rows[i].at("p_holm")), least, 1e-3) << name;
    }
  }
}

// Times that differ by a world, by a way and by chance, so that there is something to find; of every other seed less.
class ClearReport : public ReportTest {
 protected:
  void SetUp() override {
    ReportTest::SetUp();
    for (const auto& row : plan_.rows) {
      const std::string way = label(row, "way");
      double time = label(row, "r") == "1" ? 0.3 : 0.5;
      if (way == "inwards") time += 0.002 * static_cast<double>(row.seed % 3 + 1);
      if (way == "tuned") time -= 0.2 + 0.01 * static_cast<double>(row.run % 7);
      const bool missed = way == "inwards" && label(row, "r") == "1.5" && row.seed != 7;
      set(plan_.runs[row.run], missed ? 1.0 : time, !missed);
    }
  }
  [[nodiscard]] TableRow comparison(const std::string& first, const std::string& second, const std::string& r) const {
    return picked(comparisons(), {{"part", "big"},
                                  {"metric", "normalized_time"},
                                  {"r", r},
                                  {"q", "*"},
                                  {"first", first},
                                  {"second", second}})
        .at(0);
  }
};

TEST_F(ClearReport, VerdictsSayWhatTheIntervalsShow) {
  EXPECT_EQ(comparison("outwards", "tuned", "1").at("verdict"), "slower");
  EXPECT_EQ(comparison("outwards", "inwards", "1").at("verdict"), "faster (within margin)") << "by 2 to 6 of 300";
  study_.statistics.margin = 0.005;
  EXPECT_EQ(comparison("outwards", "inwards", "1").at("verdict"), "faster");
  EXPECT_EQ(comparison("outwards", "inwards", "1").at("misses"), "undecided") << "none in 14 pairs says little";
  // Of the pairs at 1.5 two are left, of seed 7: too few for any verdict.
  const TableRow few = comparison("outwards", "inwards", "1.5");
  EXPECT_EQ(few.at("verdict"), "undecided");
  EXPECT_EQ(few.at("shift_low"), "-inf");
  EXPECT_EQ(few.at("ranked"), "2");
  EXPECT_EQ(few.at("first_missed"), "0");
  EXPECT_EQ(few.at("second_missed"), "12");
  EXPECT_EQ(few.at("misses"), "fewer");
  EXPECT_LT(cell_value(few.at("mean_high")), 0.0) << "a miss counts with the limit in the restricted mean";
}

// The interval beside p_holm is at the level of Holm's step, that beside p at the study's.
TEST_F(ClearReport, NoIntervalContradictsItsP) {
  std::size_t significant = 0, not_after_holm = 0;
  for (const std::size_t seeds : {0U, 1U, 2U, 3U}) {
    for (const auto& row : plan_.rows)  // from nothing to much noise
      set(plan_.runs[row.run],
          0.4 + (label(row, "way") == "tuned" ? 0.02 : 0.0) +
              0.08 * static_cast<double>(seeds) * (time_of(row.run) - 0.5),
          true);
    for (const TableRow& row : comparisons()) {
      if (row.at("metric") == "complete" || row.at("p").empty()) continue;
      const auto excludes = [&](const char* low, const char* high) {
        return cell_value(row.at(low)) > 0.0 || cell_value(row.at(high)) < 0.0;
      };
      EXPECT_EQ(excludes("shift_low", "shift_high"), cell_value(row.at("p")) < 0.05);
      EXPECT_EQ(excludes("holm_low", "holm_high"), cell_value(row.at("p_holm")) < 0.05);
      significant += excludes("shift_low", "shift_high") ? 1 : 0;
      not_after_holm += excludes("shift_low", "shift_high") && !excludes("holm_low", "holm_high") ? 1 : 0;
    }
  }
  EXPECT_GT(significant, 10U);
  EXPECT_GT(not_after_holm, 0U);
}

TEST_F(ReportTest, WithoutTheComparedAxisThereIsNothingToCompare) {
  study_.statistics.compare = "r";
  for (const auto& row : comparisons()) EXPECT_EQ(row.at("part"), "big");
  study_.statistics.compare = "none";
  EXPECT_TRUE(comparisons().empty());
  EXPECT_FALSE(comparisons_csv(study_, results()).empty()) << "a header all the same";
}

}  // namespace
}  // namespace banyan::study
