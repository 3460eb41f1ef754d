// SPDX-License-Identifier: MIT
// Maps against brute force: all cells, all corners, all pieces of a line of sight.
#include "banyan/world/cell_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "banyan/world/random.hpp"

namespace banyan::world {
namespace {

using Place = CellGrid::Vec2;

class GridDraws {
 public:
  explicit GridDraws(std::uint64_t seed) : seed_{seed} {}
  double between(double low, double high) {
    return low + (high - low) * to_uniform(bits(seed_, Purpose::placement, next_++));
  }
  CellGrid grid(std::size_t columns, std::size_t rows, double share) {
    std::vector<std::uint8_t> cells(columns * rows);
    for (std::uint8_t& cell : cells) cell = between(0.0, 1.0) < share ? 1 : 0;
    return {columns, rows, cells};
  }
  Place point(const CellGrid& grid, double around) {
    return {between(-around, static_cast<double>(grid.columns()) + around),
            between(-around, static_cast<double>(grid.rows()) + around)};
  }
  // On quarters of a cell, so that lines of sight pass through corners and along edges, and all products are exact.
  Place quarter(const CellGrid& grid, double around) {
    const Place p = point(grid, around);
    return {std::floor(4.0 * p.x) / 4.0, std::floor(4.0 * p.y) / 4.0};
  }

