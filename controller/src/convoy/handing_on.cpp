// SPDX-License-Identifier: MIT
#include "convoy/handing_on.hpp"

#include "convoy/shortcut.hpp"
#include "tree/parent_selection.hpp"

namespace banyan {

bool has_many_targets(const ConvoyRobot& robot) noexcept {
  return robot.self.forgets && robot.self.root_size != 0 && !is_counted_large(robot);
}

bool has_far_spares(const ConvoyRobot& robot) noexcept {
  const bool thin = robot.self.neighbors_at_start > 0;
  return (is_counted_large(robot) || has_many_targets(robot) || thin) && !robot.is_root();
}

bool is_held_by_branches(const ConvoyRobot& robot, int k) noexcept {
  const TreeStanding& m = robot.table().message(k);
  return m.call_hops <= 1 && robot.convoy_of(k).child_count > (m.role == Role::worker ? 0 : 1);
}

// Of its branches the one that has least far to go. If I hear only the one that has farthest to go, the others are
// probably opposite.
Vec2 place_beside(const ConvoyRobot& robot, int k) noexcept {
  constexpr float beside_junction = 0.175F;  // of C
  constexpr int as_far = 6;                  // of per_range: a smaller difference does not count
  const TreeTable& table = robot.table();
  const TreeStanding& junction = table.message(k);
  const Vec2 at = table.position(k);
  int farthest = -1;
  int other = -1;
  for (int n = 0; n < table.size(); ++n) {
    const TreeStanding& m = table.message(n);
    if (!table.alive(n) || m.parent != table.id(k) || m.role == Role::spare) continue;
    if (junction.role != Role::worker && farthest < 0 && m.want + as_far >= junction.want) farthest = n;
    else if (other < 0 || m.want < table.message(other).want) other = n;
  }
  const Vec2 away = farthest >= 0 ? at - table.position(farthest) : left_of(at);
  const Vec2 way = other >= 0 ? table.position(other) - at : away;
  return at + unit(way) * beside_junction;
}

bool leave_junction(ConvoyRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const TreeStanding& junction = table.message(robot.parent);
  if (!has_far_spares(robot) || junction.role != Role::connector || junction.need == Need::await) return false;
  if (!is_held_by_branches(robot, robot.parent)) return false;
  const bool calls = robot.self.call_hops == 0;
  if (calls && static_cast<float>(junction.want) <= per_range * robot.self.want + 2.0F) return false;
  const int k = table.find(junction.parent);
  if (k < 0 || table.message(k).role == Role::worker || table.message(k).need == Need::await) return false;
  if (!may_be_parent(robot, k, calls ? robot.parent_range() : robot.params.recruitment_distance)) return false;
  take_parent(robot, k);
  return true;
}

}  // namespace banyan
