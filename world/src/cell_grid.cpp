// SPDX-License-Identifier: MIT
// What makes this quick is one byte per cell: within how many columns and rows nothing is occupied. A line of sight
// crosses that much in one step, and the search for the nearest wall begins there.
#include "banyan/world/cell_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace banyan::world {

using Vec2 = CellGrid::Vec2;

namespace {

constexpr std::uint8_t most_reach = 255;

// The floor; the library's is a call where the processor may lack the instruction.
std::int64_t whole_below(double x) noexcept {
  const auto toward_zero = static_cast<std::int64_t>(x);
  return toward_zero - (static_cast<double>(toward_zero) > x ? 1 : 0);
}
// How far x, in cell k, is from the nearest line between cells.
double to_line(double x, std::int64_t k) noexcept {
  const double beyond = x - static_cast<double>(k);
  return std::min(beyond, 1.0 - beyond);
}

// ---- Cells as text ----

struct RowText {
  std::string_view cells;
  std::size_t times = 1;
};

// The number that the text begins with, cut off from it; nothing if there is none. Too large a one becomes `most`.
std::optional<std::size_t> cut_number(std::string_view& text, std::size_t most) {
  std::size_t digits = 0, number = 0;
  for (; digits < text.size() && text[digits] >= '0' && text[digits] <= '9'; ++digits)
    number = std::min(most, 10 * number + static_cast<std::size_t>(text[digits] - '0'));
  if (digits == 0) return std::nullopt;
  text.remove_prefix(digits);
  return number;
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// Visits the rows of a text, visit(RowText), until it returns false.
template <class Visit> void each_row(std::string_view text, const Visit& visit) {
  text = without_blanks(text);
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    RowText row{without_blanks(text.substr(0, end))};
    text.remove_prefix(std::min(end + 1, text.size()));
    std::string_view counted = row.cells;
    if (const auto times = cut_number(counted, CellGrid::most_cells + 1); times && counted.starts_with('*'))
      row = {counted.substr(1), *times};
    if (!visit(row)) return;
  }
}

// Visits the runs of equal cells in a row, visit(occupied, length). What is wrong with it, if anything.
template <class Visit> std::optional<std::string> each_run(std::string_view cells, const Visit& visit) {
  while (!cells.empty()) {
    const auto length = cut_number(cells, CellGrid::most_cells + 1);
    if (cells.empty()) return "ends with a number; a number stands before '#' or '.'";
    if (cells[0] != '#' && cells[0] != '.')
      return "has a '" + std::string(1, cells[0]) + "'; cells are '#', occupied, or '.', free, with a number before " +
             "several of the same";
    visit(cells[0] == '#', length.value_or(1));
    cells.remove_prefix(1);
  }
  return std::nullopt;
}

void add_run(std::string& text, bool occupied, std::size_t length) {
  const char cell = occupied ? '#' : '.';
  if (length < 3) text.append(length, cell);
  else text += std::to_string(length) + cell;
}

}  // namespace

std::optional<std::string> CellGrid::text_fault(std::string_view text) {
  std::optional<std::string> fault;
  std::size_t rows = 0, columns = 0, lines = 0;
  each_row(text, [&](const RowText& row) {
    std::size_t length = 0;
    fault = each_run(row.cells,
                     [&](bool /*occupied*/, std::size_t run) { length = std::min(length + run, most_cells + 1); });
    const std::string name = "row " + std::to_string(++lines);
    if (fault) fault = name + " " + *fault;
    else if (length == 0 || row.times == 0) fault = name + " has no cells";
    else if (rows > 0 && length != columns)
      fault = name + " has " + std::to_string(length) + " cells, those above have " + std::to_string(columns);
    columns = length;
    rows = std::min(rows + row.times, most_cells + 1);
    if (!fault && (rows > most_cells || columns > most_cells || (columns > 0 && rows > most_cells / columns)))
      fault = "has more than " + std::to_string(most_cells) + " cells, as of 4096 x 4096";
    return !fault;
  });
  if (!fault && rows == 0) return "has no cells";
  return fault;
}

