// SPDX-License-Identifier: MIT
// Figures from end to end: the script, the pictures, their texts, and everything that can go wrong.
#include "banyan/study/figure.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

#include "../../src/figure/figure_text.hpp"
#include "../temporary_folder.hpp"
#include "banyan/world/random.hpp"

namespace banyan::study {
namespace {

namespace fs = std::filesystem;

class Figure : public ::testing::Test {
 protected:
  Figure() {
    std::string name = (fs::temp_directory_path() / "banyan figures XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
    folder = name;
  }
  ~Figure() override {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  [[nodiscard]] std::string at(const std::string& name) const { return (folder / name).string(); }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : fs::directory_iterator(folder)) result.push_back(entry.path().filename().string());
    std::sort(result.begin(), result.end());
    return result;
  }

  fs::path folder;
};
using FigureDraw = Figure;
using FigureErrors = Figure;

// As PATH for one scope.
class Path {
 public:
  explicit Path(const std::string& value) {
    if (const char* before = std::getenv("PATH")) before_ = before;
    ::setenv("PATH", value.c_str(), 1);
  }
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;
  ~Path() { ::setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

std::vector<double> runs(std::uint64_t seed, std::size_t count, double from, double to) {
  std::vector<double> values;
  for (std::uint64_t i = 0; i < count; ++i) {
    values.push_back(from + (to - from) * world::to_uniform(world::mix(world::mix(~seed) + i)));
  }
  return values;
}

BoxRuns box_of(std::vector<double> values, std::size_t missed = 0) { return {std::move(values), missed}; }

BoxFigure small_figure() {
  BoxFigure figure;
  figure.x_label = "redundancy k";
  figure.measures = {{"completion time", Scale::linear, {}, {}, {}, {}}};
  figure.groups = {"1", "2"};
  figure.series = {{"outwards", {}, 0}, {"inwards", {}, 0}};
  figure.panels = {
      {"r = 3 m", 0, {{box_of({7, 100, 3, 1, 10, 5, 2, 8, 4, 6, 9}), box_of({4})}, {box_of({}), box_of({2, 2, 2})}}}};
  return figure;
}

BoxFigure large(std::size_t panels, std::size_t groups, std::size_t series, const std::string& group_name,
                std::size_t missed = 0) {
  BoxFigure figure;
  figure.title = "A title that says at some length what is shown here, and for which algorithms";
  figure.x_label = "targets and redundancy";
  figure.measures = {{"completion time / limit", Scale::linear, {}, {}, {}, {}}};
  figure.columns = 3;
  for (std::size_t g = 0; g < groups; ++g) figure.groups.push_back(group_name + std::to_string(g + 1));
  for (std::size_t s = 0; s < series; ++s) figure.series.push_back({"algorithm " + std::to_string(s + 1), {}, 0});
  for (std::size_t p = 0; p < panels; ++p) {
    Panel panel{"communication range r = " + std::to_string(3 * p) + " m, with obstacles", 0, {}};
    for (std::size_t g = 0; g < groups; ++g) {
      panel.boxes.emplace_back();
      for (std::size_t s = 0; s < series; ++s)
        panel.boxes.back().push_back(box_of(runs(p * 100 + g * 10 + s, 20, 0.1, 1.0), missed));
    }
    figure.panels.push_back(panel);
  }
  return figure;
}

// Groups of two levels, and several measures.
BoxFigure nested(bool grid) {
  BoxFigure figure = large(grid ? 4 : 3, 6, 4, "");
  figure.title.clear();
  for (std::size_t g = 0; g < 6; ++g) figure.groups[g] = std::to_string(g % 3 + 2);
  figure.outer = {{"targets T", {"2", "2", "2", "3", "3", "3"}},
                  {"a longer name of what is off", std::vector<std::string>(6, "on")}};
  figure.columns = grid ? 2 : 1;
  figure.grid = grid;
  figure.measures = {{grid ? "completion time / that of convoy" : "", Scale::log, {}, {}, 1.0, {}},
                     {grid ? "share of time with a broken edge" : "", Scale::linear, {}, {}, {}, {}}};
  for (std::size_t p = 0; p < figure.panels.size(); ++p) figure.panels[p].measure = p / (grid ? 2 : 1) % 2;
  figure.panels[0].boxes[1][2].missed = 7;
  return figure;
}

CurveFigure curves() {
  CurveFigure figure;
  figure.x_label = "generation";
  figure.y_label = "fitness";
  for (int c = 0; c < 4; ++c) {
    Curve curve{"island " + std::to_string(c + 1), {}, {}, {}, {}, c == 1};
    for (int x = 0; x <= 20; ++x) {
      curve.x.push_back(x);
      curve.y.push_back(1.0 - std::exp(-0.1 * (c + 1) * x));
      curve.low.push_back(curve.y.back() * 0.9);
      curve.high.push_back(curve.y.back() * 1.05);
    }
    figure.curves.push_back(curve);
  }
  figure.curves[3].low.clear();
  figure.curves[3].high.clear();
  return figure;
}

// The rows of numbers in a $block of the script.
std::vector<std::vector<double>> rows(const std::string& script, const std::string& block) {
  std::vector<std::vector<double>> result;
  std::istringstream lines(script);
  std::string line;
  while (std::getline(lines, line) && line != block + " << EOD") {}
  while (std::getline(lines, line) && line != "EOD") {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    result.emplace_back();
    for (std::string word; words >> word;) result.back().push_back(word == "NaN" ? std::nan("") : std::stod(word));
  }
  return result;
}

// ---- reading an SVG

bool is_entity(const std::string& text, std::size_t at) {
  static constexpr std::array<std::string_view, 6> names{"&amp;", "&lt;", "&gt;", "&quot;", "&apos;", "&#"};
  return std::any_of(names.begin(), names.end(),
                     [&](std::string_view name) { return text.compare(at, name.size(), name) == 0; });
}

// Elements nest and close, and no bare "&": what gnuplot's output could get wrong with our texts.
testing::AssertionResult well_formed(const std::string& svg) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < svg.size(); ++i) {
    if (svg[i] == '&' && !is_entity(svg, i)) return testing::AssertionFailure() << "bare & at " << i;
    if (svg[i] != '<') continue;
    if (svg.compare(i, 4, "<!--") == 0) {
      i = svg.find("-->", i);
      continue;
    }
    const std::size_t end = svg.find('>', i);
    if (end == std::string::npos) return testing::AssertionFailure() << "open tag at " << i;
    const std::string tag = svg.substr(i + 1, end - i - 1);
    if (tag.find('<') != std::string::npos) return testing::AssertionFailure() << "bare < in " << tag;
    const std::string name =
        tag.substr(tag[0] == '/' ? 1 : 0, tag.find_first_of(" \t\n\r/", 1) - (tag[0] == '/' ? 1 : 0));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != name) return testing::AssertionFailure() << "unexpected </" << name << ">";
      open.pop_back();
    } else if (tag[0] != '?' && tag[0] != '!' && tag.back() != '/') {
      open.push_back(name);
    }
    i = end;
  }
  return open.empty() ? testing::AssertionSuccess() : testing::AssertionFailure() << "open <" << open.back() << ">";
}

