// SPDX-License-Identifier: MIT
// The layout of a figure of box plots (box_layout.hpp).
#include "box_layout.hpp"

#include <algorithm>
#include <cmath>

#include "figure_text.hpp"

namespace banyan::study {

namespace {

constexpr double smallest_slot_px = 9.0;
constexpr double smallest_pitch_px = 20.0;  // of groups: labels turned by 45 degrees do not touch
constexpr std::size_t many_groups = 9;      // from here on, labels of several lines are turned instead
constexpr double column_gap_px = 18.0;
constexpr double longest_label_px = 200.0;
constexpr double sine_45 = 0.70710678;

Extent extent_of(const BoxFigure& figure) {
  Extent extent;
  for (const Panel& panel : figure.panels) {
    for (const auto& group : panel.values) {
      for (const auto& values : group) {
        for (const double v : values) extent.add(v);
      }
    }
  }
  return extent;
}

GroupLabels level_labels(const BoxFigure& figure, double pitch) {
  GroupLabels result;
  const double room = pitch - 6.0;
  for (const std::string& group : figure.groups) {
    const std::string text = clean(group);
    auto lines = wrapped(text, room, text_px);
    const std::size_t own = 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    const std::size_t most = figure.groups.size() >= many_groups ? 1 : std::max<std::size_t>(own, 2);
    const bool fits = lines.size() <= most && std::all_of(lines.begin(), lines.end(), [&](const std::string& line) {
                        return text_width_px(line, text_px) <= room;
                      });
    if (!fits) return {};
    result.height = std::max(result.height, 6.0 + line_px * static_cast<double>(lines.size()));
    result.lines.push_back(std::move(lines));
  }
  return result;
}

GroupLabels group_labels(const BoxFigure& figure, double pitch, bool full_rows) {
  if (auto level = level_labels(figure, pitch); !level.lines.empty()) return level;
  GroupLabels result;
  // Slanted labels reach below the panel to the left, which in an incomplete row is not free.
  result.degrees = full_rows ? 45 : 90;
  const double slant = full_rows ? sine_45 : 1.0;
  for (std::size_t g = 0; g < figure.groups.size(); ++g) {
    std::string text = clean(figure.groups[g]);
    std::replace(text.begin(), text.end(), '\n', ' ');
    text = shortened(text, longest_label_px, text_px);
    const double width = text_width_px(text, text_px) * slant;
    result.height = std::max(result.height, 12.0 + width + (full_rows ? sine_45 * text_px / 2.0 : 0.0));
    if (full_rows) {
      result.overhang = std::max(result.overhang, width + text_px - pitch * (static_cast<double>(g) + 0.5));
    }
    result.lines.push_back({text});
  }
  return result;
}

// Three columns come to about 900 pixels, the width of a page.
void choose_panels(const BoxFigure& figure, BoxLayout& layout) {
  layout.gap = column_gap_px;
  layout.columns = std::min(figure.columns, figure.panels.size());
  layout.rows = (figure.panels.size() + layout.columns - 1) / layout.columns;
  const double usual = layout.columns == 1 ? 480.0 : layout.columns == 2 ? 350.0 : 264.0;
  const double group =
      std::max(smallest_pitch_px, smallest_slot_px * static_cast<double>(figure.series.size()) / group_share);
  layout.panel_width = std::max(usual, std::ceil(group * static_cast<double>(figure.groups.size())));
  layout.panel_height = layout.columns == 1 ? 290.0 : layout.columns == 2 ? 230.0 : layout.rows == 1 ? 200.0 : 165.0;
}

void place_texts(const BoxFigure& figure, BoxLayout& layout) {
  const double pitch = layout.panel_width / static_cast<double>(figure.groups.size());
  layout.groups = group_labels(figure, pitch, figure.panels.size() % layout.columns == 0);
  for (const Panel& panel : figure.panels) {
    layout.panel_titles.push_back(fitted(panel.title, layout.panel_width, text_px));
    layout.title_height =
        std::max(layout.title_height, line_px * static_cast<double>(layout.panel_titles.back().size()) + 6.0);
  }
  layout.y_label = fitted(figure.y_label, layout.plots_height(), text_px);
  layout.x_label = fitted(figure.x_label, layout.plots_width(), text_px);
  const double beside =
      line_px * static_cast<double>(layout.y_label.size()) + 8.0 + layout.axis.label_width_px(text_px) + 12.0;
  layout.left = edge_px + std::max(beside, layout.groups.overhang);
  layout.width = std::ceil(layout.left + layout.plots_width() + edge_px + 4.0);
  layout.title = fitted(figure.title, layout.width - 2.0 * edge_px, title_px, true);
}

void place_rows(const Legend& legend, BoxLayout& layout) {
  layout.legend_top = edge_px + (layout.title.empty() ? 0.0 : line_px * static_cast<double>(layout.title.size()) + 6.0);
  layout.top = layout.legend_top + legend.height() + (legend.height() > 0.0 ? 4.0 : 0.0) + layout.title_height;
  layout.height =
      std::ceil(layout.top + layout.plots_height() + layout.groups.height +
                (layout.x_label.empty() ? 0.0 : 6.0 + line_px * static_cast<double>(layout.x_label.size())) + edge_px);
}

}  // namespace

Legend box_legend(const BoxFigure& figure, const BoxLayout& layout) {
  std::vector<std::string> names;
  for (const Series& series : figure.series) names.push_back(series.name);
  return {names, swatch_px, layout.width - 2.0 * edge_px};
}

BoxLayout box_layout(const BoxFigure& figure) {
  BoxLayout layout{};
  layout.axis = axis_over(extent_of(figure), figure.y_minimum, figure.y_maximum, true, 0.04, 6);
  choose_panels(figure, layout);
  place_texts(figure, layout);
  place_rows(box_legend(figure, layout), layout);
  return layout;
}

}  // namespace banyan::study
