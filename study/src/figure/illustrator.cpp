// SPDX-License-Identifier: MIT
// From a study's results to the boxes of a figure (illustrator.hpp).
#include "illustrator.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "../misses.hpp"
#include "words.hpp"

namespace banyan::study {
namespace {

using Labels = std::vector<std::string>;

template <typename List, typename Item> std::size_t index_in(const List& list, const Item& item) {
  return static_cast<std::size_t>(std::find(list.begin(), list.end(), item) - list.begin());
}

std::size_t axis_index(const Part& part, const std::string& name) {
  return static_cast<std::size_t>(
      std::find_if(part.axes.begin(), part.axes.end(), [&](const Axis& a) { return a.name == name; }) -
      part.axes.begin());
}

const Axis* axis_of(const Part& part, const std::string& name) {
  const std::size_t index = axis_index(part, name);
  return index < part.axes.size() ? &part.axes[index] : nullptr;
}

// Labels of an axis that `where` selects, in the order of the file; {""} for no axis.
Labels labels_of(const Part& part, const std::string& name, const Where& where) {
  const Axis* axis = axis_of(part, name);
  if (!axis) return {""};
  Labels labels;
  for (const auto& value : axis->values) {
    const auto picked = std::find_if(where.begin(), where.end(), [&](const auto& w) { return w.first == name; });
    if (picked == where.end() || index_in(picked->second, value.label) < picked->second.size())
      labels.push_back(value.label);
  }
  return labels;
}

// ------------------------------------------------------------------------------------- colours --

// The algorithm that each value of an axis runs; none if a value runs several.
Labels algorithms_of(const Results& results, std::size_t part, std::size_t axis, std::size_t values) {
  std::vector<std::set<std::string>> found(values);
  const Plan& plan = results.plan();
  for (const PlannedRow& row : plan.rows) {
    if (row.part != part) continue;
    found[row.values[axis]].insert(plan.combinations[plan.runs[row.run].combination].scenario.mission.algorithm);
  }
  Labels names;
  for (const auto& one : found) {
    if (one.size() != 1) return {};
    names.push_back(*one.begin());
  }
  return names;
}

// The look of each value of an axis, whichever of them a figure shows. Where the axis is about algorithms, each has the
// colour of its place in the list of all algorithms, so that it is the same in all studies; several values of one
// algorithm are its variants. Elsewhere the colours are in the order of the values.
std::vector<Series> looks_of(const Study& study, const Results& results, std::size_t part, const std::string& name) {
  const std::size_t axis = axis_index(study.parts[part], name);
  if (axis == study.parts[part].axes.size()) return {Series{}};
  const auto& values = study.parts[part].axes[axis].values;
  std::vector<Series> looks;
  looks.reserve(values.size());
  for (const auto& value : values) looks.push_back({value.label, looks.size() % most_series, 0});
  const Labels algorithms = algorithms_of(results, part, axis, values.size());
  const std::set<std::string> different(algorithms.begin(), algorithms.end());
  if (different.size() < 2) return looks;
  std::map<std::string, std::size_t> seen;
  for (std::size_t v = 0; v < looks.size(); ++v) {
    looks[v].style = index_in(results.plan().algorithms, algorithms[v]) % most_series;
    looks[v].variant = seen[algorithms[v]]++ % most_variants;
  }
  return looks;
}

// --------------------------------------------------------------------------------------- boxes --

// Where a run's box is: [panel of a metric][group][series].
struct Places {
  std::vector<Labels> groups;
  Labels panels, series;
};

class Illustrator {
 public:
  Illustrator(const Study& study, const Results& results, const FigurePlan& plan, const Labels& each)
      : results_(results), plan_(plan), each_(each) {
    part_ = static_cast<std::size_t>(
        std::find_if(study.parts.begin(), study.parts.end(), [&](const Part& p) { return p.name == plan.part; }) -
        study.parts.begin());
    axes_ = &study.parts[part_];
    // Without an x axis each series is a group of its own, with its name below.
    x_ = plan.x.empty() && !plan.series.empty() ? Labels{plan.series} : plan.x;
    places_ = {combinations(*axes_, x_, plan.where), labels_of(*axes_, plan.panels, plan.where),
               labels_of(*axes_, plan.series, plan.where)};
    for (std::size_t row = 0; row < results.rows(); ++row) {
      if (results.planned(row).part != part_ || !where(row)) continue;
      for (const std::string& axis : plan.each) drawn_[axis].insert(results.label(row, axis));
      if (of_each(row)) rows_.push_back(row);
    }
    looks_ = looks_of(study, results, part_, plan.series);
    confidence_ = study.statistics.confidence;
  }

