// SPDX-License-Identifier: MIT
// Figures for print: panels of box plots, or curves, drawn by gnuplot.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "banyan/record/file.hpp"

namespace banyan::study {

// All texts may hold any bytes and "\n"; they are shown as they are, without gnuplot's markup. What is
// too long for its place is broken into lines, turned, or ends in an ellipsis.

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
  std::size_t missed = 0;      // further runs: each later than every value
};
// What is shown upwards.
struct Measure {
  std::string label;  // "completion time / limit"
  Scale scale = Scale::linear;
  std::optional<double> minimum, maximum;  // else from the values; positive on a logarithmic scale
  std::optional<double> line;              // across the panel, such as 1 for ratios
  std::optional<double> share_confidence;  // values are 0 or 1: their share with Wilson's interval, no box
};
struct Panel {
  std::string title;                        // "r = 3 m"
  std::size_t measure = 0;                  // of the figure's
  std::vector<std::vector<BoxRuns>> boxes;  // [group][series]; no run: no box
};
// What several groups have in common, written below their labels: a label per group.
struct OuterLabels {
  std::string title;                // "targets T"
  std::vector<std::string> labels;  // "2", "2", "3", "3"
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

// gnuplot is missing or failed; what() holds what it said.
class FigureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Writes `stem`.gp (the script with its data: a figure can be changed by hand and drawn again), and
// `stem`.svg, .pdf and .png, which the script draws: of the same size, texts of 8 pt, the png with 300
// pixels an inch. A box spans the quartiles with a line at the median; whiskers reach to the last
// value within 1.5 times the box (Tukey); values beyond are points. Where boxes would be thinner than
// 4.5 pt, a point at the median and a thick line take their place. Runs that missed count as later
// than all others: a box may be open at the top, and how many there are stands above it.
//
// Throws record::FileError if a file cannot be written, FigureError if gnuplot is missing or fails:
// then the script is there, and pictures of an earlier figure stay as they were. Files of these names
// are replaced, each whole. std::invalid_argument, and no file, for a figure without panel, group,
// series or measure, with too many series, with values that are not finite, or with sizes that differ.
void draw(const BoxFigure& figure, const std::string& stem);
void draw(const CurveFigure& figure, const std::string& stem);

// Its texts and sizes do not depend on gnuplot: the width that draw() gives the figure, in inches.
[[nodiscard]] double width_in(const BoxFigure& figure);

}  // namespace banyan::study
