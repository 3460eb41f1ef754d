// SPDX-License-Identifier: MIT
#include "healing/link_guard.hpp"

#include <algorithm>

#include "healing/healing.hpp"
#include "healing/tie.hpp"
#include "tree/motion.hpp"

namespace banyan {
namespace {

// No longer than that, less by how far neighbour k may be from where it was measured. Where packets get lost many in a
// row it may come back from there, and a robot that does not hear it need not drive to it, only stay. But far away it
// may be silent because the signal has faded: up to where that is rare it comes nearer.
void guard_link(const HealingRobot& robot, int k, float longest, Guard& guard) noexcept {
  constexpr float near = 0.77F;  // of C
  const TreeTable& table = robot.table();
  const float strayed = strayed_way(robot, k);
  float limit = longest - table.spread() - strayed;
  if (robot.has_bursts() && strayed > 0.0F) limit = std::max(limit, std::min(table.range(k), near) - table.spread());
  guard.add(table.position(k), limit, robot.params.guard_rate);
}

}  // namespace

void guard_edges(const HealingRobot& robot, bool lets_go, Guard& guard) noexcept {
  lets_go = lets_go && !robot.has_bursts();
  for_each_tree_neighbor(robot, [&](int k) {
    // The way back to a robot that went out of sight leads round the obstacle, not straight to it.
    if (robot.table().alive(k) || (!lets_go && robot.obstacles.empty()))
      guard_link(robot, k, robot.params.ideal_distance, guard);
  });
}

void guard_links(const HealingRobot& robot, bool lets_go, Guard& guard) noexcept {
  lets_go = lets_go && !robot.has_bursts();
  const TreeTable& table = robot.table();
  const TreeParams& p = robot.params;
  const float longest = longest_link;
  const float limited = longest - 2.0F * p.speed_gain / p.guard_rate;  // below it full speed is allowed
  const bool untied = robot.hold < 0 && robot.up() < 0 && !robot.is_root();
  // In a grown tree only robots of its epoch wait for a hold, and those that have not heard of any: others are cut off,
  // or of another fragment.
  const bool waits_for_all = robot.self.phase < Phase::grow_tree || robot.has_bursts();
  const auto holds_me = [&](int k) {
    if (!table.alive(k)) return !lets_go && is_tie(robot, k);
    const TreeStanding& m = table.message(k);
    const bool is_gap = robot.is_deaf(k) && is_newer(robot.self.epoch, m.epoch);  // unless I am untied
    const bool tied_to_me = k == robot.hold || is_gap || hold_of(m) == robot.self.id;
    const bool waits = is_untied(m) && (m.epoch == robot.self.epoch || m.phase == Phase::init || waits_for_all);
    return !robot.is_tree_neighbor(k) && (tied_to_me || (!lets_go && (untied || waits)));
  };
  // Where no packets get lost, no others can hold me.
  Rows rows = robot.tie_ticks > 0 || untied ? table.all() : table.untied;
  for (const int k : {robot.hold, robot.gap})
    if (k >= 0) rows.set(k, true);
  rows.for_each([&](int k) {
    if (k == robot.parent || k == robot.old_parent || table.range(k) + strayed_way(robot, k) <= limited || !holds_me(k))
      return;
    guard_link(robot, k, longest, guard);
  });
}

void push_nobody(const HealingRobot& robot, Guard& guard) noexcept {
  constexpr float apart = 2.1F;  // of the radius: bodies do not touch yet
  constexpr float near = 3.15F;  // nearer they slow down
  const TreeTable& table = robot.table();
  const HealingParams& p = robot.params;
  const HealingState& self = robot.self;
  const float room_apart = apart * p.body_radius;
  const bool all = robot.passes_targets_on || goes_by_memory(self);
  (all ? table.all() : table.members).for_each([&](int k) {
    if (table.age(k) > 0 || table.range(k) >= near * p.body_radius) return;
    const RobotId serves = self.healing_standings[static_cast<std::size_t>(k)].serves;
    if (!all && (table.message(k).role != Role::worker || serves == table.id(k))) return;
    guard.add_limit(unit(table.position(k)), std::max(0.0F, table.range(k) - room_apart) * p.guard_rate);
  });
}

}  // namespace banyan
