// SPDX-License-Identifier: MIT
#include "banyan/study/report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "banyan/config/document.hpp"
#include "banyan/record/table.hpp"
#include "banyan/study/figure.hpp"
#include "banyan/study/statistics.hpp"
#include "figure/illustrator.hpp"
#include "file_text.hpp"
#include "groups.hpp"

namespace banyan::study {
namespace {

SummaryOptions options_of(const StatisticsPlan& plan) { return {plan.confidence, plan.resamples, 1}; }

std::vector<double> finite(const Values& values, const std::vector<std::size_t>& rows) {
  std::vector<double> list;
  for (const std::size_t row : rows) {
    if (std::isfinite(values[row])) list.push_back(values[row]);
  }
  return list;
}

std::string summary_cells(const Summary& s, std::size_t planned) {
  std::string text = std::to_string(s.count) + "," + std::to_string(planned - s.count);
  for (const double value : {s.mean, s.standard_deviation, s.mean_interval.low, s.mean_interval.high, s.minimum,
                             s.lower_quartile, s.median, s.upper_quartile, s.maximum, s.median_interval.low,
                             s.median_interval.high, s.positive, s.positive_interval.low, s.positive_interval.high})
    text += "," + shown(value);
  return text;
}

// Different labels may look the same in a file name.
std::string file_name(const FigurePlan& plan, const std::vector<std::string>& each, std::set<std::string>& taken) {
  std::string name = plan.name;
  for (std::size_t i = 0; i < each.size(); ++i) name += "-" + plan.each[i] + "-" + file_text(each[i]);
  name = name.substr(0, 200);
  std::string unique = name;
  for (int n = 2; !taken.insert(unique).second; ++n) unique = name + "-" + std::to_string(n);
  return unique;
}

}  // namespace

std::string statistics_csv(const Study& study, const Results& results) {
  std::string text = group_header(results) +
                     ",metric,runs,missing,mean,standard_deviation,mean_low,mean_high,minimum,lower_quartile,median,"
                     "upper_quartile,maximum,median_low,median_high,positive,positive_low,positive_high\n";
  std::vector<Values> values;
  for (const auto& metric : study.statistics.metrics) values.push_back(results.values(metric));
  for (std::size_t p = 0; p < study.parts.size(); ++p) {
    const auto rows = rows_of(results, p);
    for (const auto& by : groupings(study, study.parts[p])) {
      std::map<GroupKey, std::size_t> planned;  // also of groups without runs
      for (const auto& row : results.plan().rows) {
        if (row.part == p) ++planned[key_of(study.parts[p], row, by)];
      }
      std::map<GroupKey, std::vector<std::size_t>> groups;
      for (const std::size_t row : rows) groups[key_of(study.parts[p], results.planned(row), by)].push_back(row);
      for (const auto& [key, count] : planned) {
        for (std::size_t m = 0; m < values.size(); ++m) {
          const auto summary = summarize(finite(values[m], groups[key]), options_of(study.statistics));
          text += group_cells(study, results, p, key) + "," + study.statistics.metrics[m] + "," +
                  summary_cells(summary, count) + "\n";
        }
      }
    }
  }
  return text;
}

Drawn draw_figures(const Study& study, const Results& results, const std::string& folder, const Drawer& drawer) {
  Drawn drawn;
  std::set<std::string> taken;
  for (const auto& plan : study.figures) {
    const auto part =
        std::find_if(study.parts.begin(), study.parts.end(), [&](const Part& p) { return p.name == plan.part; });
    for (const auto& each : combinations(*part, plan.each, plan.where)) {
      const std::string name = file_name(plan, each, taken);
      const BoxFigure figure = figure_of(study, results, plan, each);
      (figure.panels.empty() ? drawn.empty : drawn.figures).push_back(name);
      if (!figure.panels.empty())
        record::write_file(folder + "/" + name + ".json", figure_json(figure), record::Existing::replace);
    }
  }
  if (!drawn.figures.empty()) drawn.complaint = draw_folder(drawer, folder);
  return drawn;
}

}  // namespace banyan::study