CellGrid CellGrid::from_text(std::string_view text) {
  std::vector<std::uint8_t> cells;
  std::size_t rows = 0, columns = 0;
  each_row(text, [&](const RowText& row) {
    const std::size_t begin = cells.size();
    static_cast<void>(
        each_run(row.cells, [&](bool occupied, std::size_t run) { cells.insert(cells.end(), run, occupied ? 1 : 0); }));
    columns = cells.size() - begin;
    cells.resize(begin + columns * row.times);
    for (std::size_t k = 1; k < row.times; ++k)
      std::copy_n(cells.begin() + static_cast<std::ptrdiff_t>(begin), columns,
                  cells.begin() + static_cast<std::ptrdiff_t>(begin + k * columns));
    rows += row.times;
    return true;
  });
  for (std::size_t low = 0, high = rows - 1; low < high; ++low, --high)  // the text has the highest first
    std::swap_ranges(cells.begin() + static_cast<std::ptrdiff_t>(low * columns),
                     cells.begin() + static_cast<std::ptrdiff_t>((low + 1) * columns),
                     cells.begin() + static_cast<std::ptrdiff_t>(high * columns));
  return {columns, rows, cells};
}

std::string CellGrid::text() const {
  std::string text, last, row;
  std::size_t times = 0;
  const auto add_last = [&] {
    if (times == 0) return;
    if (!text.empty()) text += '\n';
    if (times > 1) text += std::to_string(times) + "*";
    text += last;
  };
  for (std::size_t j = rows_; j-- > 0;) {
    row.clear();
    for (std::size_t i = 0; i < columns_;) {
      const bool wall = reach_[j * columns_ + i] == 0;
      std::size_t end = i + 1;
      while (end < columns_ && (reach_[j * columns_ + end] == 0) == wall) ++end;
      add_run(row, wall, end - i);
      i = end;
    }
    if (times > 0 && row == last) {
      ++times;
      continue;
    }
    add_last();
    last.swap(row);
    times = 1;
  }
  add_last();
  return text;
}

// ---- Cells ----

// Two passes over all cells, each from what its neighbours of one half have.
CellGrid::CellGrid(std::size_t columns, std::size_t rows, const std::vector<std::uint8_t>& occupied)
    : columns_{columns}, rows_{rows}, reach_(columns * rows, most_reach) {
  const auto at = [&](std::size_t i, std::size_t j) -> std::uint8_t& { return reach_[j * columns + i]; };
  const auto one_more = [](std::uint8_t reach) {
    return static_cast<std::uint8_t>(std::min<int>(most_reach, reach + 1));
  };
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      if (occupied[j * columns + i] != 0) {
        at(i, j) = 0;
        ++occupied_;
        continue;
      }
      std::uint8_t least = most_reach;
      if (i > 0) least = at(i - 1, j);
      if (j > 0)
        for (std::size_t k = i > 0 ? i - 1 : 0; k < std::min(columns, i + 2); ++k)
          least = std::min(least, at(k, j - 1));
      at(i, j) = one_more(least);
    }
  for (std::size_t j = rows; j-- > 0;)
    for (std::size_t i = columns; i-- > 0;) {
      if (at(i, j) == 0) continue;
      std::uint8_t least = most_reach;
      if (i + 1 < columns) least = at(i + 1, j);
      if (j + 1 < rows)
        for (std::size_t k = i > 0 ? i - 1 : 0; k < std::min(columns, i + 2); ++k)
          least = std::min(least, at(k, j + 1));
      at(i, j) = std::min(at(i, j), one_more(least));
    }
}

// From outside nothing is nearer than it is from the nearest cell.
std::int64_t CellGrid::reach_from_outside(std::int64_t column, std::int64_t row) const noexcept {
  const std::int64_t i = std::clamp<std::int64_t>(column, 0, static_cast<std::int64_t>(columns_) - 1);
  const std::int64_t j = std::clamp<std::int64_t>(row, 0, static_cast<std::int64_t>(rows_) - 1);
  return std::max({std::abs(column - i), std::abs(row - j), reach(i, j)});
}

