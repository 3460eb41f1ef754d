// SPDX-License-Identifier: MIT
// Rule 6: edges are kept in sight.
#include "convoy/shortcut.hpp"

#include <algorithm>

#include "convoy/companions.hpp"
#include "convoy/towing.hpp"
#include "obstacles/sight.hpp"
#include "tree/parent_selection.hpp"

namespace banyan {
namespace {

// Fractions of `clearance`: a robot so near to the line of sight may block it soon, or very soon.
constexpr float danger = 0.8F;
constexpr float urgency = 0.7F;
constexpr float impossible = 1e9F;

// How bad neighbour k would be as parent in place of one that is hidden, or soon will be. The nearer to the
// old edge the better, and a robot of the tree rather than a spare, which joins because I name it as parent.
float repair_cost(const ConvoyRobot& robot, int k, bool urgent) noexcept {
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  const TreeStanding& m = table.message(k);
  if (k == robot.parent || table.age(k) > 0 || !robot.is_sure(k) || table.range(k) > robot.parent_range())
    return impossible;
  const bool spare = m.role == Role::spare && m.parent == nobody && m.request == nobody &&
                     m.epoch == robot.self.epoch && m.tree_hops != unreachable &&
                     (robot.convoy_of(k).below == nobody || robot.table().age(robot.parent) > 1);
  if (!spare && !is_rooted(robot, k)) return impossible;
  if (robot.power != nullptr && (is_leaving(robot, k) || (spare && !is_charged(*robot.power, k)))) return impossible;
  constexpr float costs_unclear = 2.0F;  // of C: as much as all the rest can be
  const bool clear = sees_clearly(robot, k, p.clearance);
  if (!clear && !(urgent && sees_clearly(robot, k, narrow * p.clearance))) return impossible;
  const bool leaves = m.role == Role::worker && robot.self.want > 0.0F;  // it cannot be towed
  return distance_to_segment(table.position(k), Vec2{}, table.position(robot.parent)) +
         (spare || leaves ? 1.0F : 0.0F) + (clear ? 0.0F : costs_unclear);
}

}  // namespace

Outlook outlook(const ConvoyRobot& robot) noexcept {
  constexpr int hidden_ticks = 1;  // silent for longer it is hidden
  const float clearance = robot.params.clearance;
  const bool hidden = robot.table().age(robot.parent) > std::max(hidden_ticks, usual_silence_ticks(robot));
  // Companions stand near edges. Where robots hide nothing, that endangers none.
  if (has_companions(robot.params) && !robot.params.line_of_sight) return {hidden, hidden};
  const ConvoyMessage* parent = robot.parent_message();
  const bool warned = parent != nullptr && parent->warned == robot.self.id;
  const bool endangered = hidden || warned || !sees_clearly(robot, robot.parent, danger * clearance);
  return {endangered, endangered && (hidden || warned || !sees_clearly(robot, robot.parent, urgency * clearance))};
}

// Takes the best new parent that is ahead of me, a spare only when it is urgent. If there is none, my sequence
// number rests, so that the others get ahead; not for long, for they may all be below me in the tree.
void keep_in_sight(ConvoyRobot& robot, bool urgent) noexcept {
  ConvoyState& self = robot.self;
  const TreeTable& table = robot.table();
  int best = -1;
  int behind = -1;
  float best_cost = impossible;
  float behind_cost = impossible;
  for (int k = 0; k < table.size(); ++k) {
    const float cost = repair_cost(robot, k, urgent);
    const bool ahead = is_ahead(robot, k);
    if (!ahead && cost < behind_cost) {
      behind_cost = cost;
      behind = k;
    } else if (ahead && cost < best_cost && (urgent || table.message(k).role != Role::spare)) {
      best_cost = cost;
      best = k;
    }
  }
  if (best < 0) {
    self.pending_parent = behind < 0 || ++self.pending_ticks > pending_limit_ticks ? nobody : table.id(behind);
    return;
  }
  self.grant = nobody;  // of the edge that is given up
  take_parent(robot, best);
}

bool step_before_parent(ConvoyRobot& robot) noexcept {
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  const int k = table.find(table.message(robot.parent).parent);
  if (k < 0 || table.age(k) > 0) return false;
  const float d = distance_to_segment(Vec2{}, table.position(robot.parent), table.position(k));
  if (d > danger * p.clearance || !may_be_parent(robot, k, robot.parent_range())) return false;
  take_parent(robot, k);
  return true;
}

// The child may not see a robot that is about to block the edge, because others hide it; its parent warns it.
RobotId child_to_warn(const ConvoyRobot& robot) noexcept {
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  for (const int k : robot.children)
    if (table.message(k).role != Role::spare && table.age(k) == 0 && !sees_clearly(robot, k, danger * p.clearance))
      return table.id(k);
  return nobody;
}

}  // namespace banyan
