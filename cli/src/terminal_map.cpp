// SPDX-License-Identifier: MIT
#include "terminal_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

namespace banyan::cli {
namespace {

using record::Frame;
using record::RobotFrame;
using record::Vec2;

// A character of a terminal is about twice as high as wide: two by four dots are squares.
constexpr int dots_across = 2, dots_down = 4;

struct Mark {
  char letter = ' ';
  int colour = 0;  // of the 256 of a terminal
};

Mark mark_of(const RobotFrame& robot) {
  if (!robot.alive) return {'x', 244};
  switch (robot.role) {
    case Role::root: return {'R', 202};
    case Role::worker: return {'W', 33};
    case Role::connector: return {'o', 36};
    case Role::spare: break;
  }
  return {'.', 185};
}

class Canvas {
 public:
  Canvas(const record::Viewport& view, const MapStyle& style)
      : columns_(std::max(10, style.columns)),
        lines_(std::max(5, style.lines)),
        dots_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(lines_), 0),
        marks_(dots_.size()) {
    const Vec2 size = view.high - view.low;
    // Half a character stays free at each edge.
    per_m_ = std::min((columns_ - 1) * dots_across / size.x, (lines_ - 1) * dots_down / size.y);
    middle_ = 0.5 * (view.low + view.high);
  }

  void line(Vec2 a, Vec2 b) {
    const Vec2 from = dot_of(a);
    const Vec2 to = dot_of(b);
    const double steps = std::ceil(std::max({1.0, std::fabs(to.x - from.x), std::fabs(to.y - from.y)}));
    if (!(steps < 1e5)) return;  // damage
    for (double k = 0.0; k <= steps; k += 1.0) set(from + (k / steps) * (to - from));
  }

  void mark(Vec2 at, Mark mark) {
    const Vec2 dot = dot_of(at);
    if (const auto cell = cell_of(dot)) marks_[*cell] = mark;
  }

  [[nodiscard]] std::string text(bool colour) const {
    std::string text;
    for (int line = 0; line < lines_; ++line) {
      std::string row;
      std::size_t used = 0;
      for (int column = 0; column < columns_; ++column) {
        add(place(line, column), colour, row);
        if (row.back() != ' ') used = row.size();
      }
      text.append(row, 0, used).push_back('\n');
    }
    return text;
  }

 private:
  // Dots from the upper left corner.
  [[nodiscard]] Vec2 dot_of(Vec2 p) const {
    return {0.5 * columns_ * dots_across + (p.x - middle_.x) * per_m_,
            0.5 * lines_ * dots_down - (p.y - middle_.y) * per_m_};
  }
  [[nodiscard]] std::optional<std::size_t> cell_of(Vec2 dot) const {
    if (!(dot.x >= 0.0 && dot.y >= 0.0 && dot.x < columns_ * dots_across && dot.y < lines_ * dots_down))
      return std::nullopt;
    return place(static_cast<int>(dot.y) / dots_down, static_cast<int>(dot.x) / dots_across);
  }
  [[nodiscard]] std::size_t place(int line, int column) const {
    return static_cast<std::size_t>(line) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  void set(Vec2 dot) {
    // Unicode numbers the dots of a braille pattern by columns, the lowest two last.
    constexpr std::array<std::uint8_t, 8> bits{0x01, 0x08, 0x02, 0x10, 0x04, 0x20, 0x40, 0x80};
    const auto cell = cell_of(dot);
    if (!cell) return;
    const std::size_t x = static_cast<std::size_t>(dot.x) % std::size_t{dots_across};
    const std::size_t y = static_cast<std::size_t>(dot.y) % std::size_t{dots_down};
    dots_[*cell] |= bits[y * dots_across + x];
  }
  void add(std::size_t cell, bool colour, std::string& row) const {
    const Mark& mark = marks_[cell];
    if (mark.letter != ' ') {
      if (colour) row += "\x1b[1;38;5;" + std::to_string(mark.colour) + "m";
      row += mark.letter;
      if (colour) row += "\x1b[0m";
    } else if (dots_[cell] != 0) {  // U+2800 and on
      row += {'\xE2', static_cast<char>(0xA0 + (dots_[cell] >> 6)), static_cast<char>(0x80 + (dots_[cell] & 63))};
    } else {
      row += ' ';
    }
  }

  int columns_, lines_;
  double per_m_ = 1.0;
  Vec2 middle_;
  std::vector<std::uint8_t> dots_;
  std::vector<Mark> marks_;
};

}  // namespace

std::string terminal_map(const Frame& frame, const record::Viewport& view, const MapStyle& style) {
  Canvas canvas(view, style);
  for (const RobotFrame& robot : frame.robots) {
    const auto parent = static_cast<std::size_t>(robot.parent);  // -1: beyond all
    if (robot.alive && robot.role != Role::spare && parent < frame.robots.size())
      canvas.line(robot.position, frame.robots[parent].position);
  }
  for (const auto& target : frame.targets) canvas.mark(target.position, {'+', target.active ? 175 : 244});
  // The fewer of a role, the later: none of them may be covered.
  const auto place = [&](bool alive, Role role) {
    for (const RobotFrame& robot : frame.robots)
      if (robot.alive == alive && robot.role == role) canvas.mark(robot.position, mark_of(robot));
  };
  for (const Role role : {Role::spare, Role::connector, Role::worker, Role::root}) place(false, role);
  for (const Role role : {Role::spare, Role::connector, Role::worker, Role::root}) place(true, role);
  return canvas.text(style.colour);
}

}  // namespace banyan::cli
