// SPDX-License-Identifier: MIT
// The occupied cells of a map, each a box of its own.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "banyan/world/cell_grid.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::soak {

inline std::vector<world::Box> cells_of(const world::FloorMap& map) {
  const world::Vec2 along = world::Vec2{std::cos(map.angle_rad), std::sin(map.angle_rad)} * map.cell_m;
  const world::Vec2 across{-along.y, along.x};
  std::vector<world::Box> boxes;
  for (std::size_t row = 0; row < map.cells->rows(); ++row)
    for (std::size_t column = 0; column < map.cells->columns(); ++column) {
      if (!map.cells->occupied(static_cast<std::int64_t>(column), static_cast<std::int64_t>(row))) continue;
      const auto x = static_cast<double>(column) + 0.5, y = static_cast<double>(row) + 0.5;
      boxes.push_back({map.origin + along * x + across * y, {map.cell_m, map.cell_m}, map.angle_rad});
    }
  return boxes;
}

}  // namespace banyan::soak
