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

namespace banyan::study {
namespace {

using Labels = std::vector<std::string>;
const std::string pooled = "*";  // NOLINT(cert-err58-cpp): a short string does not throw

// A number as the tables show it: six significant digits, nothing for NaN.
std::string shown(double value) {
  if (!std::isfinite(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

SummaryOptions options_of(const StatisticsPlan& plan) { return {plan.confidence, plan.resamples, 1}; }

// Axes that group runs in one part: all of them, and then what the study asks for.
std::vector<std::vector<std::string>> groupings(const Study& study, const Part& part) {
  std::vector<std::string> all;
  for (const auto& axis : part.axes) all.push_back(axis.name);
  std::vector<std::vector<std::string>> list{all};
  for (const auto& by : study.statistics.by) {
    std::vector<std::string> here;
    for (const auto& name : all) {
      if (std::find(by.begin(), by.end(), name) != by.end()) here.push_back(name);
    }
    if (std::find(list.begin(), list.end(), here) == list.end()) list.push_back(here);
  }
  return list;
}

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

// The order of a part's groups: by the values' order in the file, not by their text.
using GroupKey = std::vector<std::size_t>;  // a value index per axis of the part; npos: pooled
constexpr std::size_t any_value = static_cast<std::size_t>(-1);

GroupKey key_of(const Part& part, const PlannedRow& row, const std::vector<std::string>& by) {
  GroupKey key(part.axes.size(), any_value);
  for (std::size_t a = 0; a < key.size(); ++a) {
    if (contains(by, part.axes[a].name)) key[a] = row.values[a];
  }
  return key;
}

// "worlds,outwards,*,9": the cells that name a group, one per axis of the study.
std::string group_cells(const Study& study, const Results& results, std::size_t p, const GroupKey& key) {
  const Part& part = study.parts[p];
  std::string text = part.name;
  for (const auto& axis : results.axes()) {
    text += ",";
    for (std::size_t a = 0; a < part.axes.size(); ++a) {
      if (part.axes[a].name != axis) continue;
      text += key[a] == any_value ? pooled : record::csv_quoted(part.axes[a].values[key[a]].label);
    }
  }
  return text;
}

std::string group_header(const Results& results) {
  std::string text = "part";
  for (const auto& axis : results.axes()) text += "," + record::csv_quoted(axis);
  return text;
}

std::vector<std::size_t> rows_of(const Results& results, std::size_t part) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < results.rows(); ++row) {
    if (results.planned(row).part == part) rows.push_back(row);
  }
  return rows;
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

// ------------------------------------------------------------------------------ comparisons --

// Runs of one group, paired: by everything but the compared axis.
struct Pairing {
  std::vector<double> first, second;
};

Pairing pair_up(const Results& results, const Values& values, const std::vector<std::size_t>& first,
                const std::vector<std::size_t>& second, std::size_t compared) {
  std::map<std::pair<std::vector<std::size_t>, std::uint64_t>, double> partner;
  const auto identity = [&](std::size_t row) {
    auto key = std::pair{results.planned(row).values, results.planned(row).seed};
    key.first[compared] = 0;
    return key;
  };
  for (const std::size_t row : second) partner.emplace(identity(row), values[row]);
  Pairing pairs;
  for (const std::size_t row : first) {
    const auto found = partner.find(identity(row));
    if (found == partner.end() || !std::isfinite(values[row]) || !std::isfinite(found->second)) continue;
    pairs.first.push_back(values[row]);
    pairs.second.push_back(found->second);
  }
  return pairs;
}

struct Comparison {
  std::string cells;  // up to the names of the test
  std::size_t grouping = 0, metric = 0;
  PairedTest result;
};

class Comparer {
 public:
  Comparer(const Study& study, const Results& results) : study_(study), results_(results) {
    for (const auto& metric : study.statistics.metrics) values_.push_back(results.values(metric));
  }

  std::string csv() {
    std::string text = group_header(results_) +
                       ",metric,first,second,test,pairs,first_mean,second_mean,first_median,second_median,median_"
                       "difference,difference_low,"
                       "difference_high,first_larger,second_larger,effect,p,p_holm\n";
    for (std::size_t p = 0; p < study_.parts.size(); ++p) {
      comparisons_.clear();
      compare_part(p);
      const auto adjusted = corrected();
      for (std::size_t i = 0; i < comparisons_.size(); ++i) {
        const auto& r = comparisons_[i].result;
        text += comparisons_[i].cells + "," + shown(r.median_difference) + "," + shown(r.difference_interval.low) +
                "," + shown(r.difference_interval.high) + "," + std::to_string(r.first_larger) + "," +
                std::to_string(r.second_larger) + "," + shown(r.effect) + "," + shown(p_of(comparisons_[i])) + "," +
                shown(adjusted[i]) + "\n";
      }
    }
    return text;
  }

 private:
  static double p_of(const Comparison& c) { return c.result.pairs > 0 ? c.result.p : std::nan(""); }

  // Tests of one question form a family: a metric, over all groups of one grouping.
  [[nodiscard]] std::vector<double> corrected() const {
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> families;
    for (std::size_t i = 0; i < comparisons_.size(); ++i)
      families[{comparisons_[i].grouping, comparisons_[i].metric}].push_back(i);
    std::vector<double> adjusted(comparisons_.size());
    for (const auto& [family, members] : families) {
      std::vector<double> raw;
      for (const std::size_t i : members) raw.push_back(p_of(comparisons_[i]));
      const auto values = holm(raw);
      for (std::size_t k = 0; k < members.size(); ++k) adjusted[members[k]] = values[k];
    }
    return adjusted;
  }

  void compare_part(std::size_t p) {
    const Part& part = study_.parts[p];
    const auto axis = std::find_if(part.axes.begin(), part.axes.end(),
                                   [&](const Axis& a) { return a.name == study_.statistics.compare; });
    if (axis == part.axes.end()) return;
    const auto compared = static_cast<std::size_t>(axis - part.axes.begin());
    std::set<std::vector<std::string>> done;  // groupings that differ in the compared axis alone are one
    for (auto by : groupings(study_, part)) {
      std::erase(by, axis->name);
      if (!done.insert(by).second) continue;
      std::map<GroupKey, std::vector<std::vector<std::size_t>>> groups;  // rows by value of the compared axis
      for (const std::size_t row : rows_of(results_, p)) {
        auto key = key_of(part, results_.planned(row), by);
        key[compared] = any_value;
        auto& sides = groups[key];
        sides.resize(axis->values.size());
        sides[results_.planned(row).values[compared]].push_back(row);
      }
      for (const auto& [key, sides] : groups) compare_group(p, compared, done.size(), key, sides);
    }
  }

  void compare_group(std::size_t p, std::size_t compared, std::size_t grouping, const GroupKey& key,
                     const std::vector<std::vector<std::size_t>>& sides) {
    const Axis& axis = study_.parts[p].axes[compared];
    for (std::size_t m = 0; m < values_.size(); ++m) {
      for (std::size_t i = 0; i < sides.size(); ++i) {
        for (std::size_t j = i + 1; j < sides.size(); ++j) {
          const auto pairs = pair_up(results_, values_[m], sides[i], sides[j], compared);
          const bool binary = is_boolean(study_.statistics.metrics[m]);
          const auto options = options_of(study_.statistics);
          Comparison c;
          c.grouping = grouping;
          c.metric = m;
          c.result =
              binary ? mcnemar(pairs.first, pairs.second, options) : wilcoxon(pairs.first, pairs.second, options);
          c.cells = group_cells(study_, results_, p, key) + "," + study_.statistics.metrics[m] + "," +
                    record::csv_quoted(axis.values[i].label) + "," + record::csv_quoted(axis.values[j].label) + "," +
                    (binary ? "mcnemar" : "wilcoxon") + "," + std::to_string(c.result.pairs) + "," +
                    shown(mean(pairs.first)) + "," + shown(mean(pairs.second)) + "," +
                    (binary ? "," : shown(median(pairs.first)) + "," + shown(median(pairs.second)));
          if (binary)
            c.result.median_difference = c.result.difference_interval.low = c.result.difference_interval.high =
                std::nan("");
          comparisons_.push_back(std::move(c));
        }
      }
    }
  }

  static double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
  static double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return quantile(values, 0.5);
  }

  const Study& study_;
  const Results& results_;
  std::vector<Values> values_;
  std::vector<Comparison> comparisons_;
};

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

std::string comparisons_csv(const Study& study, const Results& results) { return Comparer(study, results).csv(); }

Drawn draw_figures(const Study& study, const Results& results, const std::string& folder) {
  return Illustrator(study, results, folder).draw_all();
}

}  // namespace banyan::study
