// SPDX-License-Identifier: MIT
// A gnuplot script under construction (figure_script.hpp).
#include "figure_script.hpp"

#include <algorithm>
#include <array>

#include "figure_text.hpp"

namespace banyan::study {

namespace {

// Okabe & Ito's colours. Neighbours in this order differ clearly in lightness too.
constexpr std::array<Style, most_series> styles{{
    {"#0072b2", "solid 0.55", "solid", 7},
    {"#d55e00", "solid 0.15", "(12,5)", 9},
    {"#009e73", "solid 0.95", "(3,4)", 5},
    {"#cc79a7", "pattern 4", "(12,4,3,4)", 13},
    {"#e69f00", "solid 0.30", "(20,6)", 11},
    {"#56b4e9", "pattern 5", "(6,4)", 6},
    {"#000000", "solid 0.50", "(2,3)", 8},
    {"#7f7f7f", "pattern 2", "(12,4,3,4,3,4)", 4},
}};

}  // namespace

const Style& style_of(std::size_t series) { return styles.at(series); }

void Script::line(std::string_view text) {
  text_ += indent_;
  text_ += text;
  text_ += '\n';
}

void Script::begin(std::string_view what, const std::string& name) {
  line("# " + std::string(what));
  line("# Run by gnuplot in its folder, this script draws an svg and a png of its own name.");
  line("reset");
  line("set encoding utf8");
  line("output = " + in_quotes("./" + name));
  line("if (exists('ARG1') && strlen(ARG1) > 0) { output = ARG1 }  # gnuplot -c script output");
}

void Script::begin_data(const std::string& block, std::string_view columns) {
  line(block + " << EOD");
  line("# " + std::string(columns));
}

void Script::begin_drawing() {
  const std::string font = "font 'DejaVu Sans," + number(text_px) + "' noenhanced background rgb 'white'";
  line("do for [format in 'svg png'] {");
  indent_ = "  ";
  line("if (format eq 'svg') {");
  line("  set terminal svg size " + number(width_) + "," + number(height_) + " " + font);
  line("} else {  # twice the size: 1.5, as pngcairo's points are 4/3 pixels");
  line("  set terminal pngcairo size " + number(2.0 * width_) + "," + number(2.0 * height_) +
       " fontscale 1.5 linewidth 2 pointscale 2 " + font);
  line("}");
  line("set output output.'.'.format");
  line("unset label; unset object; unset arrow; unset key");
  line("set border 3 back lc rgb '#808080' lw 1");
  line("set tics nomirror out scale 0.5 textcolor rgb 'black'");
  line("set grid ytics noxtics back lt 1 lc rgb '#dedede' lw 0.7");
  line("set multiplot");
}

void Script::end_drawing() {
  line("unset multiplot");
  line("unset output");
  indent_.clear();
  line("}");
}

std::string Script::screen(Place at) const {
  return "screen " + fixed(at.x / width_, 5) + ", screen " + fixed(1.0 - at.y / height_, 5);
}

void Script::label(std::string_view text, Place at, Align align, int degrees, bool title) {
  static constexpr std::array<std::string_view, 3> names{"left", "center", "right"};
  std::string command =
      "set label " + in_quotes(text) + " at " + screen(at) + " " + std::string(names.at(static_cast<std::size_t>(align)));
  if (degrees != 0) command += " rotate by " + std::to_string(degrees);
  if (title) command += " font 'DejaVu Sans:Bold," + number(title_px) + "'";
  line(command);
}

void Script::labels(const std::vector<std::string>& lines, Place at, Align align, int degrees, bool title) {
  for (const std::string& text : lines) {
    if (!text.empty()) label(text, at, align, degrees, title);
    (degrees == 90 ? at.x : at.y) += line_px;
  }
}

void Script::rectangle(Place corner, double width, double height, const std::string& style) {
  line("set object rectangle from " + screen(corner) + " to " + screen({corner.x + width, corner.y + height}) +
       " front " + style);
}

void Script::stroke(Place from, Place to, const std::string& style) {
  line("set arrow from " + screen(from) + " to " + screen(to) + " nohead front " + style);
}

void Script::point(Place at, const std::string& style) {
  line("set label '' at " + screen(at) + " front point " + style);
}

void Script::forget_labels() { line("unset label; unset object; unset arrow"); }

void Script::area(const Area& area) {
  line("set lmargin at screen " + fixed(area.left / width_, 5) + "; set rmargin at screen " +
       fixed(area.right / width_, 5));
  line("set tmargin at screen " + fixed(1.0 - area.top / height_, 5) + "; set bmargin at screen " +
       fixed(1.0 - area.bottom / height_, 5));
}

Legend::Legend(const std::vector<std::string>& names, double sample_px, double room_px) : sample_px_(sample_px) {
  if (std::all_of(names.begin(), names.end(), [](const std::string& name) { return name.empty(); })) return;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string name = clean(names[i]);
    std::replace(name.begin(), name.end(), '\n', ' ');
    name = shortened(name, room_px - sample_px - space_px, text_px);
    const double width = sample_px + space_px + text_width_px(name, text_px);
    if (rows_.empty() || rows_.back().width + gap_px + width > room_px) {
      rows_.push_back({{}, width});
    } else {
      rows_.back().width += gap_px + width;
    }
    rows_.back().entries.push_back({i, name, width});
  }
}

}  // namespace banyan::study
