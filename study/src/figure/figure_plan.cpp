// SPDX-License-Identifier: MIT
#include "figure_plan.hpp"

#include <algorithm>
#include <set>

#include "../study_checks.hpp"
#include "banyan/study/figure.hpp"
#include "words.hpp"

namespace banyan::study {
namespace {

using config::Node;
using config::Problem;
using config::TableReader;

const std::vector<std::string_view> scale_names{"linear", "log", "ratio"};  // as in FigureScale

class FigureReader {
 public:
  FigureReader(TableReader& table, const Study& study, std::vector<Problem>& problems)
      : table_(table), problems_(problems) {
    plan_.part = table.text("part", study.parts.front().name);
    const auto at =
        std::find_if(study.parts.begin(), study.parts.end(), [&](const Part& p) { return p.name == plan_.part; });
    if (at == study.parts.end()) table.report("part", "\"" + plan_.part + "\" is no part of this study");
    else part_ = &*at;
    known_ = axis_names(part_ ? std::span<const Part>(part_, 1) : std::span<const Part>(study.parts));
  }

  FigurePlan read() {
    read_metrics();
    plan_.name = table_.text("name", plan_.metrics.front().column);
    check_name(table_, plan_.name);
    plan_.title = table_.text("title");
    read_axes();
    read_where();
    read_titles();
    read_scales();
    read_sizes();
    check_series();
    return std::move(plan_);
  }

 private:
  void read_metrics() {
    if (!table_.has("metrics")) table_.require("metric");
    if (table_.has("metrics") && table_.has("metric"))
      table_.report("metrics", "stands beside metric; give one of them: metrics is the list");
    const char* key = table_.has("metrics") ? "metrics" : "metric";
    std::vector<std::string> columns{table_.text("metric")};
    if (auto several = table_.texts("metrics"); !several.empty()) columns = std::move(several);
    for (const std::string& column : columns) {
      check_metric(table_, key, column);
      plan_.metrics.push_back({column, words_of_metric(column), FigureScale::linear});
    }
  }

  void read_axes() {
    plan_.each = table_.texts("each");
    plan_.x = table_.texts("x");
    plan_.panels = table_.text("panels");
    plan_.series = table_.text("series");
    for (const auto& axis : plan_.each) check_axis(table_, "each", axis, known_);
    for (const auto& axis : plan_.x) check_axis(table_, "x", axis, known_);
    check_axis(table_, "panels", plan_.panels, known_);
    check_axis(table_, "series", plan_.series, known_);
  }

  void read_where() {
    const Node* where = table_.table("where");
    if (!where) return;
    TableReader inner(*where, table_.path("where"), problems_);
    for (const auto& [axis, value] : *where->table()) {
      check_axis(table_, "where", axis, known_);
      plan_.where.emplace_back(axis, read_picked(inner, axis));
    }
  }

  // A list with an entry per metric, or nothing.
  std::vector<std::string> per_metric(std::string_view key, bool one_for_all) {
    auto list = table_.texts(key);
    if (one_for_all && list.size() == 1) list.assign(plan_.metrics.size(), list.front());
    if (list.empty() || list.size() == plan_.metrics.size()) return list;
    table_.report(key, "are " + std::to_string(list.size()) + " for " + std::to_string(plan_.metrics.size()) +
                           (plan_.metrics.size() == 1 ? " metric" : " metrics"));
    return {};
  }

  void read_titles() {
    const auto titles = per_metric("y_title", false);
    for (std::size_t i = 0; i < titles.size(); ++i) plan_.metrics[i].title = titles[i];
  }

  void read_scales() {
    const auto scales = per_metric("y_scale", true);
    for (std::size_t i = 0; i < scales.size(); ++i) {
      const auto at = std::find(scale_names.begin(), scale_names.end(), scales[i]);
      if (at == scale_names.end()) {
        const auto near = config::nearest(scales[i], scale_names);
        table_.report("y_scale", "is \"" + scales[i] + R"("; allowed: "linear", "log", "ratio")" +
                                     (near.empty() ? "" : "; did you mean \"" + std::string(near) + "\"?"));
        return;
      }
      plan_.metrics[i].scale = static_cast<FigureScale>(at - scale_names.begin());
    }
    read_ratio();
  }

  void read_ratio() {
    plan_.ratio_to = table_.text("ratio_to");
    const bool ratio = std::any_of(plan_.metrics.begin(), plan_.metrics.end(),
                                   [](const FigureMetric& m) { return m.scale == FigureScale::ratio; });
    if (!ratio && table_.has("ratio_to")) table_.report("ratio_to", "is for y_scale = \"ratio\" only");
    if (!ratio) return;
    if (plan_.ratio_to.empty() || plan_.series.empty()) {
      table_.report("y_scale", "\"ratio\" needs series, and ratio_to, the label of the series to compare with");
      return;
    }
    if (!part_) return;
    for (const Axis& axis : part_->axes) {
      if (axis.name == plan_.series) check_label(table_, "ratio_to", plan_.ratio_to, axis);
    }
    for (FigureMetric& metric : plan_.metrics) {
      if (metric.scale == FigureScale::ratio) metric.title += " (" + plan_.ratio_to + "\u00a0=\u00a01)";
    }
  }

