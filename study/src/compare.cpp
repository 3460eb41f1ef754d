// SPDX-License-Identifier: MIT
#include "banyan/study/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "banyan/record/table.hpp"
#include "banyan/study/report.hpp"
#include "groups.hpp"
#include "misses.hpp"

namespace banyan::study {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

using RowIndices = std::vector<std::size_t>;
using Paired = std::vector<std::pair<std::size_t, std::size_t>>;  // two rows

double median_of_values(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return quantile(values, 0.5);
}

// What is tested of a comparison, until its family is complete.
struct Tests {
  SignedRank ranks{{}};
  PairedShares shares, misses;
};

class Comparing {
 public:
  Comparing(const Study& study, const Results& results, const std::vector<std::string>& metrics)
      : study_(study), results_(results), alpha_(1.0 - study.statistics.confidence) {
    for (const auto& metric : metrics) columns_.push_back(metric_column(results, metric));
  }

  void part(std::size_t p, const std::vector<std::vector<std::string>>& groupings) {
    const Part& part = study_.parts[p];
    const auto axis = std::find_if(part.axes.begin(), part.axes.end(),
                                   [&](const Axis& a) { return a.name == study_.statistics.compare; });
    if (axis == part.axes.end()) return;
    compared_ = static_cast<std::size_t>(axis - part.axes.begin());
    std::set<std::vector<std::string>> done;  // groupings that differ in the compared axis alone are one
    for (auto by : groupings) {
      std::erase(by, axis->name);
      if (!done.insert(by).second) continue;
      std::map<GroupKey, std::vector<RowIndices>> groups;  // rows by value of the compared axis
      for (const std::size_t row : rows_of(results_, p)) {
        auto key = key_of(part, results_.planned(row), by);
        key[compared_] = any_value;
        auto& sides = groups[key];
        sides.resize(axis->values.size());
        sides[results_.planned(row).values[compared_]].push_back(row);
      }
      for (const auto& [key, sides] : groups) group(p, done.size(), key, sides);
    }
  }

  std::vector<Comparison> finish() {
    judge_families();
    return std::move(comparisons_);
  }

 private:
  void group(std::size_t p, std::size_t grouping, const GroupKey& key, const std::vector<RowIndices>& sides) {
    const Axis& axis = study_.parts[p].axes[compared_];
    for (const auto& column : columns_) {
      for (const auto& [first, second] : two_by_two(axis)) {
        Comparison c;
        c.part = p;
        c.group = key;
        c.grouping = grouping;
        c.metric = column.name;
        c.first = axis.values[first].label;
        c.second = axis.values[second].label;
        c.boolean = column.boolean;
        c.can_miss = column.can_miss;
        fill(c, column, pair_up(column, sides[first], sides[second]));
      }
    }
  }