  BoxFigure figure() {
    BoxFigure figure;
    figure.title = each_in_words();
    if (!plan_.title.empty()) figure.title = plan_.title + (figure.title.empty() ? "" : " (" + figure.title + ")");
    figure.width_in = plan_.width_in;
    for (const std::string& label : places_.series) {
      const auto look = std::find_if(looks_.begin(), looks_.end(), [&](const Series& s) { return s.name == label; });
      figure.series.push_back(look == looks_.end() ? Series{label, {}, 0} : *look);
    }
    label_groups(figure);
    for (std::size_t m = 0; m < plan_.metrics.size(); ++m) add_metric(figure, m);
    arrange(figure);
    leave_out_empty(figure);
    // One panel need not be told from others.
    const bool one = plan_.metrics.size() == 1 ? figure.panels.size() == 1 : figure.columns == 1;
    if (!plan_.panels.empty() && one)
      for (Panel& panel : figure.panels) panel.title.clear();
    return figure;
  }

 private:
  [[nodiscard]] bool of_each(std::size_t row) const {
    for (std::size_t i = 0; i < each_.size(); ++i) {
      if (results_.label(row, plan_.each[i]) != each_[i]) return false;
    }
    return true;
  }

  [[nodiscard]] bool where(std::size_t row) const {
    return std::all_of(plan_.where.begin(), plan_.where.end(), [&](const auto& w) {
      return index_in(w.second, results_.label(row, w.first)) < w.second.size();
    });
  }

  // "reading: literal, line of sight off". An axis of which all figures together show one value tells nothing.
  [[nodiscard]] std::string each_in_words() const {
    std::string text;
    for (std::size_t i = 0; i < each_.size(); ++i) {
      const auto labels = drawn_.find(plan_.each[i]);
      if (labels == drawn_.end() || labels->second.size() < 2) continue;
      text += (text.empty() ? "" : ", ") + with_value(axis_of(*axes_, plan_.each[i])->title, each_[i]);
    }
    return text;
  }

  // The last axis varies fastest: it labels the groups, the others what lies farther out.
  void label_groups(BoxFigure& figure) const {
    if (x_.empty()) {
      figure.groups = {""};
      return;
    }
    figure.x_label = axis_of(*axes_, x_.back())->title;
    for (const auto& group : places_.groups) figure.groups.push_back(group.back());
    for (std::size_t i = x_.size() - 1; i-- > 0;) {
      OuterLabels outer{axis_of(*axes_, x_[i])->title, {}, {}};
      for (const auto& group : places_.groups) {
        outer.labels.push_back(group[i]);
        outer.full.push_back(with_value(outer.title, group[i]));
      }
      figure.outer.push_back(std::move(outer));
    }
  }

  void add_metric(BoxFigure& figure, std::size_t m) const {
    const FigureMetric& metric = plan_.metrics[m];
    Measure measure;
    measure.label = metric.title;
    if (metric.scale != FigureScale::linear) measure.scale = Scale::log;
    if (metric.scale == FigureScale::ratio) measure.line = 1.0;
    if (is_boolean(metric.column)) measure.share_confidence = confidence_;
    measure.late = !is_over_bound(metric.column);
    measure.minimum = plan_.y_minimum;
    measure.maximum = plan_.y_maximum;
    figure.measures.push_back(measure);
    const Axis* axis = axis_of(*axes_, plan_.panels);
    for (const auto& label : places_.panels) {
      Panel panel{axis ? with_value(axis->title, label) : "", m, {}};
      panel.boxes.assign(places_.groups.size(), std::vector<BoxRuns>(places_.series.size()));
      figure.panels.push_back(std::move(panel));
    }
    fill(figure, m);
  }

