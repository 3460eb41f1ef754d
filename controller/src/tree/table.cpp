// SPDX-License-Identifier: MIT
#include "banyan/controller/tree/table.hpp"

namespace banyan {

void TreeTable::sort(int k, const TreeTies& said, RobotId me) noexcept {
  members.set(k, said.role != Role::spare);
  rooted.set(k, said.tree_hops == 0);
  below.set(k, said.parent == me || said.old_parent == me);
  untied.set(k, said.role != Role::root && up_of(said) == nobody && (said.grant == nobody || said.grant == me));
}

void TreeTable::forget(int k) noexcept {
  close_gap(standings, k, size() + 1);
  close_gap(deaf_ticks, k, size() + 1);
  for (Rows* const rows : {&members, &rooted, &below, &untied, &deaf}) rows->close_gap(k);
}

void TreeTable::prefetch(std::size_t entries) const noexcept {
  Neighbors::prefetch(entries);
  prefetch_lines(&members, 5 * sizeof(Rows));
  prefetch_lines(standings.data(), entries * sizeof(TreeStanding));
}

}  // namespace banyan
