// SPDX-License-Identifier: MIT
// Epochs, phases and barriers (paper Fig. 1, protocol 4). "Go" spreads by gossip over the whole radio
// graph and only grows, so a lost message delays a robot but never strands it.
#pragma once

#include "banyan/controller/robot.hpp"

namespace banyan {

// Adopts the newest root token and the largest (epoch, phase) among the packets just heard.
void listen(Robot& robot) noexcept;

// The root's barriers: opens the next phase when its condition holds, or its time is over.
void advance(Robot& robot) noexcept;

// Enters (epoch, phase): a new epoch makes the parent the old parent and forgets labels and grants;
// GROW TREE forgets the old tree.
void enter(Robot& robot, std::uint16_t epoch, Phase phase) noexcept;

}  // namespace banyan