  // Each value with all that come after it; or with those that the study compares against, as the second.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> two_by_two(const Axis& axis) const {
    const auto& against = study_.statistics.against;
    const auto is_named = [&](std::size_t i) {
      return std::find(against.begin(), against.end(), axis.values[i].label) != against.end();
    };
    std::vector<std::pair<std::size_t, std::size_t>> list;
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
      for (std::size_t j = i + 1; j < axis.values.size(); ++j) {
        if (against.empty() || is_named(j)) list.emplace_back(i, j);
        else if (is_named(i)) list.emplace_back(j, i);
      }
    }
    return list;
  }

  // What two runs of a pair have in common: the world, which is the values of all other axes, and the seed.
  [[nodiscard]] std::vector<std::size_t> world_of(std::size_t row) const {
    auto values = results_.planned(row).values;
    values[compared_] = 0;
    return values;
  }

  [[nodiscard]] Paired pair_up(const MetricColumn& column, const RowIndices& first, const RowIndices& second) const {
    const auto there = [&](std::size_t row) { return column.missed[row] != 0 || std::isfinite(column.value[row]); };
    const auto identity = [&](std::size_t row) { return std::pair{world_of(row), results_.planned(row).seed}; };
    std::map<std::pair<std::vector<std::size_t>, std::uint64_t>, std::size_t> partner;
    for (const std::size_t row : second) {
      if (there(row)) partner.emplace(identity(row), row);
    }
    Paired pairs;
    for (const std::size_t row : first) {
      const auto found = there(row) ? partner.find(identity(row)) : partner.end();
      if (found != partner.end()) pairs.emplace_back(row, found->second);
    }
    return pairs;
  }

  void fill(Comparison& c, const MetricColumn& column, const Paired& pairs) {
    Tests tests;
    PairedValues ranked;
    std::map<std::vector<std::size_t>, std::size_t> worlds;
    std::vector<double> first, second, differences;
    for (const auto& [a, b] : pairs) {
      const bool first_missed = column.missed[a] != 0, second_missed = column.missed[b] != 0;
      c.first_missed += first_missed ? 1 : 0;
      c.second_missed += second_missed ? 1 : 0;
      c.both_missed += first_missed && second_missed ? 1 : 0;
      first.push_back(column.restricted[a]);
      second.push_back(column.restricted[b]);
      differences.push_back(first.back() - second.back());
      if (first_missed || second_missed) continue;
      ranked.first.push_back(column.value[a]);
      ranked.second.push_back(column.value[b]);
      ranked.stratum.push_back(worlds.emplace(world_of(a), worlds.size()).first->second);
      tests.shares.first_only += column.value[a] > column.value[b] ? 1 : 0;
      tests.shares.second_only += column.value[a] < column.value[b] ? 1 : 0;
    }
    c.pairs = pairs.size();
    c.ranked = tests.shares.pairs = ranked.first.size();
    tests.misses = {c.pairs, c.first_missed - c.both_missed, c.second_missed - c.both_missed};
    c.first_median = c.boolean ? unknown : median_of_values(ranked.first);
    c.second_median = c.boolean ? unknown : median_of_values(ranked.second);
    means(c, first, second, differences);
    if (!c.boolean) tests.ranks = SignedRank(ranked);
    comparisons_.push_back(std::move(c));
    tests_.push_back(std::move(tests));
  }

  void means(Comparison& c, const std::vector<double>& first, const std::vector<double>& second,
             const std::vector<double>& differences) const {
    c.first_mean = c.second_mean = c.mean_difference = unknown;
    c.mean_interval = {unknown, unknown};
    const auto finite = [](double value) { return std::isfinite(value); };
    if (!std::all_of(differences.begin(), differences.end(), finite)) return;
    const auto mean = [&](const std::vector<double>& values) {
      return summarize(values, {study_.statistics.confidence, 0, 1}).mean;
    };
    c.first_mean = mean(first);
    c.second_mean = mean(second);
    const std::size_t resamples = c.can_miss ? study_.statistics.resamples : 0;
    const auto summary = summarize(differences, {study_.statistics.confidence, resamples, 1});
    c.mean_difference = summary.mean;
    c.mean_interval = summary.mean_interval;
  }

  // Tests of one claim: two values, a metric, all groups of one grouping of one part.
  void judge_families() {
    using Claim = std::tuple<std::size_t, std::size_t, std::string, std::string, std::string>;
    std::map<Claim, RowIndices> families;
    for (std::size_t i = 0; i < comparisons_.size(); ++i) {
      const auto& c = comparisons_[i];
      families[{c.part, c.grouping, c.metric, c.first, c.second}].push_back(i);
    }
    for (const auto& [claim, members] : families) {
      const auto& [metric, boolean] =
          std::pair{comparisons_[members.front()].metric, comparisons_[members.front()].boolean};
      if (boolean) {
        judge_family(members, &Comparison::test,
                     [&](std::size_t i) -> const PairedShares& { return tests_[i].shares; });
      } else {
        judge_family(members, &Comparison::test, [&](std::size_t i) -> const SignedRank& { return tests_[i].ranks; });
      }
      judge_family(members, &Comparison::misses,
                   [&](std::size_t i) -> const PairedShares& { return tests_[i].misses; });
    }
  }

  static std::size_t size_of(const SignedRank& test) noexcept { return test.pairs(); }
  static std::size_t size_of(const PairedShares& test) noexcept { return test.pairs; }

  static void describe(const SignedRank& test, Judged& judged, double baseline, double margin) {
    judged.estimate = test.shift();
    judged.first_larger = test.first_larger();
    judged.second_larger = test.second_larger();
    judged.margin = margin * std::abs(baseline);
  }
  static void describe(const PairedShares& test, Judged& judged, double, double margin) {
    judged.estimate = test.difference();
    judged.first_larger = test.first_only;
    judged.second_larger = test.second_only;
    judged.margin = margin;
  }

  template <class TestOf>
  void judge_family(const RowIndices& members, Judged Comparison::*which, const TestOf& test_of) {
    std::vector<double> p;
    for (const std::size_t i : members) {
      const auto& test = test_of(i);
      p.push_back(size_of(test) > 0 ? test.p() : unknown);
    }
    const auto adjusted = holm(p), levels = holm_levels(p, alpha_);
    for (std::size_t k = 0; k < members.size(); ++k) {
      Comparison& c = comparisons_[members[k]];
      Judged& judged = c.*which;
      const auto& test = test_of(members[k]);
      describe(test, judged, c.second_median, study_.statistics.margin);
      judged.p = p[k];
      judged.p_holm = adjusted[k];
      judged.effect = test.effect();
      judged.interval = test.interval(alpha_);
      judged.holm_interval = test.interval(levels[k]);
      judged.verdict = judge(judged.holm_interval, judged.margin);
      // Where all pairs are equal no margin is needed: one of a median of 0 would be 0.
      const bool equal = judged.first_larger + judged.second_larger == 0 && judged.holm_interval.low == 0.0;
      if (equal && judged.holm_interval.high == 0.0) judged.verdict = Verdict::no_difference;
    }
  }

  const Study& study_;
  const Results& results_;
  double alpha_;
  std::size_t compared_ = 0;  // index of the axis in the part
  std::vector<MetricColumn> columns_;
  std::vector<Comparison> comparisons_;
  std::vector<Tests> tests_;  // of these
};