 private:
  std::uint64_t seed_, next_ = 0;
};

template <class Visit> void each_cell(const CellGrid& grid, const Visit& visit) {
  for (std::int64_t row = 0; row < static_cast<std::int64_t>(grid.rows()); ++row)
    for (std::int64_t column = 0; column < static_cast<std::int64_t>(grid.columns()); ++column)
      if (grid.occupied(column, row)) visit(column, row);
}

double distance_to_cell(std::int64_t column, std::int64_t row, Place p) {
  const auto x = static_cast<double>(column), y = static_cast<double>(row);
  const double dx = std::max({x - p.x, p.x - (x + 1.0), 0.0}), dy = std::max({y - p.y, p.y - (y + 1.0), 0.0});
  return std::sqrt(dx * dx + dy * dy);
}

double distance_to_area(const CellGrid& grid, Place p) {
  double least = std::numeric_limits<double>::infinity();
  each_cell(grid, [&](auto column, auto row) { least = std::min(least, distance_to_cell(column, row, p)); });
  return least;
}

// All cells that touch x from both sides, or the one it is in.
std::vector<std::int64_t> cells_at(double x) {
  const auto cell = static_cast<std::int64_t>(std::floor(x));
  return std::floor(x) == x ? std::vector{cell - 1, cell} : std::vector{cell};
}

// By definition. Between two lines of the grid the segment is in one cell or along an edge; through a corner it gets
// where no two cells that face each other there are occupied.
bool blocked_by_definition(const CellGrid& grid, Place a, Place b) {
  const Place d = b - a;
  for (std::int64_t row = -1; row <= static_cast<std::int64_t>(grid.rows()); ++row)
    for (std::int64_t column = -1; column <= static_cast<std::int64_t>(grid.columns()); ++column) {
      const Place corner{static_cast<double>(column), static_cast<double>(row)};
      const double along = dot(corner - a, d);
      if (cross(d, corner - a) != 0.0 || along <= 0.0 || along >= squared_norm(d)) continue;
      if ((grid.occupied(column, row) && grid.occupied(column - 1, row - 1)) ||
          (grid.occupied(column - 1, row) && grid.occupied(column, row - 1)))
        return true;
    }
  std::vector<double> crossings{0.0, 1.0};
  const auto cut = [&](double from, double way) {
    for (double line = std::ceil(std::min(from, from + way)); way != 0.0 && line <= std::max(from, from + way); ++line)
      crossings.push_back((line - from) / way);
  };
  cut(a.x, d.x);
  cut(a.y, d.y);
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t k = 1; k < crossings.size(); ++k) {
    if (crossings[k] - crossings[k - 1] < 1e-9) continue;
    const double middle = (crossings[k] + crossings[k - 1]) / 2.0;
    const double x = d.x == 0.0 ? a.x : a.x + d.x * middle, y = d.y == 0.0 ? a.y : a.y + d.y * middle;
    bool all = true;
    for (const std::int64_t column : cells_at(x))
      for (const std::int64_t row : cells_at(y)) all &= grid.occupied(column, row);
    if (all) return true;
  }
  return false;
}

TEST(CellGrid, BlocksWhatMeetsItsInsideOrGoesBetweenTwoCellsThatTouch) {
  GridDraws draws(1);
  int blocked = 0, free = 0;
  for (int trial = 0; trial < 60000; ++trial) {
    const bool wide = trial % 3 == 0;
    const CellGrid grid = wide ? draws.grid(60, 9, 0.01) : draws.grid(6, 5, trial % 2 == 0 ? 0.4 : 0.1);
    const Place a = draws.quarter(grid, 3.0);
    Place b = draws.quarter(grid, 3.0);
    if (trial % 7 == 0) b.x = a.x;
    if (trial % 11 == 0) b.y = a.y;
    if (a == b) continue;
    const bool expected = blocked_by_definition(grid, a, b);
    (expected ? blocked : free) += 1;
    ASSERT_EQ(grid.blocks(a, b), expected) << trial << ": " << a.x << ' ' << a.y << " to " << b.x << ' ' << b.y << '\n'
                                           << grid.text();
    ASSERT_EQ(grid.blocks(b, a), expected) << trial;
  }
  EXPECT_GT(blocked, 5000);
  EXPECT_GT(free, 5000);
}

TEST(CellGrid, SaysOfAnyLineOfSightTheSameFromBothEnds) {
  GridDraws draws(2);
  for (int trial = 0; trial < 20000; ++trial) {
    const CellGrid grid = draws.grid(20, 20, 0.05);
    const Place a = draws.point(grid, 1.0), b = draws.point(grid, 1.0);
    ASSERT_EQ(grid.blocks(a, b), grid.blocks(b, a)) << trial;
    ASSERT_EQ(grid.blocks(a, b), blocked_by_definition(grid, a, b)) << trial;
  }
}

TEST(CellGrid, LetsALineOfSightPassAlongAnEdgeButNotWithinAThickWall) {
  const CellGrid grid = CellGrid::from_text("....\n.##.\n.##.\n....");
  EXPECT_FALSE(grid.blocks({0.0, 3.0}, {4.0, 3.0})) << "along its upper edge";
  EXPECT_TRUE(grid.blocks({0.0, 2.0}, {4.0, 2.0})) << "between its two rows of cells";
  EXPECT_FALSE(grid.blocks({0.0, 2.0}, {2.0, 4.0})) << "by its corner";
  EXPECT_FALSE(grid.blocks({0.0, 2.0}, {1.0, 2.0})) << "ends on it";
  const CellGrid diagonal = CellGrid::from_text(".#\n#.");
  EXPECT_TRUE(diagonal.blocks({0.5, 1.5}, {1.5, 0.5})) << "between two cells that touch at a corner";
  EXPECT_FALSE(diagonal.blocks({0.5, 1.5}, {1.0, 1.0})) << "to where they touch";
}

TEST(CellGrid, KnowsHowFarTheNextCellIs) {
  GridDraws draws(3);
  for (int trial = 0; trial < 3000; ++trial) {
    const CellGrid grid = trial % 2 == 0 ? draws.grid(40, 30, 0.003) : draws.grid(7, 9, 0.3);
    const Place p = trial % 3 == 0 ? draws.quarter(grid, 6.0) : draws.point(grid, 6.0);
    const double expected = distance_to_area(grid, p);
    const auto column = static_cast<std::int64_t>(std::floor(p.x)), row = static_cast<std::int64_t>(std::floor(p.y));
    if (!grid.occupied(column, row)) {
      ASSERT_DOUBLE_EQ(grid.clearance(p), expected) << trial;
      ASSERT_LE(grid.least_clearance(p), expected) << trial;
      if (grid.occupied_cells() > 0) {
        ASSERT_DOUBLE_EQ(distance(grid.nearest_surface_point(p), p), expected) << trial;
      }
      continue;
    }
    double to_free = std::numeric_limits<double>::infinity();
    for (std::int64_t j = -1; j <= static_cast<std::int64_t>(grid.rows()); ++j)
      for (std::int64_t i = -1; i <= static_cast<std::int64_t>(grid.columns()); ++i)
        if (!grid.occupied(i, j)) to_free = std::min(to_free, distance_to_cell(i, j, p));
    ASSERT_DOUBLE_EQ(grid.clearance(p), -to_free) << trial;
    ASSERT_DOUBLE_EQ(distance(grid.nearest_surface_point(p), p), to_free) << trial;
  }
}

TEST(CellGrid, KnowsWithinHowManyRowsAndColumnsAllIsFree) {
  GridDraws draws(4);
  const CellGrid grid = draws.grid(50, 40, 0.01);
  for (std::int64_t j = -3; j < 43; ++j)
    for (std::int64_t i = -3; i < 53; ++i) {
      std::int64_t least = 255;
      each_cell(grid, [&](auto column, auto row) {
        least = std::min(least, std::max(std::abs(column - i), std::abs(row - j)));
      });
      if (i >= 0 && j >= 0 && i < 50 && j < 40) ASSERT_EQ(grid.reach(i, j), least);
      else ASSERT_LE(grid.reach(i, j), least);
    }
}

TEST(CellGrid, GivesAGapThatIsNoMoreThanTheDistanceAndNotFarBelowIt) {
  GridDraws draws(5);
  int looked_at = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const CellGrid grid = draws.grid(60, 60, 0.001);
    const Place a = draws.point(grid, 5.0), b = draws.point(grid, 5.0);
    if (grid.blocks(a, b) || grid.occupied_cells() == 0) continue;
    double expected = std::numeric_limits<double>::infinity();
    each_cell(grid, [&](auto column, auto row) {
      for (int k = 0; k <= 400; ++k)
        expected = std::min(expected, distance_to_cell(column, row, a + (b - a) * (k / 400.0)));
    });
    ++looked_at;
    ASSERT_LE(grid.gap(a, b), expected + 1e-12) << trial;
    ASSERT_GE(grid.gap(a, b), 0.3 * expected - 2.0) << trial;
  }
  EXPECT_GT(looked_at, 300);
}

