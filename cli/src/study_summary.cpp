// SPDX-License-Identifier: MIT
#include "study_summary.hpp"

#include <algorithm>
#include <cmath>

#include "banyan/study/compare.hpp"
#include "banyan/study/statistics.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

using namespace study;

// Sorted, without what is not there.
std::vector<double> values_of(const Values& all, const std::vector<std::size_t>& rows) {
  std::vector<double> values;
  for (const auto row : rows) {
    if (std::isfinite(all[row])) values.push_back(all[row]);
  }
  std::sort(values.begin(), values.end());
  return values;
}

// "98.3 %", "-" for no runs.
std::string share_above_zero(const std::vector<double>& values) {
  if (values.empty()) return "-";
  const auto count = std::count_if(values.begin(), values.end(), [](double v) { return v > 0.0; });
  return format("%.1f %%", 100.0 * static_cast<double>(count) / static_cast<double>(values.size()));
}

std::string row_text(const Results& results, const std::string& name, const std::vector<std::size_t>& rows) {
  const auto time = values_of(results.values("normalized_time"), rows);
  const auto share = [&](const char* column) { return share_above_zero(values_of(results.values(column), rows)); };
  std::string text =
      format("  %-32s %8zu %11s %13s %13s %11s", name.empty() ? "all" : name.substr(0, 32).c_str(), time.size(),
             share("complete").c_str(), time.empty() ? "-" : format("%.3f", quantile(time, 0.5)).c_str(),
             share("broken_ticks").c_str(), share("split_ticks").c_str());
  if (time.size() < rows.size()) text += format("  + %zu failed", rows.size() - time.size());
  return text + "\n";
}

std::string number_text(double value) {
  if (std::isinf(value)) return value < 0.0 ? "-inf" : "inf";
  return format("%+.*f", std::abs(value) < 10.0 ? 3 : 1, value);
}

std::string p_text(double p) { return p < 0.001 ? "< 0.001" : format("%.3f", p); }

std::string comparison_text(const Study& study, const Comparison& c) {
  const std::string part = study.parts[c.part].name;
  const std::string name = (part.empty() ? "" : part + ", ") + c.first + " - " + c.second;
  const std::string interval = number_text(c.test.interval.low) + " to " + number_text(c.test.interval.high);
  const std::string misses = format("%zu : %zu", c.first_missed, c.second_missed);
  std::string text =
      format("  %-38s %6zu %8s  %-18s %8s %11s  ", name.substr(0, 38).c_str(), c.ranked,
             number_text(c.test.estimate).c_str(), interval.c_str(), p_text(c.test.p).c_str(), misses.c_str()) +
      verdict_text(c);
  if (c.first_missed + c.second_missed > 0) text += "; misses: " + misses_text(c);
  return text + "\n";
}

// The time of every two values of the compared axis, all worlds of a part together.
std::string comparisons_text(const Study& study, const Results& results) {
  std::string rows;
  for (const auto& c : compare_pooled(study, results, {"normalized_time"}))
    if (c.pairs > 0) rows += comparison_text(study, c);
  if (rows.empty()) return rows;
  const std::string interval = format("%g %% interval", 100.0 * study.statistics.confidence);
  return format("\n  %-38s %6s %8s  %-18s %8s %11s  %s\n", "time / limit, first - second", "pairs", "shift",
                interval.c_str(), "p", "missed", "the first is") +
         rows +
         format(
             "  (signed ranks of the pairs that both complete, within each world; no difference: within %g %% of\n"
             "  the second's median. Every group of runs, corrected for their number: comparisons.csv)\n",
             100.0 * study.statistics.margin);
}

}  // namespace

std::string study_summary(const Study& study, const Results& results, const Folder& folder, const Drawn& drawn) {
  std::string text =
      format("\n  %-32s %8s %11s %13s %13s %11s\n", "", "runs", "complete", "median time", "edge broken", "net split");
  for (std::size_t p = 0; p < study.parts.size(); ++p) {
    const auto& part = study.parts[p];
    std::vector<std::string> labels;
    for (const auto& axis : part.axes) {
      if (axis.name != study.statistics.compare) continue;
      for (const auto& value : axis.values) labels.push_back(value.label);
    }
    if (labels.empty()) labels.emplace_back();
    for (const auto& label : labels) {
      std::vector<std::size_t> rows;
      for (std::size_t row = 0; row < results.rows(); ++row) {
        if (results.planned(row).part == p && (label.empty() || results.label(row, study.statistics.compare) == label))
          rows.push_back(row);
      }
      if (!rows.empty())
        text += row_text(results, part.name + (part.name.empty() || label.empty() ? "" : ", ") + label, rows);
    }
  }
  text += "  (time: completion / limit, 1 if never complete; the last two: share of runs with any such tick)\n";
  text += comparisons_text(study, results) + "\n";
  text +=
      "  table      " + folder.table() + "\n  statistics " + folder.statistics() + ", " + folder.comparisons() + "\n";
  if (!drawn.figures.empty())
    text += format("  figures    %zu in ", drawn.figures.size()) + folder.figures() +
            (drawn.complaint.empty() ? " (.svg, .pdf, .png)\n" : " (.json, to be drawn)\n");
  if (!drawn.empty.empty()) {
    text += "  not drawn, since no run has a value:";
    for (const auto& name : drawn.empty) text += " " + name;
    text += "\n";
  }
  return text;
}

}  // namespace banyan::cli
