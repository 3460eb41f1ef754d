// SPDX-License-Identifier: MIT
// Figures in the style of the paper's: panels of box plots, drawn by gnuplot.
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

struct Series {  // one colour, named in the legend
  std::string name;
};
// The boxes of one panel: values[group][series], each the runs behind one box, finite, in any order;
// empty: no box.
struct Panel {
  std::string title;  // "r = 3 m"
  std::vector<std::vector<std::vector<double>>> values;
};
struct BoxFigure {
  std::string title;                           // "" for none
  std::string x_label, y_label;                // "redundancy k", "completion time / limit"
  std::vector<std::string> groups;             // labels along the x axis
  std::vector<Series> series;                  // at least one, at most eight
  std::size_t columns = 1;                     // panels side by side; the rest goes below
  std::vector<Panel> panels;                   // row by row, all with the same axes
  std::optional<double> y_minimum, y_maximum;  // else from the values
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
  std::vector<Curve> curves;  // at most eight
  std::optional<double> y_minimum, y_maximum;
};

// gnuplot is missing or failed; what() holds what it said.
class FigureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Writes `stem`.gp (the script with its data: a figure can be changed by hand and drawn again),
// `stem`.svg and `stem`.png. A box spans the quartiles with a line at the median; whiskers reach to
// the last value within 1.5 times the box (Tukey); values beyond are points. Throws
// record::FileError if a file cannot be written, FigureError if gnuplot is missing or fails: then
// the script is there, and pictures of an earlier figure stay as they were. Files of these names are
// replaced, each whole. std::invalid_argument, and no file, for a figure without panel, group or
// series, with more than eight series, with values that are not finite, or with sizes that differ.
void draw(const BoxFigure& figure, const std::string& stem);
void draw(const CurveFigure& figure, const std::string& stem);

}  // namespace banyan::study
