// SPDX-License-Identifier: MIT
// The layout of a figure of box plots (box_layout.hpp).
#include "box_layout.hpp"

#include <algorithm>
#include <cmath>

#include "figure_text.hpp"
#include "words.hpp"

namespace banyan::study {

namespace {

constexpr double smallest_slot_pt = 6.2;  // the numbers of misses, turned, stand side by side
constexpr double smallest_text_pt = 6.0;  // of these
constexpr double widest_box_pt = 18.0;
constexpr std::size_t many_groups = 9;  // from here on, labels of several lines are turned instead
constexpr double column_gap_pt = 10.0;
constexpr double row_gap_pt = 8.0;
constexpr double longest_label_pt = 110.0;
constexpr double sine_45 = 0.70710678;

bool there(const BoxRuns& box) { return !box.values.empty() || box.missed > 0; }

// Every box of the figure: visit(panel, group, series, box).
template <typename Visit> void visit_boxes(const BoxFigure& figure, Visit visit) {
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    for (std::size_t g = 0; g < figure.groups.size(); ++g) {
      for (std::size_t s = 0; s < figure.series.size(); ++s) visit(p, g, s, figure.panels[p].boxes[g][s]);
    }
  }
}

FigureAxis axis_of(const BoxFigure& figure, std::size_t m, int most_ticks) {
  const Measure& measure = figure.measures[m];
  const bool logarithmic = measure.scale == Scale::log;
  AxisExtent extent;
  bool zeros = false;
  visit_boxes(figure, [&](std::size_t p, std::size_t, std::size_t, const BoxRuns& box) {
    if (figure.panels[p].measure != m) return;
    for (const double v : box.values) {
      zeros = zeros || v <= 0.0;
      if (!logarithmic || v > 0.0) extent.add(v);
    }
  });
  if (measure.line) extent.add(*measure.line);
  if (logarithmic) return log_axis_over(extent, measure.minimum, measure.maximum, zeros, most_ticks);
  return axis_over(extent, measure.minimum, measure.maximum, true, 0.04, most_ticks);
}

// Whether some group has boxes of two series.
bool is_spread(const BoxFigure& figure) {
  std::vector<std::size_t> only(figure.groups.size(), figure.series.size());
  bool spread = false;
  visit_boxes(figure, [&](std::size_t, std::size_t g, std::size_t s, const BoxRuns& box) {
    if (!there(box)) return;
    spread = spread || (only[g] != figure.series.size() && only[g] != s);
    only[g] = s;
  });
  return spread;
}

// Beside groups that are called like their only series, a legend would say the same.
bool needs_legend(const BoxFigure& figure, bool spread) {
  if (figure.series.size() == 1 && figure.series.front().name.empty()) return false;
  if (spread || figure.groups.size() != figure.series.size()) return true;
  for (std::size_t g = 0; g < figure.groups.size(); ++g) {
    if (figure.groups[g] != figure.series[g].name) return true;
  }
  return false;
}

// ------------------------------------------------------------------------------------- widths --

// Panels that need labels at their y axis: the first of a row, and those of another measure than their neighbour.
std::vector<char> labelled_panels(const BoxFigure& figure, std::size_t columns) {
  std::vector<char> labelled;
  for (std::size_t p = 0; p < figure.panels.size(); ++p)
    labelled.push_back(p % columns == 0 || figure.panels[p].measure != figure.panels[p - 1].measure ? 1 : 0);
  return labelled;
}

void choose_heights(BoxLayout& layout, bool page) {
  if (layout.columns == 1) layout.panel_height = layout.rows == 1 ? (page ? 170.0 : 125.0) : 82.0;
  else layout.panel_height = layout.rows == 1 ? (layout.columns == 2 ? 135.0 : 115.0) : 88.0;
}

// Left of the panels: the label of the measure, those of the ticks, and for misses their word.
void place_columns(const BoxFigure& figure, BoxLayout& layout) {
  std::vector<double> margins(layout.columns, 0.0);
  const double word = layout.misses.kind == MissStrip::Kind::none ? 0.0 : text_width("missed", text_pt) + 3.0;
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    if (!layout.labelled[p]) continue;
    const std::size_t m = figure.panels[p].measure, column = p % layout.columns;
    const auto lines = static_cast<double>(layout.y_labels[m].size());
    const double label = lines > 0.0 ? lines * line_pt + 2.0 : 0.0;
    const double ticks = layout.axes[m].label_width(text_pt) + tick_pt;
    margins[column] = std::max(margins[column], label + std::max(ticks, column == 0 ? word : 0.0));
  }
  double taken = 2.0 * edge_pt + 2.0;
  for (std::size_t c = 0; c < layout.columns; ++c) taken += margins[c] += c > 0 ? column_gap_pt : 0.0;
  layout.panel_width = (layout.width - taken) / static_cast<double>(layout.columns);
  double x = edge_pt;
  layout.lefts.clear();
  layout.label_lefts.clear();
  for (std::size_t c = 0; c < layout.columns; ++c) {
    layout.label_lefts.push_back(x + (c > 0 ? column_gap_pt : 0.0));
    layout.lefts.push_back(x += margins[c]);
    x += layout.panel_width;
  }
  layout.pitch = layout.panel_width / static_cast<double>(figure.groups.size());
  const double boxes = layout.spread ? static_cast<double>(figure.series.size()) : 1.0;
  layout.slot = std::min(layout.pitch * group_share / boxes, widest_box_pt / box_share);
}

