// SPDX-License-Identifier: MIT
// One cost decides who is whose parent: the first choice, repair, insertion, release and merging are one rule.
#include "caravan/rules.hpp"

namespace banyan::caravan {
namespace {

constexpr float steep = 3.0F;          // what the longest edge costs beyond its length, C
constexpr float soon = 0.075F;         // before an edge is worth a spare it begins to cost more, C
constexpr float relaxed = 0.93F;       // an edge that need not grow any more is good up to here
constexpr float costs_leaving = 4.0F;  // it goes its own way and cannot be towed, or runs low
constexpr float costs_silence = 5.0F;  // the parent is hidden, or dead
constexpr int most_rest = 15;          // rounds

// Up to where an edge may grow it costs its length; then the more, the sooner it will hold somebody back.
float stretch(const Robot& robot, float d) noexcept {
  const Params& p = robot.params;
  d = robot.stretched(d);
  const float start = robot.is_wanted() ? p.need_distance - soon : relaxed;
  return steep * std::max(0.0F, (d - start) / (p.longest_edge - start));
}

// Without the hazard.
float cost(const Robot& robot, int k) noexcept {
  const Statement& m = robot.said(k);
  const Params& p = robot.params;
  const float d = robot.range(k);
  const bool is_parent = k == robot.parent;
  float c = d + stretch(robot, d);
  if (robot.table().age(k) > robot.hidden_after()) c += costs_silence;
  if (is_newer(robot.self.newest, m.root)) c += costs_silence;  // it has not heard of the new root
  c += from_fixed(m.label);
  if (m.role == Role::spare) c += p.robot_cost * static_cast<float>(m.hops);
  // It is about to go, and would stay for me.
  if (m.role == Role::connector && m.children <= (robot.table().id(k) == robot.self.left ? 1 : 0)) c += p.robot_cost;
  if (m.leaving) c += costs_leaving;
  if (m.role == Role::worker && robot.self.want > 0) c += costs_leaving;
  // The parent serves only me, and could go.
  if (robot.parent >= 0 && (is_parent || m.parent == robot.self.parent) && robot.serves_only_me(robot.parent))
    c += p.robot_cost;
  return c;
}

// It is heard, tied to a root, not below me as far as I know, and in reach; without a parent I take what there is.
bool is_candidate(const Robot& robot, int k) noexcept {
  const Statement& m = robot.said(k);
  const bool bound = m.root.id != nobody && (m.parent != nobody || m.role == Role::root);
  const bool free = robot.parent < 0 || robot.is_lost(robot.parent);
  return robot.table().age(k) <= 1 && bound && m.parent != robot.self.id &&
         (free || robot.range(k) < robot.params.longest_edge);
}

}  // namespace

void take_parent(Robot& robot, int k) noexcept {
  State& self = robot.self;
  // The old parent is joined to the root by others, unless it believes in another root: then I join it to mine, and a
  // change that meets no other root leaves that promise as it is.
  if (robot.parent >= 0 && robot.said(robot.parent).root != robot.said(k).root) {
    robot.other = robot.parent;
    self.other = self.parent;
    self.other_rounds = 0;
  } else if (robot.other == k) {
    robot.other = -1;
    self.other = nobody;
  }
  self.left = self.parent;
  robot.parent = k;
  self.parent = robot.table().id(k);
  self.rests = false;
}

void choose_parent(Robot& robot) noexcept {
  State& self = robot.self;
  const Table& table = robot.table();
  if (robot.is_root()) {
    self.parent = nobody;
    robot.parent = -1;
    return;
  }
  const float present = robot.parent < 0
                            ? not_counted
                            : cost(robot, robot.parent) + hazard(robot, robot.parent) - robot.params.hysteresis;
  float best_cost = present, wish_cost = present;
  int best = -1, wish = -1;
  for (int k = 0; k < table.size(); ++k) {
    // No term is negative: most robots are farther from the root than I am.
    if (k == robot.parent || robot.range(k) + from_fixed(robot.said(k).label) >= std::max(best_cost, wish_cost) ||
        !is_candidate(robot, k))
      continue;
    const bool ahead = is_ahead(self, robot.said(k));
    float c = cost(robot, k);
    if (c >= (ahead ? best_cost : wish_cost)) continue;
    c += hazard(robot, k);
    if (ahead && c < best_cost) best_cost = c, best = k;
    if (!ahead && c < wish_cost && !robot.children.has(table.find(robot.said(k).parent))) wish_cost = c, wish = k;
  }
  if (best >= 0 && best_cost <= wish_cost) {
    if (robot.parent >= 0 && robot.said(best).role == Role::spare && self.role != Role::spare) ++self.tally.insertions;
    take_parent(robot, best);
    return;
  }
  const bool may_rest = self.rests ? self.rest_rounds < most_rest : self.rest_rounds == 0;
  self.rests = robot.parent >= 0 && wish >= 0 && wish_cost < best_cost && may_rest;
  if (self.rests) robot.add_elapsed(self.rest_rounds);
  else {
    self.rest_rounds = static_cast<std::uint16_t>(std::max(0, self.rest_rounds - robot.elapsed_rounds));
    if (best >= 0) take_parent(robot, best);
  }
}

}  // namespace banyan::caravan