Vec2 CellGrid::nearest_of_cell(std::int64_t column, std::int64_t row, Vec2 p) noexcept {
  const auto x = static_cast<double>(column), y = static_cast<double>(row);
  return {std::clamp(p.x, x, x + 1.0), std::clamp(p.y, y, y + 1.0)};
}

std::int64_t CellGrid::first_near(double x, double farthest) noexcept {
  return std::max<std::int64_t>(0, -whole_below(farthest - x) - 1);
}
std::int64_t CellGrid::last_near(double x, double farthest, std::size_t size) noexcept {
  return std::min(static_cast<std::int64_t>(size) - 1, whole_below(x + farthest));
}

std::int64_t CellGrid::column_at(double x) const noexcept {
  return std::clamp<std::int64_t>(whole_below(x), 0, static_cast<std::int64_t>(columns_) - 1);
}
std::int64_t CellGrid::row_at(double y) const noexcept {
  return std::clamp<std::int64_t>(whole_below(y), 0, static_cast<std::int64_t>(rows_) - 1);
}

// ---- Lines of sight ----

// Along a line of cells: at(k, 0) is cell k of the line, at(k, -1) the one beside it, from which it is separated by the
// segment if that runs on the line between them (`across` is whole).
template <class Reach> bool CellGrid::blocks_along(const Reach& at, double across, double from, double to) noexcept {
  const std::int64_t row = whole_below(across), end = static_cast<std::int64_t>(std::ceil(to));
  const bool between = static_cast<double>(row) == across;
  for (std::int64_t k = whole_below(from); k < end;) {
    const std::int64_t here = at(k, row), beside = between ? at(k, row - 1) : here;
    if (here == 0 && beside == 0) return true;
    const auto corner = static_cast<double>(k);
    if (between && corner > from && corner < to &&
        ((here == 0 && at(k - 1, row - 1) == 0) || (beside == 0 && at(k - 1, row) == 0)))
      return true;
    k += std::max<std::int64_t>(1, std::min(here, beside));
  }
  return false;
}

// Of a segment that rises to the right. Nothing is occupied within `free` cells around the one it is in, so it goes on
// from where it leaves that square. On which side of a corner it does says one cross product; so no error adds up.
template <class Reach> bool CellGrid::blocks_across(const Reach& at, Vec2 a, Vec2 b) noexcept {
  const Vec2 d = b - a;
  // Above 0: the corner is to the left of the segment; 0: on it.
  const auto side = [&](std::int64_t x, std::int64_t y) {
    return d.x * (static_cast<double>(y) - a.y) - d.y * (static_cast<double>(x) - a.x);
  };
  std::int64_t column = whole_below(a.x), row = whole_below(a.y);
  while (true) {
    const std::int64_t free = at(column, row);
    if (free == 0) return true;
    const std::int64_t right = column + free, top = row + free;
    if (b.x <= static_cast<double>(right) && b.y <= static_cast<double>(top)) return false;
    const double corner = side(right, top);
    if (corner == 0.0) {
      if (at(right, top - 1) == 0 && at(right - 1, top) == 0) return true;
      column = right;
      row = top;
    } else if (corner > 0.0) {
      const double y = a.y + (static_cast<double>(right) - a.x) * (d.y / d.x);
      std::int64_t next = std::clamp(whole_below(y), row, top - 1);
      while (next + 1 < top && side(right, next + 1) <= 0.0) ++next;
      while (next > row && side(right, next) > 0.0) --next;
      column = right;
      row = next;
    } else {
      const double x = a.x + (static_cast<double>(top) - a.y) * (d.x / d.y);
      std::int64_t next = std::clamp(whole_below(x), column, right - 1);
      while (next + 1 < right && side(next + 1, top) >= 0.0) ++next;
      while (next > column && side(next, top) < 0.0) --next;
      column = next;
      row = top;
    }
  }
}