// Everything that follows from a number of columns in that width.
void try_columns(const BoxFigure& figure, BoxLayout& layout, std::size_t columns) {
  layout.columns = columns;
  layout.rows = (figure.panels.size() + columns - 1) / columns;
  choose_heights(layout, layout.width > column_in * points_in + 1.0);
  layout.labelled = labelled_panels(figure, columns);
  layout.axes.clear();
  layout.y_labels.clear();
  const bool one = figure.measures.size() == 1;
  const double room = one ? static_cast<double>(layout.rows) * layout.panel_height : layout.panel_height + 12.0;
  for (std::size_t m = 0; m < figure.measures.size(); ++m) {
    layout.axes.push_back(axis_of(figure, m, layout.panel_height < 100.0 ? 5 : 6));
    layout.y_labels.push_back(fitted(figure.measures[m].label, room, text_pt));
  }
  place_columns(figure, layout);
}

// As many columns as asked for, or where boxes would be too thin fewer, of full rows.
void choose_columns(const BoxFigure& figure, BoxLayout& layout, double inches) {
  layout.width = inches * points_in;
  const std::size_t asked = std::min(figure.columns, figure.panels.size());
  for (std::size_t columns = asked;; --columns) {
    if (columns < asked && figure.panels.size() % columns != 0) continue;
    try_columns(figure, layout, columns);
    if (columns == 1 || figure.grid || layout.slot >= smallest_slot_pt) return;
  }
}

void choose_width(const BoxFigure& figure, BoxLayout& layout) {
  if (figure.width_in) return choose_columns(figure, layout, *figure.width_in);
  const bool narrow = figure.columns == 1 || figure.panels.size() == 1;
  choose_columns(figure, layout, narrow ? column_in : page_in);
  if (narrow && layout.slot < smallest_slot_pt) choose_columns(figure, layout, page_in);
}

// ------------------------------------------------------------------------------------- labels --

GroupLabels level_labels(const BoxFigure& figure, double pitch) {
  GroupLabels result;
  const double room = pitch - 3.0;
  for (const std::string& group : figure.groups) {
    const std::string text = clean(group);
    auto lines = wrapped(text, room, text_pt);
    const std::size_t own = 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    const std::size_t most = figure.groups.size() >= many_groups ? 1 : std::max<std::size_t>(own, 2);
    const bool fits = lines.size() <= most && std::all_of(lines.begin(), lines.end(), [&](const std::string& line) {
                        return text_width(line, text_pt) <= room;
                      });
    if (!fits) return {};
    result.height = std::max(result.height, 4.0 + line_pt * static_cast<double>(lines.size()));
    result.lines.push_back(std::move(lines));
  }
  return result;
}

// Slanted labels reach below the panel to the left, which is not free in an incomplete row, and not where groups are
// nearer to each other than lines are.
GroupLabels group_labels(const BoxFigure& figure, const BoxLayout& layout) {
  const double pitch = layout.pitch;
  if (auto level = level_labels(figure, pitch); !level.lines.empty()) return level;
  GroupLabels result;
  const bool slanted = figure.panels.size() % layout.columns == 0 && pitch >= line_pt / sine_45;
  result.degrees = slanted ? 45 : 90;
  for (std::size_t g = 0; g < figure.groups.size(); ++g) {
    std::string text = clean(figure.groups[g]);
    std::replace(text.begin(), text.end(), '\n', ' ');
    text = shortened(text, longest_label_pt, text_pt);
    const double width = text_width(text, text_pt) * (slanted ? sine_45 : 1.0);
    result.height = std::max(result.height, 8.0 + width + (slanted ? sine_45 * text_pt / 2.0 : 0.0));
    if (slanted)
      result.overhang = std::max(result.overhang, width + text_pt / 2.0 - pitch * (static_cast<double>(g) + 0.5));
    result.lines.push_back({text});
  }
  return result;
}

