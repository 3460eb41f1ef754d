// SPDX-License-Identifier: MIT
#include "banyan/controller/inwards.hpp"

#include "banyan/controller/paper.hpp"
#include "banyan/controller/tree/parent_selection.hpp"

namespace banyan {
namespace {

bool may_join_inwards(const TreeRobot& robot) noexcept { return robot.self.is_worker || is_named_parent(robot); }

bool all_workers_counted(const TreeRobot& robot) noexcept {
  return robot.self.subtree_workers >= robot.self.flood_workers;
}

// SELECT PARENT: the candidate with the smallest distance to the root; corrected: within S if there is one.
void select_inner_parent(TreeRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const auto is_safe = [&](int k) {
    return robot.reading.prefers_safe_parent && table.range(k) <= robot.params.safe_range;
  };
  const auto is_better = [&](int a, int b) {
    return is_safe(a) != is_safe(b) ? is_safe(a) : table.message(a).label < table.message(b).label;
  };
  select_parent(robot, {.may_join = may_join_inwards(robot),
                        .workers_relay = false,
                        .accepts = [](int) { return true; },
                        .prefers = is_better});
}

constexpr Growth inwards_growth{.all_counted = all_workers_counted, .select_parent = select_inner_parent};

}  // namespace

HealingParams inwards_defaults() noexcept {
  HealingParams p;
  p.safe_range = 0.67627905F;
  p.avoidance_range = 0.20495F;
  p.ideal_distance = 0.7704205F;
  p.interaction_gain = 0.05F;
  p.target_gain = 0.2539F;
  p.reconfiguration_drives = 4.4F;
  p.liveness_rounds = 5.0F;
  p.recruitment_distance = 0.6606765F;
  p.insertion_distance = 0.0331975F;
  return p;
}

Output<TreeMessage> inwards_literal_step(const TreeParams& params, TreeState& state,
                                         const Inputs<Heard>& inputs) noexcept {
  return literal_step(inwards_growth, params, state, inputs);
}

Output<HealingMessage> inwards_step(const HealingParams& params, HealingState& state,
                                    const Inputs<Heard>& inputs) noexcept {
  return corrected_step(inwards_growth, params, state, inputs);
}

}  // namespace banyan
