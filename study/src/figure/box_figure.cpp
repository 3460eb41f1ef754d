// SPDX-License-Identifier: MIT
// The script of a figure of box plots.
#include <algorithm>
#include <cmath>

#include "banyan/study/statistics.hpp"
#include "box_layout.hpp"
#include "box_numbers.hpp"
#include "figure_check.hpp"
#include "figure_script.hpp"
#include "figure_scripts.hpp"
#include "figure_text.hpp"

namespace banyan::study {

namespace {

constexpr double flat_pt = 2.0;       // a box of less height is hardly more than its median line
constexpr const char* late = "9e99";  // in the data: missed, so later than everything

void check_panel(const BoxFigure& figure, const Panel& panel) {
  require(panel.measure < figure.measures.size(), "every panel needs a measure of the figure");
  require(panel.boxes.size() == figure.groups.size(), "every panel needs boxes for every group");
  for (const auto& group : panel.boxes) {
    require(group.size() == figure.series.size(), "every group needs a box for every series");
    for (const BoxRuns& box : group) {
      const bool finite = std::all_of(box.values.begin(), box.values.end(), [](double v) { return std::isfinite(v); });
      require(finite, "values must be finite");
      const bool share = figure.measures[panel.measure].share_confidence.has_value();
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
    require(outer.labels.size() == figure.groups.size(), "every group needs its outer labels");
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

std::string block(const char* kind, std::size_t panel, std::size_t series) {
  return std::string("$") + kind + "_" + std::to_string(panel + 1) + "_" + std::to_string(series + 1);
}

Style look_of(const BoxFigure& figure, std::size_t series) {
  return style_of(figure.series[series].style.value_or(series), figure.series[series].variant);
}

// Boxes of a panel's series, and the points beyond their whiskers.
struct Blocks {
  bool boxes = false, points = false;
};

std::string late_or(double value) { return std::isinf(value) ? late : number(value); }

// Points of one value would hide each other: the golden ratio spreads them over half the box.
double jitter(std::size_t index) {
  constexpr double golden = 0.61803398874989485;
  const double turn = (static_cast<double>(index) + 0.5) * golden;
  return turn - std::floor(turn) - 0.5;
}

BoxNumbers numbers_shown(const BoxRuns& box, const Measure& measure) {
  if (!measure.share_confidence) return numbers_of(box.values, box.missed);
  const auto hits =
      static_cast<std::size_t>(std::count_if(box.values.begin(), box.values.end(), [](double v) { return v > 0.0; }));
  const double share = static_cast<double>(hits) / static_cast<double>(box.values.size());
  const Interval interval = wilson(hits, box.values.size(), *measure.share_confidence);
  return {interval.low, share, share, share, interval.high, {}};
}

Blocks write_data(Script& script, const BoxFigure& figure, const BoxLayout& layout, std::size_t panel,
                  std::size_t series) {
  Blocks blocks;
  std::string points;
  const double width = layout.box_width() / layout.pitch;
  for (std::size_t g = 0; g < figure.groups.size(); ++g) {
    const BoxRuns& box = figure.panels[panel].boxes[g][series];
    if (box.values.empty() && box.missed == 0) continue;
    const double x = 0.5 + layout.center(g, series, figure.series.size()) / layout.pitch;
    const BoxNumbers numbers = numbers_shown(box, figure.measures[figure.panels[panel].measure]);
    if (!blocks.boxes)
      script.begin_data(block("box", panel, series), "x low lower_quartile median upper_quartile high runs missed");
    blocks.boxes = true;
    std::string row = fixed(x, 4);
    for (const double v : {numbers.low, numbers.lower, numbers.median, numbers.upper, numbers.high})
      row += " " + late_or(v);
    script.line(row + " " + std::to_string(box.values.size() + box.missed) + " " + std::to_string(box.missed));
    for (std::size_t i = 0; i < numbers.outliers.size(); ++i)
      points += fixed(x + 0.5 * width * jitter(i), 4) + " " + number(numbers.outliers[i]) + "\n";
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

// -------------------------------------------------------------------------------------- texts --

void draw_sample(Script& script, const Style& style, bool thin, PanelPoint at) {
  if (thin) {
    script.stroke({at.x + 1.0, at.y}, {at.x + swatch_pt - 1.0, at.y}, "front lw 1.6 lc " + rgb(style.color));
    script.point({at.x + swatch_pt / 2.0, at.y}, 4.5, "pt " + std::to_string(style.point) + " lc " + rgb(style.color));
  } else {
    script.rectangle(
        {at.x, at.y - 3.5}, swatch_pt, 7.0,
        "fc " + rgb(style.color) + " fs solid " + number(style.fill) + " border lc " + rgb(style.color) + " lw 0.7");
  }
}

void draw_sheet(Script& script, const BoxFigure& figure, const BoxLayout& layout) {
  const double bottom = layout.tops.back() + layout.panel_height + layout.groups.height + layout.outer_height();
  const double left = layout.lefts.front(), right = layout.lefts.back() + layout.panel_width;
  script.labels(layout.title, {layout.width / 2.0, edge_pt + line_pt / 2.0}, Align::center);
  box_legend(figure, layout)
      .draw(script, layout.width / 2.0, layout.legend_top, [&](Script& to, std::size_t series, PanelPoint at) {
        draw_sample(to, look_of(figure, series), layout.thin, at);
      });
  if (figure.measures.size() == 1) {
    const double middle = (layout.tops.front() + layout.tops.back() + layout.panel_height) / 2.0;
    script.labels(layout.y_labels.front(), {layout.label_lefts.front() + line_pt / 2.0, middle}, Align::center, 90);
  }
  double y = bottom + 3.0 + line_pt / 2.0;
  script.labels(layout.x_label, {(left + right) / 2.0, y}, Align::center);
  y += line_pt * (static_cast<double>(layout.x_label.size()) - (layout.note_beside ? 1.0 : 0.0));
  if (layout.x_label.empty()) y = bottom + 1.0 + line_pt / 2.0;
  if (!layout.note.empty()) script.label(layout.note, {right, y}, Align::right);
}

void draw_outer(Script& script, const BoxLayout& layout, const Area& area) {
  double y = area.bottom + layout.groups.height + line_pt / 2.0;
  for (const auto& spans : layout.outer) {
    for (const Span& span : spans) {
      const auto groups = static_cast<double>(span.first + span.last + 1);
      script.label(span.text, {area.left + layout.pitch * groups / 2.0, y}, Align::center);
    }
    y += line_pt;
  }
}

// Lines between groups of one outer label, down to it where there are labels; without outer labels between all groups
// of several boxes.
void separate_groups(Script& script, const BoxFigure& figure, const BoxLayout& layout, const Area& area, bool labels) {
  const auto separate = [&](std::size_t group, double bottom, const char* color) {
    const double x = area.left + layout.pitch * static_cast<double>(group);
    if (group > 0) script.stroke({x, area.top}, {x, bottom}, "back lw 0.4 lc rgb '" + std::string(color) + "'");
  };
  double bottom = area.bottom + (labels ? layout.groups.height : 0.0);
  for (const auto& spans : layout.outer) {
    if (labels) bottom += line_pt;
    for (const Span& span : spans) separate(span.first, bottom, "#b0b0b0");
  }
  if (!layout.outer.empty() || !layout.spread) return;
  for (std::size_t g = 1; g < figure.groups.size(); ++g) separate(g, area.bottom, "#d0d0d0");
}

void draw_group_labels(Script& script, const BoxFigure& figure, const BoxLayout& layout, const Area& area) {
  const bool level = layout.groups.degrees == 0;
  for (std::size_t g = 0; g < figure.groups.size(); ++g) {
    const double x = area.left + layout.pitch * (static_cast<double>(g) + 0.5);
    script.labels(layout.groups.lines[g], {x, area.bottom + (level ? 3.0 + line_pt / 2.0 : 5.0)},
                  level ? Align::center : Align::right, layout.groups.degrees);
  }
}

void draw_texts(Script& script, const BoxFigure& figure, const BoxLayout& layout, std::size_t panel) {
  const Area area = layout.area(panel);
  const std::size_t m = figure.panels[panel].measure, column = panel % layout.columns;
  const double strip = layout.row_misses[panel / layout.columns] ? layout.misses.height : 0.0;
  const auto& title = layout.panel_titles[panel];
  const double title_top = area.top - strip - 3.0 - line_pt * static_cast<double>(title.size());
  script.labels(title, {(area.left + area.right) / 2.0, title_top + line_pt / 2.0}, Align::center);
  if (figure.measures.size() > 1 && layout.labelled[panel])
    script.labels(layout.y_labels[m], {layout.label_lefts[column] + line_pt / 2.0, (area.top + area.bottom) / 2.0},
                  Align::center, 90);
  const bool labels = panel + layout.columns >= figure.panels.size();  // there is no panel below
  separate_groups(script, figure, layout, area, labels);
  if (!labels) return;
  draw_group_labels(script, figure, layout, area);
  draw_outer(script, layout, area);
}

// ------------------------------------------------------------------------------------- misses --

void draw_miss_bar(Script& script, const BoxRuns& box, const Style& style, double x, double bottom, double width) {
  const double share = static_cast<double>(box.missed) / static_cast<double>(box.missed + box.values.size());
  const double height = std::max(0.5, share * miss_bar_pt);
  script.rectangle({x - width / 2.0, bottom - height}, width, height,
                   "fc " + rgb(style.color) + " fs solid 1.0 border lc " + rgb(style.color) + " lw 0.3");
}

void draw_misses(Script& script, const BoxFigure& figure, const BoxLayout& layout, std::size_t panel) {
  if (!layout.row_misses[panel / layout.columns]) return;
  const Area area = layout.area(panel);
  const MissStrip& strip = layout.misses;
  const bool bars = strip.kind == MissStrip::Kind::bars, level = strip.kind == MissStrip::Kind::level;
  if (panel % layout.columns == 0) {
    const double middle = area.top - strip.height / 2.0;
    script.label("missed", {area.left - 3.0, bars ? area.top - 2.0 - line_pt / 2.0 : middle - 1.5}, Align::right);
    if (bars) script.label("all", {area.left - 3.0, area.top - 2.0 - miss_bar_pt}, Align::right);
  }
  if (bars) {
    for (const double y : {area.top - 2.0, area.top - 2.0 - miss_bar_pt})
      script.stroke({area.left, y}, {area.right, y}, "back lw 0.4 lc rgb '#b0b0b0'");
  }
  for (std::size_t g = 0; g < figure.groups.size(); ++g) {
    for (std::size_t s = 0; s < figure.series.size(); ++s) {
      const BoxRuns& box = figure.panels[panel].boxes[g][s];
      if (box.missed == 0) continue;
      const double x = area.left + layout.center(g, s, figure.series.size());
      if (bars) draw_miss_bar(script, box, look_of(figure, s), x, area.top - 2.0, layout.box_width());
      else
        script.label(miss_text(box), {x, area.top - (level ? 3.0 + line_pt / 2.0 : 2.5)},
                     level ? Align::center : Align::left, level ? 0 : 90, strip.size);
      if (level) script.stroke({x, area.top}, {x, area.top - 3.0}, "front lw 1 lc " + rgb(look_of(figure, s).color));
    }
  }
}

// -------------------------------------------------------------------------------------- boxes --

// What misses or, on a logarithmic axis, is 0 ends at the edge; a box that is beyond it altogether is not drawn.
constexpr const char* functions =
    "show(v) = v > upper ? upper : v < lower ? lower : v\n"
    "within(x, low) = low > upper ? NaN : x\n"
    "height(v) = logarithmic ? log(show(v)/lower)/log(upper/lower) : (show(v) - lower)/(upper - lower)";

std::string box_plots(const BoxFigure& figure, const std::string& data, std::size_t series) {
  const Style style = look_of(figure, series);
  const std::string color = rgb(style.color);
  std::string plots = ", \\\n    " + data +
                      " using (within($1, $2)):(show($3)):(show($2)):(show($6)):(show($5)):(width) with candlesticks "
                      "whiskerbars 0.5 lw 0.7 lc " +
                      color + " fs solid " + number(style.fill) + " border lc " + color + " notitle";
  // A box hardly higher than its median line has that in the colour of its series.
  plots += ", \\\n    " + data +
           " using (within($1, $4) - width/2):(show($4)):(width):(0):(height($5) - height($3) < flat ? 0x" +
           std::string(style.color.substr(1)) + " : 0x000000) with vectors nohead lw 1.4 lc rgb variable notitle";
  return plots;
}

std::string thin_plots(const BoxFigure& figure, const std::string& data, std::size_t series) {
  const Style style = look_of(figure, series);
  const std::string color = rgb(style.color);
  const auto line = [&](const char* from, const char* to, const char* width) {
    return ", \\\n    " + data + " using (within($1, " + from + ")):(show(" + from + ")):(0):(show(" + to +
           ") - show(" + from + ")) with vectors nohead lw " + width + " lc " + color + " notitle";
  };
  return line("$2", "$6", "0.5") + line("$3", "$5", "1.6") + ", \\\n    " + data +
         " using (within($1, $4)):(show($4)) with points pt " + std::to_string(style.point) + " " + point_size(4.5) +
         " lc " + color + " notitle";
}

void draw_boxes(Script& script, const BoxFigure& figure, const BoxLayout& layout, std::size_t panel,
                const std::vector<Blocks>& blocks) {
  std::string plots = "plot NaN notitle";
  for (std::size_t s = 0; s < figure.series.size(); ++s) {
    if (!blocks[s].boxes) continue;
    const std::string data = block("box", panel, s);
    const bool share = figure.measures[figure.panels[panel].measure].share_confidence.has_value();
    plots += share || layout.thin ? thin_plots(figure, data, s) : box_plots(figure, data, s);
  }
  for (std::size_t s = 0; s < figure.series.size() && !layout.thin; ++s) {
    if (!blocks[s].points) continue;
    const Style style = look_of(figure, s);
    plots += ", \\\n    " + block("out", panel, s) + " using (within($1, $2)):(show($2)) with points pt " +
             std::to_string(style.point) + " " + point_size(3.2) + " lc " + rgb(style.color, 0.4) + " notitle";
  }
  script.line(plots);
}

void draw_panel(Script& script, const BoxFigure& figure, const BoxLayout& layout, std::size_t panel,
                const std::vector<Blocks>& blocks) {
  const Panel& shown = figure.panels[panel];
  const FigureAxis& axis = layout.axes[shown.measure];
  const Area area = layout.area(panel);
  script.area(area);
  const bool empty = std::none_of(blocks.begin(), blocks.end(), [](const Blocks& b) { return b.boxes; });
  script.frame(!empty);
  script.axis('y', axis.low, axis.high, axis.scale == Scale::log, axis.tick_list(layout.labelled[panel] != 0));
  if (empty) script.line("unset ytics");  // in a grid, beside others
  if (empty) script.label("no runs", {(area.left + area.right) / 2.0, (area.top + area.bottom) / 2.0}, Align::center);
  script.line("upper = " + number(axis.high) + "; lower = " + number(axis.low) +
              "; logarithmic = " + (axis.scale == Scale::log ? "1" : "0"));
  draw_texts(script, figure, layout, panel);
  draw_misses(script, figure, layout, panel);
  if (const auto& line = figure.measures[shown.measure].line; line && *line > axis.low && *line < axis.high)
    script.line("set arrow from graph 0, first " + number(*line) + " to graph 1, first " + number(*line) +
                " nohead back lw 0.7 lc rgb '#606060'");
  draw_boxes(script, figure, layout, panel, blocks);
  script.forget_labels();
}

}  // namespace

std::string script_of(const BoxFigure& figure, const std::string& name) {
  check(figure);
  const BoxLayout layout = box_layout(figure);

  Script script(layout.width, layout.height);
  script.begin("Boxes: quartiles and median; whiskers: last value within 1.5 times the box; points: values beyond.",
               name);
  script.line(std::string("# Runs that missed are later than all others: ") + late + ".");
  script.line("width = " + fixed(layout.box_width() / layout.pitch, 4) + "  # of a box; groups are 1 apart");
  script.line("flat = " + fixed(flat_pt / layout.panel_height, 4) + "  # share of the panel's height");
  script.line(functions);
  std::vector<std::vector<Blocks>> blocks(figure.panels.size());
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    for (std::size_t s = 0; s < figure.series.size(); ++s)
      blocks[p].push_back(write_data(script, figure, layout, p, s));
  }
  script.begin_drawing();
  script.line("unset xtics  # the groups have labels");
  script.line("set xrange [0.5:" + fixed(static_cast<double>(figure.groups.size()) + 0.5, 1) + "]");
  draw_sheet(script, figure, layout);
  for (std::size_t p = 0; p < figure.panels.size(); ++p) draw_panel(script, figure, layout, p, blocks[p]);
  script.end_drawing();
  return script.text();
}

double width_in(const BoxFigure& figure) {
  check(figure);
  return box_layout(figure).width / points_in;
}

}  // namespace banyan::study
