// SPDX-License-Identifier: MIT
// A figure as JSON, for figures.py to draw.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "banyan/study/figure.hpp"

namespace banyan::study {

namespace {

using Json = nlohmann::ordered_json;

constexpr int format_version = 1;
constexpr std::size_t longest_line = 120;

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(std::string("figure: ") + what);
}

void require_ends(std::optional<double> minimum, std::optional<double> maximum) {
  require(std::isfinite(minimum.value_or(0.0)) && std::isfinite(maximum.value_or(0.0)),
          "the ends of the axis must be finite");
  require(!minimum || !maximum || *minimum < *maximum, "the axis must end above where it begins");
}

void check_panel(const BoxFigure& figure, const Panel& panel) {
  require(panel.measure < figure.measures.size(), "every panel needs a measure of the figure");
  require(panel.boxes.size() == figure.groups.size(), "every panel needs boxes for every group");
  const bool share = figure.measures[panel.measure].share_confidence.has_value();
  for (const auto& group : panel.boxes) {
    require(group.size() == figure.series.size(), "every group needs a box for every series");
    for (const BoxRuns& box : group) {
      const bool finite = std::all_of(box.values.begin(), box.values.end(), [](double v) { return std::isfinite(v); });
      require(finite, "values must be finite");
      require(!share || (box.missed == 0 && std::all_of(box.values.begin(), box.values.end(),
                                                        [](double v) { return v == 0.0 || v == 1.0; })),
              "a share is of values 0 or 1");
    }
  }
}

void check(const BoxFigure& figure) {
  require(!figure.series.empty() && figure.series.size() <= most_series, "needs one to twelve series");
  for (const Series& series : figure.series)
    require(series.style.value_or(0) < most_series && series.variant < most_variants,
            "has twelve styles of eight variants");
  require(!figure.groups.empty(), "needs a group");
  for (const OuterLabels& outer : figure.outer)
    require(outer.labels.size() == figure.groups.size() && outer.full.size() == figure.groups.size(),
            "every group needs its outer labels");
  require(!figure.panels.empty(), "needs a panel");
  require(figure.columns >= 1, "needs a column");
  require(!figure.measures.empty(), "needs a measure");
  for (const Measure& measure : figure.measures) {
    require_ends(measure.minimum, measure.maximum);
    const bool positive = measure.minimum.value_or(1.0) > 0.0 && measure.maximum.value_or(1.0) > 0.0;
    require(measure.scale == Scale::linear || positive, "a logarithmic axis needs positive ends");
  }
  require(std::isfinite(figure.width_in.value_or(1.0)) && figure.width_in.value_or(1.0) >= 1.0, "is too narrow");
  for (const Panel& panel : figure.panels) check_panel(figure, panel);
}

bool finite_or_gap(const std::vector<double>& values) {
  return std::none_of(values.begin(), values.end(), [](double v) { return std::isinf(v); });
}

void check(const CurveFigure& figure) {
  require(!figure.curves.empty() && figure.curves.size() <= most_series, "needs one to twelve curves");
  require_ends(figure.y_minimum, figure.y_maximum);
  for (const Curve& curve : figure.curves) {
    require(curve.y.size() == curve.x.size(), "a curve needs as many y as x");
    require(curve.low.size() == curve.high.size() && (curve.low.empty() || curve.low.size() == curve.x.size()),
            "a band needs both ends at every x");
    require(std::all_of(curve.x.begin(), curve.x.end(), [](double v) { return std::isfinite(v); }), "x must be finite");
    require(finite_or_gap(curve.y) && finite_or_gap(curve.low) && finite_or_gap(curve.high),
            "values must be finite, or NaN for a gap");
  }
}

Json optional(std::optional<double> value) { return value ? Json(*value) : Json(); }

Json json_of(const Measure& measure) {
  return {{"label", measure.label},
          {"scale", measure.scale == Scale::log ? "log" : "linear"},
          {"minimum", optional(measure.minimum)},
          {"maximum", optional(measure.maximum)},
          {"line", optional(measure.line)},
          {"share_confidence", optional(measure.share_confidence)},
          {"late", measure.late}};
}

Json json_of(const Panel& panel) {
  Json groups = Json::array();
  for (const auto& group : panel.boxes) {
    Json boxes = Json::array();
    for (const BoxRuns& box : group) boxes.push_back({{"values", box.values}, {"missed", box.missed}});
    groups.push_back(std::move(boxes));
  }
  return {{"title", panel.title}, {"measure", panel.measure}, {"boxes", std::move(groups)}};
}

// What fits is on one line, and so are numbers and boxes however many they are: for people to read and change.
bool on_one_line(const Json& json, const std::string& text) {
  if (!json.is_structured() || text.size() <= longest_line || json.contains("values")) return true;
  return json.is_array() &&
         std::none_of(json.begin(), json.end(), [](const Json& item) { return item.is_structured(); });
}

void append(std::string& text, const Json& json, const std::string& indent) {
  const std::string line = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (on_one_line(json, line)) {
    text += line;
    return;
  }
  const std::string inner = indent + "  ";
  text += json.is_object() ? "{" : "[";
  const char* separator = "\n";
  for (const auto& [key, value] : json.items()) {
    text += separator + inner;
    if (json.is_object()) text += Json(key).dump() + ": ";
    append(text, value, inner);
    separator = ",\n";
  }
  text += "\n" + indent + (json.is_object() ? "}" : "]");
}

std::string text_of(const char* kind, const Json& content) {
  Json root{{"format", "banyan.figure"}, {"format_version", format_version}, {"kind", kind}};
  root.update(content);
  std::string text;
  append(text, root, "");
  return text + "\n";
}

}  // namespace

std::string figure_json(const BoxFigure& figure) {
  check(figure);
  Json series = Json::array(), outer = Json::array(), measures = Json::array(), panels = Json::array();
  for (std::size_t s = 0; s < figure.series.size(); ++s) {
    const Series& one = figure.series[s];
    series.push_back({{"name", one.name}, {"color", one.style.value_or(s)}, {"variant", one.variant}});
  }
  for (const OuterLabels& one : figure.outer)
    outer.push_back({{"title", one.title}, {"labels", one.labels}, {"full", one.full}});
  for (const Measure& measure : figure.measures) measures.push_back(json_of(measure));
  for (const Panel& panel : figure.panels) panels.push_back(json_of(panel));
  return text_of("boxes", {{"title", figure.title},
                           {"x_label", figure.x_label},
                           {"counted", figure.counted},
                           {"width_in", optional(figure.width_in)},
                           {"columns", figure.columns},
                           {"grid", figure.grid},
                           {"groups", figure.groups},
                           {"outer", std::move(outer)},
                           {"series", std::move(series)},
                           {"measures", std::move(measures)},
                           {"panels", std::move(panels)}});
}

std::string figure_json(const CurveFigure& figure) {
  check(figure);
  Json curves = Json::array();
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    const Curve& curve = figure.curves[i];
    Json json{{"name", curve.name}, {"color", i}, {"points", curve.points}, {"x", curve.x}, {"y", curve.y}};
    if (!curve.low.empty()) json.update({{"low", curve.low}, {"high", curve.high}});
    curves.push_back(std::move(json));
  }
  return text_of("curves", {{"title", figure.title},
                            {"x_label", figure.x_label},
                            {"y_label", figure.y_label},
                            {"y_minimum", optional(figure.y_minimum)},
                            {"y_maximum", optional(figure.y_maximum)},
                            {"curves", std::move(curves)}});
}

}  // namespace banyan::study
