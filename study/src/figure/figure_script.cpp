// SPDX-License-Identifier: MIT
// A gnuplot script under construction (figure_script.hpp).
#include "figure_script.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "figure_text.hpp"

namespace banyan::study {

namespace {

constexpr double png_pixels_in = 300.0;  // in an inch
constexpr double svg_pixels_in = 96.0;   // as CSS has it

// Okabe and Ito's colours without their yellow, which is no line on white, and five more that are as far from these,
// and from each other, as these are: a test measures it for the colour-blind too. Neighbours differ in the lightness of
// their fill.
constexpr std::array<Style, most_series> styles{{
    {"#0072b2", 0.55, "solid"},
    {"#d55e00", 0.15, "(12,5)"},
    {"#009e73", 0.90, "(3,4)"},
    {"#cc79a7", 0.30, "(12,4,3,4)"},
    {"#e69f00", 0.70, "(20,6)"},
    {"#56b4e9", 0.20, "(6,4)"},
    {"#000000", 0.00, "(2,3)"},
    {"#882255", 0.45, "(8,3)"},
    {"#8cb85c", 0.70, "(16,4,2,4)"},
    {"#332288", 0.25, "(4,2)"},
    {"#664400", 0.60, "(10,8)"},
    {"#9966ff", 0.10, "(12,4,3,4,3,4)"},
}};
constexpr std::array<int, 6> filled_points{7, 9, 5, 13, 11, 15};
// Of variants: each far from those before it (van der Corput's sequence).
constexpr std::array<double, most_variants> fill_steps{0.0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875};

}  // namespace

Style style_of(std::size_t series, std::size_t variant) {
  Style style = styles.at(series);
  style.fill = std::fmod(style.fill + fill_steps.at(variant), 1.0);
  // The same shape, open; then the next shape, filled, and so on.
  style.point = filled_points.at((series + variant / 2) % filled_points.size()) - static_cast<int>(variant % 2);
  return style;
}

std::string rgb(std::string_view color, double clear) {
  constexpr std::string_view digits = "0123456789abcdef";
  const auto alpha = static_cast<std::size_t>(std::lround(255.0 * clear));
  std::string text = "rgb '#";
  if (alpha > 0) {
    text += digits[alpha / 16];
    text += digits[alpha % 16];
  }
  return text + std::string(color.substr(1)) + "'";
}

std::string point_size(double points) { return "ps " + number(points) + "*dot"; }

void Script::line(std::string_view text) {
  text_ += indent_;
  text_ += text;
  text_ += '\n';
}

void Script::begin(std::string_view what, const std::string& name) {
  line("# " + std::string(what));
  line("# Run by gnuplot in its folder, this script draws an svg, a pdf and a png of its own name.");
  line("reset");
  line("set encoding utf8");
  line("output = " + in_quotes("./" + name));
  line("if (exists('ARG1') && strlen(ARG1) > 0) { output = ARG1 }  # gnuplot -c script output");
}

void Script::begin_data(const std::string& block, std::string_view columns) {
  line(block + " << EOD");
  line("# " + std::string(columns));
}

// Each terminal has units of its own. `font`.size is a size in points, a line of width 1 is 1 pt wide in all of them,
// and `dot` is a point's size per pt of its width.
void Script::begin_drawing() {
  const double svg = svg_pixels_in / points_in, png = png_pixels_in / points_in;
  const auto inches = [](double points) { return number(points / points_in) + "in"; };
  line("do for [format in 'svg pdf png'] {");
  indent_ = "  ";
  line("font = format eq 'svg' ? 'sans-serif,' : 'DejaVu Sans,'  # an svg has the reader's own");
  line("if (format eq 'svg') {");
  line("  set terminal svg size " + number(std::round(width_ * svg)) + "," + number(std::round(height_ * svg)) +
       " font font." + in_quotes(number(text_pt)) + " fontscale " + fixed(svg, 4) + " linewidth " + fixed(svg, 4) +
       " noenhanced background rgb 'white'");
  line("  dot = 0.167");
  line("}");
  line("if (format eq 'pdf') {");
  line("  set terminal pdfcairo size " + inches(width_) + "," + inches(height_) + " font font." +
       in_quotes(number(text_pt)) + " fontscale 0.75 linewidth 2 noenhanced background rgb 'white'");
  line("  dot = 0.08");
  line("}");
  line("if (format eq 'png') {");
  line("  set terminal pngcairo size " + number(std::round(width_ * png)) + "," + number(std::round(height_ * png)) +
       " font font." + in_quotes(number(text_pt)) + " fontscale " + fixed(png * 0.75, 4) + " linewidth " +
       fixed(png, 4) + " pointscale " + fixed(png, 4) + " noenhanced background rgb 'white'");
  line("  dot = 0.08");
  line("}");
  line("set output output.'.'.format");
  line("unset label; unset object; unset arrow; unset key");
  frame(true);
  line("set tics nomirror out scale 0.35 textcolor rgb 'black'");
  line("set grid ytics noxtics back lt 1 lc rgb '#dedede' lw 0.4");
  line("set multiplot");
}

void Script::end_drawing() {
  line("unset multiplot");
  line("unset output");
  indent_.clear();
  line("}");
}

std::string Script::screen(PanelPoint at) const {
  return "screen " + fixed(at.x / width_, 5) + ", screen " + fixed(1.0 - at.y / height_, 5);
}

void Script::label(std::string_view text, PanelPoint at, Align align, int degrees, double size) {
  static constexpr std::array<std::string_view, 3> names{"left", "center", "right"};
  std::string command = "set label " + in_quotes(text) + " at " + screen(at) + " " +
                        std::string(names.at(static_cast<std::size_t>(align)));
  if (degrees != 0) command += " rotate by " + std::to_string(degrees);
  if (size != text_pt) command += " font font." + in_quotes(number(size));
  line(command);
}

void Script::labels(const std::vector<std::string>& lines, PanelPoint at, Align align, int degrees) {
  for (const std::string& text : lines) {
    if (!text.empty()) label(text, at, align, degrees);
    (degrees == 90 ? at.x : at.y) += line_pt;
  }
}

void Script::rectangle(PanelPoint corner, double width, double height, const std::string& style) {
  line("set object rectangle from " + screen(corner) + " to " + screen({corner.x + width, corner.y + height}) +
       " front " + style);
}

void Script::stroke(PanelPoint from, PanelPoint to, const std::string& style) {
  line("set arrow from " + screen(from) + " to " + screen(to) + " nohead " + style);
}

void Script::point(PanelPoint at, double size, const std::string& style) {
  line("set label '' at " + screen(at) + " front point " + point_size(size) + " " + style);
}

void Script::forget_labels() { line("unset label; unset object; unset arrow"); }

void Script::area(const Area& area) {
  line("set lmargin at screen " + fixed(area.left / width_, 5) + "; set rmargin at screen " +
       fixed(area.right / width_, 5));
  line("set tmargin at screen " + fixed(1.0 - area.top / height_, 5) + "; set bmargin at screen " +
       fixed(1.0 - area.bottom / height_, 5));
}

void Script::frame(bool shown) { line(shown ? "set border 3 back lc rgb '#606060' lw 0.5" : "unset border"); }

void Script::axis(char letter, double low, double high, bool logarithmic, const std::string& ticks) {
  const std::string name(1, letter);
  line((logarithmic ? "set logscale " : "unset logscale ") + name);
  line("set " + name + "range [" + number(low) + ":" + number(high) + "]");
  line("set " + name + "tics " + ticks);
}

Legend::Legend(const std::vector<std::string>& names, double sample, double room) : sample_(sample) {
  if (std::all_of(names.begin(), names.end(), [](const std::string& name) { return name.empty(); })) return;
  for (const std::string& given : names) {
    std::string name = clean(given);
    std::replace(name.begin(), name.end(), '\n', ' ');
    names_.push_back(shortened(name, room - sample - space_pt, text_pt));
  }
  // As many columns as fit in, and then as few as the same number of rows needs.
  columns_ = names_.size();
  while (columns_ > 1 && !fits(room)) --columns_;
  const std::size_t rows = (names_.size() + columns_ - 1) / columns_;
  columns_ = (names_.size() + rows - 1) / rows;
  (void)fits(room);
}

bool Legend::fits(double room) {
  lefts_.assign(columns_ + 1, 0.0);
  for (std::size_t c = 0; c < columns_; ++c) {
    double widest = 0.0;
    for (std::size_t i = c; i < names_.size(); i += columns_) widest = std::max(widest, text_width(names_[i], text_pt));
    lefts_[c + 1] = lefts_[c] + sample_ + space_pt + widest + gap_pt;
  }
  return lefts_.back() - gap_pt <= room;
}

double Legend::height() const noexcept {
  const std::size_t rows = (names_.size() + columns_ - 1) / columns_;
  return row_pt * static_cast<double>(rows);
}

}  // namespace banyan::study
