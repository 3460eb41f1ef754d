// SPDX-License-Identifier: MIT
// SELECT ROOT (paper Sec. III-C): the root token moves from neighbour to neighbour towards the
// centroid, with an acknowledgement at every step, and then the next epoch opens.
#pragma once

#include "banyan/controller/core/function_ref.hpp"
#include "banyan/controller/tree/robot.hpp"

namespace banyan {

// Takes the token if it is offered to this robot. The offer that was taken; null if there was none.
const TreeMessage* accept_offer(TreeRobot& robot) noexcept;

// One that was root, by a token with the number `held`, and has heard of its heir's token is tied to the heir from
// then on. To be called before it enters the epoch that the heir may have opened already: that forgets the offer.
void hand_over(TreeRobot& robot, Serial held) noexcept;

// The root in SELECT ROOT: offer the token to a better neighbour, wait for the acknowledgement, take
// the token back if none comes, or open the next epoch. `may_inherit(k)`: neighbour k may become root.
void select_root(TreeRobot& robot, FunctionRef<bool(int k)> may_inherit) noexcept;

}  // namespace banyan
