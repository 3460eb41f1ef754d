// SPDX-License-Identifier: MIT
// A gnuplot script under construction. Places are pixels of the svg from its upper left corner; the
// png has the same layout at twice the size.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace banyan::study {

inline constexpr double text_px = 12.0;
inline constexpr double title_px = 13.0;       // of the whole figure, bold
inline constexpr double line_px = 16.0;        // from one line of text to the next
inline constexpr double edge_px = 12.0;        // around everything
inline constexpr std::size_t most_series = 8;  // that can be told apart

// How a series is told from the others: by colour, and in grey print by the lightness or pattern of
// its fill, its dashes and its points.
struct Style {
  std::string_view color;  // "#0072b2"
  std::string_view fill;   // gnuplot's fill style of a box
  std::string_view dash;   // gnuplot's dash type of a line
  int point;               // gnuplot's point type
};
[[nodiscard]] const Style& style_of(std::size_t series);  // < most_series

enum class Align { left, center, right };

struct Place {
  double x = 0.0, y = 0.0;
};
struct Area {  // of a panel, within its axes
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
};

class Script {
 public:
  Script(double width_px, double height_px) : width_(width_px), height_(height_px) {}

  // The text so far; `name` is what the files are called if the script is run by hand.
  void begin(std::string_view what, const std::string& name);
  void begin_data(const std::string& block, std::string_view columns);
  void end_data() { line("EOD"); }
  void begin_drawing();
  void end_drawing();

  void line(std::string_view text);
  // Text on one line, its middle at `at`; `degrees` against the clock.
  void label(std::string_view text, Place at, Align align, int degrees = 0, bool title = false);
  // Lines one below the other (or, turned by 90 degrees, one right of the other), the first at `at`.
  void labels(const std::vector<std::string>& lines, Place at, Align align, int degrees = 0, bool title = false);
  void rectangle(Place corner, double width, double height, const std::string& style);
  void stroke(Place from, Place to, const std::string& style);
  void point(Place at, const std::string& style);
  void forget_labels();  // those so far are drawn; the next panel does not repeat them
  void area(const Area& area);

  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  [[nodiscard]] std::string screen(Place at) const;

  std::string text_, indent_;
  double width_, height_;
};

// One legend for all panels: names beside a sample of each series, in rows, centred.
class Legend {
 public:
  // No legend if no series has a name. `sample_px`: the width of a sample.
  Legend(const std::vector<std::string>& names, double sample_px, double room_px);
  [[nodiscard]] double height() const noexcept { return static_cast<double>(rows_.size()) * row_px; }
  // sample(script, series, left end of its middle line) draws one.
  template <typename Sample> void draw(Script& script, double center_x, double top, Sample sample) const {
    double y = top + row_px / 2.0;
    for (const Row& row : rows_) {
      double x = center_x - row.width / 2.0;
      for (const Entry& entry : row.entries) {
        sample(script, entry.series, Place{x, y});
        script.label(entry.name, {x + sample_px_ + space_px, y}, Align::left);
        x += entry.width + gap_px;
      }
      y += row_px;
    }
  }

 private:
  static constexpr double row_px = 20.0;
  static constexpr double space_px = 6.0;
  static constexpr double gap_px = 22.0;
  struct Entry {
    std::size_t series;
    std::string name;
    double width;
  };
  struct Row {
    std::vector<Entry> entries;
    double width = 0.0;
  };
  std::vector<Row> rows_;
  double sample_px_;
};

}  // namespace banyan::study
