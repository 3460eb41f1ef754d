// SPDX-License-Identifier: MIT
// A floor of square cells, each free or occupied: what a map is made of. Everything here is in cells: the lower left
// corner is the origin, x points to the right, y up, and each cell is 1 wide. All around it is free. Immutable, so that
// worlds share it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/controller/core/vec2.hpp"

namespace banyan::world {

class CellGrid {
 public:
  using Vec2 = BasicVec2<double>;
  static constexpr std::size_t most_cells = std::size_t{1} << 24;

  // `occupied`: columns x rows values, 0: free; the lowest row first. 1 to most_cells cells. O(cells).
  CellGrid(std::size_t columns, std::size_t rows, const std::vector<std::uint8_t>& occupied);

  // Rows of cells, the highest first: '#' occupied, '.' free, "12." twelve free ones, "3*" before a row three of them.
  // What is wrong with such a text, if anything; and the grid of one with which nothing is wrong.
  [[nodiscard]] static std::optional<std::string> text_fault(std::string_view text);
  [[nodiscard]] static CellGrid from_text(std::string_view text);
  // The shortest such text; equal grids have equal ones.
  [[nodiscard]] std::string text() const;

  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
  [[nodiscard]] std::size_t occupied_cells() const noexcept { return occupied_; }
  // Also of cells outside, which are free.
  [[nodiscard]] bool occupied(std::int64_t column, std::int64_t row) const noexcept { return reach(column, row) == 0; }
  // No occupied cell is fewer columns and fewer rows away than this; 0: the cell is occupied. Exact up to 254, within
  // the grid.
  [[nodiscard]] std::int64_t reach(std::int64_t column, std::int64_t row) const noexcept {
    const auto i = static_cast<std::size_t>(column), j = static_cast<std::size_t>(row);  // negative ones become huge
    return i < columns_ && j < rows_ ? reach_[j * columns_ + i] : reach_from_outside(column, row);
  }

  // Whether the open segment a-b meets the inside of the occupied area, or passes between two occupied cells that touch
  // at a corner. Along an edge of the area, or by a corner of it, it is free. Symmetric in a and b to the last bit.
  [[nodiscard]] bool blocks(Vec2 a, Vec2 b) const noexcept;
  // No more than the distance between the segment a-b and the occupied area.
  [[nodiscard]] double gap(Vec2 a, Vec2 b) const noexcept;
  // No more than the distance of p to the occupied area, and less than it by no more than its half and two cells.
  // Constant time.
  [[nodiscard]] double least_clearance(Vec2 p) const noexcept;
  // The distance itself; inside the area the negative one to where it ends; infinity if all is free.
  [[nodiscard]] double clearance(Vec2 p) const noexcept;
  // The point of the area's edge nearest to p, also from inside; p if all is free.
  [[nodiscard]] Vec2 nearest_surface_point(Vec2 p) const noexcept;
  // A short shift that brings a disc of `radius` at p out of the area; zero if it is out. In a gap that is too narrow
  // for the disc some of it stays in.
  [[nodiscard]] Vec2 push_out(Vec2 p, double radius) const noexcept;

  // Calls visit(point) with the nearest point of every occupied cell no farther from p than `farthest`.
  template <class Visit> void each_near(Vec2 p, double farthest, const Visit& visit) const {
    if (least_clearance(p) > farthest) return;
    const std::int64_t top = last_near(p.y, farthest, rows_), right = last_near(p.x, farthest, columns_);
    for (std::int64_t row = first_near(p.y, farthest); row <= top; ++row)
      for (std::int64_t column = first_near(p.x, farthest); column <= right;) {
        const std::int64_t free = reach(column, row);
        if (free == 0) {
          const Vec2 point = nearest_of_cell(column, row, p);
          if (squared_norm(point - p) <= farthest * farthest) visit(point);
        }
        column += free == 0 ? 1 : free;
      }
  }

  // Calls visit(low, high) with the corners of rectangles that the occupied cells make up, each as wide as it can be
  // and then as high.
  template <class Visit> void each_block(const Visit& visit) const {
    std::vector<Block> open, next;  // of the row below, by column
    for (std::size_t row = 0; row <= rows_; ++row) {
      next.clear();
      auto old = open.begin();
      const auto close = [&](const Block& block) {
        visit(Vec2{static_cast<double>(block.from), static_cast<double>(block.row)},
              Vec2{static_cast<double>(block.to), static_cast<double>(row)});
      };
      for (std::size_t column = 0; row < rows_ && column < columns_;) {
        if (reach_[row * columns_ + column] != 0) {
          ++column;
          continue;
        }
        Block block{column, column, row};
        while (block.to < columns_ && reach_[row * columns_ + block.to] == 0) ++block.to;
        column = block.to;
        for (; old != open.end() && old->from < block.from; ++old) close(*old);
        if (old != open.end() && old->from == block.from && old->to == block.to) block.row = old++->row;
        next.push_back(block);
      }
      for (; old != open.end(); ++old) close(*old);
      open.swap(next);
    }
  }

  friend bool operator==(const CellGrid&, const CellGrid&) = default;

 private:
  struct Block {
    std::size_t from, to, row;
  };
  struct Found {
    double distance2 = std::numeric_limits<double>::infinity();
    Vec2 point{};
    std::int64_t column = 0, row = 0;
  };
  [[nodiscard]] static Vec2 nearest_of_cell(std::int64_t column, std::int64_t row, Vec2 p) noexcept;
  [[nodiscard]] static std::int64_t first_near(double x, double farthest) noexcept;
  [[nodiscard]] static std::int64_t last_near(double x, double farthest, std::size_t size) noexcept;
  [[nodiscard]] std::int64_t reach_from_outside(std::int64_t column, std::int64_t row) const noexcept;
  // The cell that p is in, or the nearest one.
  [[nodiscard]] std::int64_t column_at(double x) const noexcept;
  [[nodiscard]] std::int64_t row_at(double y) const noexcept;
  [[nodiscard]] bool is_inside(Vec2 p) const noexcept;
  [[nodiscard]] Found nearest(Vec2 p, double farthest) const noexcept;
  [[nodiscard]] Found nearest_free(Vec2 p) const noexcept;
  template <class Reach> static bool blocks_along(const Reach& at, double across, double from, double to) noexcept;
  template <class Reach> static bool blocks_across(const Reach& at, Vec2 a, Vec2 b) noexcept;

  std::size_t columns_, rows_, occupied_ = 0;
  std::vector<std::uint8_t> reach_;  // row by row; 255: no less
};

}  // namespace banyan::world
