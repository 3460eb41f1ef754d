// SPDX-License-Identifier: MIT
// The beginning and the end of a tick for robots that heal (tree/tick.hpp).
#pragma once

#include "healing/robot.hpp"
#include "tree/tick.hpp"

namespace banyan {

[[nodiscard]] HealingState initial_healing_state(RobotId id, bool worker, bool root) noexcept;
void begin_as(HealingState& self, RobotId id, bool worker, bool root) noexcept;  // in place

// A robot that has resigned from its target, or serves another's, stays with that, however long it is sent.
void follow_orders(HealingRobot& robot, const Orders& orders) noexcept;

void carry_memory(HealingState& self, const Carry& carry) noexcept;
void begin_tick(HealingRobot& robot, const Inputs<Heard>& inputs) noexcept;

// The tree's part and healing's. Index of the target that the message speaks of; -1: none.
int write_healing(const HealingRobot& robot, HealingMessage& message) noexcept;
[[nodiscard]] Report healing_report(const HealingState& state) noexcept;

void add_to(Digest& digest, const HealingState& state) noexcept;
void add_to(Digest& digest, const HealingMessage& message) noexcept;

}  // namespace banyan
