// SPDX-License-Identifier: MIT
#include "banyan/controller/outwards.hpp"

#include "banyan/controller/paper.hpp"
#include "banyan/controller/tree/parent_selection.hpp"

namespace banyan {
namespace {

// All robots join in SELECT PARENT; later only those that still matter to the tree.
bool may_join_outwards(const TreeRobot& robot) noexcept {
  return robot.self.phase == Phase::select_parent || robot.self.role != Role::spare;
}

// Never equality: with motion and occlusion the flood under-counts (protocol 4).
bool all_robots_counted(const TreeRobot& robot) noexcept { return robot.self.subtree >= robot.self.flood_robots; }

// SELECT PARENT: the nearest robot that has joined already.
void select_nearest_parent(TreeRobot& robot) noexcept {
  select_parent(robot, {.may_join = may_join_outwards(robot),
                        .workers_relay = false,
                        .accepts = [&](int k) { return robot.table().message(k).committed; },
                        .prefers = [&](int a, int b) { return robot.table().range(a) < robot.table().range(b); }});
}

constexpr Growth outwards_growth{.all_counted = all_robots_counted, .select_parent = select_nearest_parent};

}  // namespace

HealingParams outwards_defaults() noexcept { return {}; }  // the defaults of TreeParams

Output<TreeMessage> outwards_literal_step(const TreeParams& params, TreeState& state,
                                          const Inputs<Heard>& inputs) noexcept {
  return literal_step(outwards_growth, params, state, inputs);
}

Output<HealingMessage> outwards_step(const HealingParams& params, HealingState& state,
                                     const Inputs<Heard>& inputs) noexcept {
  return corrected_step(outwards_growth, params, state, inputs);
}

}  // namespace banyan
