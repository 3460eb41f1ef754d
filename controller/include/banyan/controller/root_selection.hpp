// SPDX-License-Identifier: MIT
// SELECT ROOT (paper Sec. III-C): the root token moves from neighbour to neighbour towards the
// centroid, with an acknowledgement at every step, and then the next epoch opens.
#pragma once

#include "banyan/controller/robot.hpp"

namespace banyan {

// Takes the token if it is offered to this robot.
void accept_offer(Robot& robot) noexcept;

// The root in SELECT ROOT: offer the token to a better neighbour, wait for the acknowledgement, take
// the token back if none comes, or open the next epoch.
void select_root(Robot& robot) noexcept;

}  // namespace banyan
