// SPDX-License-Identifier: MIT
// The script of a figure of curves with bands.
#include <algorithm>
#include <cmath>

#include "figure_axis.hpp"
#include "figure_check.hpp"
#include "figure_script.hpp"
#include "figure_scripts.hpp"
#include "figure_text.hpp"

namespace banyan::study {

namespace {

constexpr double plot_height_pt = 135.0;
constexpr double sample_pt = 22.0;

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

struct Axes {
  FigureAxis x, y;
};

Axes axes_of(const CurveFigure& figure) {
  AxisExtent x, y;
  bool points = false;
  for (const Curve& curve : figure.curves) {
    for (const double v : curve.x) x.add(v);
    for (const auto* values : {&curve.y, &curve.low, &curve.high}) {
      for (const double v : *values) y.add(v);
    }
    points = points || curve.points;
  }
  // Bare lines run from edge to edge; points must not be cut.
  return {axis_over(x, std::nullopt, std::nullopt, false, points ? 0.03 : 0.0, 8),
          axis_over(y, figure.y_minimum, figure.y_maximum, true, 0.04, 6)};
}

struct CurveLayout {
  std::vector<std::string> title, x_label, y_label;
  double width = 0.0, height = 0.0, legend_top = 0.0;
  Area area;
};

CurveLayout place(const CurveFigure& figure, const Axes& axes) {
  CurveLayout layout;
  layout.width = column_in * points_in;
  layout.y_label = fitted(figure.y_label, plot_height_pt, text_pt);
  const auto lines = static_cast<double>(layout.y_label.size());
  layout.area.left = edge_pt + (lines > 0.0 ? lines * line_pt + 2.0 : 0.0) + axes.y.label_width(text_pt) + tick_pt;
  // The last tick's label is centred at the right end of the axis.
  layout.area.right = layout.width - edge_pt - axes.x.label_width(text_pt) / 2.0;
  layout.x_label = fitted(figure.x_label, layout.area.right - layout.area.left, text_pt);
  layout.title = fitted(figure.title, layout.width - 2.0 * edge_pt, text_pt);
  layout.legend_top = edge_pt + (layout.title.empty() ? 0.0 : line_pt * static_cast<double>(layout.title.size()) + 3.0);
  return layout;
}

void place_below(const Legend& legend, CurveLayout& layout) {
  layout.area.top = layout.legend_top + legend.height() + 6.0;
  layout.area.bottom = layout.area.top + plot_height_pt;
  const double label = layout.x_label.empty() ? 0.0 : 3.0 + line_pt * static_cast<double>(layout.x_label.size());
  layout.height = std::ceil(layout.area.bottom + 15.0 + label + edge_pt);
}

bool visible(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

std::string block(std::size_t curve) { return "$curve_" + std::to_string(curve + 1); }

void write_data(Script& script, const Curve& curve, std::size_t index) {
  if (curve.x.empty()) return;
  const bool band = !curve.low.empty();
  script.begin_data(block(index), band ? "x y low high" : "x y");
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    std::string row = number(curve.x[i]) + " " + number(curve.y[i]);
    if (band) row += " " + number(curve.low[i]) + " " + number(curve.high[i]);
    script.line(row);
  }
  script.end_data();
}

std::string color_of(std::size_t curve) { return "lc " + rgb(style_of(curve).color); }
std::string line_of(std::size_t curve) { return color_of(curve) + " lw 1.1 dt " + std::string(style_of(curve).dash); }
std::string point_of(std::size_t curve) { return "pt " + std::to_string(style_of(curve).point); }
constexpr double point_pt = 4.0;
const std::string band_fill = "fs transparent solid 0.18 noborder";

void draw_sheet(Script& script, const CurveFigure& figure, const CurveLayout& layout, const Legend& legend) {
  script.labels(layout.title, {layout.width / 2.0, edge_pt + line_pt / 2.0}, Align::center);
  legend.draw(script, layout.width / 2.0, layout.legend_top, [&](Script& to, std::size_t i, PanelPoint at) {
    if (visible(figure.curves[i].low)) {
      to.rectangle({at.x, at.y - 3.5}, sample_pt, 7.0, "fc " + rgb(style_of(i).color) + " " + band_fill);
    }
    to.stroke(at, {at.x + sample_pt, at.y}, "front " + line_of(i));
    if (figure.curves[i].points) to.point({at.x + sample_pt / 2.0, at.y}, point_pt, point_of(i) + " " + color_of(i));
  });
  const Area& area = layout.area;
  script.labels(layout.y_label, {edge_pt + line_pt / 2.0, (area.top + area.bottom) / 2.0}, Align::center, 90);
  script.labels(layout.x_label, {(area.left + area.right) / 2.0, area.bottom + 18.0 + line_pt / 2.0}, Align::center);
}

void draw_curves(Script& script, const CurveFigure& figure) {
  std::string plots = "plot NaN notitle";
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    if (!visible(figure.curves[i].low) || !visible(figure.curves[i].high)) continue;
    plots += ", \\\n    " + block(i) + " using 1:3:4 with filledcurves " + color_of(i) + " " + band_fill + " notitle";
  }
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    const Curve& curve = figure.curves[i];
    if (!visible(curve.y)) continue;
    plots += ", \\\n    " + block(i) + " using 1:2 with " + (curve.points ? "linespoints " : "lines ") + line_of(i) +
             (curve.points ? " " + point_of(i) + " " + point_size(point_pt) : "") + " notitle";
  }
  script.line(plots);
}

void set_axes(Script& script, const Axes& axes) {
  script.axis('x', axes.x.low, axes.x.high, false, "nomirror " + axes.x.tick_list());
  script.axis('y', axes.y.low, axes.y.high, false, "nomirror " + axes.y.tick_list());
}

}  // namespace

std::string script_of(const CurveFigure& figure, const std::string& name) {
  check(figure);
  const Axes axes = axes_of(figure);
  CurveLayout layout = place(figure, axes);
  std::vector<std::string> names;
  for (const Curve& curve : figure.curves) names.push_back(curve.name);
  const Legend legend(names, sample_pt, layout.width - 2.0 * edge_pt);
  place_below(legend, layout);

  Script script(layout.width, layout.height);
  script.begin("Curves, some with a band.", name);
  for (std::size_t i = 0; i < figure.curves.size(); ++i) write_data(script, figure.curves[i], i);
  script.begin_drawing();
  set_axes(script, axes);
  draw_sheet(script, figure, layout, legend);
  script.area(layout.area);
  draw_curves(script, figure);
  script.end_drawing();
  return script.text();
}

}  // namespace banyan::study
