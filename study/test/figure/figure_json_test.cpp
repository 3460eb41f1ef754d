// SPDX-License-Identifier: MIT
// A figure's JSON holds what the figure holds, whatever its texts and numbers are.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "banyan/study/figure.hpp"
#include "banyan/world/random.hpp"

namespace banyan::study {
namespace {

using Json = nlohmann::json;

BoxFigure small_figure() {
  BoxFigure figure;
  figure.x_label = "redundancy k";
  figure.measures = {{"completion time", Scale::log, 0.5, {}, 1.0, {}, true}, {"done", Scale::linear, {}, {}, {}, 0.9}};
  figure.groups = {"1", "2"};
  figure.outer = {{"T", {"2", "3"}, {"T = 2", "T = 3"}}};
  figure.series = {{"outwards", {}, 0}, {"inwards", 7, 2}};
  figure.panels = {{"r = 3 m", 0, {{{{7, 100.25, 3}, 0}, {{4}, 2}}, {{{}, 3}, {{2, 2, 2}, 0}}}},
                   {"", 1, {{{{1, 0}, 0}, {}}, {{}, {{1}, 0}}}}};
  return figure;
}

CurveFigure curves() {
  CurveFigure figure{"t", "generation", "fitness", {}, 0.25, {}};
  figure.curves = {{"a", {0, 1, 2}, {0.5, std::nan(""), 0.75}, {0, 0.25, 0.5}, {1, 1, 1}, true},
                   {"b", {0, 2}, {1, 2}, {}, {}, false}};
  return figure;
}

TEST(FigureJson, HoldsAllOfAFigure) {
  const Json json = Json::parse(figure_json(small_figure()));
  EXPECT_EQ(json, Json::parse(R"({"format": "banyan.figure", "format_version": 1, "kind": "boxes",
    "title": "", "x_label": "redundancy k", "counted": "runs", "width_in": null, "columns": 1, "grid": false,
    "groups": ["1", "2"], "outer": [{"title": "T", "labels": ["2", "3"], "full": ["T = 2", "T = 3"]}],
    "series": [{"name": "outwards", "color": 0, "variant": 0}, {"name": "inwards", "color": 7, "variant": 2}],
    "measures": [{"label": "completion time", "scale": "log", "minimum": 0.5, "maximum": null, "line": 1.0,
                  "share_confidence": null, "late": true},
                 {"label": "done", "scale": "linear", "minimum": null, "maximum": null, "line": null,
                  "share_confidence": 0.9, "late": true}],
    "panels": [{"title": "r = 3 m", "measure": 0,
                "boxes": [[{"values": [7.0, 100.25, 3.0], "missed": 0}, {"values": [4.0], "missed": 2}],
                          [{"values": [], "missed": 3}, {"values": [2.0, 2.0, 2.0], "missed": 0}]]},
               {"title": "", "measure": 1,
                "boxes": [[{"values": [1.0, 0.0], "missed": 0}, {"values": [], "missed": 0}],
                          [{"values": [], "missed": 0}, {"values": [1.0], "missed": 0}]]}]})"));
}

TEST(FigureJson, HoldsCurvesAndTheirGaps) {
  const Json json = Json::parse(figure_json(curves()));
  EXPECT_EQ(json, Json::parse(R"({"format": "banyan.figure", "format_version": 1, "kind": "curves", "title": "t",
    "x_label": "generation", "y_label": "fitness", "y_minimum": 0.25, "y_maximum": null, "curves": [
      {"name": "a", "color": 0, "points": true, "x": [0.0, 1.0, 2.0], "y": [0.5, null, 0.75],
       "low": [0.0, 0.25, 0.5], "high": [1.0, 1.0, 1.0]},
      {"name": "b", "color": 1, "points": false, "x": [0.0, 2.0], "y": [1.0, 2.0]}]})"));
}

TEST(FigureJson, NumbersReadBackAsTheyAre) {
  BoxFigure figure = small_figure();
  std::vector<double>& values = figure.panels[0].boxes[0][0].values;
  values = {0.1, 1.0 / 3.0, 5e-324, std::numeric_limits<double>::max(), 123456789.123456789, -0.0};
  for (std::uint64_t i = 0; i < 200; ++i)
    values.push_back(std::exp(200.0 * world::to_uniform(world::mix(world::mix(~i))) - 100.0));
  const std::string text = figure_json(figure);
  EXPECT_EQ(Json::parse(text)["panels"][0]["boxes"][0][0]["values"].get<std::vector<double>>(), values);
  EXPECT_EQ(figure_json(figure), text);
}

TEST(FigureJson, TextsAreTextsWhateverTheyHold) {
  BoxFigure figure = small_figure();
  const std::string evil = "it's \"q\" $x_1$ 50% \\n <b> & \t\n\x01 λ₂ }";
  figure.title = evil;
  figure.series[0].name = "a\xff";
  const Json json = Json::parse(figure_json(figure));
  EXPECT_EQ(json["title"], evil);
  EXPECT_EQ(json["series"][0]["name"], "a\xEF\xBF\xBD") << "what is no UTF-8 is U+FFFD";
}

// People change it by hand: a line for each thing, all runs of a box on one.
TEST(FigureJson, IsForPeople) {
  BoxFigure figure = small_figure();
  figure.panels[0].boxes[0][0].values.assign(300, 0.123);
  const std::string text = figure_json(figure);
  EXPECT_NE(text.find("\n  \"x_label\": \"redundancy k\",\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n          {\"values\":[0.123,0.123,"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("}\n"));
}

TEST(FigureJson, FiguresThatCannotBeDrawn) {
  const auto rejects = [](auto change) {
    BoxFigure figure = small_figure();
    change(figure);
    EXPECT_THROW((void)figure_json(figure), std::invalid_argument);
  };
  rejects([](BoxFigure& f) { f.series.clear(); });
  rejects([](BoxFigure& f) { f.series.resize(13); });
  rejects([](BoxFigure& f) { f.series[0].style = 12; });
  rejects([](BoxFigure& f) { f.series[0].variant = 8; });
  rejects([](BoxFigure& f) { f.measures.clear(); });
  rejects([](BoxFigure& f) { f.panels[0].measure = 2; });
  rejects([](BoxFigure& f) { f.outer = {{"T", {"2"}, {"T = 2"}}}; });
  rejects([](BoxFigure& f) { f.outer[0].full.pop_back(); });
  rejects([](BoxFigure& f) { f.width_in = 0.5; });
  rejects([](BoxFigure& f) { f.measures[0].minimum = 0.0; });
  rejects([](BoxFigure& f) { f.groups.clear(); });
  rejects([](BoxFigure& f) { f.groups.emplace_back("3"); });
  rejects([](BoxFigure& f) { f.panels.clear(); });
  rejects([](BoxFigure& f) { f.columns = 0; });
  rejects([](BoxFigure& f) { f.panels[0].boxes[0].pop_back(); });
  rejects([](BoxFigure& f) { f.panels[0].boxes[0][0].values[0] = std::numeric_limits<double>::quiet_NaN(); });
  rejects([](BoxFigure& f) { f.panels[1].boxes[0][0].values[0] = 0.5; });
  rejects([](BoxFigure& f) { f.measures[0].minimum = std::numeric_limits<double>::infinity(); });
  rejects([](BoxFigure& f) { f.measures[0].minimum = 2.0, f.measures[0].maximum = 2.0; });
  const auto rejects_curve = [](auto change) {
    CurveFigure figure = curves();
    change(figure.curves[0]);
    EXPECT_THROW((void)figure_json(figure), std::invalid_argument);
  };
  rejects_curve([](Curve& c) { c.y.pop_back(); });
  rejects_curve([](Curve& c) { c.low.pop_back(); });
  rejects_curve([](Curve& c) { c.high.clear(); });
  rejects_curve([](Curve& c) { c.x[0] = std::nan(""); });
  rejects_curve([](Curve& c) { c.y[0] = std::numeric_limits<double>::infinity(); });
  EXPECT_THROW((void)figure_json(CurveFigure{}), std::invalid_argument);
}

}  // namespace
}  // namespace banyan::study