// Groups of the same label of this level, and of all levels farther out.
std::vector<Span> spans_of(const BoxFigure& figure, std::size_t level) {
  std::vector<Span> spans;
  for (std::size_t g = 0; g < figure.groups.size(); ++g) {
    bool same = g > 0;
    for (std::size_t l = level; same && l < figure.outer.size(); ++l)
      same = figure.outer[l].labels[g] == figure.outer[l].labels[g - 1];
    if (same) spans.back().last = g;
    else spans.push_back({g, g, ""});
  }
  return spans;
}

// "targets T = 2" below its groups where there is room for that, else "2", and the x axis names the title.
void label_outer(const BoxFigure& figure, BoxLayout& layout, std::string& x_label) {
  bool bare = false;
  for (std::size_t level = 0; level < figure.outer.size(); ++level) {
    const OuterLabels& outer = figure.outer[level];
    std::vector<Span> spans = spans_of(figure, level);
    const auto room = [&](const Span& span) {
      return layout.pitch * static_cast<double>(span.last - span.first + 1) - 4.0;
    };
    const auto full = [&](const Span& span) { return clean(with_value(outer.title, outer.labels[span.first])); };
    const bool fits = std::all_of(spans.begin(), spans.end(),
                                  [&](const Span& span) { return text_width(full(span), text_pt) <= room(span); });
    for (Span& span : spans)
      span.text = fits ? full(span) : shortened(clean(outer.labels[span.first]), room(span), text_pt);
    if (!fits) {
      x_label += (bare ? "; below that, " : "; below it, ") + outer.title;
      bare = true;
    }
    layout.outer.push_back(std::move(spans));
  }
}

std::string note_of(const BoxFigure& figure) {
  std::size_t fewest = 0, most = 0;
  visit_boxes(figure, [&](std::size_t, std::size_t, std::size_t, const BoxRuns& box) {
    const std::size_t n = box.values.size() + box.missed;
    if (n == 0) return;
    fewest = fewest == 0 ? n : std::min(fewest, n);
    most = std::max(most, n);
  });
  if (most == 0) return "";
  std::string text = "n = " + std::to_string(fewest);
  if (most > fewest) text += "–" + std::to_string(most);
  return text + " " + figure.counted + " each";
}

void place_texts(const BoxFigure& figure, BoxLayout& layout) {
  layout.groups = group_labels(figure, layout);
  // Slanted labels may reach beyond the left edge: they are turned upright then.
  if (layout.groups.overhang > layout.lefts.front() - edge_pt) {
    layout.groups.degrees = 90;
    layout.groups.height = 0.0;
    for (const auto& lines : layout.groups.lines)
      layout.groups.height = std::max(layout.groups.height, 8.0 + text_width(lines.front(), text_pt));
  }
  std::string x_label = figure.x_label;
  label_outer(figure, layout, x_label);
  const double plots = layout.width - edge_pt - layout.lefts.front();
  for (const Panel& panel : figure.panels)
    layout.panel_titles.push_back(fitted(panel.title, layout.panel_width + column_gap_pt / 2.0, text_pt));
  layout.x_label = fitted(x_label, plots, text_pt);
  layout.title = fitted(figure.title, layout.width - 2.0 * edge_pt, text_pt);
  layout.note = note_of(figure);
  const double used = layout.x_label.empty() ? 0.0 : text_width(layout.x_label.back(), text_pt) / 2.0 + line_pt;
  layout.note_beside = plots / 2.0 - used >= text_width(layout.note, text_pt);
}

// ------------------------------------------------------------------------------------- misses --

std::string widest_miss(const BoxFigure& figure) {
  std::string widest;
  visit_boxes(figure, [&](std::size_t, std::size_t, std::size_t, const BoxRuns& box) {
    if (box.missed == 0) return;
    const std::string text = miss_text(box);
    if (text_width(text, text_pt) > text_width(widest, text_pt)) widest = text;
  });
  return widest;
}