std::string unescaped(std::string text) {
  for (const auto& [entity, character] : std::vector<std::pair<std::string, std::string>>{
           {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}, {"&amp;", "&"}}) {
    for (std::size_t i = text.find(entity); i != std::string::npos; i = text.find(entity, i + 1)) {
      text.replace(i, entity.size(), character);
    }
  }
  return text;
}

struct Point {
  double x, y;
};
struct Text {
  std::string text;
  std::array<Point, 4> corners;  // of the box around its letters
};

double attribute(const std::string& tag, const std::string& before) {
  const std::size_t at = tag.find(before);
  return at == std::string::npos ? 0.0 : std::stod(tag.substr(at + before.size()));
}

std::vector<Text> texts(const std::string& svg) {
  std::vector<Text> result;
  for (std::size_t i = svg.find("<text>"); i != std::string::npos; i = svg.find("<text>", i + 1)) {
    const std::string text = unescaped(svg.substr(i + 6, svg.find("</text>", i) - i - 6));
    const std::string tag = svg.substr(svg.rfind("<g transform", i), i - svg.rfind("<g transform", i));
    if (text.empty()) continue;
    const std::size_t comma = tag.find(',');
    const Point at{attribute(tag, "translate("), std::stod(tag.substr(comma + 1))};
    const double turn = attribute(tag, "rotate(") * std::acos(-1.0) / 180.0;
    const double size = attribute(tag, "font-size=\"");
    const double width = text_width(text, size);
    const double from = tag.find("\"end\"") != std::string::npos      ? -width
                        : tag.find("\"middle\"") != std::string::npos ? -width / 2.0
                                                                      : 0.0;
    Text found{text, {}};
    const std::array<Point, 4> flat{
        {{from, -0.75 * size}, {from + width, -0.75 * size}, {from + width, 0.2 * size}, {from, 0.2 * size}}};
    for (std::size_t c = 0; c < 4; ++c) {
      found.corners[c] = {at.x + std::cos(turn) * flat[c].x - std::sin(turn) * flat[c].y,
                          at.y + std::sin(turn) * flat[c].x + std::cos(turn) * flat[c].y};
    }
    result.push_back(found);
  }
  return result;
}