  [[nodiscard]] BoxRuns& box_of(BoxFigure& figure, std::size_t m, std::size_t row) const {
    Labels group;
    for (const auto& axis : x_) group.push_back(results_.label(row, axis));
    const std::size_t panel = plan_.panels.empty() ? 0 : index_in(places_.panels, results_.label(row, plan_.panels));
    const std::size_t s = plan_.series.empty() ? 0 : index_in(places_.series, results_.label(row, plan_.series));
    return figure.panels[m * places_.panels.size() + panel].boxes[index_in(places_.groups, group)][s];
  }

  void fill(BoxFigure& figure, std::size_t m) const {
    const FigureMetric& metric = plan_.metrics[m];
    const MetricColumn column = metric_column(results_, metric.column);
    const bool late = is_time(metric.column);  // a miss counts as later than all others
    if (metric.scale == FigureScale::ratio) return fill_ratios(figure, m, column, late);
    const Values complete = results_.values("complete");
    const bool over_bound = is_over_bound(metric.column);
    for (const std::size_t row : rows_) {
      if (column.missed[row] != 0) {
        if (late) ++box_of(figure, m, row).missed;
      } else if (over_bound && complete[row] == 0.0) {
        ++box_of(figure, m, row).missed;
      } else if (std::isfinite(column.value[row])) {
        box_of(figure, m, row).values.push_back(column.value[row]);
      }
    }
  }

  // Each run by the run of the same seed and world of the series ratio_to. None where that one missed or is 0.
  void fill_ratios(BoxFigure& figure, std::size_t m, const MetricColumn& column, bool late) const {
    const std::size_t axis = axis_index(*axes_, plan_.series);
    const Values complete = results_.values("complete");
    const bool over_bound = is_over_bound(plan_.metrics[m].column);
    const auto is_unbound = [&](std::size_t row) { return over_bound && complete[row] == 0.0; };
    const auto identity = [&](std::size_t row) {
      auto values = results_.planned(row).values;
      values[axis] = 0;
      return std::pair{values, results_.planned(row).seed};
    };
    std::map<std::pair<std::vector<std::size_t>, std::uint64_t>, double> reference;
    for (std::size_t row = 0; row < results_.rows(); ++row) {
      if (results_.planned(row).part != part_ || results_.label(row, plan_.series) != plan_.ratio_to) continue;
      if (column.missed[row] == 0 && !is_unbound(row) && std::isfinite(column.value[row]) && column.value[row] != 0.0)
        reference.emplace(identity(row), column.value[row]);
    }
    for (const std::size_t row : rows_) {
      if (results_.label(row, plan_.series) == plan_.ratio_to) continue;
      const auto partner = reference.find(identity(row));
      if (partner == reference.end()) continue;
      if (column.missed[row] != 0) {
        if (late) ++box_of(figure, m, row).missed;
      } else if (is_unbound(row)) {
        ++box_of(figure, m, row).missed;
      } else if (std::isfinite(column.value[row])) {
        box_of(figure, m, row).values.push_back(column.value[row] / partner->second);
      }
    }
  }

  // Several metrics: a row each, of the panels that there are; or, without panels, a panel each under its name.
  void arrange(BoxFigure& figure) const {
    constexpr std::size_t usual_columns = 3;
    if (plan_.metrics.size() == 1) {
      figure.columns = plan_.columns.value_or(usual_columns);
    } else if (plan_.panels.empty()) {
      figure.columns = plan_.columns.value_or(plan_.width_in == page_in ? usual_columns : 1);
      for (Panel& panel : figure.panels) panel.title = std::move(figure.measures[panel.measure].label);
      for (Measure& measure : figure.measures) measure.label.clear();
    } else {
      figure.columns = places_.panels.size();
      figure.grid = true;
      for (std::size_t i = places_.panels.size(); i < figure.panels.size(); ++i) figure.panels[i].title.clear();
    }
    const bool ratio = std::all_of(plan_.metrics.begin(), plan_.metrics.end(),
                                   [](const FigureMetric& metric) { return metric.scale == FigureScale::ratio; });
    figure.counted = ratio ? "pairs" : "runs";
  }

