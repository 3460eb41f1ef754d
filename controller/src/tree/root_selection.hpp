// SPDX-License-Identifier: MIT
// SELECT ROOT (paper Sec. III-C): the root token moves from neighbour to neighbour towards the
// centroid, with an acknowledgement at every step, and then the next epoch opens.
#pragma once

#include "banyan/controller/core/function_ref.hpp"
#include "tree/robot.hpp"

namespace banyan {

// Takes the token if it is offered to this robot. The offer that was taken; null if there was none.
const TreeMessage* accept_offer(TreeRobot& robot) noexcept;

// A former root, by a token with the number `held`, that has heard of its successor's token is tied to that robot from
// then on. Call it before the robot enters an epoch that its successor may have opened, which forgets the offer.
void hand_over(TreeRobot& robot, Serial held) noexcept;

// The root in SELECT ROOT: offer the token to a better neighbour, wait for the acknowledgement, take
// the token back if none comes, or open the next epoch. `may_inherit(k)`: neighbour k may become root. `leaves`: it
// offers the token to the nearest of them, wherever the centroid is.
void select_root(TreeRobot& robot, FunctionRef<bool(int k)> may_inherit, bool leaves = false) noexcept;

}  // namespace banyan