// Two rectangles are apart if they are along a side of one of them.
bool apart_along_sides(const Text& a, const Text& b) {
  for (std::size_t side = 0; side < 2; ++side) {
    const Point axis{a.corners[side + 1].x - a.corners[side].x, a.corners[side + 1].y - a.corners[side].y};
    const auto range = [&](const Text& t) {
      std::array<double, 4> at{};
      for (std::size_t c = 0; c < 4; ++c) at[c] = axis.x * t.corners[c].x + axis.y * t.corners[c].y;
      return std::pair(*std::min_element(at.begin(), at.end()), *std::max_element(at.begin(), at.end()));
    };
    const auto [a_low, a_high] = range(a);
    const auto [b_low, b_high] = range(b);
    if (a_high < b_low || b_high < a_low) return true;
  }
  return false;
}

void expect_texts_apart(const std::string& svg) {
  const std::vector<Text> all = texts(svg);
  EXPECT_GT(all.size(), 5U);
  const double width = attribute(svg, "width=\""), height = attribute(svg, "height=\"");
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const Point& corner : all[i].corners) {
      EXPECT_TRUE(corner.x >= 0.0 && corner.x <= width && corner.y >= 0.0 && corner.y <= height)
          << all[i].text << " leaves the picture at " << corner.x << ", " << corner.y;
    }
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_TRUE(apart_along_sides(all[i], all[j]) || apart_along_sides(all[j], all[i]))
          << "\"" << all[i].text << "\" touches \"" << all[j].text << "\"";
    }
  }
}

bool shows(const std::string& svg, const std::string& text) {
  const std::vector<Text> all = texts(svg);
  return std::any_of(all.begin(), all.end(), [&](const Text& t) { return t.text == text; });
}

// Width and height of the page of a PDF, points.
std::pair<double, double> pdf_size(const std::string& pdf) {
  const std::string box = "MediaBox [ 0 0 ";
  const std::size_t at = pdf.find(box);
  if (!pdf.starts_with("%PDF-1.") || at == std::string::npos) return {0.0, 0.0};
  std::istringstream numbers(pdf.substr(at + box.size(), 40));
  double width = 0.0, height = 0.0;
  numbers >> width >> height;
  return {width, height};
}

// Width and height of a PNG, from its first chunk.
std::pair<double, double> png_size(const std::string& png) {
  if (png.compare(0, 8, "\x89PNG\r\n\x1a\n") != 0 || png.size() < 24) return {0.0, 0.0};
  const auto natural = [&](std::size_t at) {
    double value = 0.0;
    for (std::size_t i = 0; i < 4; ++i) value = 256.0 * value + static_cast<std::uint8_t>(png[at + i]);
    return value;
  };
  return {natural(16), natural(20)};
}

// ---- what is drawn

TEST_F(FigureDraw, WritesTheNumbersOfTheBoxes) {
  draw(small_figure(), at("time"));
  const std::string script = contents(at("time.gp"));
  // quantile(c(1:10, 100), c(.25, .5, .75)) in R: 3.5, 6, 8.5.
  const auto first = rows(script, "$box_1_1"), second = rows(script, "$box_1_2"), points = rows(script, "$out_1_1");
  ASSERT_EQ(first.size(), 1U) << "no box for no values";
  EXPECT_EQ(std::vector<double>(first[0].begin() + 1, first[0].end()),
            (std::vector<double>{1, 3.5, 6, 8.5, 10, 11, 0}));
  ASSERT_EQ(second.size(), 2U);
  EXPECT_EQ(std::vector<double>(second[0].begin() + 1, second[0].end()), (std::vector<double>{4, 4, 4, 4, 4, 1, 0}));
  EXPECT_EQ(std::vector<double>(second[1].begin() + 1, second[1].end()), (std::vector<double>{2, 2, 2, 2, 2, 3, 0}));
  // Beside each other within their group, the point above its box.
  EXPECT_LT(first[0][0], 1.0);
  EXPECT_GT(second[0][0], 1.0);
  EXPECT_NEAR(second[1][0] - second[0][0], 1.0, 1e-9);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0][0], first[0][0], 0.1);
  EXPECT_EQ(points[0][1], 100.0);
  EXPECT_EQ(script.find("$out_1_2"), std::string::npos);
}

TEST_F(FigureDraw, MakesFourFilesAndNothingElse) {
  draw(small_figure(), at("time"));
  EXPECT_EQ(names(), (std::vector<std::string>{"time.gp", "time.pdf", "time.png", "time.svg"}));
  const std::string svg = contents(at("time.svg"));
  EXPECT_TRUE(well_formed(svg));
  for (const char* text :
       {"redundancy k", "completion time", "1", "2", "outwards", "inwards", "r = 3 m", "n = 1–11 runs each"}) {
    EXPECT_TRUE(shows(svg, text)) << text;
  }
}

