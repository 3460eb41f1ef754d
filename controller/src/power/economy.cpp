// SPDX-License-Identifier: MIT
// How robots on batteries move: out of the lines of sight of those that change places, and spares that wait save their
// charge.
#include "power/power.hpp"

namespace banyan {
namespace {

// Neighbour k takes another robot's place, or another one takes its place or is on its way to do so.
bool changes_places(const PowerRobot& me, int k) noexcept {
  const PowerStanding& said = me.standing(k);
  return said.relieves != nobody ||
         (said.leaving && (me.robot.table().message(k).grant != nobody || has_reliever(me, k)));
}

}  // namespace

float give_way(const PowerRobot& me, float clearance, Guard& guard) noexcept {
  constexpr float slow = 0.25F;             // of its speed: a charged spare that waits
  constexpr float room = 1.5F;              // times the clearance: a robot nearer to an edge hurries
  constexpr float hides = 0.035F;           // from body to line of sight
  constexpr float to_pass = 0.05F;          // for those that take part
  constexpr float to_move = 0.09F;          // for others, since robots that change places move
  constexpr float hesitates_drives = 0.8F;  // then it pushes through
  const HealingRobot& robot = me.robot;
  const TreeState& self = robot.self;
  const TreeTable& table = robot.table();
  const bool free = self.role == Role::spare && self.parent == nobody;
  const int leaver = table.find(me.power.said.relieves);
  if (!free && leaver < 0) return 1.0F;
  const bool joins = leaver >= 0 || self.spare_state == SpareState::extend_edge;
  const bool pushes = leaver < 0 && self.request_ticks > robot.params.rounds(hesitates_drives);
  bool waits = free && self.request == nobody && !self.called && !me.power.travels;
  const auto keep_apart = [&](Vec2 to) {
    const float d = norm(to);
    if (d > hides) guard.add_limit(to / d, (d - (joins ? to_pass : to_move)) * robot.params.guard_rate);
  };
  for (int k = 0; k < table.size(); ++k) {
    if (k == leaver || me.is_spare(k)) continue;
    const Vec2 at = table.position(k);
    const RobotId id = up_of(table.message(k));
    if (leaver >= 0 && robot.is_tree_neighbor(k)) {
      const Vec2 body = table.position(leaver);
      keep_apart(-nearest_on_segment(-body, at - body));
    }
    const int up = id == self.id ? -1 : table.find(id);
    if (up < 0) continue;
    const Vec2 to = nearest_on_segment(at, table.position(up));
    waits = waits && norm(to) >= room * clearance;
    if (!pushes && table.id(k) != self.request && (changes_places(me, k) || changes_places(me, up))) keep_apart(to);
  }
  return waits ? slow : 1.0F;
}

}  // namespace banyan
