// SPDX-License-Identifier: MIT
#include "banyan/measure/roots.hpp"

#include <algorithm>

namespace banyan::measure {
namespace {

constexpr Column<Roots::Row> roots_table[] = {
    column<&Roots::Row::two_roots_ticks>("two_roots_ticks", "ticks with more than one living root",
                                         "ticks with two roots"),
    quantity<&Roots::Row::longest_two_roots_s>("longest_two_roots_s", "the longest time of that without a break",
                                               "longest time with two roots (s)"),
    column<&Roots::Row::epochs>("epochs", "the highest epoch reached"),
    quantity<&Roots::Row::start_phase_ticks>("start_phase_ticks", "mean length of START", "phase START (ticks)"),
    quantity<&Roots::Row::select_phase_ticks>("select_phase_ticks", "mean length of SELECT PARENT",
                                              "phase SELECT PARENT (ticks)"),
};

// The newest token decides which robot is the root; null if none lives.
const Report* newest_root(const world::World& world) {
  const auto reports = world.reports();
  const Report* root = nullptr;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Report& m = reports[i];
    if (world.alive()[i] != 0 && m.role == Role::root && (root == nullptr || has_newer_root(m, *root))) root = &m;
  }
  return root;
}

}  // namespace

std::span<const Column<Roots::Row>> Roots::columns() noexcept { return roots_table; }

void Roots::observe(const Moment& now, Row& row) {
  streak_ = now.tick.roots > 1 ? streak_ + 1 : 0;
  row.two_roots_ticks += now.tick.roots > 1 ? 1 : 0;
  longest_ = std::max(longest_, streak_);
  const Report* const root = newest_root(now.world);
  if (root == nullptr) return;
  if (const int further = ahead_by(root->epoch, last_epoch_); further > 0) {
    row.epochs += static_cast<std::uint64_t>(further);
    last_epoch_ = root->epoch;
  }
  if (root->phase == Phase::start_tree) ++start_ticks_;
  if (root->phase == Phase::select_parent) ++select_ticks_;
}

void Roots::sum_up(const Moment& end, Row& row) const {
  const double epochs = std::max(1.0, static_cast<double>(row.epochs));
  row.start_phase_ticks = static_cast<double>(start_ticks_) / epochs;
  row.select_phase_ticks = static_cast<double>(select_ticks_) / epochs;
  row.longest_two_roots_s = static_cast<double>(longest_) * end.world.scenario().tick_s;
}

}  // namespace banyan::measure
