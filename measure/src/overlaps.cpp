// SPDX-License-Identifier: MIT
#include "banyan/measure/overlaps.hpp"

#include <algorithm>

namespace banyan::measure {
namespace {

constexpr Column<Overlaps::Row> overlaps_table[] = {
    {"overlap_ticks", "in which bodies of living robots overlap; empty unless robot.body is linear", 0,
     [](const Overlaps::Row& row) -> Cell {
       return row.overlap_ticks < 0 ? Cell{} : Cell{static_cast<std::uint64_t>(row.overlap_ticks)};
     },
     "ticks with bodies that overlap"},
};

}  // namespace

std::span<const Column<Overlaps::Row>> Overlaps::columns() noexcept { return overlaps_table; }

Overlaps::Overlaps(const world::World& start)
    : reach_m_{2.0 * start.scenario().robot.radius_m},
      ticks_{start.scenario().robot.body == world::BodyModel::linear ? 0 : -1} {
  if (ticks_ == 0) by_x_.reserve(start.size());
}

void Overlaps::observe(const world::World& world) {
  if (ticks_ < 0) return;
  const auto alive = world.alive();
  const auto positions = world.positions();
  by_x_.clear();
  for (std::size_t i = 0; i < alive.size(); ++i)
    if (alive[i] != 0) by_x_.push_back(positions[i]);
  std::sort(by_x_.begin(), by_x_.end(), [](world::Vec2 a, world::Vec2 b) { return a.x < b.x; });
  if (any()) ++ticks_;
}

bool Overlaps::any() const noexcept {
  for (std::size_t a = 0; a < by_x_.size(); ++a)
    for (std::size_t b = a + 1; b < by_x_.size() && by_x_[b].x - by_x_[a].x < reach_m_; ++b)
      if (squared_norm(by_x_[b] - by_x_[a]) < reach_m_ * reach_m_) return true;
  return false;
}

}  // namespace banyan::measure