std::string within(const std::string& word, Verdict verdict) {
  return verdict == Verdict::lower_within || verdict == Verdict::higher_within ? word + " (within margin)" : word;
}

std::string worded(Verdict verdict, const char* lower, const char* higher) {
  switch (verdict) {
    case Verdict::no_difference: return "no difference";
    case Verdict::lower:
    case Verdict::lower_within: return within(lower, verdict);
    case Verdict::higher:
    case Verdict::higher_within: return within(higher, verdict);
    case Verdict::undecided: break;
  }
  return "undecided";
}

std::string interval_cells(const Interval& interval) { return shown(interval.low) + "," + shown(interval.high); }

std::string comparison_cells(const Comparison& c) {
  const auto count = [](std::size_t number) { return std::to_string(number); };
  std::string text =
      (c.ranked > 0 ? verdict_text(c) : "") + "," + (c.pairs > 0 ? misses_text(c) : "") + "," + count(c.pairs) + ",";
  text += c.can_miss ? count(c.first_missed) + "," + count(c.second_missed) + "," + count(c.both_missed) : ",,";
  text += "," + count(c.ranked) + "," + shown(c.first_median) + "," + shown(c.second_median) + "," +
          shown(c.test.estimate) + "," + interval_cells(c.test.interval) + "," + shown(c.test.p) + "," +
          interval_cells(c.test.holm_interval) + "," + shown(c.test.p_holm) + "," + shown(c.test.margin) + "," +
          shown(c.test.effect) + "," + count(c.test.first_larger) + "," + count(c.test.second_larger);
  text += "," + shown(c.first_mean) + "," + shown(c.second_mean) + "," + shown(c.mean_difference) + "," +
          interval_cells(c.mean_interval);
  text += c.can_miss ? "," + shown(c.misses.p) + "," + shown(c.misses.p_holm) : ",,";
  return text + "," + (c.boolean ? "mcnemar" : "signed rank");
}

}  // namespace

std::vector<Comparison> compare(const Study& study, const Results& results) {
  Comparing comparing(study, results, study.statistics.metrics);
  for (std::size_t p = 0; p < study.parts.size(); ++p) comparing.part(p, groupings(study, study.parts[p]));
  return comparing.finish();
}

std::vector<Comparison> compare_pooled(const Study& study, const Results& results,
                                       const std::vector<std::string>& metrics) {
  Comparing comparing(study, results, metrics);
  for (std::size_t p = 0; p < study.parts.size(); ++p) comparing.part(p, {{}});
  return comparing.finish();
}

std::string verdict_text(const Comparison& c) {
  if (c.boolean) return worded(c.test.verdict, "less often", "more often");
  return is_time(c.metric) ? worded(c.test.verdict, "faster", "slower") : worded(c.test.verdict, "lower", "higher");
}

std::string misses_text(const Comparison& c) { return c.can_miss ? worded(c.misses.verdict, "fewer", "more") : ""; }

std::string comparisons_csv(const Study& study, const Results& results) {
  std::string text =
      group_header(results) +
      ",metric,first,second,verdict,misses,pairs,first_missed,second_missed,both_missed,ranked,first_median,"
      "second_median,shift,shift_low,shift_high,p,holm_low,holm_high,p_holm,margin,effect,first_larger,second_larger,"
      "first_mean,second_mean,mean_difference,mean_low,mean_high,p_missed,p_missed_holm,test\n";
  for (const auto& c : compare(study, results)) {
    text += group_cells(study, results, c.part, c.group) + "," + c.metric + "," + record::csv_quoted(c.first) + "," +
            record::csv_quoted(c.second) + "," + comparison_cells(c) + "\n";
  }
  return text;
}

}  // namespace banyan::study
