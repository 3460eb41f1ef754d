// SPDX-License-Identifier: MIT
// The paper's own ways: what a policy does unless it says otherwise.
#include "banyan/controller/policy.hpp"

#include "banyan/controller/motion.hpp"
#include "banyan/controller/spare_management.hpp"

namespace banyan {

float Policy::rest_distance(const Params& params) const noexcept { return params.arrival_distance_m; }

bool Policy::needs_spare(const Robot& robot) const noexcept { return is_stretched(robot) || child_in_need(robot); }

bool Policy::reconstructs(const Robot&) const noexcept { return true; }

bool Policy::may_call(const Robot&) const noexcept { return true; }

bool Policy::may_insert(const Robot& robot, int owner, int parent) const noexcept {
  const Neighborhood& table = robot.table();
  return norm((table.position(owner) + table.position(parent)) * 0.5F) <= robot.params.insertion_distance_m;
}

bool Policy::may_inherit(const Robot&, int) const noexcept { return true; }

void Policy::tend_tree(Robot&) const noexcept {}

void Policy::limit_motion(const Robot&, Guard&) const noexcept {}

Vec2 Policy::tree_motion(const Robot& robot) const noexcept { return spring_motion(robot); }

Vec2 Policy::spare_motion(const Robot& robot) const noexcept { return attendance_motion(robot); }

}  // namespace banyan