  static bool has_runs(const BoxRuns& box) { return !box.values.empty() || box.missed > 0; }

  template <typename Visit> static bool any_box(const BoxFigure& figure, Visit visit) {
    for (std::size_t p = 0; p < figure.panels.size(); ++p) {
      for (std::size_t g = 0; g < figure.groups.size(); ++g) {
        for (std::size_t s = 0; s < figure.series.size(); ++s) {
          if (has_runs(figure.panels[p].boxes[g][s]) && visit(p, g, s)) return true;
        }
      }
    }
    return false;
  }

  // Series, groups and panels without a run. In a grid of panels, rows and columns of which all panels are empty.
  static void leave_out_empty(BoxFigure& figure) {
    for (std::size_t s = figure.series.size(); s-- > 0;) {
      if (any_box(figure, [&](std::size_t, std::size_t, std::size_t at) { return at == s; })) continue;
      figure.series.erase(figure.series.begin() + static_cast<std::ptrdiff_t>(s));
      for (Panel& panel : figure.panels) {
        for (auto& group : panel.boxes) group.erase(group.begin() + static_cast<std::ptrdiff_t>(s));
      }
    }
    for (std::size_t g = figure.groups.size(); g-- > 0;) {
      if (any_box(figure, [&](std::size_t, std::size_t at, std::size_t) { return at == g; })) continue;
      const auto at = static_cast<std::ptrdiff_t>(g);
      figure.groups.erase(figure.groups.begin() + at);
      for (OuterLabels& outer : figure.outer) {
        outer.labels.erase(outer.labels.begin() + at);
        outer.full.erase(outer.full.begin() + at);
      }
      for (Panel& panel : figure.panels) panel.boxes.erase(panel.boxes.begin() + at);
    }
    leave_out_panels(figure);
  }

  static void leave_out_panels(BoxFigure& figure) {
    const std::size_t columns = figure.grid ? figure.columns : 1;
    std::set<std::size_t> full, full_rows, full_columns;
    for (std::size_t p = 0; p < figure.panels.size(); ++p) {
      if (!any_box(figure, [&](std::size_t at, std::size_t, std::size_t) { return at == p; })) continue;
      full.insert(p);
      full_rows.insert(p / columns);
      full_columns.insert(p % columns);
    }
    // The titles of the first row are those of their columns.
    const std::size_t first = full_rows.empty() ? 0 : *full_rows.begin();
    std::vector<Panel> panels;
    for (std::size_t p = 0; p < figure.panels.size(); ++p) {
      const bool keep =
          figure.grid ? full_rows.contains(p / columns) && full_columns.contains(p % columns) : full.contains(p);
      if (!keep) continue;
      if (figure.grid && p / columns == first) figure.panels[p].title = figure.panels[p % columns].title;
      panels.push_back(std::move(figure.panels[p]));
    }
    figure.panels = std::move(panels);
    if (figure.grid) figure.columns = std::max<std::size_t>(1, full_columns.size());
  }

  const Results& results_;
  const FigurePlan& plan_;
  const Labels& each_;
  std::size_t part_ = 0;
  const Part* axes_ = nullptr;
  Labels x_;
  Places places_;
  std::vector<std::size_t> rows_;                       // that the figure is of
  std::map<std::string, std::set<std::string>> drawn_;  // the labels of each axis of `each` that have runs
  std::vector<Series> looks_;
  double confidence_ = 0.95;
};

}  // namespace

std::vector<Labels> combinations(const Part& part, const Labels& axes, const Where& where) {
  std::vector<Labels> list{{}};
  for (const auto& name : axes) {
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

BoxFigure figure_of(const Study& study, const Results& results, const FigurePlan& plan,
                    const std::vector<std::string>& each) {
  return Illustrator(study, results, plan, each).figure();
}

}  // namespace banyan::study