  void read_sizes() {
    if (table_.has("columns")) plan_.columns = static_cast<std::size_t>(table_.whole("columns", 3, {1, 6}));
    if (const auto width = table_.number("width_in", config::Range{})) {
      if (*width != column_in && *width != page_in)
        table_.report("width_in", "is " + config::number_text(*width) + "; allowed: 3.5, a column, or 7, a page");
      plan_.width_in = width;
    }
    for (const auto& [key, end] : {std::pair{"y_minimum", &plan_.y_minimum}, {"y_maximum", &plan_.y_maximum}}) {
      *end = table_.number(key, config::Range{});
      if (!*end) continue;
      if (plan_.metrics.size() > 1) table_.report(key, "is for a figure of one metric");
      if (plan_.metrics.front().scale != FigureScale::linear && **end <= 0.0)
        table_.report(key, "is " + config::number_text(**end) + "; on a logarithmic scale it is above 0");
    }
    if (plan_.y_minimum && plan_.y_maximum && *plan_.y_minimum >= *plan_.y_maximum)
      table_.report("y_minimum", "must be below y_maximum");
  }

  void check_series() {
    if (!part_) return;
    for (const auto& axis : part_->axes) {
      if (axis.name != plan_.series) continue;
      std::size_t count = axis.values.size();
      for (const auto& [name, labels] : plan_.where) count = name == axis.name ? labels.size() : count;
      if (count > most_series)
        table_.report("series", "\"" + axis.name + "\" has " + std::to_string(count) +
                                    " values; a figure has colours for " + std::to_string(most_series));
    }
  }

  static void check_label(TableReader& table, const std::string& key, const std::string& label, const Axis& axis) {
    std::vector<std::string_view> known;
    for (const auto& value : axis.values) known.push_back(value.label);
    if (std::find(known.begin(), known.end(), label) != known.end()) return;
    const auto near = config::nearest(label, known);
    table.report(key, "\"" + label + "\" is no label of the axis \"" + axis.name + "\"" +
                          (near.empty() ? "" : "; did you mean \"" + std::string(near) + "\"?"));
  }

  // The labels of an axis, each of which must exist: a figure of nothing is a mistake.
  std::vector<std::string> read_picked(TableReader& table, const std::string& name) {
    std::vector<std::string> labels;
    const Node* node = table.any(name);
    const auto* items = node->array();
    if (items && items->empty()) table.report(name, "is an empty list: give at least one value");
    for (std::size_t i = 0; items ? i < items->size() : i < 1; ++i)
      labels.push_back(label_of(items ? (*items)[i] : *node));
    if (!part_) return labels;
    for (const auto& axis : part_->axes) {
      if (axis.name != name) continue;
      for (const auto& label : labels) check_label(table, name, label, axis);
    }
    return labels;
  }

  TableReader& table_;
  std::vector<Problem>& problems_;
  const Part* part_ = nullptr;  // null if there is none of that name
  std::vector<std::string_view> known_;
  FigurePlan plan_;
};

// Without [[figures]]: time and connectivity of every part, over as many axes as a figure can show.
void add_standard_figures(Study& study) {
  for (const auto& part : study.parts) {
    std::vector<std::string> left;
    std::string series;
    for (const auto& axis : part.axes) {
      const bool fits = axis.values.size() <= most_series;
      if (fits && (series.empty() || axis.name == study.statistics.compare)) {
        if (!series.empty()) left.push_back(series);
        series = axis.name;
      } else {
        left.push_back(axis.name);
      }
    }
    for (const char* metric : {"normalized_time", "disconnected_time_ratio"}) {
      FigurePlan figure;
      figure.metrics = {{metric, words_of_metric(metric), FigureScale::linear}};
      figure.name = (part.name.empty() ? "" : part.name + "-") + std::string(metric);
      figure.part = part.name;
      figure.series = series;
      auto rest = left;
      if (!rest.empty()) {
        figure.x = {rest.back()};
        rest.pop_back();
      }
      if (!rest.empty()) {
        figure.panels = rest.back();
        rest.pop_back();
      }
      figure.each = rest;
      study.figures.push_back(std::move(figure));
    }
  }
}

}  // namespace

void read_figures(TableReader& top, Study& study, std::vector<Problem>& problems) {
  const auto list = top.tables("figures");
  for (std::size_t i = 0; i < list.size(); ++i) {
    TableReader table(*list[i], "figures[" + std::to_string(i) + "]", problems);
    study.figures.push_back(FigureReader(table, study, problems).read());
    table.finish();
  }
  std::set<std::string> names;
  for (const auto& figure : study.figures) {
    if (!names.insert(figure.name).second) top.report("figures", "has two figures named \"" + figure.name + "\"");
  }
  if (!top.has("figures")) add_standard_figures(study);
}

}  // namespace banyan::study
