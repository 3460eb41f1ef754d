// SPDX-License-Identifier: MIT
#include "banyan/controller/tree/table.hpp"

namespace banyan {

void TreeTable::sort(int k, const TreeTies& said, RobotId me) noexcept {
  members.set(k, said.role != Role::spare);
  below.set(k, said.parent == me || said.old_parent == me);
  untied.set(k, said.role != Role::root && up_of(said) == nobody && (said.grant == nobody || said.grant == me));
  std::uint8_t& hops = standings[static_cast<std::size_t>(k)].tree_hops;
  const bool matters = std::min(hops, said.tree_hops) <= least_hops;
  hops = said.tree_hops;
  if (matters) find_nearest();
}

void TreeTable::find_nearest() noexcept {
  least_hops = unreachable;
  for (int k = 0; k < size(); ++k) {
    const std::uint8_t hops = message(k).tree_hops;
    if (hops < least_hops) nearest = {};
    least_hops = std::min(least_hops, hops);
    nearest.set(k, hops == least_hops);
  }
}

void TreeTable::forget(int k) noexcept {
  const bool was_nearest = message(k).tree_hops == least_hops;
  close_gap(standings, k, size() + 1);
  close_gap(deaf_ticks, k, size() + 1);
  for (Rows* const rows : {&members, &nearest, &below, &untied, &deaf}) rows->close_gap(k);
  if (was_nearest) find_nearest();
}

void TreeTable::prefetch(std::size_t entries) const noexcept {
  Neighbors::prefetch(entries);
  prefetch_lines(&members, 5 * sizeof(Rows) + sizeof least_hops);
  prefetch_lines(standings.data(), entries * sizeof(TreeStanding));
}

}  // namespace banyan