TEST(CellGrid, PushesADiscOutOfWallsAndCorners) {
  const CellGrid grid = CellGrid::from_text("20#\n16*#18.#\n20#\n");
  GridDraws draws(6);
  for (int trial = 0; trial < 20000; ++trial) {
    const double radius = draws.between(0.2, 3.0);
    const Place p{draws.between(0.3, 19.7), draws.between(0.3, 17.7)};
    const Place shift = grid.push_out(p, radius);
    ASSERT_GE(grid.clearance(p + shift), radius * (1.0 - 1e-6)) << p.x << ' ' << p.y << " radius " << radius;
    ASSERT_LE(norm(shift), 1.5 * (radius + 1.0)) << "no farther than needed";
    if (grid.clearance(p) >= radius) { ASSERT_EQ(shift, Place{}); }
  }
}

TEST(CellGrid, ListsTheNearestPointOfEachCellInReach) {
  GridDraws draws(7);
  for (int trial = 0; trial < 2000; ++trial) {
    const CellGrid grid = draws.grid(30, 20, 0.05);
    const Place p = draws.point(grid, 4.0);
    const double reach = draws.between(0.0, 8.0);
    std::vector<double> seen, expected;
    grid.each_near(p, reach, [&](Place point) { seen.push_back(distance(point, p)); });
    each_cell(grid, [&](auto column, auto row) {
      if (const double d = distance_to_cell(column, row, p); d <= reach) expected.push_back(d);
    });
    std::sort(seen.begin(), seen.end());
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(seen.size(), expected.size()) << trial;
    for (std::size_t k = 0; k < seen.size(); ++k) ASSERT_DOUBLE_EQ(seen[k], expected[k]);
  }
}

TEST(CellGrid, IsMadeUpOfItsBlocks) {
  GridDraws draws(8);
  for (int trial = 0; trial < 500; ++trial) {
    const CellGrid grid = draws.grid(12, 9, 0.6);
    std::vector<int> covered(12 * 9);
    grid.each_block([&](Place low, Place high) {
      for (auto y = static_cast<std::size_t>(low.y); y < static_cast<std::size_t>(high.y); ++y)
        for (auto x = static_cast<std::size_t>(low.x); x < static_cast<std::size_t>(high.x); ++x) ++covered[y * 12 + x];
    });
    for (std::int64_t y = 0; y < 9; ++y)
      for (std::int64_t x = 0; x < 12; ++x)
        ASSERT_EQ(covered[static_cast<std::size_t>(y * 12 + x)], grid.occupied(x, y) ? 1 : 0) << trial;
  }
  int blocks = 0;
  CellGrid::from_text("20#\n16*#18.#\n20#").each_block([&](Place, Place) { ++blocks; });
  EXPECT_EQ(blocks, 4);
}

TEST(CellGrid, IsTheSameAfterItsText) {
  GridDraws draws(9);
  for (int trial = 0; trial < 500; ++trial) {
    const CellGrid grid =
        draws.grid(1 + static_cast<std::size_t>(draws.between(0.0, 40.0)),
                   1 + static_cast<std::size_t>(draws.between(0.0, 20.0)), trial % 3 == 0 ? 0.02 : 0.5);
    ASSERT_EQ(CellGrid::text_fault(grid.text()), std::nullopt);
    ASSERT_EQ(CellGrid::from_text(grid.text()), grid) << grid.text();
  }
  EXPECT_EQ(CellGrid::from_text("  #####\n  #...#\r\n  #...#\n  #####\n").text(), "5#\n2*#3.#\n5#");
  EXPECT_TRUE(CellGrid::from_text("..#\n...").occupied(2, 1)) << "the first row is the highest";
}

TEST(CellGrid, SaysWhatIsWrongWithAText) {
  const auto fault = [](std::string_view text) { return CellGrid::text_fault(text).value_or("nothing"); };
  EXPECT_EQ(fault(""), "has no cells");
  EXPECT_EQ(fault("##\n#x"),
            "row 2 has a 'x'; cells are '#', occupied, or '.', free, with a number before several of "
            "the same");
  EXPECT_EQ(fault("###\n##"), "row 2 has 2 cells, those above have 3");
  EXPECT_EQ(fault("##\n\n##"), "row 2 has no cells");
  EXPECT_EQ(fault("0*##"), "row 1 has no cells");
  EXPECT_EQ(fault("##7"), "row 1 ends with a number; a number stands before '#' or '.'");
  EXPECT_EQ(fault("99999999999999999999*99999999999999999999."), "has more than 16777216 cells, as of 4096 x 4096");
  EXPECT_EQ(fault("4097*4096."), "has more than 16777216 cells, as of 4096 x 4096");
  EXPECT_EQ(fault("4096*4096."), "nothing");
}

}  // namespace
}  // namespace banyan::world
