// SPDX-License-Identifier: MIT
// Figures for print: panels of box plots, or curves. What is drawn is decided here and left as JSON
// (docs/file-formats.md); how it looks, by hosts/python/banyan/figures.py.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "banyan/record/file.hpp"

namespace banyan::study {

// All texts may hold any bytes and "\n".

inline constexpr double column_in = 3.5, page_in = 7.0;  // widths for print, inches
inline constexpr std::size_t most_series = 12;           // that can be told apart
inline constexpr std::size_t most_variants = 8;          // of one colour

enum class Scale { linear, log };

struct Series {  // one colour, named in the legend
  std::string name;
  std::optional<std::size_t> style;  // its colour, < most_series; its place in the list by default
  std::size_t variant = 0;           // of others of that colour, < most_variants: told apart by their fill
};
// The runs behind one box.
struct BoxRuns {
  std::vector<double> values;  // finite, in any order
  std::size_t missed = 0;      // further runs
};
// What is shown upwards.
struct Measure {
  std::string label;  // "completion time / limit"
  Scale scale = Scale::linear;
  std::optional<double> minimum, maximum;  // else from the values; positive on a logarithmic scale
  std::optional<double> line;              // across the panel, such as 1 for ratios
  std::optional<double> share_confidence;  // values are 0 or 1: their share with Wilson's interval, no box
  bool late = true;                        // a run that missed is later than every value; else in no box
};
struct Panel {
  std::string title;                        // "r = 3 m"
  std::size_t measure = 0;                  // of the figure's
  std::vector<std::vector<BoxRuns>> boxes;  // [group][series]; no run: no box
};
// What several groups have in common, written below their labels: a label per group.
struct OuterLabels {
  std::string title;                      // "targets T"
  std::vector<std::string> labels, full;  // "2", "2", "3", "3"; "targets T = 2", ...: where there is room
};
struct BoxFigure {
  std::string title;                // "" for none
  std::string x_label;              // "redundancy k"
  std::vector<std::string> groups;  // labels along the x axis
  std::vector<OuterLabels> outer;   // the nearest to the groups first
  std::vector<Series> series;       // at least one, at most twelve
  std::vector<Measure> measures;
  std::size_t columns = 1;  // panels side by side, fewer if boxes would be too thin; the rest goes below
  bool grid = false;        // rows of `columns` belong together: no other number of columns
  std::vector<Panel> panels;
  std::string counted = "runs";    // what n is the number of
  std::optional<double> width_in;  // else one column if everything fits in, or a page
};
// Lines with a band instead of boxes: a quantity over generations, or over a parameter.
struct Curve {
  std::string name;
  std::vector<double> x, y;       // of the same length, x finite; NaN in y, low or high: a gap
  std::vector<double> low, high;  // a band, or both empty
  bool points = false;            // mark the points; else a bare line
};
struct CurveFigure {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;  // at most twelve
  std::optional<double> y_minimum, y_maximum;
};

// The whole file; the same bytes for the same figure, and numbers read back as they are. std::invalid_argument for a
// figure without panel, group, series or measure, with too many series, with values that are not finite, or with sizes
// that differ.
[[nodiscard]] std::string figure_json(const BoxFigure& figure);
[[nodiscard]] std::string figure_json(const CurveFigure& figure);

// What makes pictures of figures: figures.py, by the first of these interpreters that has matplotlib.
struct Drawer {
  std::string script;  // "": no pictures are made
  std::vector<std::string> pythons{"python3", "/usr/bin/python3"};
};
// Draws all figures of a folder, and waits. Returns what went wrong, with what Python said and the command that draws
// them later; "" if nothing did. Then pictures of earlier figures stay as they were.
[[nodiscard]] std::string draw_folder(const Drawer& drawer, const std::string& folder);
// The Python of these that has matplotlib; "" if none has.
[[nodiscard]] std::string python_that_draws(const Drawer& drawer);

}  // namespace banyan::study
