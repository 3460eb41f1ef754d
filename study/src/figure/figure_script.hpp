// SPDX-License-Identifier: MIT
// A gnuplot script under construction. Places are points (1/72 inch) from the upper left corner. It
// draws an svg, a pdf and a png of the same layout.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/study/figure.hpp"

namespace banyan::study {

inline constexpr double points_in = 72.0;  // in an inch
inline constexpr double text_pt = 8.0;
inline constexpr double line_pt = 10.0;  // from one line of text to the next
inline constexpr double edge_pt = 3.0;   // around everything
inline constexpr double tick_pt = 6.0;   // a tick mark and the space before its label

// How a series is told from the others: by colour, and in grey print by the lightness of its fill, its
// dashes and its points.
struct Style {
  std::string_view color;  // "#0072b2"
  double fill;             // how much of the colour a box is filled with
  std::string_view dash;   // gnuplot's dash type of a line
  int point = 0;           // gnuplot's point type
};
// `series` < most_series; `variant` < most_variants: of the same colour, but with another fill and other points.
[[nodiscard]] Style style_of(std::size_t series, std::size_t variant = 0);

enum class Align { left, center, right };

struct PanelPoint {
  double x = 0.0, y = 0.0;
};
struct Area {  // of a panel, within its axes
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
};

class Script {
 public:
  Script(double width, double height) : width_(width), height_(height) {}

  // The text so far; `name` is what the files are called if the script is run by hand.
  void begin(std::string_view what, const std::string& name);
  void begin_data(const std::string& block, std::string_view columns);
  void end_data() { line("EOD"); }
  void begin_drawing();
  void end_drawing();

  void line(std::string_view text);
  // Text on one line, its middle at `at`; `degrees` against the clock. `size` in points.
  void label(std::string_view text, PanelPoint at, Align align, int degrees = 0, double size = text_pt);
  // Lines one below the other (or, turned by 90 degrees, one right of the other), the first at `at`.
  void labels(const std::vector<std::string>& lines, PanelPoint at, Align align, int degrees = 0);
  void rectangle(PanelPoint corner, double width, double height, const std::string& style);
  void stroke(PanelPoint from, PanelPoint to, const std::string& style);
  void point(PanelPoint at, double size, const std::string& style);  // size: see point_size()
  void forget_labels();  // those so far are drawn; the next panel does not repeat them
  void area(const Area& area);
  void frame(bool shown);  // the lines of the axes
  void axis(char letter, double low, double high, bool logarithmic, const std::string& ticks);

  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  [[nodiscard]] std::string screen(PanelPoint at) const;

  std::string text_, indent_;
  double width_, height_;
};

// "rgb '#0072b2'", and with `clear`, a share from 0 to 1, partly transparent.
[[nodiscard]] std::string rgb(std::string_view color, double clear = 0.0);
// "ps 1.5*dot": gnuplot's size of a point that is about so many points (1/72 inch) wide.
[[nodiscard]] std::string point_size(double points);

// One legend for all panels: names beside a sample of each series, in rows and columns.
class Legend {
 public:
  // No legend if no series has a name. `sample`: the width of a sample.
  Legend(const std::vector<std::string>& names, double sample, double room);
  [[nodiscard]] double height() const noexcept;
  // draw_sample(script, series, left end of its middle line) draws one.
  template <typename Sample> void draw(Script& script, double center_x, double top, Sample draw_sample) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const std::size_t row = i / columns_;
      const PanelPoint at{center_x - (lefts_.back() - gap_pt) / 2.0 + lefts_[i % columns_],
                          top + (static_cast<double>(row) + 0.5) * row_pt};
      draw_sample(script, i, at);
      script.label(names_[i], {at.x + sample_ + space_pt, at.y}, Align::left);
    }
  }

 private:
  static constexpr double row_pt = 11.0;
  static constexpr double space_pt = 3.0;
  static constexpr double gap_pt = 10.0;
  [[nodiscard]] bool fits(double room);  // with so many columns; places them

  std::vector<std::string> names_;
  std::size_t columns_ = 1;
  std::vector<double> lefts_;  // of the columns, and the end of the last
  double sample_;
};

}  // namespace banyan::study
