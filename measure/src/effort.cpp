// SPDX-License-Identifier: MIT
#include "banyan/measure/effort.hpp"

#include <algorithm>

namespace banyan::measure {
namespace {

constexpr Column<Effort::Row> effort_table[] = {
    column<&Effort::Row::decisions>("decisions", "times a living robot has changed its role, parent or served target"),
    quantity<&Effort::Row::driven_m>("driven_m", "the way of a robot, mean over the robots at the start",
                                     "metres driven per robot"),
};

}  // namespace

std::span<const Column<Effort::Row>> Effort::columns() noexcept { return effort_table; }

Effort::Effort(const world::World& start)
    : position_(start.positions().begin(), start.positions().end()),
      alive_(start.alive().begin(), start.alive().end()),
      at_start_(start.arrived()) {
  choice_.reserve(start.size());
  for (const Report& report : start.reports()) choice_.push_back(of(report));
}

void Effort::observe(const world::World& world) {
  const auto alive = world.alive();
  const auto positions = world.positions();
  const auto reports = world.reports();
  for (std::size_t i = 0; i < alive.size(); ++i) {
    if (alive[i] == 0) continue;
    if (alive_[i] != 0) driven_m_ += distance(position_[i], positions[i]);  // whoever joins was put there
    const Choice choice = of(reports[i]);
    if (choice != choice_[i]) ++decisions_;
    choice_[i] = choice;
  }
  std::copy(positions.begin(), positions.end(), position_.begin());
  std::copy(alive.begin(), alive.end(), alive_.begin());
}

void Effort::sum_up(const Moment& /*end*/, Row& row) const {
  row.decisions = decisions_;
  row.driven_m = driven_m_ / static_cast<double>(at_start_);
}

}  // namespace banyan::measure