bool CellGrid::blocks(Vec2 a, Vec2 b) const noexcept {
  if (b.x != a.x ? b.x < a.x : b.y < a.y) std::swap(a, b);
  const auto width = static_cast<double>(columns_), height = static_cast<double>(rows_);
  if (b.x <= 0.0 || a.x >= width || std::max(a.y, b.y) <= 0.0 || std::min(a.y, b.y) >= height) return false;
  const auto upright = [this](std::int64_t i, std::int64_t j) { return reach(i, j); };
  const auto mirrored = [this](std::int64_t i, std::int64_t j) { return reach(i, -1 - j); };
  const auto turned = [this](std::int64_t i, std::int64_t j) { return reach(j, i); };
  if (a == b) return is_inside(a);
  if (a.y == b.y) return blocks_along(upright, a.y, a.x, b.x);
  if (a.x == b.x) return blocks_along(turned, a.x, a.y, b.y);
  if (a.y < b.y) return blocks_across(upright, a, b);
  return blocks_across(mirrored, {a.x, -a.y}, {b.x, -b.y});
}

// All cells around a point of a line or corner belong to it.
bool CellGrid::is_inside(Vec2 p) const noexcept {
  const std::int64_t right = whole_below(p.x), top = whole_below(p.y);
  const std::int64_t left = static_cast<double>(right) == p.x ? right - 1 : right;
  const std::int64_t bottom = static_cast<double>(top) == p.y ? top - 1 : top;
  return occupied(left, bottom) && occupied(left, top) && occupied(right, bottom) && occupied(right, top);
}

// Points of the segment are looked at so near to each other that what lies between them is bounded by both.
double CellGrid::gap(Vec2 a, Vec2 b) const noexcept {
  constexpr double least_step = 0.5, worth_knowing = 0.1;  // cells
  const double length = banyan::distance(a, b);
  const Vec2 along = unit(b - a);
  double clear = least_clearance(a), least = clear;
  for (double at = 0.0; at < length;) {
    if (least < worth_knowing) return 0.0;
    const double step = std::min(std::max(least_step, 0.5 * clear), length - at);
    at += std::max(step, 1e-9 * length);
    const double next = least_clearance(at < length ? a + along * at : b);
    least = std::min(least, 0.5 * (clear + next - step));
    clear = next;
  }
  return std::max(0.0, least * (1.0 - 1e-9));
}

// ---- Distances ----

double CellGrid::least_clearance(Vec2 p) const noexcept {
  const std::int64_t column = whole_below(p.x), row = whole_below(p.y);
  const std::int64_t free = reach(column, row);
  return free == 0 ? 0.0 : static_cast<double>(free - 1) + std::min(to_line(p.x, column), to_line(p.y, row));
}

// Rings of cells around p, or around the cell nearest to it. No cell of a ring is nearer than the ring is.
CellGrid::Found CellGrid::nearest(Vec2 p, double farthest) const noexcept {
  Found best{farthest * farthest, p, 0, 0};
  const std::int64_t column = column_at(p.x), row = row_at(p.y);
  const auto columns = static_cast<std::int64_t>(columns_), rows = static_cast<std::int64_t>(rows_);
  const Vec2 within{std::clamp(p.x, 0.0, static_cast<double>(columns_)),
                    std::clamp(p.y, 0.0, static_cast<double>(rows_))};
  const double outside2 = squared_norm(p - within);
  const std::array<double, 4> to_sides{within.x - static_cast<double>(column),
                                       static_cast<double>(column + 1) - within.x, within.y - static_cast<double>(row),
                                       static_cast<double>(row + 1) - within.y};
  const double inset = std::max(0.0, *std::min_element(to_sides.begin(), to_sides.end()));
  const auto look = [&](std::int64_t i, std::int64_t j) {
    const std::int64_t free = reach(i, j);
    if (free > 0) return free;
    const Vec2 point = nearest_of_cell(i, j, p);
    const double distance2 = squared_norm(point - p);
    if (distance2 < best.distance2) best = {distance2, point, i, j};
    return std::int64_t{1};
  };
  const std::int64_t last = std::max({column, columns - 1 - column, row, rows - 1 - row});
  for (std::int64_t ring = reach(column, row); ring <= last; ++ring) {
    const double away = ring == 0 ? 0.0 : static_cast<double>(ring - 1) + inset;
    if (outside2 + away * away >= best.distance2) break;
    const std::int64_t left = std::max<std::int64_t>(0, column - ring), right = std::min(columns - 1, column + ring);
    const std::int64_t bottom = std::max<std::int64_t>(0, row - ring), top = std::min(rows - 1, row + ring);
    if (row - ring >= 0)
      for (std::int64_t i = left; i <= right;) i += look(i, row - ring);
    if (row + ring < rows && ring > 0)
      for (std::int64_t i = left; i <= right;) i += look(i, row + ring);
    if (column - ring >= 0)
      for (std::int64_t j = bottom; j <= top;) j += look(column - ring, j);
    if (column + ring < columns && ring > 0)
      for (std::int64_t j = bottom; j <= top;) j += look(column + ring, j);
  }
  return best;
}

