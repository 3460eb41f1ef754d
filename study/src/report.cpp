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
#include "file_text.hpp"
#include "groups.hpp"

namespace banyan::study {
namespace {

using Labels = std::vector<std::string>;

SummaryOptions options_of(const StatisticsPlan& plan) { return {plan.confidence, plan.resamples, 1}; }

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

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

// ---------------------------------------------------------------------------------- figures --

const Axis* axis_of(const Part& part, const std::string& name) {
  for (const auto& axis : part.axes) {
    if (axis.name == name) return &axis;
  }
  return nullptr;
}

// Labels of an axis that `where` selects, in the order of the file; {""} for no axis.
Labels labels_of(const Part& part, const std::string& name, const Where& where) {
  const Axis* axis = axis_of(part, name);
  if (!axis) return {""};
  Labels labels;
  for (const auto& value : axis->values) {
    const auto picked = std::find_if(where.begin(), where.end(), [&](const auto& w) { return w.first == name; });
    if (picked == where.end() || contains(picked->second, value.label)) labels.push_back(value.label);
  }
  return labels;
}

// Every combination of labels of several axes, the last fastest.
std::vector<Labels> combinations(const Part& part, const std::vector<std::string>& names, const Where& where) {
  std::vector<Labels> list{{}};
  for (const auto& name : names) {
    std::vector<Labels> longer;
    for (const auto& start : list) {
      for (const auto& label : labels_of(part, name, where)) {
        longer.push_back(start);
        longer.back().push_back(label);
      }
    }
    list = std::move(longer);
  }
  return list;
}

// "reading = literal, line of sight = off"
std::string in_words(const Part& part, const std::vector<std::string>& names, const Labels& labels) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i > 0 ? ", " : "") + axis_of(part, names[i])->title + " = " + labels[i];
  return text;
}

class Illustrator {
 public:
  Illustrator(const Study& study, const Results& results, std::string folder)
      : study_(study), results_(results), folder_(std::move(folder)) {}

  Drawn draw_all() {
    for (const auto& plan : study_.figures) draw_plan(plan);
    return std::move(drawn_);
  }

 private:
  void draw_plan(const FigurePlan& plan) {
    for (std::size_t p = 0; p < study_.parts.size(); ++p) {
      if (study_.parts[p].name != plan.part) continue;
      for (const auto& each : combinations(study_.parts[p], plan.each, plan.where)) draw_one(plan, p, each);
    }
  }

  void draw_one(const FigurePlan& plan, std::size_t p, const Labels& each) {
    const Part& part = study_.parts[p];
    const auto groups = combinations(part, plan.x, plan.where);
    const auto panels = labels_of(part, plan.panels, plan.where);
    const auto series = labels_of(part, plan.series, plan.where);
    BoxFigure figure;
    figure.title = plan.title + (plan.title.empty() || each.empty() ? "" : ": ") + in_words(part, plan.each, each);
    figure.y_label = plan.y_title;
    figure.columns = std::min(plan.columns, panels.size());
    figure.y_minimum = plan.y_minimum;
    figure.y_maximum = plan.y_maximum;
    label_groups(part, plan, groups, figure);
    for (const auto& s : series) figure.series.push_back({s});
    const Axis* panel_axis = axis_of(part, plan.panels);
    for (const auto& label : panels) {
      Panel panel;
      if (panel_axis) panel.title = panel_axis->title + " = " + label;
      panel.values.assign(groups.size(), std::vector<std::vector<double>>(series.size()));
      figure.panels.push_back(std::move(panel));
    }
    fill(plan, p, each, {groups, panels, series}, figure);
    const std::string name = file_name(plan, each);
    try {
      draw(figure, folder_ + "/" + name);
      drawn_.figures.push_back(name);
    } catch (const FigureError& e) { drawn_.complaints.push_back(name + ": " + e.what()); }
  }

  // Different labels may look the same in a file name.
  std::string file_name(const FigurePlan& plan, const Labels& each) {
    std::string name = plan.name;
    for (std::size_t i = 0; i < each.size(); ++i) name += "-" + plan.each[i] + "-" + file_text(each[i]);
    name = name.substr(0, 200);
    std::string unique = name;
    for (int n = 2; !names_.insert(unique).second; ++n) unique = name + "-" + std::to_string(n);
    return unique;
  }

  static void label_groups(const Part& part, const FigurePlan& plan, const std::vector<Labels>& groups,
                           BoxFigure& figure) {
    if (plan.x.size() == 1) {
      figure.x_label = axis_of(part, plan.x.front())->title;
      for (const auto& g : groups) figure.groups.push_back(g.front());
      return;
    }
    for (const auto& g : groups) {
      std::string text;
      for (std::size_t i = 0; i < g.size(); ++i) text += (i > 0 ? ", " : "") + plan.x[i] + " " + g[i];
      figure.groups.push_back(text);
    }
  }

  struct Order {
    std::vector<Labels> groups;
    Labels panels, series;
  };
  void fill(const FigurePlan& plan, std::size_t p, const Labels& each, const Order& order, BoxFigure& figure) const {
    const auto values = results_.values(plan.metric);
    const auto index = [](const auto& list, const auto& item) {
      return static_cast<std::size_t>(std::find(list.begin(), list.end(), item) - list.begin());
    };
    for (std::size_t row = 0; row < results_.rows(); ++row) {
      if (results_.planned(row).part != p || !std::isfinite(values[row]) || !picked(plan, each, row)) continue;
      Labels group;
      for (const auto& axis : plan.x) group.push_back(results_.label(row, axis));
      const auto g = index(order.groups, group);
      const auto panel = plan.panels.empty() ? 0 : index(order.panels, results_.label(row, plan.panels));
      const auto s = plan.series.empty() ? 0 : index(order.series, results_.label(row, plan.series));
      figure.panels[panel].values[g][s].push_back(values[row]);
    }
  }

  [[nodiscard]] bool picked(const FigurePlan& plan, const Labels& each, std::size_t row) const {
    for (std::size_t i = 0; i < each.size(); ++i) {
      if (results_.label(row, plan.each[i]) != each[i]) return false;
    }
    return std::all_of(plan.where.begin(), plan.where.end(),
                       [&](const auto& w) { return contains(w.second, results_.label(row, w.first)); });
  }

  const Study& study_;
  const Results& results_;
  std::string folder_;
  std::set<std::string> names_;
  Drawn drawn_;
};

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

Drawn draw_figures(const Study& study, const Results& results, const std::string& folder) {
  return Illustrator(study, results, folder).draw_all();
}

}  // namespace banyan::study
