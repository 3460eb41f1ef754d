// SPDX-License-Identifier: MIT
// The script of a figure of box plots.
#include <algorithm>
#include <cmath>

#include "box_layout.hpp"
#include "box_numbers.hpp"
#include "figure_check.hpp"
#include "figure_script.hpp"
#include "figure_scripts.hpp"
#include "figure_text.hpp"

namespace banyan::study {

namespace {

constexpr double box_share = 0.80;   // of a series' slot that its box fills
constexpr double widest_box = 0.36;  // of the distance of groups, for few series

void check(const BoxFigure& figure) {
  require(!figure.series.empty() && figure.series.size() <= most_series, "needs one to eight series");
  require(!figure.groups.empty(), "needs a group");
  require(!figure.panels.empty(), "needs a panel");
  require(figure.columns >= 1, "needs a column");
  require_ends(figure.y_minimum, figure.y_maximum);
  for (const Panel& panel : figure.panels) {
    require(panel.values.size() == figure.groups.size(), "every panel needs values for every group");
    for (const auto& group : panel.values) {
      require(group.size() == figure.series.size(), "every group needs values for every series");
      for (const auto& values : group) {
        const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
        require(finite, "values must be finite");
      }
    }
  }
}

std::string block(const char* kind, std::size_t panel, std::size_t series) {
  return std::string("$") + kind + "_" + std::to_string(panel + 1) + "_" + std::to_string(series + 1);
}

// Boxes of a panel's series, and the points beyond their whiskers.
struct Blocks {
  bool boxes = false, points = false;
};

double box_width(std::size_t series) {
  return std::min(widest_box, box_share * group_share / static_cast<double>(series));
}

// Points of one value would hide each other: the golden ratio spreads them over half the box.
double jitter(std::size_t index) {
  constexpr double golden = 0.61803398874989485;
  const double turn = (static_cast<double>(index) + 0.5) * golden;
  return turn - std::floor(turn) - 0.5;
}

Blocks write_data(Script& script, const BoxFigure& figure, std::size_t panel, std::size_t series) {
  Blocks blocks;
  std::string points;
  const double count = static_cast<double>(figure.series.size());
  const double width = box_width(figure.series.size());
  const double slot = std::min(group_share / count, width / box_share);
  for (std::size_t g = 0; g < figure.groups.size(); ++g) {
    const std::vector<double>& values = figure.panels[panel].values[g][series];
    if (values.empty()) continue;
    const double x = static_cast<double>(g + 1) + (static_cast<double>(series) - (count - 1.0) / 2.0) * slot;
    const BoxNumbers box = numbers_of(values);
    if (!blocks.boxes)
      script.begin_data(block("box", panel, series), "x low lower_quartile median upper_quartile high");
    blocks.boxes = true;
    script.line(fixed(x, 4) + " " + number(box.low) + " " + number(box.lower) + " " + number(box.median) + " " +
                number(box.upper) + " " + number(box.high));
    for (std::size_t i = 0; i < box.outliers.size(); ++i) {
      points += fixed(x + 0.5 * width * jitter(i), 4) + " " + number(box.outliers[i]) + "\n";
    }
  }
  if (blocks.boxes) script.end_data();
  if (points.empty()) return blocks;
  blocks.points = true;
  script.begin_data(block("out", panel, series), "x value");
  points.pop_back();
  script.line(points);
  script.end_data();
  return blocks;
}

void draw_sheet(Script& script, const BoxLayout& layout, const Legend& legend) {
  const double middle = layout.left + layout.plots_width() / 2.0;
  script.labels(layout.title, {layout.width / 2.0, edge_px + line_px / 2.0}, Align::center, 0, true);
  legend.draw(script, layout.width / 2.0, layout.legend_top, [](Script& to, std::size_t series, Place at) {
    const Style& style = style_of(series);
    const std::string color = "rgb '" + std::string(style.color) + "'";
    to.rectangle({at.x, at.y - 6.0}, swatch_px, 12.0,
                 "fc " + color + " fs " + std::string(style.fill) + " border lc " + color + " lw 1.2");
  });
  script.labels(layout.y_label, {edge_px + line_px / 2.0, layout.top + layout.plots_height() / 2.0}, Align::center, 90);
  script.labels(layout.x_label,
                {middle, layout.top + layout.plots_height() + layout.groups.height + 6.0 + line_px / 2.0},
                Align::center);
}

void draw_texts(Script& script, const BoxFigure& figure, const BoxLayout& layout, std::size_t panel) {
  const Area area = layout.area(panel);
  const auto& title = layout.panel_titles[panel];
  const double title_top = area.top - 6.0 - line_px * static_cast<double>(title.size());
  script.labels(title, {(area.left + area.right) / 2.0, title_top + line_px / 2.0}, Align::center);
  if (panel + layout.columns < figure.panels.size()) return;  // there is a panel below
  const double pitch = layout.panel_width / static_cast<double>(figure.groups.size());
  for (std::size_t g = 0; g < figure.groups.size(); ++g) {
    const double x = area.left + pitch * (static_cast<double>(g) + 0.5);
    const bool level = layout.groups.degrees == 0;
    script.labels(layout.groups.lines[g], {x, area.bottom + (level ? 6.0 + line_px / 2.0 : 9.0)},
                  level ? Align::center : Align::right, layout.groups.degrees);
  }
}

void draw_boxes(Script& script, const BoxFigure& figure, std::size_t panel, const std::vector<Blocks>& blocks) {
  std::string plots = "plot NaN notitle";
  for (std::size_t s = 0; s < figure.series.size(); ++s) {
    if (!blocks[s].boxes) continue;
    const Style& style = style_of(s);
    const std::string color = "rgb '" + std::string(style.color) + "'", data = block("box", panel, s);
    plots += ", \\\n    " + data + " using 1:3:2:6:5:(width) with candlesticks whiskerbars 0.5 lw 1.2 lc " + color +
             " fs " + std::string(style.fill) + " border lc " + color + " notitle";
    // A box without height is only its median line, which then has the colour of its series.
    plots += ", \\\n    " + data + " using ($1-width/2):4:(width):(0):($3==$5 ? 0x" +
             std::string(style.color.substr(1)) + " : 0x1a1a1a) with vectors nohead lw 2.5 lc rgb variable notitle";
  }
  for (std::size_t s = 0; s < figure.series.size(); ++s) {
    if (!blocks[s].points) continue;
    const Style& style = style_of(s);
    plots += ", \\\n    " + block("out", panel, s) + " using 1:2 with points pt " + std::to_string(style.point) +
             " ps 0.35 lc rgb '#60" + std::string(style.color.substr(1)) + "' notitle";
  }
  script.line(plots);
}

}  // namespace

std::string script_of(const BoxFigure& figure, const std::string& name) {
  check(figure);
  const BoxLayout layout = box_layout(figure);

  Script script(layout.width, layout.height);
  script.begin("Boxes: quartiles and median; whiskers: last value within 1.5 times the box; points: values beyond.",
               name);
  script.line("width = " + fixed(box_width(figure.series.size()), 4) + "  # of a box; groups are 1 apart");
  std::vector<std::vector<Blocks>> blocks(figure.panels.size());
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    for (std::size_t s = 0; s < figure.series.size(); ++s) blocks[p].push_back(write_data(script, figure, p, s));
  }
  script.begin_drawing();
  script.line("unset xtics  # the groups have labels");
  script.line("set xrange [0.5:" + fixed(static_cast<double>(figure.groups.size()) + 0.5, 1) + "]");
  script.line("set yrange [" + number(layout.axis.low) + ":" + number(layout.axis.high) + "]");
  script.line("set ytics " + number(layout.axis.first_tick) + ", " + number(layout.axis.step));
  draw_sheet(script, layout, box_legend(figure, layout));
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    script.area(layout.area(p));
    script.line("set format y '" + (p % layout.columns == 0 ? layout.axis.format() : "") + "'");
    draw_texts(script, figure, layout, p);
    draw_boxes(script, figure, p, blocks[p]);
    script.forget_labels();
  }
  script.end_drawing();
  return script.text();
}

}  // namespace banyan::study