// The same for free cells, of a point in an occupied one. All around the grid is free.
CellGrid::Found CellGrid::nearest_free(Vec2 p) const noexcept {
  Found best;
  const std::int64_t column = whole_below(p.x), row = whole_below(p.y);
  const double inset = std::min(to_line(p.x, column), to_line(p.y, row));
  const auto look = [&](std::int64_t i, std::int64_t j) {
    if (occupied(i, j)) return;
    const Vec2 point = nearest_of_cell(i, j, p);
    const double distance2 = squared_norm(point - p);
    if (distance2 < best.distance2) best = {distance2, point, i, j};
  };
  for (std::int64_t ring = 1;; ++ring) {
    const double away = static_cast<double>(ring - 1) + inset;
    if (away * away >= best.distance2) return best;
    for (std::int64_t k = -ring; k <= ring; ++k) {
      look(column + k, row - ring);
      look(column + k, row + ring);
      look(column - ring, row + k);
      look(column + ring, row + k);
    }
  }
}

double CellGrid::clearance(Vec2 p) const noexcept {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (occupied(whole_below(p.x), whole_below(p.y))) return -std::sqrt(nearest_free(p).distance2);
  return occupied_ == 0 ? infinity : std::sqrt(nearest(p, infinity).distance2);
}

Vec2 CellGrid::nearest_surface_point(Vec2 p) const noexcept {
  if (occupied(whole_below(p.x), whole_below(p.y))) return nearest_free(p).point;
  return nearest(p, std::numeric_limits<double>::infinity()).point;
}

// Away from the nearest cell, and again, as long as another one is in the way: in a corner two are.
Vec2 CellGrid::push_out(Vec2 p, double radius) const noexcept {
  constexpr int most_pushes = 8;
  constexpr double rounding = 1e-9;
  const double enough = radius * (1.0 - rounding);
  Vec2 at = p;
  for (int k = 0; k < most_pushes && least_clearance(at) < enough; ++k) {
    const std::int64_t column = whole_below(at.x), row = whole_below(at.y);
    const bool in = occupied(column, row);
    const Found found = in ? nearest_free(at) : nearest(at, radius);
    const double distance = std::sqrt(found.distance2);
    if (!in && distance >= enough) break;
    Vec2 out = in ? found.point - at : at - found.point;
    if (distance == 0.0) {  // on the very edge: straight out of the cell, or into the free one
      const Vec2 middle{static_cast<double>(found.column) + 0.5, static_cast<double>(found.row) + 0.5};
      const Vec2 from = in ? middle - at : at - middle;
      out = std::abs(from.x) > std::abs(from.y) ? Vec2{from.x, 0.0} : Vec2{0.0, from.y};
    }
    at = found.point + unit(out) * radius;
  }
  return at - p;
}

}  // namespace banyan::world