TEST_F(FigureDraw, HasTheSameSizeInAllFormats) {
  for (const double inches : {3.5, 7.0}) {
    BoxFigure figure = small_figure();
    figure.width_in = inches;
    draw(figure, at("time"));
    EXPECT_EQ(width_in(figure), inches);
    const std::string svg = contents(at("time.svg"));
    const auto [width, height] = pdf_size(contents(at("time.pdf")));
    EXPECT_EQ(width, 72.0 * inches);
    EXPECT_NEAR(attribute(svg, "width=\""), 96.0 / 72.0 * width, 0.5);
    EXPECT_NEAR(attribute(svg, "height=\""), 96.0 / 72.0 * height, 0.5);
    const auto [pixels, lines] = png_size(contents(at("time.png")));
    EXPECT_EQ(pixels, 300.0 * inches);
    EXPECT_NEAR(lines, 300.0 / 72.0 * height, 0.5);
  }
}

TEST_F(FigureDraw, HasOneFontOfEightPoints) {
  draw(large(3, 3, 2, "group ", 1), at("font"));
  const std::string svg = contents(at("font.svg")), pdf = contents(at("font.pdf"));
  std::size_t found = 0;
  for (std::size_t i = svg.find("font-family="); i != std::string::npos; i = svg.find("font-family=", i + 1), ++found) {
    EXPECT_EQ(svg.substr(i, 24), "font-family=\"sans-serif\"");
    EXPECT_NEAR(attribute(svg.substr(i, 80), "font-size=\""), 8.0 * 96.0 / 72.0, 0.01);
  }
  EXPECT_GT(found, 10U);
  EXPECT_EQ(svg.find("font-weight"), std::string::npos);
  found = 0;
  for (std::size_t i = pdf.find("BaseFont /"); i != std::string::npos; i = pdf.find("BaseFont /", i + 1), ++found)
    EXPECT_EQ(pdf.substr(i + 16, 11), "+DejaVuSans");
  EXPECT_GT(found, 0U);
}

TEST_F(FigureDraw, IsAsWideAsItsBoxesNeed) {
  EXPECT_EQ(width_in(small_figure()), 3.5);
  EXPECT_EQ(width_in(large(3, 3, 2, "g")), 7.0) << "panels side by side";
  EXPECT_EQ(width_in(large(1, 12, 3, "g")), 7.0) << "too many for a column";
  BoxFigure narrow = large(3, 3, 2, "g");
  narrow.columns = 1;
  EXPECT_EQ(width_in(narrow), 3.5);
}

// Where boxes of three panels side by side would be too thin, the panels are one below the other.
TEST_F(FigureDraw, HasFewerColumnsWhereBoxesWouldBeTooThin) {
  const auto tops = [&](std::size_t groups) {
    draw(large(3, groups, 3, ""), at("columns"));
    std::set<double> found;
    for (const Text& text : texts(contents(at("columns.svg"))))
      if (text.text.starts_with("communication range")) found.insert(std::round(text.corners[0].y));
    return found.size();
  };
  EXPECT_EQ(tops(3), 1U);
  EXPECT_EQ(tops(9), 3U);
}

// ---- misses

TEST_F(FigureDraw, RunsThatMissedAreLaterThanAllOthers) {
  BoxFigure figure = small_figure();
  figure.panels[0].boxes[0][0] = box_of({1, 2, 3, 4, 5}, 4);  // of nine: quartiles are the 3rd, 5th and 7th
  figure.panels[0].boxes[0][1] = box_of({1, 2}, 8);           // no box is left
  figure.panels[0].boxes[1][0] = box_of({}, 3);
  draw(figure, at("time"));
  const double late = 9e99;
  const auto first = rows(contents(at("time.gp")), "$box_1_1"), second = rows(contents(at("time.gp")), "$box_1_2");
  const auto numbers = [](const std::vector<double>& row) { return std::vector<double>(row.begin() + 1, row.end()); };
  EXPECT_EQ(numbers(first.at(0)), (std::vector<double>{1, 3, 5, late, late, 9, 4}));
  EXPECT_EQ(numbers(first.at(1)), (std::vector<double>{late, late, late, late, late, 3, 3}));
  EXPECT_EQ(numbers(second.at(0)), (std::vector<double>{late, late, late, late, late, 10, 8}));
  EXPECT_EQ(rows(contents(at("time.gp")), "$out_1_2").size(), 2U) << "what there is of values, as points";
  const std::string svg = contents(at("time.svg"));
  for (const char* text : {"missed", "4/9", "8/10", "3/3", "n = 3–10 runs each"}) EXPECT_TRUE(shows(svg, text)) << text;
  EXPECT_FALSE(shows(contents(at("time.svg")), "0/3"));
}

