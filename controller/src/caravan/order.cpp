// SPDX-License-Identifier: MIT
// The order: who may be whose parent.
#include "caravan/rules.hpp"

namespace banyan::caravan {

bool is_ahead(const State& self, const Statement& m) noexcept {
  return m.root == self.root ? m.root.id != nobody && is_newer(m.beat, self.beat) : is_newer(m.root, self.root);
}

// The pair flows down the tree, one less a hop.
void keep_up(Robot& robot) noexcept {
  State& self = robot.self;
  if (robot.is_root()) {
    self.beat = advanced(self.beat, robot.elapsed_rounds);
    self.label = 0;
    return;
  }
  const int k = robot.parent;
  if (k < 0 || robot.table().age(k) > 0) return;
  const Statement& m = robot.said(k);
  self.label = static_cast<std::uint16_t>(
      std::min(m.label + std::max(1, static_cast<int>(robot.range(k) * per_range)), UINT16_MAX - 1));
  if (self.rests) return;
  const Serial behind = advanced(m.beat, -1);
  if (m.root != self.root ? is_newer(m.root, self.root) : is_newer(behind, self.beat)) {
    self.root = m.root;
    self.beat = behind;
  }
}

}  // namespace banyan::caravan
