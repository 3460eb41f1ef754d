// SPDX-License-Identifier: MIT
// Where everything in a figure of box plots goes, in pixels of the svg. Sizes follow from the texts,
// so that none of them overlaps another.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "banyan/study/figure.hpp"
#include "figure_axis.hpp"
#include "figure_script.hpp"

namespace banyan::study {

inline constexpr double group_share = 0.82;  // of the distance of groups that boxes fill
inline constexpr double swatch_px = 22.0;    // a series in the legend

// How the labels of the groups are written below the axis.
struct GroupLabels {
  std::vector<std::vector<std::string>> lines;  // per group
  int degrees = 0;
  double height = 0.0;    // below the axis
  double overhang = 0.0;  // left of the panel
};

struct BoxLayout {
  std::size_t columns, rows;
  double panel_width, panel_height, gap;  // gap: between columns
  FigureAxis axis;
  GroupLabels groups;
  std::vector<std::string> title, y_label, x_label;
  std::vector<std::vector<std::string>> panel_titles;
  double title_height = 0.0;     // above each panel
  double left = 0.0, top = 0.0;  // of the first panel's axes
  double legend_top = 0.0;
  double width = 0.0, height = 0.0;

  [[nodiscard]] Area area(std::size_t panel) const {
    const std::size_t row = panel / columns, column = panel % columns;
    const double x = left + static_cast<double>(column) * (panel_width + gap),
                 y = top + static_cast<double>(row) * row_pitch();
    return {x, x + panel_width, y, y + panel_height};
  }
  [[nodiscard]] double row_pitch() const { return panel_height + title_height + 14.0; }
  [[nodiscard]] double plots_width() const {
    const auto n = static_cast<double>(columns);
    return n * panel_width + (n - 1.0) * gap;
  }
  [[nodiscard]] double plots_height() const { return static_cast<double>(rows - 1) * row_pitch() + panel_height; }
};

[[nodiscard]] BoxLayout box_layout(const BoxFigure& figure);
[[nodiscard]] Legend box_legend(const BoxFigure& figure, const BoxLayout& layout);

}  // namespace banyan::study