// The number stands at the middle of its box, found by the left and right ends of the panel.
TEST_F(FigureDraw, TheNumberOfMissesIsAboveItsBox) {
  for (const std::size_t series : {1U, 4U, 10U}) {
    BoxFigure figure = large(1, 3, series, "");
    const std::size_t s = series - 1;
    if (s > 0) figure.panels[0].boxes[1][s - 1].missed = 5;  // beside it: no room for both on a line
    figure.panels[0].boxes[1][s].missed = 3;
    draw(figure, at("misses"));
    const auto box = rows(contents(at("misses.gp")), "$box_1_" + std::to_string(series)).at(1);
    const std::vector<Text> all = texts(contents(at("misses.svg")));
    const auto middle = [&](const std::string& wanted) {
      const auto text = std::find_if(all.begin(), all.end(), [&](const Text& t) { return t.text == wanted; });
      EXPECT_NE(text, all.end()) << wanted;
      return text == all.end() ? 0.0 : (text->corners[0].x + text->corners[2].x) / 2.0;
    };
    // The labels of groups 1 and 3 are at 1 and 3 on the axis.
    const double pitch = (middle("3") - middle("1")) / 2.0;
    const double number = middle("3/23");
    EXPECT_NEAR(number, middle("1") + (box[0] - 1.0) * pitch, 3.0) << series;
    expect_texts_apart(contents(at("misses.svg")));
  }
}

TEST_F(FigureDraw, TooManyBoxesForNumbersHaveBars) {
  draw(large(1, 30, 3, "g", 5), at("bars"));
  const std::string svg = contents(at("bars.svg")), script = contents(at("bars.gp"));
  EXPECT_TRUE(shows(svg, "missed"));
  EXPECT_FALSE(shows(svg, "5/25"));
  std::size_t bars = 0;
  for (std::size_t i = script.find("fs solid 1.0"); i != std::string::npos; i = script.find("fs solid 1.0", i + 1))
    ++bars;
  EXPECT_EQ(bars, 90U);
  EXPECT_EQ(script.find("candlesticks"), std::string::npos) << "points and lines instead of boxes";
}

// ---- scales

TEST_F(FigureDraw, ALogarithmicAxisShowsZerosAtItsEnd) {
  BoxFigure figure = small_figure();
  figure.measures[0].scale = Scale::log;
  draw(figure, at("log"));
  EXPECT_NE(contents(at("log.gp")).find(" set logscale y"), std::string::npos);
  EXPECT_FALSE(shows(contents(at("log.svg")), "0"));
  figure.panels[0].boxes[1][1] = box_of({0.0, 0.0, 2.0});
  draw(figure, at("log"));
  EXPECT_TRUE(shows(contents(at("log.svg")), "0"));
  figure.measures[0].scale = Scale::linear;
  draw(figure, at("linear"));
  EXPECT_EQ(contents(at("linear.gp")).find(" set logscale y"), std::string::npos);
}

TEST_F(FigureDraw, SharesAreShownWithTheirInterval) {
  BoxFigure figure = small_figure();
  figure.measures[0].share_confidence = 0.95;
  figure.panels[0].boxes = {{box_of({1, 1, 1, 0, 1, 1, 1, 1, 1, 1}), box_of({})}, {box_of({}), box_of({0, 0})}};
  draw(figure, at("share"));
  const auto row = rows(contents(at("share.gp")), "$box_1_1").at(0);
  // Wilson's interval of 9 in 10, as in R's prop.test(9, 10, correct = FALSE): 0.596 to 0.982.
  EXPECT_NEAR(row[1], 0.59585, 1e-4);
  EXPECT_EQ(row[3], 0.9);
  EXPECT_NEAR(row[5], 0.98212, 1e-4);
  figure.panels[0].boxes[0][0].values[0] = 0.5;
  EXPECT_THROW(draw(figure, at("share")), std::invalid_argument);
}

TEST_F(FigureDraw, TextsNeverOverlap) {
  int n = 0;
  for (const BoxFigure& figure :
       {large(3, 9, 2, "T = 2, k = "), large(9, 3, 3, ""), large(5, 4, 8, "two obstacles "), large(5, 12, 1, "group "),
        large(1, 2, 1, "a very long name of one group that is far too long "), large(2, 30, 3, "g"), nested(false),
        nested(true), large(3, 4, 2, "", 3), large(1, 4, 7, "", 30), large(2, 3, 12, "group ", 12)}) {
    const std::string stem = at(std::to_string(++n));
    SCOPED_TRACE(n);
    draw(figure, stem);
    expect_texts_apart(contents(stem + ".svg"));
  }
  draw(curves(), at("curves"));
  expect_texts_apart(contents(at("curves.svg")));
}

TEST_F(FigureDraw, LabelsAreOnTheEdgesOnly) {
  draw(large(6, 3, 1, "group "), at("edges"));
  const std::vector<Text> all = texts(contents(at("edges.svg")));
  const auto count = [&](const std::string& text) {
    return std::count_if(all.begin(), all.end(), [&](const Text& t) { return t.text == text; });
  };
  EXPECT_EQ(count("group 2"), 3) << "below the last row";
  EXPECT_EQ(count("0.5"), 2) << "left of the first column";
  EXPECT_EQ(count("algorithm 1"), 1) << "one legend";
}

