// SPDX-License-Identifier: MIT
// How robots on batteries move: spares that wait save their charge.
#include <algorithm>

#include "banyan/controller/power/power.hpp"

namespace banyan {

float leisure(const PowerRobot& me, float clearance_m) noexcept {
  constexpr float slow = 0.25F;
  constexpr float room = 1.5F;  // times the clearance: whoever is nearer to an edge hurries
  const TreeState& self = me.robot.self;
  const TreeTable& table = me.robot.table();
  if (self.role != Role::spare || self.parent != nobody || self.request != nobody || self.called || me.power.travels)
    return 1.0F;
  for (int k = 0; k < table.size(); ++k) {
    const RobotId up = me.is_spare(k) ? nobody : table.message(k).parent;
    const int parent = up == nobody ? -1 : table.find(up);
    if (parent >= 0 && norm(nearest_on_segment(table.position(k), table.position(parent))) < room * clearance_m)
      return 1.0F;
  }
  return slow;
}

}  // namespace banyan
