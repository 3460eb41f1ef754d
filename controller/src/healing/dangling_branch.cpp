// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/core/search.hpp"
#include "healing/healing.hpp"

namespace banyan {
namespace {

constexpr float near_enough = 0.15F;  // of C

void watch_children(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  const TreeTable& table = robot.table();
  const auto hangs = [&](int k) { return table.message(k).role != Role::spare; };
  const auto lives = [&](int k) { return hangs(k) && !fades(robot, k); };
  const auto any = [&](auto is) { return banyan::any_of(robot.children, is); };
  if (!robot.params.heals() || self.role != Role::connector || self.phase != Phase::grow_tree || any(lives)) {
    self.dangling_ticks = 0;
    return;
  }
  const auto leaves = [&](int k) { return hangs(k) && fades(robot, k); };
  const auto lost = first_of(robot.children, leaves);
  if (lost != robot.children.end()) {
    self.lost_child = table.position(*lost);
    self.dangling_ticks = static_cast<std::uint16_t>(robot.params.rounds(robot.params.pursue_for_drives));
  } else if (self.dangling_ticks > 0) {
    const bool done = norm(self.lost_child) < near_enough;
    self.dangling_ticks =
        done ? std::uint16_t{0} : static_cast<std::uint16_t>(std::max(self.dangling_ticks - robot.elapsed_ticks, 0));
  }
}

}  // namespace

void watch_branch(HealingRobot& robot) noexcept {
  watch_children(robot);
  robot.carries_on = robot.self.dangling_ticks > 0 && robot.useful_children == 0;
}

}  // namespace banyan