TEST_F(FigureDraw, GroupsHaveOuterLabels) {
  draw(nested(false), at("outer"));
  const std::string svg = contents(at("outer.svg"));
  EXPECT_TRUE(shows(svg, "targets T = 2") && shows(svg, "targets T = 3"));
  EXPECT_TRUE(shows(svg, "a longer name of what is off on"));
  BoxFigure thin = nested(false);
  thin.width_in = 3.5;
  thin.outer[0].title = "how many targets there are in all, T";
  draw(thin, at("outer"));
  EXPECT_FALSE(shows(contents(at("outer.svg")), "how many targets there are in all, T = 2"));
  EXPECT_NE(contents(at("outer.gp")).find("below it, how many targets"), std::string::npos);
}

TEST_F(FigureDraw, AnEmptyPlaceInAGridHasNoAxes) {
  BoxFigure figure = nested(true);
  draw(figure, at("full"));
  EXPECT_FALSE(shows(contents(at("full.svg")), "no runs"));
  for (auto& group : figure.panels[3].boxes) std::fill(group.begin(), group.end(), BoxRuns{});
  draw(figure, at("grid"));
  EXPECT_TRUE(shows(contents(at("grid.svg")), "no runs"));
  const std::string script = contents(at("grid.gp"));
  EXPECT_LT(script.find("unset border"), script.find("\"no runs\""));
  EXPECT_EQ(script.find("unset border"), script.rfind("unset border"));
  expect_texts_apart(contents(at("grid.svg")));
}

// A group for each series needs no legend, and its box stands in the middle.
TEST_F(FigureDraw, NamesBelowTheBoxesReplaceTheLegend) {
  BoxFigure figure = small_figure();
  figure.groups = {"outwards", "inwards"};
  figure.panels[0].boxes = {{box_of({1, 2, 3}), box_of({})}, {box_of({}), box_of({2, 3, 4})}};
  draw(figure, at("names"));
  const std::vector<Text> all = texts(contents(at("names.svg")));
  EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const Text& t) { return t.text == "inwards"; }), 1);
  EXPECT_EQ(rows(contents(at("names.gp")), "$box_1_2").at(0)[0], 2.0);
}

TEST_F(FigureDraw, ASeriesHasTheLookItIsGiven) {
  BoxFigure figure = small_figure();
  figure.series[0].style = 4;
  figure.series[1] = {"inwards, tuned", 4, 1};
  draw(figure, at("looks"));
  const std::string script = contents(at("looks.gp"));
  const auto fill_of = [&](const std::string& data) {
    const std::size_t at = script.find(data + " using (within($1, $2)):(show($3))");
    const std::string plot = script.substr(at, script.find("notitle", at) - at);
    EXPECT_NE(plot.find("#e69f00"), std::string::npos) << plot;
    return attribute(plot, "fs solid ");
  };
  EXPECT_GE(std::fabs(fill_of("$box_1_1") - fill_of("$box_1_2")), 0.2) << "told apart by the fill";
}

TEST_F(FigureDraw, CurvesHoldTheirDataAndGaps) {
  CurveFigure figure = curves();
  figure.curves[0].y[3] = std::numeric_limits<double>::quiet_NaN();
  draw(figure, at("fitness"));
  const std::string script = contents(at("fitness.gp"));
  const auto first = rows(script, "$curve_1");
  ASSERT_EQ(first.size(), 21U);
  EXPECT_TRUE(std::isnan(first[3][1]));
  EXPECT_EQ(first[7],
            (std::vector<double>{7, figure.curves[0].y[7], figure.curves[0].low[7], figure.curves[0].high[7]}));
  EXPECT_EQ(rows(script, "$curve_4")[0].size(), 2U) << "no band";
  const std::string svg = contents(at("fitness.svg"));
  EXPECT_TRUE(well_formed(svg));
  for (const char* text : {"island 1", "island 4", "generation", "fitness"}) EXPECT_TRUE(shows(svg, text)) << text;
}

TEST_F(FigureDraw, DrawsWhatIsEmpty) {
  BoxFigure boxes = small_figure();
  for (auto& group : boxes.panels[0].boxes) {
    for (auto& box : group) box.values.clear();
  }
  draw(boxes, at("boxes"));
  EXPECT_TRUE(well_formed(contents(at("boxes.svg"))));
  CurveFigure lines;
  lines.curves = {Curve{}, Curve{"gap", {1.0}, {std::nan("")}, {std::nan("")}, {std::nan("")}, true}};
  draw(lines, at("lines"));
  EXPECT_TRUE(well_formed(contents(at("lines.svg"))));
}

