// SPDX-License-Identifier: MIT
#include "banyan/measure/effort.hpp"

#include <algorithm>

namespace banyan::measure {

Effort::Effort(const world::World& world) : position_(world.positions().begin(), world.positions().end()) {
  choice_.reserve(world.size());
  for (const Report& report : world.reports()) choice_.push_back(of(report));
}

void Effort::observe(const world::World& world) {
  const auto alive = world.alive();
  const auto positions = world.positions();
  const auto reports = world.reports();
  for (std::size_t i = 0; i < alive.size(); ++i) {
    if (alive[i] == 0) continue;
    driven_m_ += distance(position_[i], positions[i]);
    const Choice choice = of(reports[i]);
    if (choice != choice_[i]) ++decisions_;
    choice_[i] = choice;
  }
  std::copy(positions.begin(), positions.end(), position_.begin());
}

}  // namespace banyan::measure
