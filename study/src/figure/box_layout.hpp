// SPDX-License-Identifier: MIT
// Where everything in a figure of box plots goes, in points. The width is given; heights follow from
// the texts, so that none of them overlaps another.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "banyan/study/figure.hpp"
#include "figure_axis.hpp"
#include "figure_script.hpp"

namespace banyan::study {

inline constexpr double group_share = 0.86;  // of the distance of groups that boxes fill
inline constexpr double box_share = 0.80;    // of a series' slot that its box fills
inline constexpr double thin_pt = 4.5;       // slots below it have a point and a line instead of a box
inline constexpr double swatch_pt = 14.0;    // a series in the legend
inline constexpr double miss_bar_pt = 16.0;  // if all runs missed

// How the labels of the groups are written below the axis.
struct GroupLabels {
  std::vector<std::vector<std::string>> lines;  // per group
  int degrees = 0;
  double height = 0.0;    // below the axis
  double overhang = 0.0;  // left of the panel
};
// Neighbouring groups of one outer label.
struct Span {
  std::size_t first = 0, last = 0;  // groups
  std::string text;
};
// The misses above the panels: "12/50" beside the word, level or turned, or bars where that does not fit.
struct MissStrip {
  enum class Kind { none, level, turned, bars } kind = Kind::none;
  double size = text_pt;  // of the text
  double height = 0.0;
};

struct BoxLayout {
  std::size_t columns = 1, rows = 1;
  double width = 0.0, height = 0.0;
  double panel_width = 0.0, panel_height = 0.0;
  double pitch = 0.0, slot = 0.0;  // from group to group, from box to box of a group
  bool thin = false;               // points and lines instead of boxes
  bool spread = true;              // the boxes of a group stand side by side; else each group has one
  bool legend = true;
  std::vector<FigureAxis> axes;     // per measure
  std::vector<double> lefts, tops;  // of the panels' axes, per column and row
  std::vector<double> label_lefts;  // of the y labels, per column
  std::vector<char> labelled;       // per panel: its y axis has labels
  MissStrip misses;
  std::vector<char> row_misses;  // per row: it has the strip
  GroupLabels groups;
  std::vector<std::vector<Span>> outer;  // per outer level
  std::vector<std::string> title, x_label;
  std::vector<std::vector<std::string>> panel_titles, y_labels;  // per panel, per measure
  double legend_top = 0.0;
  std::string note;
  bool note_beside = false;  // on the last line of x_label

  [[nodiscard]] Area area(std::size_t panel) const {
    const double x = lefts[panel % columns], y = tops[panel / columns];
    return {x, x + panel_width, y, y + panel_height};
  }
  // Of a box, within its panel.
  [[nodiscard]] double center(std::size_t group, std::size_t series, std::size_t count) const {
    const double aside = spread ? static_cast<double>(series) - (static_cast<double>(count) - 1.0) / 2.0 : 0.0;
    return pitch * (static_cast<double>(group) + 0.5) + slot * aside;
  }
  [[nodiscard]] double box_width() const;
  [[nodiscard]] double outer_height() const { return line_pt * static_cast<double>(outer.size()); }
};

// "12/50": of how many runs how many missed.
[[nodiscard]] std::string miss_text(const BoxRuns& box);

[[nodiscard]] BoxLayout box_layout(const BoxFigure& figure);
[[nodiscard]] Legend box_legend(const BoxFigure& figure, const BoxLayout& layout);

}  // namespace banyan::study