TEST_F(FigureDraw, SameDataSameBytes) {
  draw(large(2, 3, 2, "g"), at("one"));
  const std::string script = contents(at("one.gp")), svg = contents(at("one.svg"));
  draw(large(2, 3, 2, "g"), at("one"));
  EXPECT_EQ(contents(at("one.gp")), script);
  EXPECT_EQ(contents(at("one.svg")), svg);
}

TEST_F(FigureDraw, TheKeptScriptDrawsTheSameByHand) {
  draw(small_figure(), at("time"));
  const std::string svg = contents(at("time.svg"));
  fs::remove(at("time.svg"));
  fs::remove(at("time.png"));
  fs::remove(at("time.pdf"));
  // As a user would: NOLINTNEXTLINE(cert-env33-c)
  ASSERT_EQ(std::system(("cd '" + folder.string() + "' && gnuplot -d time.gp").c_str()), 0);
  EXPECT_EQ(contents(at("time.svg")), svg);
  EXPECT_TRUE(fs::exists(at("time.png")));
  EXPECT_EQ(pdf_size(contents(at("time.pdf"))).first, 252.0);
}

// ---- texts that could do harm

TEST_F(FigureDraw, TextsAreTextsWhateverTheyHold) {
  const std::string harm = at("harm");
  const std::vector<std::string> evil{"it's \"quoted\" {/Bold x}_a^b $x @output", "\"; system('touch " + harm + "')",
                                      "'; system('touch " + harm + "') #", "`touch " + harm + "`",
                                      "a\\b %s <b> & &amp; é λ₂ EOD }"};
  BoxFigure figure = small_figure();
  figure.width_in = 7.0;
  figure.title = evil[0] + "\n" + evil[1] + "\n" + evil[2] + "\n" + evil[3] + "\n" + evil[4] + "\\";
  figure.x_label = evil[1];
  figure.measures[0].label = evil[4];
  figure.groups = {"{a}_1", "EOD\n'"};
  figure.series = {{evil[0], {}, 0}, {"`x` 50%", {}, 0}};
  figure.panels[0].title = "a\x01\xff";
  for (const std::string& name : {std::string("plain"), std::string("-e it's a \"name\" `x` $(y) @output λ {1}"),
                                  std::string("|touch harm"), std::string("<touch harm"), std::string("new\nline")}) {
    SCOPED_TRACE(name);
    draw(figure, at(name));
    EXPECT_FALSE(fs::exists(harm));
    const std::string svg = contents(at(name + ".svg"));
    EXPECT_TRUE(well_formed(svg));
    EXPECT_TRUE(png_size(contents(at(name + ".png"))).first > 0.0);
    for (const std::string& text : {evil[0], evil[4], std::string("{a}_1"), std::string("'"), std::string("`x` 50%")}) {
      EXPECT_TRUE(shows(svg, text)) << text;
    }
  }
  EXPECT_EQ(names().size(), 20U);
}

TEST_F(FigureDraw, AStemMayBeRelative) {
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  draw(small_figure(), "-time");
  fs::current_path(before);
  EXPECT_EQ(names(), (std::vector<std::string>{"-time.gp", "-time.pdf", "-time.png", "-time.svg"}));
}

// ---- what can go wrong

TEST_F(FigureErrors, WithoutGnuplotTheScriptIsThere) {
  const Path path("/nonexistent");
  try {
    draw(small_figure(), at("time"));
    FAIL() << "no error";
  } catch (const FigureError& error) {
    EXPECT_NE(std::string(error.what()).find("not installed"), std::string::npos) << error.what();
  }
  EXPECT_EQ(names(), (std::vector<std::string>{"time.gp"}));
  EXPECT_EQ(rows(contents(at("time.gp")), "$box_1_1").size(), 1U);
}

// A program called gnuplot, `body` of a shell script, first in PATH.
class FigureStandIn : public Figure {
 protected:
  void stand_in(const std::string& body) const {
    fs::create_directories(folder / "bin");
    std::ofstream(folder / "bin/gnuplot") << "#!/bin/sh\n" << body;
    ::chmod((folder / "bin/gnuplot").c_str(), 0755);
  }
  [[nodiscard]] std::string error_of(const std::string& body) const {
    stand_in(body);
    const Path path((folder / "bin").string() + ":" + std::getenv("PATH"));
    try {
      draw(small_figure(), at("time"));
    } catch (const FigureError& error) { return error.what(); }
    return "";
  }
};

TEST_F(FigureStandIn, TellsWhatGnuplotSaid) {
  const std::string error = error_of("echo 'line 7: no such terminal' >&2; exit 3");
  EXPECT_NE(error.find("line 7: no such terminal"), std::string::npos) << error;
  EXPECT_NE(error.find("status 3"), std::string::npos) << error;
  EXPECT_NE(error.find("time.gp"), std::string::npos) << error;
  EXPECT_NE(error_of("kill -9 $$").find("signal 9"), std::string::npos);
  EXPECT_TRUE(fs::exists(at("time.gp")));
}