// Whether the numbers of misses, each above its box, stay clear of each other and within their panel.
bool fit_level(const BoxFigure& figure, const BoxLayout& layout) {
  bool fit = true;
  std::size_t last = figure.panels.size();
  double taken = 0.0;
  visit_boxes(figure, [&](std::size_t p, std::size_t g, std::size_t s, const BoxRuns& box) {
    if (p != last) taken = -3.0;
    last = p;
    if (box.missed == 0) return;
    const double half = text_width(miss_text(box), text_pt) / 2.0, x = layout.center(g, s, figure.series.size());
    fit = fit && x - half >= taken && x + half <= layout.panel_width + 3.0;
    taken = x + half + 4.0;
  });
  return fit;
}

MissStrip strip_of(const BoxFigure& figure, const BoxLayout& layout) {
  const std::string widest = widest_miss(figure);
  if (widest.empty()) return {};
  if (fit_level(figure, layout)) return {MissStrip::Kind::level, text_pt, line_pt + 3.0};
  if (layout.slot < smallest_slot_pt) return {MissStrip::Kind::bars, text_pt, miss_bar_pt + 7.0};
  const double size = std::clamp(std::floor(2.0 * (layout.slot - 0.2)) / 2.0, smallest_text_pt, text_pt);
  return {MissStrip::Kind::turned, size, text_width(widest, size) + 5.0};
}

void place_misses(const BoxFigure& figure, BoxLayout& layout) {
  layout.misses = strip_of(figure, layout);
  layout.row_misses.assign(layout.rows, 0);
  visit_boxes(figure, [&](std::size_t p, std::size_t, std::size_t, const BoxRuns& box) {
    if (box.missed > 0) layout.row_misses[p / layout.columns] = 1;
  });
}

// --------------------------------------------------------------------------------------- rows --

// Group labels are below the last row, and below a panel over an empty place: the row beneath keeps clear of them by
// its own height only if it is the last.
void place_rows(const BoxFigure& figure, const Legend& legend, BoxLayout& layout) {
  layout.legend_top = edge_pt + (layout.title.empty() ? 0.0 : line_pt * static_cast<double>(layout.title.size()) + 3.0);
  double y = layout.legend_top + legend.height() + (legend.height() > 0.0 ? 4.0 : 0.0);
  for (std::size_t row = 0; row < layout.rows; ++row) {
    double title = 0.0;
    for (std::size_t c = 0; c < layout.columns && row * layout.columns + c < figure.panels.size(); ++c) {
      const auto lines = static_cast<double>(layout.panel_titles[row * layout.columns + c].size());
      title = std::max(title, lines > 0.0 ? lines * line_pt + 3.0 : 0.0);
    }
    y += std::max(title + (layout.row_misses[row] ? layout.misses.height : 0.0), 5.0) + (row > 0 ? row_gap_pt : 0.0);
    layout.tops.push_back(y);
    y += layout.panel_height;
  }
  const double x_label = layout.x_label.empty() ? 0.0 : 3.0 + line_pt * static_cast<double>(layout.x_label.size());
  const double note = layout.note.empty() || (layout.note_beside && !layout.x_label.empty()) ? 0.0 : line_pt + 1.0;
  layout.height = std::ceil(y + layout.groups.height + layout.outer_height() + x_label + note + edge_pt);
}

}  // namespace

std::string miss_text(const BoxRuns& box) {
  return std::to_string(box.missed) + "/" + std::to_string(box.values.size() + box.missed);
}

double BoxLayout::box_width() const { return box_share * slot; }

Legend box_legend(const BoxFigure& figure, const BoxLayout& layout) {
  std::vector<std::string> names;
  for (const Series& series : figure.series) names.push_back(layout.legend ? series.name : "");
  return {names, swatch_pt, layout.width - 2.0 * edge_pt};
}

BoxLayout box_layout(const BoxFigure& figure) {
  BoxLayout layout;
  layout.spread = is_spread(figure);
  layout.legend = needs_legend(figure, layout.spread);
  if (!widest_miss(figure).empty()) layout.misses.kind = MissStrip::Kind::level;  // its word takes room
  choose_width(figure, layout);
  layout.thin = layout.slot < thin_pt || std::all_of(figure.measures.begin(), figure.measures.end(),
                                                     [](const Measure& m) { return m.share_confidence.has_value(); });
  place_misses(figure, layout);
  place_texts(figure, layout);
  place_rows(figure, box_legend(figure, layout), layout);
  return layout;
}

}  // namespace banyan::study