TEST_F(FigureStandIn, ALotOfMessagesDoNotBlock) {
  const std::string error = error_of(
      "i=0; while [ $i -lt 3000 ]; do echo 'a rather long line of an error message'; i=$((i+1)); done; exit 1");
  EXPECT_GT(error.size(), 1000U);
  EXPECT_LT(error.size(), 10000U);
}

TEST_F(FigureStandIn, HalfAPictureDoesNotReplaceAWholeOne) {
  draw(small_figure(), at("time"));
  const std::string svg = contents(at("time.svg")), png = contents(at("time.png")), pdf = contents(at("time.pdf"));
  EXPECT_NE(error_of("exit 0").find("did not draw"), std::string::npos);
  EXPECT_NE(error_of("echo '<svg>' > \"$4.svg\"; echo > \"$4.png\"").find("half"), std::string::npos);
  const std::string whole_svg = "echo '<svg></svg>' > \"$4.svg\"; ";
  EXPECT_NE(error_of(whole_svg + "echo %PDF > \"$4.pdf\"; : > \"$4.png\"").find("half of figure.pdf"),
            std::string::npos);
  EXPECT_NE(error_of(whole_svg + "echo %%EOF > \"$4.pdf\"; : > \"$4.png\"").find("half of figure.png"),
            std::string::npos);
  EXPECT_EQ(contents(at("time.svg")), svg);
  EXPECT_EQ(contents(at("time.png")), png);
  EXPECT_EQ(contents(at("time.pdf")), pdf);
  EXPECT_EQ(names(), (std::vector<std::string>{"bin", "time.gp", "time.pdf", "time.png", "time.svg"}));
}

TEST_F(FigureErrors, AFolderThatIsNotThere) {
  EXPECT_THROW(draw(small_figure(), at("missing/time")), record::FileError);
  EXPECT_THROW(draw(curves(), at("missing/time")), record::FileError);
  EXPECT_THROW(draw(small_figure(), folder.string() + "/"), record::FileError);
  EXPECT_THROW(draw(small_figure(), ""), record::FileError);
  EXPECT_TRUE(names().empty());
}

TEST_F(FigureErrors, APictureThatCannotBeReplaced) {
  fs::create_directory(at("time.png"));  // permissions would not stop root
  EXPECT_THROW(draw(small_figure(), at("time")), record::FileError);
}

TEST_F(FigureErrors, FiguresThatCannotBeDrawn) {
  const auto rejects = [&](auto change) {
    BoxFigure figure = small_figure();
    change(figure);
    EXPECT_THROW(draw(figure, at("time")), std::invalid_argument);
  };
  rejects([](BoxFigure& f) { f.series.clear(); });
  rejects([](BoxFigure& f) { f.series.resize(13); });
  rejects([](BoxFigure& f) { f.series[0].style = 12; });
  rejects([](BoxFigure& f) { f.series[0].variant = 8; });
  rejects([](BoxFigure& f) { f.measures.clear(); });
  rejects([](BoxFigure& f) { f.panels[0].measure = 1; });
  rejects([](BoxFigure& f) { f.outer = {{"T", {"2"}}}; });
  rejects([](BoxFigure& f) { f.width_in = 0.5; });
  rejects([](BoxFigure& f) { f.measures[0].scale = Scale::log, f.measures[0].minimum = 0.0; });
  rejects([](BoxFigure& f) { f.groups.clear(); });
  rejects([](BoxFigure& f) { f.groups.push_back("3"); });
  rejects([](BoxFigure& f) { f.panels.clear(); });
  rejects([](BoxFigure& f) { f.columns = 0; });
  rejects([](BoxFigure& f) { f.panels[0].boxes[0].pop_back(); });
  rejects([](BoxFigure& f) { f.panels[0].boxes[0][0].values[0] = std::numeric_limits<double>::quiet_NaN(); });
  rejects([](BoxFigure& f) { f.measures[0].minimum = std::numeric_limits<double>::infinity(); });
  rejects([](BoxFigure& f) { f.measures[0].minimum = 2.0, f.measures[0].maximum = 2.0; });
  const auto rejects_curve = [&](auto change) {
    CurveFigure figure = curves();
    change(figure.curves[0]);
    EXPECT_THROW(draw(figure, at("time")), std::invalid_argument);
  };
  rejects_curve([](Curve& c) { c.y.pop_back(); });
  rejects_curve([](Curve& c) { c.low.pop_back(); });
  rejects_curve([](Curve& c) { c.high.clear(); });
  rejects_curve([](Curve& c) { c.x[0] = std::nan(""); });
  rejects_curve([](Curve& c) { c.y[0] = std::numeric_limits<double>::infinity(); });
  EXPECT_THROW(draw(CurveFigure{}, at("time")), std::invalid_argument);
  EXPECT_TRUE(names().empty());
}

}  // namespace
}  // namespace banyan::study
